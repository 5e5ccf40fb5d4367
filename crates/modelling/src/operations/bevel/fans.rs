//! The faces around a vertex, in order.

use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, VertexId};

/// Corners at one vertex, counter-clockwise seen from outside: each leaves along the edge by
/// which the one before it is entered.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fan {
    pub(super) vertex: VertexId,
    /// The range of its corners in [`Fans::corners`].
    pub(super) start: usize,
    pub(super) end: usize,
    /// Whether the last corner is entered by the edge along which the first leaves.
    pub(super) is_closed: bool,
    /// Whether it is closed, or ends at edges with one face. Otherwise it ends where more than two faces
    /// meet, or faces that wind in opposite ways; or it is one face that runs along an edge and
    /// back.
    pub(super) is_simple: bool,
}

/// Fans with their corners in one list.
#[derive(Debug, Default)]
pub(super) struct Fans {
    pub(super) corners: Vec<CornerId>,
    pub(super) fans: Vec<Fan>,
}

impl Fans {
    /// Adds the fan of a corner.
    pub(super) fn walk(&mut self, mesh: &EditMesh, corner: CornerId) -> Fan {
        let (first, is_closed) = first_of_fan(mesh, corner);
        let start = self.corners.len();
        let mut last = first;
        self.corners.push(first);
        while let Some(next) = next_in_fan(mesh, last).filter(|&next| next != first) {
            self.corners.push(next);
            last = next;
        }
        let is_simple = if is_closed {
            self.corners.len() - start > 1
        } else {
            let ends = [mesh.corner_edge(first), mesh.corner_edge(mesh.previous_corner(last))];
            ends.iter().all(|&edge| mesh.is_boundary(edge))
        };
        let vertex = mesh.corner_vertex(corner);
        let fan = Fan { vertex, start, end: self.corners.len(), is_closed, is_simple };
        self.fans.push(fan);
        fan
    }
}

/// The corner that leaves along the edge by which a corner is entered.
fn next_in_fan(mesh: &EditMesh, corner: CornerId) -> Option<CornerId> {
    let before = mesh.previous_corner(corner);
    let [a, b] = mesh.edge_pair(mesh.corner_edge(before))?;
    let other = if a == before { b } else { a };
    (mesh.corner_vertex(other) == mesh.corner_vertex(corner)).then_some(other)
}

/// The corner that is entered by the edge along which a corner leaves.
fn previous_in_fan(mesh: &EditMesh, corner: CornerId) -> Option<CornerId> {
    let [a, b] = mesh.edge_pair(mesh.corner_edge(corner))?;
    let other = mesh.next_corner(if a == corner { b } else { a });
    (mesh.corner_vertex(other) == mesh.corner_vertex(corner)).then_some(other)
}

/// The first corner of an open fan, or the corner itself; and whether the fan is closed.
fn first_of_fan(mesh: &EditMesh, corner: CornerId) -> (CornerId, bool) {
    let mut first = corner;
    while let Some(previous) = previous_in_fan(mesh, first) {
        if previous == corner {
            return (corner, true);
        }
        first = previous;
    }
    (first, false)
}
