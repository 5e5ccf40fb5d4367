//! Materials, textures and lights, field by field. Parameters of materials beyond the fixed list follow at
//! the end of the capture, by their names in glTF.

use trigon_camera::UpAxis;
use trigon_math::Vec3;
use trigon_scene::{
    AlphaMode, ExtensionParameter, Filter, Light, LightKind, Material, MetallicRoughness, MipFilter,
    NormalMap, Occlusion, ParameterField, Sampler, Scene, Shading, Texture, TextureAsset, TextureBinding,
    TextureFormat, Wrap,
};

use super::stored::{CaptureReader, CaptureWriter, Damage, Stored, choice, record};

/// Later parameters follow at the end of the capture.
impl Stored for Material {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        self.name.write(to);
        self.base_color.write(to);
        self.base_color_texture.write(to);
        self.shading.write(to);
        self.emissive.write(to);
        self.emissive_texture.write(to);
        self.normal_map.write(to);
        self.occlusion.write(to);
        self.alpha_mode.write(to);
        self.double_sided.write(to);
        self.transmission.write(to);
        self.transmission_texture.write(to);
        self.ior.write(to);
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        Ok(Self {
            name: Stored::read(from)?,
            base_color: Stored::read(from)?,
            base_color_texture: Stored::read(from)?,
            shading: Stored::read(from)?,
            emissive: Stored::read(from)?,
            emissive_texture: Stored::read(from)?,
            normal_map: Stored::read(from)?,
            occlusion: Stored::read(from)?,
            alpha_mode: Stored::read(from)?,
            double_sided: Stored::read(from)?,
            transmission: Stored::read(from)?,
            transmission_texture: Stored::read(from)?,
            ior: Stored::read(from)?,
            ..Self::default()
        })
    }
}
choice!(AlphaMode { 0 => Opaque, 1 => Mask { cutoff }, 2 => Blend });
choice!(Shading {
    0 => Unlit,
    1 => Lambert,
    2 => BlinnPhong { specular, shininess, specular_texture },
    3 => MetallicRoughness(model),
});
record!(MetallicRoughness {
    metallic,
    roughness,
    texture,
    specular,
    specular_texture,
    specular_color,
    specular_color_texture,
});
record!(NormalMap { binding, scale });
record!(Occlusion { binding, strength });

record!(Sampler { wrap_u, wrap_v, magnification, minification, mip });
choice!(Wrap { 0 => Repeat, 1 => MirroredRepeat, 2 => ClampToEdge });
choice!(Filter { 0 => Nearest, 1 => Linear });
choice!(MipFilter { 0 => None, 1 => Nearest, 2 => Linear, 3 => Anisotropic(probes) });
choice!(TextureFormat { 0 => Srgb, 1 => Linear });
record!(TextureAsset { name, texture });

/// With a radius since version 8.
impl Stored for Light {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        let Self { kind, color, intensity, range, radius } = self;
        kind.write(to);
        color.write(to);
        [*intensity, *range, *radius].write(to);
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        let (kind, color) = (Stored::read(from)?, Stored::read(from)?);
        let [intensity, range] = Stored::read(from)?;
        let radius = if from.version < 8 { 0.0 } else { Stored::read(from)? };
        Ok(Self { kind, color, intensity, range, radius })
    }
}
choice!(LightKind { 0 => Ambient, 1 => Directional, 2 => Point, 3 => Spot { inner, outer } });

impl Stored for TextureBinding {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        let Self { texture, uv_set, transform, sampler } = self;
        texture.write(to);
        (*uv_set as u64).write(to);
        transform.write(to);
        sampler.write(to);
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        let texture = Stored::read(from)?;
        let uv_set = usize::try_from(u64::read(from)?);
        let uv_set = uv_set.map_err(|_| Damage::malformed("there is no UV set of such a number"))?;
        Ok(Self { texture, uv_set, transform: Stored::read(from)?, sampler: Stored::read(from)? })
    }
}

/// The base level; the smaller ones are recomputed.
impl Stored for Texture {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        self.format().write(to);
        self.width().write(to);
        self.height().write(to);
        self.texels().collect::<Vec<_>>().write(to);
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        let (format, width, height) = (Stored::read(from)?, u32::read(from)?, u32::read(from)?);
        let pixels = u64::from(width) * u64::from(height);
        if pixels > from.limits.image_pixels {
            let allowed = from.limits.image_pixels;
            return Err(Damage::Limit(format!("a texture has {pixels} pixels, {allowed} are allowed")));
        }
        Self::new(width, height, Stored::read(from)?, format)
            .map_err(|error| Damage::malformed(error.to_string()))
    }
}

