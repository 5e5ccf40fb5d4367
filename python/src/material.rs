//! Materials and their textures.

use std::path::PathBuf;

use numpy::PyReadonlyArray3;
use pyo3::prelude::*;
use trigon_io::{Limits, load_image};
use trigon_math::Vec4;
use trigon_scene::{
    AlphaMode, Material, MaterialId, MaterialTexture, MetallicRoughness, Scene, Shading, Texture,
    TextureBinding,
};

use crate::arrays::Channels;
use crate::errors::{load_error, value_error};

/// How a surface looks. Colours are sRGB, three or four numbers from 0 to 1.
///
/// Without `metallic`, `roughness` and their texture it is a plastic; `unlit` shows the colour as it is. Textures are
/// arrays of bytes, (height, width) or (height, width, 1, 3 or 4), or paths of PNG, JPEG or WebP files; (0, 0) of texture
/// coordinates is their upper left corner. They mean what they do in glTF:
///
/// - `texture` (sRGB) is multiplied with `color`, and `emissive_texture` (sRGB) with `emission`.
/// - `metallic_roughness_texture`: green is multiplied with `roughness`, blue with `metallic`.
/// - `normal_texture`: directions, of which `normal_scale` multiplies x and y. Y points up in the image.
/// - `occlusion_texture`: red is how much ambient light arrives; `occlusion_strength` goes from 0 to 1.
///
/// Factors that a texture is multiplied with are 1 unless they are given.
///
/// >>> import numpy, trigon3d
/// >>> gold = trigon3d.Material((1.0, 0.86, 0.57), metallic=1.0, roughness=0.3)
/// >>> flat = numpy.full((4, 4, 3), [128, 128, 255], dtype=numpy.uint8)
/// >>> wall = trigon3d.Material(roughness=0.9, normal_texture=flat)
#[pyclass(name = "Material", module = "trigon3d", frozen)]
#[derive(Clone)]
pub(crate) struct PyMaterial {
    material: Material,
    textures: Vec<(MaterialTexture, Texture)>,
    normal_scale: f32,
    occlusion_strength: f32,
}

#[pymethods]
impl PyMaterial {
    #[new]
    #[pyo3(signature = (
        color=None, *, metallic=None, roughness=None, emission=None, unlit=false, double_sided=true,
        alpha_mode="opaque", alpha_cutoff=0.5, texture=None, metallic_roughness_texture=None, normal_texture=None,
        normal_scale=1.0, occlusion_texture=None, occlusion_strength=1.0, emissive_texture=None, name=String::new()
    ))]
    fn new(
        color: Option<Channels>,
        metallic: Option<f32>,
        roughness: Option<f32>,
        emission: Option<Channels>,
        unlit: bool,
        double_sided: bool,
        alpha_mode: &str,
        alpha_cutoff: f32,
        texture: Option<&Bound<'_, PyAny>>,
        metallic_roughness_texture: Option<&Bound<'_, PyAny>>,
        normal_texture: Option<&Bound<'_, PyAny>>,
        normal_scale: f32,
        occlusion_texture: Option<&Bound<'_, PyAny>>,
        occlusion_strength: f32,
        emissive_texture: Option<&Bound<'_, PyAny>>,
        name: String,
    ) -> PyResult<Self> {
        let mut textures = Vec::new();
        for (slot, name, value) in [
            (MaterialTexture::BaseColor, "texture", texture),
            (MaterialTexture::MetallicRoughness, "metallic_roughness_texture", metallic_roughness_texture),
            (MaterialTexture::Normal, "normal_texture", normal_texture),
            (MaterialTexture::Occlusion, "occlusion_texture", occlusion_texture),
            (MaterialTexture::Emissive, "emissive_texture", emissive_texture),
        ] {
            if let Some(value) = value {
                textures.push((slot, image(value, name, slot)?));
            }
        }
        if !normal_scale.is_finite() || !(0.0..=1.0).contains(&occlusion_strength) {
            return Err(value_error("normal_scale is finite, and occlusion_strength goes from 0 to 1"));
        }
        let has_texture = metallic_roughness_texture.is_some();
        let light = emission.unwrap_or(Channels::grey(if emissive_texture.is_some() { 1.0 } else { 0.0 }));
        // White beside a texture, else the usual grey.
        let color = color.unwrap_or(Channels::grey(if texture.is_some() { 1.0 } else { USUAL_GREY }));
        let material = Material {
            name,
            base_color: color.linear("color")?,
            shading: shading(unlit, has_texture, metallic, roughness)?,
            emissive: light.linear("emission").map(Vec4::truncate)?,
            alpha_mode: self::alpha_mode(alpha_mode, alpha_cutoff)?,
            double_sided,
            ..Material::default()
        };
        Ok(Self { material, textures, normal_scale, occlusion_strength })
    }
}

