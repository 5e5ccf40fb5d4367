//! Selecting by place: what scripts use where a user would draw a box.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::edit::{EdgeId, EditMesh, FaceId, VertexId};
use trigon_mesh::math::DVec3;

use super::select_related::change_selections;
use super::{Action, Outcome};
use crate::document::Change;
use crate::error::EditError;
use crate::selection::{ElementKind, Elements};

/// Selects the elements whose middle (the mean of their vertices) lies within a box, bounds included.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectWithin {
    /// The smallest coordinates, in metres in the space of the mesh.
    pub min: [f64; 3],
    /// The largest coordinates, in metres in the space of the mesh.
    pub max: [f64; 3],
    /// Whether what was selected before stays so.
    pub add: bool,
}

impl Default for SelectWithin {
    fn default() -> Self {
        Self { min: [-1e30; 3], max: [1e30; 3], add: false }
    }
}

impl Action for SelectWithin {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let (min, max) = (DVec3::from(self.min), DVec3::from(self.max));
        let is_within = |middle: DVec3| middle.cmpge(min).all() && middle.cmple(max).all();
        change_selections(change, "select within a box", |mesh, kind, selection| {
            let found = match kind {
                ElementKind::Vertex => Elements::Vertices(within(mesh.vertices(), is_within, |v| {
                    middle(mesh, &mut [v].into_iter())
                })),
                ElementKind::Edge => Elements::Edges(within(mesh.edges(), is_within, |edge: EdgeId| {
                    middle(mesh, &mut mesh.edge_vertices(edge).into_iter())
                })),
                ElementKind::Face => Elements::Faces(within(mesh.faces(), is_within, |face: FaceId| {
                    middle(mesh, &mut mesh.face_vertices(face))
                })),
            };
            let before = selection.bits().clone();
            selection.select(mesh, kind, &found);
            if self.add {
                let mut all = selection.bits().clone();
                all.union_with(&before);
                selection.set(all);
            }
            Ok(())
        })
    }
}

fn within<I: Copy>(
    elements: impl Iterator<Item = I>,
    is_within: impl Fn(DVec3) -> bool,
    middle: impl Fn(I) -> DVec3,
) -> Vec<I> {
    elements.filter(|&element| is_within(middle(element))).collect()
}

fn middle(mesh: &EditMesh, vertices: &mut dyn Iterator<Item = VertexId>) -> DVec3 {
    let (sum, count) = vertices.fold((DVec3::ZERO, 0u32), |(sum, count), vertex| {
        (sum + mesh.position(vertex).as_dvec3(), count + 1)
    });
    sum / f64::from(count)
}
