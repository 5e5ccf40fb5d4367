//! Materials of the document, as near as the materials of the scene come.

use std::collections::BTreeMap;

use gltf_json::material::AlphaMode as JsonAlphaMode;
use gltf_json::{Root, texture};
use trigon_math::glam::Affine2;
use trigon_math::{Vec2, Vec3, Vec4, elementary};
use trigon_scene::{AlphaMode, Material, MaterialId, Shading, TextureBinding};

use super::accessor::valid;
use super::buffers::Buffers;
use super::images::{Images, convert_sampler};
use crate::error::{LoadError, Place};
use crate::import::Import;
use crate::warning::Warnings;

/// Converts the materials that are used, `None` being the format's default.
pub(crate) fn add_materials(
    import: &mut Import<'_>,
    root: &Root,
    buffers: &mut Buffers<'_>,
    used: &[Option<usize>],
) -> Result<BTreeMap<Option<usize>, MaterialId>, LoadError> {
    let textures: Vec<usize> =
        used.iter().filter_map(|&material| Some(base_texture(root, material?)?.index.value())).collect();
    let images = Images::read(import, root, buffers, &textures)?;
    let mut ids = BTreeMap::new();
    for &index in used {
        let material = match index {
            Some(index) => convert(root, index, &images, &mut import.warnings),
            None => default_material(),
        };
        ids.insert(index, import.scene.add_material(material));
    }
    Ok(ids)
}

/// The UV set that a material's base colour texture is looked up in.
pub(crate) fn texture_set(root: &Root, material: Option<usize>) -> Option<u32> {
    let info = base_texture(root, material?)?;
    let transform = info.extensions.as_ref().and_then(|extensions| extensions.texture_transform.as_ref());
    Some(transform.and_then(|transform| transform.tex_coord).unwrap_or(info.tex_coord))
}

fn base_texture(root: &Root, material: usize) -> Option<&texture::Info> {
    root.materials[material].pbr_metallic_roughness.base_color_texture.as_ref()
}

/// White and matt, from one side: what the specification gives a primitive
/// without a material.
fn default_material() -> Material {
    let plain = Material { base_color: Vec4::ONE, double_sided: false, ..Material::default() };
    plain.with_name("default").with_shading(Shading::Lambert)
}

fn convert(root: &Root, index: usize, images: &Images, warnings: &mut Warnings) -> Material {
    let from = &root.materials[index];
    let pbr = &from.pbr_metallic_roughness;
    warn_of_textures(from, index, warnings);
    let base_color = clean(Vec4::from(pbr.base_color_factor.0), Vec4::ONE).clamp(Vec4::ZERO, Vec4::ONE);
    let is_unlit = from.extensions.as_ref().is_some_and(|extensions| extensions.unlit.is_some());
    // A factor multiplies its texture; without the texture it says nothing.
    let has_map = pbr.metallic_roughness_texture.is_some();
    let (metallic, roughness) =
        if has_map { (0.0, 0.5) } else { (pbr.metallic_factor.0, pbr.roughness_factor.0) };
    let emissive =
        clean(Vec3::from(from.emissive_factor.0).extend(0.0), Vec4::ZERO).truncate().max(Vec3::ZERO);
    Material {
        name: from.name.clone().unwrap_or_else(|| format!("material {index}")),
        base_color,
        base_color_texture: base_texture(root, index).and_then(|info| bind(root, info, images)),
        shading: if is_unlit {
            Shading::Unlit
        } else {
            approximate(base_color.truncate(), metallic, roughness)
        },
        emissive: if from.emissive_texture.is_some() || is_unlit { Vec3::ZERO } else { emissive },
        alpha_mode: match valid(&from.alpha_mode) {
            Some(JsonAlphaMode::Mask) => {
                AlphaMode::Mask { cutoff: from.alpha_cutoff.map_or(0.5, |cutoff| cutoff.0) }
            }
            Some(JsonAlphaMode::Blend) => AlphaMode::Blend,
            _ => AlphaMode::Opaque,
        },
        double_sided: from.double_sided,
        ..Material::default()
    }
}

fn clean(value: Vec4, otherwise: Vec4) -> Vec4 {
    if value.is_finite() { value } else { otherwise }
}

