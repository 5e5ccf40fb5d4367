//! Materials.

use numpy::{PyReadonlyArray3, PyUntypedArrayMethods};
use pyo3::prelude::*;
use trigon_math::Vec4;
use trigon_scene::{
    AlphaMode, Material, MaterialId, MetallicRoughness, Scene, Shading, Texture, TextureBinding,
    TextureFormat,
};

use crate::arrays::color;
use crate::errors::value_error;

/// How a surface looks. Colours are sRGB, three or four numbers from 0 to 1.
///
/// Without `metallic` and `roughness` it is a plastic; `unlit` shows the colour as it is. `texture` is an image of
/// (height, width, 3 or 4) bytes in sRGB, multiplied with the colour; (0, 0) of texture coordinates is its upper left
/// corner.
///
/// >>> import trigon3d
/// >>> gold = trigon3d.Material((1.0, 0.86, 0.57), metallic=1.0, roughness=0.3)
#[pyclass(name = "Material", module = "trigon3d", frozen)]
#[derive(Clone)]
pub(crate) struct PyMaterial {
    material: Material,
    texture: Option<Texture>,
}

#[pymethods]
impl PyMaterial {
    #[new]
    #[pyo3(signature = (
        color=vec![0.8, 0.8, 0.8], *, metallic=None, roughness=None, emission=None, unlit=false, double_sided=true,
        alpha_mode="opaque", alpha_cutoff=0.5, texture=None, name=String::new()
    ))]
    fn new(
        color: Vec<f32>,
        metallic: Option<f32>,
        roughness: Option<f32>,
        emission: Option<Vec<f32>>,
        unlit: bool,
        double_sided: bool,
        alpha_mode: &str,
        alpha_cutoff: f32,
        texture: Option<&Bound<'_, PyAny>>,
        name: String,
    ) -> PyResult<Self> {
        let usual = Material::default();
        let shading = match (unlit, metallic, roughness) {
            (true, ..) => Shading::Unlit,
            (false, None, None) => usual.shading,
            (false, metallic, roughness) => {
                let [metallic, roughness] = [metallic.unwrap_or(0.0), roughness.unwrap_or(1.0)];
                if !(0.0..=1.0).contains(&metallic) || !(0.0..=1.0).contains(&roughness) {
                    return Err(value_error("metallic and roughness go from 0 to 1"));
                }
                Shading::MetallicRoughness(MetallicRoughness {
                    metallic,
                    roughness,
                    ..MetallicRoughness::default()
                })
            }
        };
        let alpha_mode = match alpha_mode {
            "opaque" => AlphaMode::Opaque,
            "blend" => AlphaMode::Blend,
            "mask" => AlphaMode::Mask { cutoff: alpha_cutoff },
            other => {
                return Err(value_error(format!(
                    "alpha_mode is {other:?}, not \"opaque\", \"blend\" or \"mask\""
                )));
            }
        };
        let material = Material {
            name,
            base_color: self::color(&color, "color")?,
            shading,
            emissive: emission.map_or(Ok(Vec4::ZERO), |light| self::color(&light, "emission"))?.truncate(),
            alpha_mode,
            double_sided,
            ..usual
        };
        Ok(Self { material, texture: texture.map(image).transpose()? })
    }
}

impl PyMaterial {
    /// Adds it to a scene, with its texture.
    pub(crate) fn add_to(&self, scene: &mut Scene) -> MaterialId {
        let mut material = self.material.clone();
        if let Some(texture) = &self.texture {
            let texture = scene.add_texture("texture", texture.clone());
            material.base_color_texture = Some(TextureBinding::new(texture));
        }
        scene.add_material(material)
    }
}

/// An image of bytes as a texture.
fn image(value: &Bound<'_, PyAny>) -> PyResult<Texture> {
    let array = value.py().import("numpy")?.call_method1("ascontiguousarray", (value,))?;
    let array: PyReadonlyArray3<'_, u8> = array
        .extract()
        .map_err(|_| value_error("texture is no array of (height, width, 3 or 4) bytes (uint8)"))?;
    let &[height, width, channels] = array.shape() else {
        return Err(value_error("texture has no three axes"));
    };
    let bytes = array.as_slice().map_err(value_error)?;
    let texels: Vec<[u8; 4]> = match channels {
        3 => bytes.as_chunks::<3>().0.iter().map(|&[r, g, b]| [r, g, b, 255]).collect(),
        4 => bytes.as_chunks::<4>().0.to_vec(),
        other => return Err(value_error(format!("texture has {other} channels, not 3 or 4"))),
    };
    let side = |side| u32::try_from(side).map_err(value_error);
    Texture::new(side(width)?, side(height)?, texels, TextureFormat::Srgb).map_err(value_error)
}
