//! Vertices and edges: the points at which they must be visible, and what they belong to.

use trigon_mesh::Mesh;

use super::nearby::Nearby;
use super::region::Area;
use super::screen::{Spot, nearer_first};

/// What has points of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Vertex,
    Edge,
}

impl Kind {
    /// How many of them a mesh has.
    pub(super) fn count(self, mesh: &Mesh) -> usize {
        match self {
            Self::Vertex => mesh.vertex_count(),
            Self::Edge => mesh.edge_count(),
        }
    }

    /// Whether a face has this vertex, or this edge as one of its sides.
    pub(super) fn belongs(self, mesh: &Mesh, face: u32, element: u32) -> bool {
        match self {
            Self::Vertex => mesh.face_vertices(face as usize).contains(&element),
            Self::Edge => {
                mesh.face_corners(face as usize).any(|corner| mesh.corner_edge(corner) == Some(element))
            }
        }
    }

    /// Calls `visit` with the points of an element that lie in the area.
    #[inline]
    pub(super) fn points(self, nearby: &Nearby<'_>, element: usize, mut visit: impl FnMut(Spot)) {
        let mut keep = |spot: Spot| {
            if spot.is_in_range() && nearby.area.contains(spot.at) {
                visit(spot);
            }
        };
        match self {
            Self::Vertex => nearby.vertex(element).into_iter().for_each(keep),
            Self::Edge => {
                if let Some(line) = nearby.edge(element) {
                    own_points(&line, nearby.area, &mut keep);
                }
            }
        }
    }
}

/// The points of a line that make an edge seen: where it crosses the middles of columns
/// of pixels, or of rows where it is steeper; where it crosses none, its own middle. Those
/// beside the area are left out.
fn own_points(line: &[Spot; 2], area: &Area<'_>, mut visit: impl FnMut(Spot)) {
    let [start, end] = nearer_first(*line, |spot| spot.at);
    let way = end.at - start.at;
    let (axis, pixels) = if way.x.abs() >= way.y.abs() { (0, &area.columns) } else { (1, &area.rows) };
    let (from, to) = (start.at[axis], end.at[axis]);
    let (low, high) = if from < to { (from, to) } else { (to, from) };
    let (first, last) = (-floor(0.5 - low), floor(high - 0.5));
    if first > last || low == high {
        visit(start.towards(&end, 0.5));
        return;
    }
    // The casts saturate.
    let inside = (first as u32).max(pixels.start)..(last as u32).saturating_add(1).min(pixels.end);
    if last < 0.0 {
        return;
    }
    for pixel in inside {
        let middle = f64::from(pixel) + 0.5;
        let mut spot = start.towards(&end, (middle - from) / (to - from));
        spot.at[axis] = middle;
        visit(spot);
    }
}

/// The largest whole number up to one; near those numbers whose size no image has.
/// Where the processor has no instruction for it, this takes less than a call.
#[inline]
fn floor(number: f64) -> f64 {
    let whole = number as i64 as f64;
    if whole > number { whole - 1.0 } else { whole }
}
