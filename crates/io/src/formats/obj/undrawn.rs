//! Warnings about combinations of statements in a material that are not supported, given once all of them are
//! known.

use std::path::Path;

use super::mtl::{Fields, MapKind};
use crate::error::Location;
use crate::warning::Warnings;

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
