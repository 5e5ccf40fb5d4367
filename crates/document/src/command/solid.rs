//! Solidifying faces, making struts of their edges, and reducing their number.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_modelling::{DecimateGoal, DecimateSettings, SolidifySettings, WireframeSettings};

use super::{Action, Outcome};
use crate::error::EditError;
use crate::selection::Elements;
use crate::state::{AfterEdit, Change};

const FACES: &str = "at least one selected face";

/// Gives the selected faces a second layer behind them, joined along the border, so that a surface becomes a wall.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Solidify {
    /// The distance between both layers, in metres.
    #[schemars(range(min = 0.0))]
    pub thickness: f64,
    /// Where the wall lies: -1 is behind the surface, 0 in its middle, 1 in front of it.
    #[schemars(range(min = -1.0, max = 1.0))]
    pub offset: f64,
    /// Whether walls that meet at an angle keep the thickness.
    pub even: bool,
    /// Whether the layers are joined along borders.
    pub rim: bool,
    /// The material slot of the rim. Default: those of the faces beside it.
    pub rim_material: Option<u32>,
    /// The material slot of the second layer. Default: those of the faces in front of it.
    pub inner_material: Option<u32>,
}

impl Default for Solidify {
    fn default() -> Self {
        let SolidifySettings { thickness, offset, even, rim, rim_material, inner_material } =
            SolidifySettings::default();
        Self { thickness, offset, even, rim, rim_material, inner_material }
    }
}

impl Action for Solidify {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let &Self { thickness, offset, even, rim, rim_material, inner_material } = self;
        let settings = SolidifySettings { thickness, offset, even, rim, rim_material, inner_material };
        change.edit_selected_faces("solidifying", FACES, |mesh, faces| {
            mesh.solidify_faces(faces, &settings).map(drop)
        })?;
        Ok(Outcome::silent())
    }
}

/// Makes struts of the edges of the selected faces.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Wireframe {
    /// The width and height of struts, in metres.
    #[schemars(range(min = 0.0))]
    pub thickness: f64,
    /// Whether the faces go, with edges and vertices that nothing else uses.
    pub replace: bool,
}

impl Default for Wireframe {
    fn default() -> Self {
        let WireframeSettings { thickness, replace } = WireframeSettings::default();
        Self { thickness, replace }
    }
}

impl Action for Wireframe {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let settings = WireframeSettings { thickness: self.thickness, replace: self.replace };
        let kind = change.selection().kind();
        change.edit_selected("making a wireframe", FACES, |mesh, selection| {
            let made = mesh.wireframe_faces(&selection.faces(mesh, kind), &settings)?;
            Ok(AfterEdit::Select(Elements::Faces(made)))
        })?;
        Ok(Outcome::silent())
    }
}

/// Why there are more triangles than were asked for.
const HELD: &str = "more are left than were asked for: borders, marks and ends of texture coordinates hold them; \
                    without hold_values those of texture coordinates and colours do not";

/// Reduces the number of triangles of the selected faces, with as little change of the surface as possible. Other faces are
/// cut into triangles first. Borders, seams, sharp edges and the borders of materials hold.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Decimate {
    /// When to end; the other goals' values are not used.
    pub goal: DecimateGoal,
    /// How many triangles to leave, in parts of all.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub ratio: f64,
    /// How many triangles to leave in each mesh.
    pub faces: u32,
    /// The largest error, in metres: the root of the mean squared distance of a new vertex from the planes of the triangles
    /// that it stands for.
    #[schemars(range(min = 0.0))]
    pub error: f64,
    /// Whether borders of texture coordinates and colours hold. Without it corners keep their values where their vertices
    /// move.
    pub hold_values: bool,
}

impl Default for Decimate {
    fn default() -> Self {
        let DecimateSettings { goal, ratio, faces, error, hold_values } = DecimateSettings::default();
        Self { goal, ratio, faces, error, hold_values }
    }
}

