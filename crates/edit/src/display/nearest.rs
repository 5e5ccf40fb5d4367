//! How far an element is from the pointer on the screen.

use trigon_mesh::edit::{EdgeId, FaceId, VertexId};
use trigon_mesh::math::DVec2;
use trigon_scene::{MeshId, NodeId};

use super::pick::Picks;
use crate::selection::ElementKind;

/// An element that is edited, with an object that shows it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Target {
    pub(super) node: NodeId,
    pub(super) mesh: MeshId,
    /// Its number of the kind that is looked for.
    pub(super) element: u32,
}

/// Pixels from a point to a vertex, to an edge's line, or to a face's middle; infinite where it
/// is not on the screen.
pub(super) fn distance(picks: &Picks<'_>, kind: ElementKind, target: &Target, point: DVec2) -> f64 {
    let Some(mesh) = picks.document.mesh(target.mesh) else { return f64::INFINITY };
    let world = picks.document.nodes().world_transform(target.node);
    let at = |vertex: VertexId| {
        picks.projector.to_screen(world.transform_point3(mesh.position(vertex).as_dvec3()))
    };
    let found = match kind {
        ElementKind::Vertex => at(VertexId::new(target.element)).map(|at| at.distance(point)),
        ElementKind::Edge => {
            let [a, b] = mesh.edge_vertices(EdgeId::new(target.element)).map(at);
            a.zip(b).map(|(a, b)| distance_to_line([a, b], point))
        }
        ElementKind::Face => {
            let center = world.transform_point3(mesh.face_center(FaceId::new(target.element)));
            picks.projector.to_screen(center).map(|center| center.distance(point))
        }
    };
    found.unwrap_or(f64::INFINITY)
}

/// From a point to the line between two others.
fn distance_to_line([a, b]: [DVec2; 2], point: DVec2) -> f64 {
    let along = b - a;
    let length = along.length_squared();
    let share = if length > 0.0 { ((point - a).dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
    (a + along * share).distance(point)
}
