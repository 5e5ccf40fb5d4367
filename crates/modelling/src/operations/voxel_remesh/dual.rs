//! The surface between the points inside and outside: a quad for each edge of the lattice between them, and a vertex for
//! each sheet of it in each cell.

use trigon_math::DVec3;

use super::cell::{CellSheets, is_ambiguous};
use super::lattice::{InsidePoints, Lattice};
use super::lines::LineCrossing;

/// Quads over numbered vertices.
#[derive(Debug, Default)]
pub(super) struct DualSurface {
    pub(super) positions: Vec<DVec3>,
    /// Counter-clockwise seen from outside.
    pub(super) quads: Vec<[u32; 4]>,
}

/// An edge of the lattice between a point inside and one outside.
struct CrossedEdge {
    /// The index of its first point.
    start: u64,
    axis: usize,
    /// Whether its first point is inside.
    starts_inside: bool,
}

impl CrossedEdge {
    /// The cells around it, counter-clockwise seen against its axis, and its number in each of them.
    fn cells(&self, lattice: &Lattice) -> [(u64, usize); 4] {
        let [b, c] = [(self.axis + 1) % 3, (self.axis + 2) % 3].map(|axis| lattice.stride(axis));
        let edge = 4 * self.axis;
        [
            (self.start - b - c, edge + 3),
            (self.start - c, edge + 2),
            (self.start, edge),
            (self.start - b, edge + 1),
        ]
    }

    /// Where it crosses the surface: the first crossing from outside.
    fn crossing(&self, lattice: &Lattice, crossings: &[LineCrossing]) -> DVec3 {
        let numbers = lattice.numbers(self.start);
        let at = |axis: usize| lattice.coordinate(axis, numbers[axis]);
        let [b, c] = [(self.axis + 1) % 3, (self.axis + 2) % 3];
        let line = lattice.line(self.axis, [numbers[b], numbers[c]]);
        // Which points are inside is decided along x; another axis may cross a point on the other side of it by rounding.
        let margin = 1e-9 * lattice.step;
        let [from, to] = [at(self.axis), lattice.coordinate(self.axis, numbers[self.axis] + 1)];
        let first = crossings.partition_point(|crossing| {
            crossing.line < line || crossing.line == line && crossing.coordinate < from - margin
        });
        let mut here = crossings[first..]
            .iter()
            .take_while(|crossing| crossing.line == line && crossing.coordinate <= to + margin)
            .map(|crossing| crossing.coordinate);
        let found = if self.starts_inside { here.last() } else { here.next() };
        let mut position = DVec3::new(at(0), at(1), at(2));
        position[self.axis] = found.unwrap_or(0.5 * (from + to)).clamp(from, to);
        position
    }
}

/// The cells that the surface crosses, in the order of their indices.
struct CrossedCells {
    indices: Vec<u64>,
    sheets: Vec<CellSheets>,
    /// The number of the vertex of each cell's first sheet.
    first: Vec<u32>,
    vertices: u32,
}

impl CrossedCells {
    fn new(lattice: &Lattice, inside: &InsidePoints, edges: &[CrossedEdge]) -> Self {
        let mut indices: Vec<u64> =
            edges.iter().flat_map(|edge| edge.cells(lattice).map(|(cell, _)| cell)).collect();
        indices.sort_unstable();
        indices.dedup();
        let corners: Vec<u8> = indices.iter().map(|&cell| corners_inside(lattice, inside, cell)).collect();
        let joined = joined_sides(lattice, &indices, &corners);
        let sheets: Vec<CellSheets> =
            corners.iter().zip(joined).map(|(&corners, joined)| CellSheets::new(corners, joined)).collect();
        let mut vertices = 0;
        let first = sheets.iter().map(|sheets| {
            let first = vertices;
            vertices += sheets.count();
            first
        });
        let first = first.collect();
        Self { indices, sheets, first, vertices }
    }

    /// The vertex of the sheet that crosses an edge of a cell.
    fn vertex(&self, cell: u64, edge: usize) -> u32 {
        let number = self.indices.binary_search(&cell).expect("cells of all crossed edges are listed");
        self.first[number] + self.sheets[number].of(edge) as u32
    }
}

/// Makes the surface. `crossings` are those of the lines along each axis.
///
/// Vertices are the means of their sheet's crossings (S. Gibson, "Constrained Elastic Surface Nets", 1998, without its
/// relaxation); several sheets of a cell have a vertex each (G. Nielson, "Dual Marching Cubes", 2004). So each vertex has
/// one cycle of faces.
pub(super) fn dual_surface(
    lattice: &Lattice,
    inside: &InsidePoints,
    crossings: &[Vec<LineCrossing>; 3],
) -> DualSurface {
    let mut edges = Vec::new();
    for axis in 0..3 {
        inside.for_each_change(axis, |start, starts_inside| {
            edges.push(CrossedEdge { start, axis, starts_inside });
        });
    }
    let cells = CrossedCells::new(lattice, inside, &edges);
    let mut sums = vec![(DVec3::ZERO, 0_u8); cells.vertices as usize];
    let mut surface = DualSurface::default();
    for edge in &edges {
        let position = edge.crossing(lattice, &crossings[edge.axis]);
        let mut quad = edge.cells(lattice).map(|(cell, number)| cells.vertex(cell, number));
        for vertex in quad {
            let (sum, count) = &mut sums[vertex as usize];
            *sum += position;
            *count += 1;
        }
        if !edge.starts_inside {
            quad.reverse();
        }
        surface.quads.push(quad);
    }
    surface.positions = sums.into_iter().map(|(sum, count)| sum / f64::from(count)).collect();
    surface
}

/// A bit for each corner of a cell that is inside.
fn corners_inside(lattice: &Lattice, inside: &InsidePoints, cell: u64) -> u8 {
    let [x, y, z] = lattice.numbers(cell);
    (0..8_u64)
        .filter(|corner| inside.contains([x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2)]))
        .fold(0, |bits, corner| bits | 1 << corner)
}

/// For each cell the sides across which inner corners are joined.
///
/// Inner corners across a side are separated, but where one sheet would cross the side twice in both cells beside it: both
/// of its vertices would be joined by two edges, of which a mesh has only one, with four faces. Joining the corners
/// instead divides the sheet on both sides (R. Wenger, "Isosurfaces", 2013, 3.3.5, has another way to find these cells).
/// Each division leaves fewer such sides.
fn joined_sides(lattice: &Lattice, indices: &[u64], corners: &[u8]) -> Vec<u8> {
    let mut joined = vec![0_u8; indices.len()];
    for (cell, &index) in indices.iter().enumerate() {
        for axis in 0..3 {
            let (far, near) = (2 * axis + 1, 2 * axis);
            if !is_ambiguous(corners[cell], far) {
                continue;
            }
            let next = indices.binary_search(&(index + lattice.stride(axis)));
            let next = next.expect("the surface crosses the cell beside it, too");
            let is_doubled =
                |cell: usize, side: usize| CellSheets::new(corners[cell], joined[cell]).is_doubled_at(side);
            if is_doubled(cell, far) && is_doubled(next, near) {
                joined[cell] |= 1 << far;
                joined[next] |= 1 << near;
            }
        }
    }
    joined
}