/// Names the textures that are not drawn yet.
fn warn_of_textures(from: &gltf_json::Material, index: usize, warnings: &mut Warnings) {
    let textures = [
        ("metallic-roughness", from.pbr_metallic_roughness.metallic_roughness_texture.is_some()),
        ("normal", from.normal_texture.is_some()),
        ("occlusion", from.occlusion_texture.is_some()),
        ("emissive", from.emissive_texture.is_some()),
    ];
    for (name, _) in textures.iter().filter(|(_, is_there)| *is_there) {
        let named = |name: &String| Place::Named(format!("material {index} \"{name}\""));
        let place = from.name.as_ref().map_or(Place::Item("material", index), named);
        warnings.push(
            place,
            format!("a {name} texture is not drawn yet"),
            "bake its effect into the base colour texture if it matters",
        );
    }
}

/// Metal and roughness as a Blinn-Phong highlight: F₀ · (n + 8) / 8 with
/// n = 2 / roughness⁴ − 2, the normalisation of Akenine-Möller, Haines,
/// Hoffman, "Real-Time Rendering", 3rd edition, 7.6, faded out towards full
/// roughness. There is no environment for a metal to mirror, so it keeps its
/// colour as a diffuse one instead of turning black.
fn approximate(base: Vec3, metallic: f32, roughness: f32) -> Shading {
    // Below this the highlight would be smaller than any pixel.
    const SMOOTHEST: f32 = 0.2;
    const DIELECTRIC: f32 = 0.04;
    let metallic = if metallic.is_finite() { metallic.clamp(0.0, 1.0) } else { 1.0 };
    let roughness = if roughness.is_finite() { roughness.clamp(SMOOTHEST, 1.0) } else { 1.0 };
    if roughness >= 1.0 {
        return Shading::Lambert;
    }
    let squared = roughness * roughness;
    let shininess = 2.0 / (squared * squared) - 2.0;
    let reflected = Vec3::splat(DIELECTRIC).lerp(base * 0.5, metallic);
    Shading::blinn_phong(reflected * ((shininess + 8.0) / 8.0 * (1.0 - squared)), shininess)
}

fn bind(root: &Root, info: &texture::Info, images: &Images) -> Option<TextureBinding> {
    let texture = images.get(root, info.index.value())?;
    let transform = info.extensions.as_ref().and_then(|extensions| extensions.texture_transform.as_ref());
    let uv_set = transform.and_then(|transform| transform.tex_coord).unwrap_or(info.tex_coord);
    Some(TextureBinding {
        texture,
        // Where the mesh lacks the set, the mesh reader filled it in.
        uv_set: uv_set as usize,
        transform: transform.map_or(Affine2::IDENTITY, to_affine),
        sampler: convert_sampler(root, info.index.value()),
    })
}

/// KHR_texture_transform: translation · rotation · scale, turning
/// counter-clockwise with v pointing down.
fn to_affine(from: &gltf_json::extensions::texture::TextureTransform) -> Affine2 {
    let (sine, cosine) = elementary::sin_cos(f64::from(from.rotation.0));
    let (sine, cosine) = (sine as f32, cosine as f32);
    let (scale, offset) = (Vec2::from(from.scale.0), Vec2::from(from.offset.0));
    let matrix = trigon_math::glam::Mat2::from_cols(
        Vec2::new(cosine, -sine) * scale.x,
        Vec2::new(sine, cosine) * scale.y,
    );
    let affine = Affine2::from_mat2_translation(matrix, offset);
    if affine.is_finite() { affine } else { Affine2::IDENTITY }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roughness_one_is_matt_and_smooth_is_sharp() {
        assert_eq!(approximate(Vec3::ONE, 1.0, 1.0), Shading::Lambert, "matt");
        let exponent = |roughness| match approximate(Vec3::ONE, 0.0, roughness) {
            Shading::BlinnPhong { shininess, .. } => shininess,
            other => panic!("a highlight was expected, not {other:?}"),
        };
        assert!(exponent(0.3) > exponent(0.5) && exponent(0.5) > exponent(0.9), "smoother is sharper");
        assert!(exponent(0.0).is_finite() && exponent(f32::MIN).is_finite(), "and never infinite");
        assert_eq!(approximate(Vec3::ONE, f32::NAN, f32::NAN), Shading::Lambert, "nor not a number");
    }
}
