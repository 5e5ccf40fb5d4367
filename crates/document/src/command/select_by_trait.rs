//! Selecting elements by what they are.

use std::cmp::Ordering;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_modelling::{EdgeId, EditMesh, FaceId};

use super::select_related::change_selections;
use super::{Action, Outcome};
use crate::error::EditError;
use crate::selection::{ElementKind, Elements};
use crate::state::Change;

/// A property of elements.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ElementTrait {
    /// Faces by their number of sides.
    #[default]
    Sides,
    /// Vertices without edges, edges without faces, or faces without neighbours, by what is selected.
    Loose,
    /// Faces all of whose edges have more than two faces.
    Interior,
}

/// How a number of sides compares to the given one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SideComparison {
    /// As many.
    #[default]
    Equal,
    /// Less.
    Fewer,
    /// More.
    More,
}

/// Selects exactly the elements with a property.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectByTrait {
    /// The property.
    pub by: ElementTrait,
    /// The number of sides, for faces by it.
    #[schemars(range(min = 3))]
    pub sides: u32,
    /// How the numbers compare.
    pub comparison: SideComparison,
}

impl Default for SelectByTrait {
    fn default() -> Self {
        Self { by: ElementTrait::default(), sides: 4, comparison: SideComparison::default() }
    }
}

impl SelectByTrait {
    fn elements(&self, mesh: &EditMesh, kind: ElementKind) -> Elements {
        match (self.by, kind) {
            (ElementTrait::Sides, _) => Elements::Faces(self.faces_by_sides(mesh)),
            (ElementTrait::Loose, ElementKind::Vertex) => {
                let is_loose = |&vertex: &_| mesh.vertex_edges(vertex).next().is_none();
                Elements::Vertices(mesh.vertices().filter(is_loose).collect())
            }
            (ElementTrait::Loose, ElementKind::Edge) => {
                let is_loose = |&edge: &EdgeId| mesh.edge_faces(edge).next().is_none();
                Elements::Edges(mesh.edges().filter(is_loose).collect())
            }
            (ElementTrait::Loose, ElementKind::Face) => {
                let is_loose = |&face: &FaceId| mesh.face_edges(face).all(|edge| mesh.is_boundary(edge));
                Elements::Faces(mesh.faces().filter(is_loose).collect())
            }
            (ElementTrait::Interior, _) => {
                let is_shared = |edge| mesh.edge_faces(edge).nth(2).is_some();
                let is_interior = |&face: &FaceId| mesh.face_edges(face).all(is_shared);
                Elements::Faces(mesh.faces().filter(is_interior).collect())
            }
        }
    }

    fn faces_by_sides(&self, mesh: &EditMesh) -> Vec<FaceId> {
        let wanted = match self.comparison {
            SideComparison::Equal => Ordering::Equal,
            SideComparison::Fewer => Ordering::Less,
            SideComparison::More => Ordering::Greater,
        };
        mesh.faces().filter(|&face| mesh.face_size(face).cmp(&(self.sides as usize)) == wanted).collect()
    }
}

impl Action for SelectByTrait {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        change_selections(change, "select by trait", |mesh, kind, selection| {
            selection.select(mesh, kind, &self.elements(mesh, kind));
            Ok(())
        })
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;
    use trigon_mesh::primitives;

    use crate::tests::commands::{chosen, editing_faces, run};

    #[test]
    fn faces_are_found_by_their_sides() {
        let mut document = editing_faces(primitives::cylinder(1.0, 2.0, 7));
        let by = |sides: u32, comparison: &str| json!({ "op": "select_by_trait", "sides": sides, "comparison": comparison });
        assert_eq!(chosen(&mut document, json!({ "op": "select_by_trait" })), 7, "quads");
        assert_eq!(chosen(&mut document, by(4, "more")), 2, "both ends");
        assert_eq!(chosen(&mut document, by(4, "fewer")), 0);
        assert_eq!(chosen(&mut document, by(7, "fewer")), 7);
    }

    #[test]
    fn a_wall_inside_a_box_is_interior() {
        let mut document = editing_faces(primitives::cube(2.0));
        run(&mut document, json!({ "op": "bisect", "fill": true }));
        assert_eq!(chosen(&mut document, json!({ "op": "select_by_trait", "by": "interior" })), 1);
        assert_eq!(chosen(&mut document, json!({ "op": "select_by_trait", "by": "loose" })), 0);
        let mut single = editing_faces(primitives::grid(1.0, 1.0, 1, 1));
        assert_eq!(chosen(&mut single, json!({ "op": "select_by_trait", "by": "loose" })), 1);
    }
}
