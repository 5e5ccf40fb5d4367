//! Which sides of triangles are edges of their polygons, and how much larger a polygon is than each of its
//! triangles.

use trigon_mesh::Mesh;
use trigon_raster::EdgeFlags;

/// For each triangle of a mesh's triangulation.
pub(super) fn flags_of_mesh(source: &Mesh) -> Vec<EdgeFlags> {
    let triangulation = source.triangulation();
    let mut flags = Vec::with_capacity(triangulation.triangles.len());
    let mut rest = triangulation.triangles.as_slice();
    for face in triangulation.triangle_faces.chunk_by(|a, b| a == b) {
        let (triangles, others) = rest.split_at(face.len());
        rest = others;
        flags_of_face(source, (face[0], triangles), |part| flags.push(part));
    }
    flags
}

/// For each triangle of a face. An edge of a triangle is an edge of its polygon when it
/// joins neighbouring corners; all others are diagonals of the triangulation.
pub(super) fn flags_of_face(
    source: &Mesh,
    (face, triangles): (u32, &[[u32; 3]]),
    mut give: impl FnMut(EdgeFlags),
) {
    let corners = source.face_corners(face as usize);
    let (first, last) = (corners.start as u32, corners.end as u32 - 1);
    let neighbours = |from: u32, to: u32| to == if from == last { first } else { from + 1 };
    let edges = |&[a, b, c]: &[u32; 3]| [(a, b), (b, c), (c, a)].map(|(from, to)| neighbours(from, to));
    let measure = |triangle: &[u32; 3]| Measure::new(source, triangle, edges(triangle));
    let mut give_all = |measures: &[Measure]| {
        let whole = measures.iter().copied().fold(Measure::default(), Measure::sum);
        for (triangle, part) in triangles.iter().zip(measures) {
            give(EdgeFlags::new(edges(triangle)).with_radius_ratio(part.radius_ratio(&whole)));
        }
    };
    match triangles {
        [triangle] => give(EdgeFlags::new(edges(triangle))),
        // Quads are many, and take no memory.
        [first, second] => give_all(&[measure(first), measure(second)]),
        _ => give_all(&triangles.iter().map(measure).collect::<Vec<_>>()),
    }
}

/// The size of a triangle of a polygon.
#[derive(Clone, Copy, Default)]
struct Measure {
    /// Twice the area.
    area: f64,
    perimeter: f64,
    /// The length of those sides that are edges of the polygon.
    edges: f64,
}

impl Measure {
    fn new(source: &Mesh, triangle: &[u32; 3], edges: [bool; 3]) -> Self {
        let position = |corner: u32| source.positions()[source.corner_vertices()[corner as usize] as usize];
        let [a, b, c] = triangle.map(|corner| position(corner).as_dvec3());
        let sides = [b - a, c - b, a - c];
        let lengths = sides.map(|side| side.length());
        let of_edges = lengths.iter().zip(edges).filter(|(_, is_edge)| *is_edge);
        Self {
            area: sides[0].cross(sides[1]).length(),
            perimeter: lengths.iter().sum(),
            edges: of_edges.map(|(length, _)| length).sum(),
        }
    }

    /// The ratio of the polygon's inner radius to that of this triangle.
    fn radius_ratio(&self, whole: &Self) -> f32 {
        // A triangle in the middle of a polygon may have no edge.
        let own = if self.edges > 0.0 { self.edges } else { self.perimeter };
        // Without area the ratio is NaN, and ignored.
        ((whole.area * own) / (self.area * whole.edges)) as f32
    }

    fn sum(self, other: Self) -> Self {
        Self {
            area: self.area + other.area,
            perimeter: self.perimeter + other.perimeter,
            edges: self.edges + other.edges,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cube_shows_twelve_edges_and_no_diagonal() {
        let cube = trigon_mesh::primitives::cube(1.0);
        let flags = flags_of_mesh(&cube);
        let shown: usize =
            flags.iter().map(|flags| (0..3).filter(|&edge| flags.contains(edge)).count()).sum();
        assert_eq!((flags.len(), shown), (12, 24), "each edge is seen from its two faces");
    }
}
