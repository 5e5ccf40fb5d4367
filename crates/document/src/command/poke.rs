//! Poking faces, and the convex hull of vertices.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_modelling::HullSettings;

use super::{Action, Outcome};
use crate::error::EditError;
use crate::selection::{ElementKind, Elements};
use crate::state::{AfterEdit, Change};

/// Cuts each selected face into triangles around a new vertex in its middle.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Poke {
    /// How far the new vertices move along the faces' normals, in metres.
    pub offset: f64,
}

impl Action for Poke {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        change.edit_selected("poking", "at least one selected face", |mesh, selection| {
            let made = mesh.poke_faces(&selection.faces(mesh, kind), self.offset)?;
            Ok(AfterEdit::Select(Elements::Faces(made.faces)))
        })?;
        Ok(Outcome::silent())
    }
}

/// Makes the smallest convex solid around the selected vertices of each mesh.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ConvexHull {
    /// Whether faces and edges among the vertices that are not the hull's go, and vertices that nothing uses then.
    pub replace: bool,
}

impl Default for ConvexHull {
    fn default() -> Self {
        Self { replace: HullSettings::default().replace }
    }
}

impl Action for ConvexHull {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let settings = HullSettings { replace: self.replace };
        let kind = change.selection().kind();
        let mut faces = 0;
        change.edit_selected(
            "making a convex hull",
            "at least four selected vertices",
            |mesh, selection| {
                let hull = mesh.convex_hull(&selection.vertices(mesh, kind), &settings)?;
                faces += hull.faces.len();
                let corners = || hull.faces.iter().flat_map(|&face| mesh.face_vertices(face));
                Ok(AfterEdit::Select(match kind {
                    ElementKind::Vertex => Elements::Vertices(corners().collect()),
                    _ => Elements::Faces(hull.faces.clone()),
                }))
            },
        )?;
        Ok(Outcome::counted("made", faces, ["face", "faces"]))
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;
    use trigon_mesh::primitives;

    use crate::tests::commands::{edited, editing_faces, run, try_run};

    #[test]
    fn faces_are_poked_and_enclosed_and_all_is_undone() {
        let mut document = editing_faces(primitives::cube(2.0));
        run(&mut document, json!({ "op": "poke", "offset": 0.5 }));
        assert_eq!(edited(&document).face_count(), 24);
        let outcome = try_run(&mut document, json!({ "op": "convex_hull" })).expect("possible");
        assert_eq!(outcome.message, "made 24 faces", "a tetrakis hexahedron");
        run(&mut document, json!({ "op": "select_none" }));
        (0..3).for_each(|_| document.undo().expect("three"));
        assert_eq!(edited(&document).face_count(), 6);
        let mut flat = editing_faces(primitives::grid(1.0, 1.0, 2, 2));
        let refused = try_run(&mut flat, json!({ "op": "convex_hull" })).expect_err("flat").to_string();
        assert!(refused.contains("plane"), "{refused}");
    }
}
