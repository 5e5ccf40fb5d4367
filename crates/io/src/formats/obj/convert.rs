//! Converts MTL materials to materials of the scene, with warnings about combinations of statements that are not
//! supported. Colours are taken as sRGB, as they look in the programs that write them.

use std::path::Path;

use trigon_math::color::srgb_to_linear;
use trigon_math::{Vec3, Vec4};
use trigon_scene::{AlphaMode, Material, MetallicRoughness, Shading};

use super::mtl::{Fields, MapKind, MtlMaterial};
use super::mtl_reader::Stated;
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

/// Warns of what is not drawn as the material says. `alpha` is the opacity that
/// it got.
pub(super) fn warn_undrawn(file: &Path, from: &Fields, alpha: f32, warnings: &mut Warnings) {
    let mut notes = Notes { file, warnings };
    let lets_light_through = alpha < 1.0 || from.has(MapKind::Opacity);
    notes.illumination_model(from, lets_light_through);
    notes.filter(from, lets_light_through);
    notes.ambient(from);
    notes.opacity(from);
    notes.physically_based(from);
    notes.maps(from);
}

struct Notes<'a> {
    file: &'a Path,
    warnings: &'a mut Warnings,
}

impl Notes<'_> {
    fn warn(&mut self, line: u64, what: &str, remedy: &str) {
        self.warnings.push_about(self.file, Location::Line(line), what, remedy);
    }

    /// Models 3 to 9 reflect what is around by as much as Ks, and 4, 6, 7 and 9 are glass.
    fn illumination_model(&mut self, from: &Fields, lets_light_through: bool) {
        let Some(model) = from.illumination_model else { return };
        let shines = from.specular.is_some_and(|specular| specular.value != [0.0; 3]);
        let shines = (shines || from.has(MapKind::Specular)) && !from.is_physically_based();
        if matches!(model.value, 3..=9) && shines {
            let what = "illum 3 to 9 asks for reflections of what is around, and only highlights are drawn";
            self.warn(model.line, what, "write Pm and Pr for a surface that reflects");
        }
        if matches!(model.value, 4 | 6 | 7 | 9) && lets_light_through {
            let what =
                "illum 4, 6, 7 or 9 asks for glass, and the surface is drawn clear without bending light";
            self.warn(model.line, what, "export the model as GLB, which keeps glass");
        }
        if model.value == 10 {
            let what = "illum 10 asks for a surface that shows nothing but shadows, and it is drawn whole";
            self.warn(model.line, what, "remove the surface, or write another illum");
        }
    }

    fn filter(&mut self, from: &Fields, lets_light_through: bool) {
        let Some(filter) = from.filter else { return };
        // Black lets nothing through, as an opaque surface does.
        if filter.value != [1.0; 3] && (lets_light_through || filter.value != [0.0; 3]) {
            let what = "Tf or Kt colours the light that passes through, which is not drawn";
            self.warn(filter.line, what, "write d for transparency, and Kd for its colour");
        }
    }

    fn ambient(&mut self, from: &Fields) {
        if let (Some(ambient), None, None) = (from.ambient, from.diffuse, from.map(MapKind::BaseColor)) {
            let what = "a material has Ka and no Kd, and is drawn grey";
            self.warn(ambient.line, what, "write its colour as Kd");
        }
        let Some(map) = &from.ambient_map else { return };
        let color = from.map(MapKind::BaseColor).map(|map| &map.statement.file);
        if color != Some(&map.value) {
            let what = format!("map_Ka \"{}\" is not drawn", map.value);
            self.warn(map.line, &what, "bake it into map_Kd if it matters");
        }
    }

    /// `Tr` is 1 − d; what both say must agree, but for roundings of two decimals.
    fn opacity(&mut self, from: &Fields) {
        const ROUNDING: f32 = 0.01;
        let (Some(dissolve), Some(transparency)) = (from.dissolve, from.transparency) else { return };
        if (dissolve.value + transparency.value - 1.0).abs() > ROUNDING {
            // One of them hides the surface.
            let what = match dissolve.value > 0.0 || transparency.value >= 1.0 {
                true => "d and Tr contradict each other (Tr is 1 − d), and d counts",
                false => "d 0 and Tr contradict each other (Tr is 1 − d), and Tr counts",
            };
            self.warn(transparency.line, what, "remove one of them");
        }
    }

    fn physically_based(&mut self, from: &Fields) {
        /// What exporters write for plastic: a reflection of 4 %, which is drawn.
        const PLASTIC: [f32; 3] = [0.5; 3];
        if !from.is_physically_based() {
            return;
        }
        if let Some(specular) = from.specular.filter(|specular| specular.value != PLASTIC) {
            let what = "Ks is not drawn beside Pr or Pm, which set the highlight";
            self.warn(specular.line, what, "write Pm 1 for a metal, whose highlights are coloured");
        }
        if let Some(map) = from.map(MapKind::Specular) {
            let what = format!("map_Ks \"{}\" is not drawn beside Pr or Pm", map.statement.file);
            self.warn(map.line, &what, "write map_Pm instead");
        }
        let has_roughness = from.roughness.is_some() || from.has(MapKind::Roughness);
        if let Some(shininess) = from.shininess.filter(|_| !has_roughness) {
            let what = "Ns is not drawn beside Pm, and the roughness is 0.5";
            self.warn(shininess.line, what, "write Pr");
        }
        if let Some(refraction) = from.refraction.filter(|refraction| refraction.value <= 1.0) {
            let what = "Ni is not above 1, and 1.5 is taken";
            self.warn(refraction.line, what, "write the index of refraction, such as 1.5");
        }
    }

    fn maps(&mut self, from: &Fields) {
        if let (Some(norm), Some(bump)) = (from.map(MapKind::Normal), from.map(MapKind::Bump))
            && norm.statement.file != bump.statement.file
        {
            let what = format!("bump \"{}\" is not drawn beside norm", bump.statement.file);
            self.warn(bump.line, &what, "put both into one normal map");
        }
        for (first, second) in
            [(MapKind::BaseColor, MapKind::Opacity), (MapKind::Roughness, MapKind::Metallic)]
        {
            if let (Some(first), Some(second)) = (from.map(first), from.map(second))
                && !first.statement.is_placed_like(&second.statement)
            {
                let (this, that) = (&second.statement.file, &first.statement.file);
                let what = format!("texture \"{this}\" is placed as \"{that}\" is, whatever its options say");
                self.warn(second.line, &what, "give both the same -s, -o and -clamp");
            }
        }
    }
}
