//! Which sides of triangles are edges of polygons, the mesh's edge for each such side, and how much larger a polygon is
//! than each of its triangles.

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
        push_flags_of_face(source, face[0], triangles, &mut flags);
    }
    flags
}

/// Appends the flags of each triangle of a face. An edge of a triangle is an edge of its polygon when it
/// joins neighbouring corners; all others are diagonals of the triangulation.
pub(super) fn push_flags_of_face(
    source: &Mesh,
    face: u32,
    triangles: &[[u32; 3]],
    flags: &mut Vec<EdgeFlags>,
) {
    let corners = source.face_corners(face as usize);
    let (first, last) = (corners.start as u32, corners.end as u32 - 1);
    let neighbours = |from: u32, to: u32| to == if from == last { first } else { from + 1 };
    let edges = |&[a, b, c]: &[u32; 3]| [(a, b), (b, c), (c, a)].map(|(from, to)| neighbours(from, to));
    let measure = |triangle: &[u32; 3]| Measure::new(source, triangle, edges(triangle));
    let made = |triangle: &[u32; 3], part: Measure, whole: &Measure| {
        EdgeFlags::new(edges(triangle)).with_radius_ratio(part.radius_ratio(whole))
    };
    match triangles {
        [triangle] => flags.push(EdgeFlags::new(edges(triangle))),
        // A quad: most faces of most meshes.
        [one, other] => {
            let parts = [measure(one), measure(other)];
            let whole = parts[0].sum(parts[1]);
            flags.extend([made(one, parts[0], &whole), made(other, parts[1], &whole)]);
        }
        _ => {
            let parts: Vec<Measure> = triangles.iter().map(measure).collect();
            let whole = parts.iter().copied().fold(Measure::default(), Measure::sum);
            flags.extend(triangles.iter().zip(parts).map(|(triangle, part)| made(triangle, part, &whole)));
        }
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
    #[inline(always)]
    fn radius_ratio(&self, whole: &Self) -> f32 {
        // A triangle in the middle of a polygon may have no edge.
        let own = if self.edges > 0.0 { self.edges } else { self.perimeter };
        // Without area the ratio is NaN, and ignored.
        ((whole.area * own) / (self.area * whole.edges)) as f32
    }

    #[inline(always)]
    fn sum(self, other: Self) -> Self {
        Self {
            area: self.area + other.area,
            perimeter: self.perimeter + other.perimeter,
            edges: self.edges + other.edges,
        }
    }
}

/// Marks a diagonal of a triangulation.
pub(super) const NO_EDGE: u32 = u32::MAX;

/// For each triangle of a mesh's triangulation, the edges of its three sides, starting at the first corner.
pub(super) fn sides_of_mesh(source: &Mesh) -> Vec<[u32; 3]> {
    let triangulation = source.triangulation();
    let triangles = triangulation.triangles.iter().zip(&triangulation.triangle_faces);
    triangles.map(|(triangle, &face)| sides_of_triangle(source, face, triangle)).collect()
}

/// The edges of one triangle of a face. A side is an edge if it joins consecutive corners of the face.
pub(super) fn sides_of_triangle(source: &Mesh, face: u32, &[a, b, c]: &[u32; 3]) -> [u32; 3] {
    let corners = source.face_corners(face as usize);
    let (first, last) = (corners.start as u32, corners.end as u32 - 1);
    [(a, b), (b, c), (c, a)].map(|(from, to)| {
        let next = if from == last { first } else { from + 1 };
        if to == next { source.corner_edge(from as usize).unwrap_or(NO_EDGE) } else { NO_EDGE }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use trigon_math::Vec3;
    use trigon_mesh::{MeshBuilder, primitives};

    proptest! {
        #[test]
        fn quads_have_the_flags_of_polygons(
            corners in prop::array::uniform4(prop::array::uniform3(prop_oneof![
                4 => -2.0_f32..2.0,
                4 => (-1_i8..=1).prop_map(f32::from),
                1 => prop::sample::select(vec![-0.0, 1e-30, 1e30, f32::NAN, f32::INFINITY]),
            ])),
            is_first: bool,
        ) {
            let mut builder = MeshBuilder::new();
            corners.iter().for_each(|&corner| { builder.push_vertex(Vec3::from_array(corner)); });
            builder.push_face(&[0, 1, 2, 3]).expect("four vertices");
            let quad = builder.build();
            let (triangles, edges) = if is_first {
                ([[0, 1, 2], [0, 2, 3]], [[true, true, false], [false, true, true]])
            } else {
                ([[0, 1, 3], [1, 2, 3]], [[true, false, true], [true, true, false]])
            };
            let mut own = Vec::new();
            push_flags_of_face(&quad, 0, &triangles, &mut own);
            let parts = [0, 1].map(|half| Measure::new(&quad, &triangles[half], edges[half]));
            let whole = parts.into_iter().fold(Measure::default(), Measure::sum);
            let expected =
                [0, 1].map(|half| EdgeFlags::new(edges[half]).with_radius_ratio(parts[half].radius_ratio(&whole)));
            prop_assert_eq!(own, expected);
        }
    }

    #[test]
    fn a_cube_shows_twelve_edges_and_no_diagonal() {
        let cube = primitives::cube(1.0);
        let flags = flags_of_mesh(&cube);
        let shown: usize =
            flags.iter().map(|flags| (0..3).filter(|&edge| flags.contains(edge)).count()).sum();
        assert_eq!((flags.len(), shown), (12, 24), "each edge is seen from its two faces");
    }

    #[test]
    fn every_edge_is_a_side_on_each_of_its_faces() {
        for mesh in [primitives::cube(1.0), primitives::dodecahedron(1.0)] {
            let mut found = vec![0; mesh.edge_count()];
            let triangulation = mesh.triangulation();
            for (sides, triangle) in sides_of_mesh(&mesh).iter().zip(&triangulation.triangles) {
                let vertices = triangle.map(|corner| mesh.corner_vertices()[corner as usize]);
                for (side, &edge) in sides.iter().enumerate().filter(|(_, edge)| **edge != NO_EDGE) {
                    let [from, to] = [vertices[side], vertices[(side + 1) % 3]];
                    assert_eq!(mesh.edges()[edge as usize], [from.min(to), from.max(to)], "side {side}");
                    found[edge as usize] += 1;
                }
            }
            assert!(found.iter().all(|&count| count == 2), "{found:?}");
        }
    }
}