/// Of a material without a colour, in sRGB.
const USUAL_GREY: f32 = 0.8;

/// How light is reflected: the plastic, unless something is said of metal or roughness.
fn shading(
    unlit: bool,
    has_texture: bool,
    metallic: Option<f32>,
    roughness: Option<f32>,
) -> PyResult<Shading> {
    if unlit {
        return Ok(Shading::Unlit);
    }
    if !has_texture && metallic.is_none() && roughness.is_none() {
        return Ok(Material::default().shading);
    }
    let usual = if has_texture { 1.0 } else { 0.0 };
    let [metallic, roughness] = [metallic.unwrap_or(usual), roughness.unwrap_or(1.0)];
    if !(0.0..=1.0).contains(&metallic) || !(0.0..=1.0).contains(&roughness) {
        return Err(value_error("metallic and roughness go from 0 to 1"));
    }
    Ok(Shading::MetallicRoughness(MetallicRoughness { metallic, roughness, ..MetallicRoughness::default() }))
}

fn alpha_mode(name: &str, cutoff: f32) -> PyResult<AlphaMode> {
    match name {
        "opaque" => Ok(AlphaMode::Opaque),
        "blend" => Ok(AlphaMode::Blend),
        "mask" if cutoff.is_finite() => Ok(AlphaMode::Mask { cutoff }),
        "mask" => Err(value_error("alpha_cutoff is not finite")),
        other => Err(value_error(format!("alpha_mode is {other:?}, not \"opaque\", \"blend\" or \"mask\""))),
    }
}

impl PyMaterial {
    /// Adds it to a scene, with its textures.
    pub(crate) fn add_to(&self, scene: &mut Scene) -> MaterialId {
        let mut material = self.material.clone();
        for (slot, texture) in &self.textures {
            let texture = scene.add_texture("texture", texture.clone());
            material.set_texture(*slot, Some(TextureBinding::new(texture)));
        }
        if let Some(map) = &mut material.normal_map {
            map.scale = self.normal_scale;
        }
        if let Some(map) = &mut material.occlusion {
            map.strength = self.occlusion_strength;
        }
        scene.add_material(material)
    }
}

/// An array of bytes or the path of an image as a texture.
fn image(value: &Bound<'_, PyAny>, name: &str, slot: MaterialTexture) -> PyResult<Texture> {
    let limits = Limits::default();
    if let Ok(path) = value.extract::<PathBuf>() {
        let image = load_image(path, &limits).map_err(load_error)?;
        let texels = image.rgba.as_chunks::<4>().0.to_vec();
        return Texture::new(image.width, image.height, texels, slot.format()).map_err(value_error);
    }
    let numpy = value.py().import("numpy")?;
    let array = numpy.call_method1("asarray", (value,))?;
    let shape: Vec<usize> = array.getattr("shape")?.extract()?;
    let (&[height, width] | &[height, width, 1 | 3 | 4]) = &shape[..] else {
        return Err(value_error(format!(
            "{name} has the shape {shape:?}, but needs (height, width) or (height, width, 1, 3 or 4)"
        )));
    };
    let side = |side: usize| u32::try_from(side).ok().filter(|side| *side <= limits.image_side);
    let (Some(width), Some(height)) = (side(width), side(height)) else {
        return Err(value_error(format!(
            "{name} has {width} × {height} pixels; the limit is {} a side",
            limits.image_side
        )));
    };
    if u64::from(width) * u64::from(height) > limits.image_pixels {
        return Err(value_error(format!("{name} has more than {} pixels", limits.image_pixels)));
    }
    let channels = shape.get(2).copied().unwrap_or(1);
    let rows = numpy.call_method1("ascontiguousarray", (&array,))?;
    let rows = rows.call_method1("reshape", (height, width, channels))?;
    let rows: PyReadonlyArray3<'_, u8> = rows.extract().map_err(|_| {
        let found = array.getattr("dtype").map_or_else(|_| String::new(), |found| found.to_string());
        value_error(format!("{name} holds {found}, but needs bytes (uint8)"))
    })?;
    let texels = texels(rows.as_slice().map_err(value_error)?, channels);
    Texture::new(width, height, texels, slot.format()).map_err(value_error)
}

/// Pixels of one channel (grey), three, or four.
fn texels(bytes: &[u8], channels: usize) -> Vec<[u8; 4]> {
    match channels {
        1 => bytes.iter().map(|&grey| [grey, grey, grey, 255]).collect(),
        3 => bytes.as_chunks::<3>().0.iter().map(|&[r, g, b]| [r, g, b, 255]).collect(),
        _ => bytes.as_chunks::<4>().0.to_vec(),
    }
}
