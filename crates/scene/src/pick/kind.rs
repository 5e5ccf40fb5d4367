//! Vertices and edges: where they have to be seen, and what they belong to.

use std::ops::Range;

use trigon_mesh::Mesh;

use super::hiding::Candidate;
use super::object::Object;
use super::region::Area;
use super::screen::{Screen, Spot};

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

    /// The points of some elements that lie in an area.
    pub(super) fn candidates(
        self,
        object: &Object<'_>,
        screen: &Screen,
        area: &Area<'_>,
        elements: Range<usize>,
    ) -> Vec<Candidate> {
        let (spots, mut found) = (object.vertices(screen), Vec::new());
        let number = object.node.index() as u32;
        let mut keep = |element: usize, spot: Spot| {
            if spot.is_in_range() && area.contains(spot.at) {
                found.push(Candidate { spot, object: number, element: element as u32 });
            }
        };
        match self {
            Self::Vertex => {
                let used = object.used();
                elements.filter(|&vertex| used[vertex]).for_each(|vertex| keep(vertex, spots[vertex]));
            }
            Self::Edge => {
                let edges = object.mesh().edges();
                for edge in elements {
                    let ends = edges[edge].map(|vertex| spots[vertex as usize]);
                    let line = match ends.map(|end| end.is_somewhere()) {
                        [true, true] if is_beside(&ends, area) => None,
                        [true, true] => Some(ends),
                        [false, false] => None,
                        _ => object.cut_line(screen, edges[edge]),
                    };
                    if let Some(line) = line {
                        own_points(&line, area, |spot| keep(edge, spot));
                    }
                }
            }
        }
        found
    }
}

/// Whether a line lies on one side of an area.
fn is_beside([start, end]: &[Spot; 2], area: &Area<'_>) -> bool {
    let apart = |from: f64, to: f64, pixels: &Range<u32>| {
        let (low, high) = (f64::from(pixels.start), f64::from(pixels.end));
        (from < low && to < low) || (from > high && to > high)
    };
    apart(start.at.x, end.at.x, &area.columns) || apart(start.at.y, end.at.y, &area.rows)
}

/// The points of a line that make an edge seen: where it crosses the middles of columns
/// of pixels, or of rows where it is steeper; where it crosses none, its own middle. Those
/// beside the area are left out.
fn own_points([start, end]: &[Spot; 2], area: &Area<'_>, mut visit: impl FnMut(Spot)) {
    let way = end.at - start.at;
    let (axis, pixels) = if way.x.abs() >= way.y.abs() { (0, &area.columns) } else { (1, &area.rows) };
    let (from, to) = (start.at[axis], end.at[axis]);
    let (low, high) = if from < to { (from, to) } else { (to, from) };
    let (first, last) = ((low - 0.5).ceil(), (high - 0.5).floor());
    if first > last || low == high {
        visit(start.towards(end, 0.5));
        return;
    }
    // The casts saturate.
    let inside = (first as u32).max(pixels.start)..(last as u32).saturating_add(1).min(pixels.end);
    if last < 0.0 {
        return;
    }
    for pixel in inside {
        let middle = f64::from(pixel) + 0.5;
        let mut spot = start.towards(end, (middle - from) / (to - from));
        spot.at[axis] = middle;
        visit(spot);
    }
}
