//! Materials, textures and lights, field by field.

use trigon_scene::{
    AlphaMode, Filter, Light, LightKind, Material, MetallicRoughness, MipFilter, NormalMap, Occlusion,
    Sampler, Shading, Texture, TextureAsset, TextureBinding, TextureFormat, Wrap,
};

use super::stored::{Stored, choice, record};
use super::stream::{Damage, Reader, Writer};

/// Later parameters follow at the end of the capture: see [`super::parameters`].
impl Stored for Material {
    fn write(&self, to: &mut Writer<'_>) {
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

    fn read(from: &mut Reader<'_>) -> Result<Self, Damage> {
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

record!(Light { kind, color, intensity, range });
choice!(LightKind { 0 => Ambient, 1 => Directional, 2 => Point, 3 => Spot { inner, outer } });

impl Stored for TextureBinding {
    fn write(&self, to: &mut Writer<'_>) {
        let Self { texture, uv_set, transform, sampler } = self;
        texture.write(to);
        (*uv_set as u64).write(to);
        transform.write(to);
        sampler.write(to);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Damage> {
        let texture = Stored::read(from)?;
        let uv_set = usize::try_from(u64::read(from)?);
        let uv_set = uv_set.map_err(|_| Damage::malformed("there is no UV set of such a number"))?;
        Ok(Self { texture, uv_set, transform: Stored::read(from)?, sampler: Stored::read(from)? })
    }
}

/// The base level; the smaller ones are recomputed.
impl Stored for Texture {
    fn write(&self, to: &mut Writer<'_>) {
        self.format().write(to);
        self.width().write(to);
        self.height().write(to);
        self.texels().collect::<Vec<_>>().write(to);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Damage> {
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
