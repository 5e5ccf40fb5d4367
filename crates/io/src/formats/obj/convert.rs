//! Converts MTL materials to materials of the scene. Colours are taken as sRGB, as they look in the programs
//! that write them.

use std::path::Path;

use trigon_math::color::srgb_to_linear;
use trigon_math::{Vec3, Vec4};
use trigon_scene::{AlphaMode, Material, MetallicRoughness, Shading};

use super::mtl::{Fields, MapKind, MtlMaterial};
use super::mtl_values::Stated;
use super::undrawn::warn_undrawn;
use crate::error::Location;
use crate::warning::Warnings;

/// Converts what a library says of a material. The textures come later.
pub(super) fn convert(file: &Path, from: Fields, warnings: &mut Warnings) -> MtlMaterial {
    let textured = from.has(MapKind::BaseColor);
    let diffuse = value(from.diffuse).map(to_linear);
    // Many exporters write black beside a texture that they do not mean to darken.
    let base = match diffuse {
        Some(color) if !textured || color != Vec3::ZERO => color,
        _ if textured => Vec3::ONE,
        _ => Material::default().base_color.truncate(),
    };
    let alpha = alpha(file, &from, warnings);
    warn_undrawn(file, &from, alpha, warnings);
    let specular = white_beside_map(value(from.specular), from.has(MapKind::Specular));
    let material = Material {
        name: from.name.clone(),
        base_color: Vec4::from((base, alpha)),
        shading: metallic_roughness(&from)
            .unwrap_or_else(|| shading(file, &from, specular.map(to_linear), warnings)),
        emissive: white_beside_map(value(from.emissive), from.has(MapKind::Emissive))
            .map_or(Vec3::ZERO, to_linear),
        alpha_mode: match alpha < 1.0 {
            true => AlphaMode::Blend,
            // What map_d is used for: leaves and fences.
            false if from.has(MapKind::Opacity) => AlphaMode::Mask { cutoff: 0.5 },
            false => AlphaMode::Opaque,
        },
        // Below 1 there is no such matter; many exporters write 0 or 1 for "no matter".
        ior: value(from.refraction).filter(|&ior| ior > 1.0).unwrap_or(Material::default().ior),
        // OBJ does not say which side counts, and many a file has it mixed up.
        double_sided: true,
        ..Material::default()
    };
    MtlMaterial { material, maps: from.maps, file: file.to_owned(), line: from.line }
}

fn value<T>(stated: Option<Stated<T>>) -> Option<T> {
    stated.map(|stated| stated.value)
}

/// A colour beside its texture: exporters leave it out, or write black, where
/// the texture is to be seen as it is.
fn white_beside_map(color: Option<[f32; 3]>, has_map: bool) -> Option<[f32; 3]> {
    if has_map && color.is_none_or(|color| color == [0.0; 3]) { Some([1.0; 3]) } else { color }
}

/// The model of "physically-based" MTL, where a material has any of its fields
/// (`Pr`, `Pm`, `map_Pr`, `map_Pm`; after the extension by Exocortex).
fn metallic_roughness(from: &Fields) -> Option<Shading> {
    if !from.is_physically_based() {
        return None;
    }
    let default = MetallicRoughness::default();
    // Without a number of its own, a texture is to be seen as it is.
    let factor = |value: Option<f32>, has_map: bool, otherwise: f32| match value {
        Some(value) if value != 0.0 || !has_map => value,
        _ if has_map => 1.0,
        _ => otherwise,
    };
    Some(Shading::MetallicRoughness(MetallicRoughness {
        roughness: factor(value(from.roughness), from.has(MapKind::Roughness), default.roughness),
        metallic: factor(value(from.metallic), from.has(MapKind::Metallic), default.metallic),
        ..default
    }))
}

/// `d`, or 1 − `Tr`. Exporters disagree about both; of two readings the one that shows the surface counts.
fn alpha(file: &Path, from: &Fields, warnings: &mut Warnings) -> f32 {
    let of_transparency = from.transparency.map(|stated| Stated { value: 1.0 - stated.value, ..stated });
    let mut opaque = |line: u64, what: &str, remedy: &str| {
        warnings.push_about(file, Location::Line(line), what, remedy);
        1.0
    };
    match (from.dissolve, of_transparency) {
        (Some(Stated { value: ..=0.0, .. }), Some(Stated { value, .. })) if value > 0.0 => value,
        (Some(Stated { line, value: ..=0.0 }), _) if from.has(MapKind::Opacity) => {
            opaque(line, "d 0 beside map_d would be invisible, and map_d counts alone", "write d 1")
        }
        (Some(Stated { value, .. }), _) => value,
        (None, Some(Stated { line, value: ..=0.0 })) => {
            opaque(line, "Tr 1 would be invisible and is read as opaque", "write d instead of Tr")
        }
        (None, Some(Stated { value, .. })) => value,
        (None, None) => 1.0,
    }
}

/// Illumination model 0 has the colour alone, whatever the light, and 1 no highlight.
fn shading(file: &Path, from: &Fields, specular: Option<Vec3>, warnings: &mut Warnings) -> Shading {
    let model = value(from.illumination_model);
    match specular {
        _ if model == Some(0) => Shading::Unlit,
        Some(specular) if specular != Vec3::ZERO && model != Some(1) => exponent(file, from, warnings)
            .map_or(Shading::Lambert, |exponent| Shading::blinn_phong(specular, exponent)),
        _ => Shading::Lambert,
    }
}

/// How small a highlight is; none if there is no highlight. Many exporters write `Ks 1 1 1` for a surface
/// without one, and leave `Ns` out or at 0 or 1: a highlight as wide as that is a white veil over everything.
fn exponent(file: &Path, from: &Fields, warnings: &mut Warnings) -> Option<f32> {
    const USUAL: f32 = 30.0;
    const WIDEST: f32 = 1.0;
    let stated = match (from.shininess, from.map(MapKind::Specular)) {
        (Some(Stated { value, .. }), _) if value > WIDEST => return Some(value),
        // An image of highlights is no placeholder.
        (None, Some(_)) => return Some(USUAL),
        (Some(Stated { line, .. }), _) => Some(line),
        (None, None) => from.specular.map(|specular| specular.line),
    };
    if let Some(line) = stated {
        let what = "Ks without Ns, or with Ns of at most 1, is a placeholder, and no highlight is drawn";
        warnings.push_about(file, Location::Line(line), what, "write Ns, such as 30, or Ks 0");
    }
    None
}

fn to_linear(color: [f32; 3]) -> Vec3 {
    Vec3::from(color.map(srgb_to_linear))
}
