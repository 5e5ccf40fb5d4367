//! Laying faces flat as islands of texture coordinates, and packing islands.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_modelling::{PackSettings, SmartProjection, UnwrapMethod, UnwrapSettings, Unwrapped};

use super::{Action, Outcome};
use crate::error::EditError;
use crate::state::Change;

const FACES: &str = "at least one selected face";

/// Lays the selected faces flat along seams, and packs the islands into the image. Pinned coordinates stay, and so do
/// islands with pins (`pin_uvs`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Unwrap {
    /// The set of texture coordinates, from 0; the next one is added if it does not exist.
    pub uv_set: u32,
    /// How islands are laid flat.
    pub method: UnwrapMethod,
    /// In how many steps stretch is made smaller afterwards, at most.
    pub minimize_stretch: u32,
    /// The distance between islands and to the border of the image, in sides of the image.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub margin: f64,
}

impl Default for Unwrap {
    fn default() -> Self {
        let UnwrapSettings { method, minimize_stretch, margin, .. } = UnwrapSettings::default();
        Self { uv_set: 0, method, minimize_stretch, margin }
    }
}

impl Action for Unwrap {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let settings = UnwrapSettings {
            uv_set: self.uv_set as usize,
            method: self.method,
            minimize_stretch: self.minimize_stretch,
            margin: self.margin,
        };
        let mut sum = Unwrapped::default();
        change.edit_selected_faces("unwrapping", FACES, |mesh, faces| {
            add(&mut sum, mesh.unwrap_faces(faces, &settings)?);
            Ok(())
        })?;
        Ok(outcome(&sum))
    }
}

/// Projects the selected faces along a few directions, those that face similarly together, and packs the islands
/// into the image.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SmartProject {
    /// The set of texture coordinates, from 0; the next one is added if it does not exist.
    pub uv_set: u32,
    /// The greatest angle between a face's normal and the direction from which it is projected, in degrees.
    #[schemars(range(min = 5.0, max = 89.0))]
    pub angle_limit: f64,
    /// The distance between islands and to the border of the image, in sides of the image.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub margin: f64,
}

impl Default for SmartProject {
    fn default() -> Self {
        Self { uv_set: 0, angle_limit: 66.0, margin: SmartProjection::default().margin }
    }
}

impl Action for SmartProject {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let settings = SmartProjection {
            uv_set: self.uv_set as usize,
            angle_limit: self.angle_limit.to_radians(),
            margin: self.margin,
        };
        let mut sum = Unwrapped::default();
        change.edit_selected_faces("projecting texture coordinates", FACES, |mesh, faces| {
            add(&mut sum, mesh.smart_project_uvs(faces, &settings)?);
            Ok(())
        })?;
        Ok(outcome(&sum))
    }
}

/// Arranges the islands of the selected faces in the image so that they do not overlap. Islands with pins stay.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct PackIslands {
    /// The set of texture coordinates, from 0.
    pub uv_set: u32,
    /// Whether islands may be turned.
    pub rotate: bool,
    /// Whether areas of islands become proportional to their areas on the surface.
    pub average_scale: bool,
    /// The distance between islands and to the border of the image, in sides of the image.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub margin: f64,
}

impl Default for PackIslands {
    fn default() -> Self {
        let PackSettings { rotate, average_scale, margin } = PackSettings::default();
        Self { uv_set: 0, rotate, average_scale, margin }
    }
}

impl Action for PackIslands {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let &Self { rotate, average_scale, margin, .. } = self;
        let settings = PackSettings { rotate, average_scale, margin };
        let mut count = 0;
        change.edit_selected_faces("packing islands", FACES, |mesh, faces| {
            count += mesh.pack_uv_islands(faces, self.uv_set as usize, &settings)?;
            Ok(())
        })?;
        Ok(Outcome::counted("packed", count, ISLANDS))
    }
}

const ISLANDS: [&str; 2] = ["island", "islands"];

pub(super) fn add(sum: &mut Unwrapped, of: Unwrapped) {
    sum.islands += of.islands;
    sum.not_conformal += of.not_conformal;
    sum.pinned += of.pinned;
    sum.overlapping += of.overlapping;
    sum.turned_over += of.turned_over;
}

