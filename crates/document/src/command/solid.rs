//! Solidifying faces, making struts and tubes of edges, and reducing the number of faces.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
pub use trigon_modelling::{
    DecimateSettings as Decimate, SolidifySettings as Solidify, TubeSettings as Tube,
    WireframeSettings as Wireframe,
};

use super::{Action, Outcome};
use crate::error::EditError;
use crate::selection::Elements;
use crate::state::{AfterEdit, Change};

const FACES: &str = "at least one selected face";

impl Action for Solidify {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        change.edit_selected_faces("solidifying", FACES, |mesh, faces| {
            mesh.solidify_faces(faces, self).map(drop)
        })?;
        Ok(Outcome::silent())
    }
}

impl Action for Wireframe {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        change.edit_selected("making a wireframe", FACES, |mesh, selection| {
            let made = mesh.wireframe_faces(&selection.faces(mesh, kind), self)?;
            Ok(AfterEdit::Select(Elements::Faces(made)))
        })?;
        Ok(Outcome::silent())
    }
}

impl Action for Tube {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        change.edit_selected("making a tube", "at least one selected edge", |mesh, selection| {
            let made = mesh.tube_edges(&selection.edges(mesh, kind), self)?;
            Ok(AfterEdit::Select(Elements::Faces(made)))
        })?;
        Ok(Outcome::silent())
    }
}

/// Why there are more triangles than were asked for.
const HELD: &str = "more are left than were asked for: borders, marks and ends of texture coordinates hold them; \
                    without hold_values those of texture coordinates and colours do not";

impl Action for Decimate {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let (mut removed, mut is_held) = (0, false);
        change.edit_selected("decimating", FACES, |mesh, selection| {
            let made = mesh.decimate(&selection.faces(mesh, kind), self)?;
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
    fn a_face_becomes_a_ring_and_is_undone() {
        let mut document = editing_faces(primitives::grid(2.0, 2.0, 1, 1));
        run(&mut document, json!({ "op": "tube", "radius": 0.1, "sides": 6 }));
        assert_eq!(edited(&document).face_count(), 1 + 4 * 6);
        document.undo().expect("one");
        assert_eq!(edited(&document).face_count(), 1);
        let refused = try_run(&mut document, json!({ "op": "tube", "sides": 2 })).expect_err("too few");
        assert!(refused.to_string().contains("sides"), "{refused}");
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