/// The extensions whose parameters are in the fixed list.
const FIXED: [&str; 2] = ["KHR_materials_specular", "KHR_materials_transmission"];

/// Stands before the list of materials' parameters, if there is one.
const LISTED: u8 = 1;

/// Stands before the direction that is up, unless it is +Y.
const UP: u8 = 2;

/// What a parameter is set to.
#[derive(Clone, Copy, PartialEq)]
enum Value {
    Number(f32),
    Color(Vec3),
    Texture(Option<TextureBinding>),
}

choice!(Value { 0 => Number(number), 1 => Color(color), 2 => Texture(binding) });

impl Value {
    /// What a material has; `None` where its shading model does not have the parameter.
    fn of(field: ParameterField, material: &mut Material) -> Option<Self> {
        match field {
            ParameterField::Share(field) | ParameterField::Amount(field) => {
                field(material).map(|number| Self::Number(*number))
            }
            ParameterField::Color(field) => field(material).map(|color| Self::Color(*color)),
            ParameterField::Texture(slot) => Some(Self::Texture(material.texture(slot))),
        }
    }

    fn set(self, field: ParameterField, material: &mut Material) -> Result<(), Damage> {
        match (field, self) {
            (ParameterField::Share(field) | ParameterField::Amount(field), Self::Number(number)) => {
                field(material).into_iter().for_each(|field| *field = number);
            }
            (ParameterField::Color(field), Self::Color(color)) => {
                field(material).into_iter().for_each(|field| *field = color);
            }
            (ParameterField::Texture(slot), Self::Texture(binding)) => material.set_texture(slot, binding),
            _ => return Err(Damage::malformed("a parameter of a material is of another kind")),
        }
        Ok(())
    }
}

fn listed() -> impl Iterator<Item = &'static ExtensionParameter> {
    Material::EXTENSION_PARAMETERS.iter().filter(|row| !FIXED.contains(&row.extension))
}

/// The up axis, and parameters of materials beyond the fixed list of a material, by their names in glTF.
/// Parameters follow at the end of a capture, and only where they are not the default, so that a further
/// parameter is no new version of the format.
///
/// Writes what is not the default, if there is anything.
pub(super) fn write(scene: &Scene, to: &mut CaptureWriter<'_>) {
    if scene.up != UpAxis::default() {
        UP.write(to);
        // An axis made from its direction has the same bits.
        scene.up.direction().write(to);
    }
    write_list(scene, to);
}

fn write_list(scene: &Scene, to: &mut CaptureWriter<'_>) {
    let mut count = 0_u64;
    let mut listing = CaptureWriter { bytes: Vec::new(), scene };
    for (id, material) in scene.materials.iter() {
        let mut plain = Material { shading: material.shading, ..Material::default() };
        if let Some(model) = plain.shading.metallic_roughness_mut() {
            *model = MetallicRoughness::default();
        }
        for row in listed() {
            let value = Value::of(row.field, &mut material.clone());
            if let Some(value) =
                value.filter(|&value| Value::of(row.field, &mut plain.clone()) != Some(value))
            {
                count += 1;
                id.write(&mut listing);
                (row.extension.to_owned(), row.name.to_owned()).write(&mut listing);
                value.write(&mut listing);
            }
        }
    }
    if count > 0 {
        LISTED.write(to);
        count.write(to);
        to.bytes.extend(listing.bytes);
    }
}

/// Reads what [`write`](fn@write) wrote.
pub(super) fn read(scene: &mut Scene, from: &mut CaptureReader<'_>) -> Result<(), Damage> {
    while !from.is_at_end() {
        match u8::read(from)? {
            UP => scene.up = UpAxis::new(Stored::read(from)?),
            LISTED => read_list(scene, from)?,
            _ => return Err(Damage::malformed("more follows where it should end")),
        }
    }
    Ok(())
}

fn read_list(scene: &mut Scene, from: &mut CaptureReader<'_>) -> Result<(), Damage> {
    for _ in 0..from.count(size_of::<Value>())? {
        let id = Stored::read(from)?;
        let (extension, name) = <(String, String)>::read(from)?;
        let value = Value::read(from)?;
        let row = listed().find(|row| (row.extension, row.name) == (&extension, &name));
        let row = row.ok_or_else(|| {
            Damage::malformed(format!("this version of trigon does not know {name} of {extension}"))
        })?;
        if let Some(material) = scene.materials.get_mut(id) {
            value.set(row.field, material)?;
        }
    }
    Ok(())
}