/// What was done.
fn outcome(of: &Unwrapped) -> Outcome {
    Outcome { warnings: warnings(of), ..Outcome::counted("made", of.islands, ISLANDS) }
}

/// What users may want to improve.
pub(super) fn warnings(of: &Unwrapped) -> Vec<String> {
    let mut warnings = Vec::new();
    if of.not_conformal > 0 {
        warnings.push(format!(
            "{} of the islands would overlap themselves if angles were preserved, so they are stretched more: mark \
             more seams there",
            of.not_conformal
        ));
    }
    if of.overlapping > 0 {
        warnings.push(format!(
            "{} of the islands overlap themselves because of where their pins are: move pins, or clear some",
            of.overlapping
        ));
    }
    if of.turned_over > 0 {
        warnings.push(format!(
            "{} triangles have no area in the image or are turned over: mark more seams there, or merge vertices by \
             distance",
            of.turned_over
        ));
    }
    warnings
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};
    use trigon_mesh::primitives;
    use trigon_scene::{Material, Scene};

    use crate::document::Document;
    use crate::tests::commands::{run, try_run};

    fn editing(mesh: trigon_mesh::Mesh) -> Document {
        let mut scene = Scene::new();
        scene.add_object("object", mesh, Material::default());
        let mut document = Document::new(scene);
        run(&mut document, json!({ "op": "edit_objects", "objects": ["object"] }));
        run(&mut document, json!({ "op": "set_element_kind", "kind": "face" }));
        run(&mut document, json!({ "op": "select_all" }));
        document
    }

    /// All texture coordinates of the first set.
    fn uvs(document: &Document) -> Vec<[f32; 2]> {
        let (id, _) = document.selection().meshes().next().expect("it is edited");
        let mesh = document.mesh(id).expect("it is there");
        mesh.corners().filter_map(|corner| mesh.uv(0, corner)).map(|uv| uv.to_array()).collect()
    }

    #[test]
    fn a_closed_cube_is_unwrapped_once_it_has_seams_and_undone() {
        let mut document = editing(primitives::cube(2.0));
        let refused =
            try_run(&mut document, json!({ "op": "unwrap" })).expect_err("it is closed").to_string();
        assert!(refused.contains("mark seams") && refused.contains("Smart Projection"), "{refused}");
        let before = uvs(&document);
        run(&mut document, json!({ "op": "mark_seam" }));
        for (command, message) in [
            (json!({ "op": "unwrap", "method": "convex", "minimize_stretch": 3 }), "made 6 islands"),
            (json!({ "op": "unwrap", "margin": 0.02 }), "made 6 islands"),
            (json!({ "op": "smart_project", "angle_limit": 40 }), "made 6 islands"),
            (json!({ "op": "pack_islands", "rotate": false }), "packed 6 islands"),
        ] {
            let outcome = try_run(&mut document, command.clone()).expect("possible");
            assert_eq!((outcome.message.as_str(), outcome.warnings.len()), (message, 0), "{command}");
        }
        (0..5).for_each(|_| document.undo().expect("five"));
        assert_eq!(uvs(&document), before, "all is undone");
    }

    #[test]
    fn what_is_out_of_range_is_refused() {
        let mut document = editing(primitives::cube(2.0));
        run(&mut document, json!({ "op": "mark_seam" }));
        for (command, word) in [
            (json!({ "op": "unwrap", "margin": 0.4 }), "margin"),
            (json!({ "op": "smart_project", "angle_limit": 90 }), "angle"),
            (json!({ "op": "pack_islands", "uv_set": 7 }), "unwrap the faces first"),
            (json!({ "op": "project_uvs_cylinder", "axis": [0, 0, 0] }), "axis"),
            (json!({ "op": "project_uvs_sphere", "axis": [0, 0, 0] }), "axis"),
        ] {
            let command: Value = command;
            let refused = try_run(&mut document, command.clone()).expect_err("out of range").to_string();
            assert!(refused.contains(word), "{command}: {refused}");
        }
    }
}