impl Action for Decimate {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let &Self { goal, ratio, faces, error, hold_values } = self;
        let settings = DecimateSettings { goal, ratio, faces, error, hold_values };
        let kind = change.selection().kind();
        let (mut removed, mut is_held) = (0, false);
        change.edit_selected("decimating", FACES, |mesh, selection| {
            let made = mesh.decimate(&selection.faces(mesh, kind), &settings)?;
            removed += made.removed;
            is_held |= made.is_held;
            Ok(AfterEdit::Select(Elements::Faces(made.faces)))
        })?;
        let mut outcome = Outcome::counted("removed", removed, ["triangle", "triangles"]);
        if is_held {
            outcome.warnings.push(HELD.into());
        }
        Ok(outcome)
    }
}

/// Reverses one subdivision of the selected quads: those around the middle of each former face become that face.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct UnSubdivide {}

impl Action for UnSubdivide {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let mut removed = 0;
        change.edit_selected("reversing a subdivision", FACES, |mesh, selection| {
            let made = mesh.un_subdivide(&selection.faces(mesh, kind))?;
            removed += made.removed;
            Ok(AfterEdit::Select(Elements::Faces(made.faces)))
        })?;
        Ok(Outcome::counted("removed", removed, ["vertex", "vertices"]))
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;
    use trigon_mesh::primitives;

    use crate::tests::commands::{edited, editing_faces, run, try_run};

    #[test]
    fn a_grid_becomes_a_solid_and_is_undone() {
        let mut document = editing_faces(primitives::grid(2.0, 2.0, 2, 2));
        run(&mut document, json!({ "op": "solidify", "thickness": 0.5, "rim_material": 1 }));
        assert!(edited(&document).is_watertight() && (edited(&document).volume() - 2.0).abs() < 1e-6);
        document.undo().expect("one");
        assert_eq!(edited(&document).face_count(), 4);
        let refused = try_run(&mut document, json!({ "op": "solidify", "offset": 2 })).expect_err("too far");
        assert!(refused.to_string().contains("offset"), "{refused}");
    }

    #[test]
    fn a_cube_becomes_struts_and_is_undone() {
        let mut document = editing_faces(primitives::cube(2.0));
        run(&mut document, json!({ "op": "wireframe", "thickness": 0.1 }));
        assert!(edited(&document).is_watertight() && edited(&document).face_count() == 72);
        document.undo().expect("one");
        assert_eq!(edited(&document).face_count(), 6);
    }

    #[test]
    fn a_subdivided_cube_becomes_a_cube_again() {
        let mut document = editing_faces(primitives::cube(2.0));
        run(&mut document, json!({ "op": "subdivide" }));
        run(&mut document, json!({ "op": "select_all" }));
        let outcome = try_run(&mut document, json!({ "op": "un_subdivide" })).expect("possible");
        assert_eq!((outcome.message.as_str(), edited(&document).face_count()), ("removed 18 vertices", 6));
        let refused =
            try_run(&mut document, json!({ "op": "un_subdivide" })).expect_err("a cube").to_string();
        assert!(refused.contains("regular"), "{refused}");
    }

    #[test]
    fn a_sphere_is_reduced_to_each_goal() {
        for (command, most) in [
            (json!({ "op": "decimate", "ratio": 0.25 }), 320),
            (json!({ "op": "decimate", "goal": "faces", "faces": 100 }), 100),
            (json!({ "op": "decimate", "goal": "error", "error": 0.05 }), 600),
        ] {
            let mut document = editing_faces(primitives::icosphere(1.0, 3));
            let outcome = try_run(&mut document, command.clone()).expect("possible");
            let left = edited(&document).face_count();
            assert!(left <= most && edited(&document).is_watertight(), "{left} after {command}");
            assert_eq!(outcome.message, format!("removed {} triangles", 1280 - left));
        }
    }
}
