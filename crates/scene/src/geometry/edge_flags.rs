//! Which sides of triangles are edges of their polygons, and how much larger a polygon is than each of its
//! triangles.

use trigon_mesh::{Halves, Mesh, QuadCut, Quads};
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
    give: impl FnMut(EdgeFlags),
) {
    let corners = source.face_corners(face as usize);
    match source.corner_vertices()[corners.clone()] {
        // Most faces of most meshes.
        [a, b, c, d] => match diagonal(corners.start as u32, triangles) {
            Some(cut) => {
                let mut quads = Quads::<1>::NONE;
                quads.place(0, [a, b, c, d].map(|vertex| source.positions()[vertex as usize]));
                flags_of_quads(&quads, &[Some(cut)]).into_iter().flatten().for_each(give);
            }
            None => flags_of_any(source, (face, triangles), give),
        },
        _ => flags_of_any(source, (face, triangles), give),
    }
}

/// The diagonal along which a quad with this first corner is cut; `None` if it is cut in another way.
fn diagonal(first: u32, triangles: &[[u32; 3]]) -> Option<QuadCut> {
    // Number by number: they were just written, and a processor waits to read several at once.
    let &[[a, b, c], [d, e, f]] = triangles else { return None };
    match [a, b, c, d, e, f].map(|corner| corner.wrapping_sub(first)) {
        [0, 1, 2, 0, 2, 3] => Some(QuadCut::First),
        [0, 1, 3, 1, 2, 3] => Some(QuadCut::Second),
        _ => None,
    }
}

/// For the triangles of each quad: what [`flags_of_any`] finds in more steps.
#[inline(always)]
pub(super) fn flags_of_quads<const N: usize>(
    quads: &Quads<N>,
    cuts: &[Option<QuadCut>; N],
) -> [[EdgeFlags; 2]; N] {
    // Loops, because closures for arrays are not always inlined.
    let mut is_first = [true; N];
    for (is_first, cut) in is_first.iter_mut().zip(cuts) {
        *is_first = *cut != Some(QuadCut::Second);
    }
    let Halves { doubled_areas, outer_lengths, diagonals } = quads.halves(is_first);
    let mut ratios = [[0.0; N]; 2];
    for lane in 0..N {
        let measure = |triangle: usize| Measure {
            area: doubled_areas[triangle][lane],
            perimeter: outer_lengths[triangle][lane] + diagonals[lane],
            edges: outer_lengths[triangle][lane],
        };
        let (one, other) = (measure(0), measure(1));
        let whole = one.sum(other);
        (ratios[0][lane], ratios[1][lane]) = (one.radius_ratio(&whole), other.radius_ratio(&whole));
    }
    let mut flags = [[EdgeFlags::NONE; 2]; N];
    for (lane, (flags, cut)) in flags.iter_mut().zip(cuts).enumerate() {
        let made = match cut {
            Some(QuadCut::Ear(_)) => {
                flags[0] = EdgeFlags::new([true, true, false]);
                continue;
            }
            Some(QuadCut::Second) => [[true, false, true], [true, true, false]],
            _ => [[true, true, false], [false, true, true]],
        };
        let [one, other] = made;
        flags[0] = EdgeFlags::new(one).with_radius_ratio(ratios[0][lane]);
        flags[1] = EdgeFlags::new(other).with_radius_ratio(ratios[1][lane]);
    }
    flags
}

/// For the triangles of any face.
fn flags_of_any(source: &Mesh, (face, triangles): (u32, &[[u32; 3]]), mut give: impl FnMut(EdgeFlags)) {
    let corners = source.face_corners(face as usize);
    let (first, last) = (corners.start as u32, corners.end as u32 - 1);
    let neighbours = |from: u32, to: u32| to == if from == last { first } else { from + 1 };
    let edges = |&[a, b, c]: &[u32; 3]| [(a, b), (b, c), (c, a)].map(|(from, to)| neighbours(from, to));
    if let [triangle] = triangles {
        return give(EdgeFlags::new(edges(triangle)));
    }
    let measures: Vec<_> =
        triangles.iter().map(|triangle| Measure::new(source, triangle, edges(triangle))).collect();
    let whole = measures.iter().copied().fold(Measure::default(), Measure::sum);
    for (triangle, part) in triangles.iter().zip(measures) {
        give(EdgeFlags::new(edges(triangle)).with_radius_ratio(part.radius_ratio(&whole)));
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

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::Vec3;
    use trigon_mesh::MeshBuilder;

    use super::*;

    proptest! {
        #[test]
        fn quads_have_the_flags_of_polygons(
            corners in prop::array::uniform4(prop::array::uniform3(prop_oneof![
                4 => -2.0_f32..2.0,
                4 => (-1_i8..=1).prop_map(f32::from),
                1 => prop::sample::select(vec![-0.0, 1e-30, 1e30, f32::NAN, f32::INFINITY]),
            ])),
        ) {
            let mut builder = MeshBuilder::new();
            corners.iter().for_each(|&corner| { builder.push_vertex(Vec3::from_array(corner)); });
            builder.push_face(&[0, 1, 2, 3]).expect("four vertices");
            let quad = builder.build();
            for from_first in [true, false] {
                let triangles = if from_first { [[0, 1, 2], [0, 2, 3]] } else { [[0, 1, 3], [1, 2, 3]] };
                let (mut own, mut expected) = (Vec::new(), Vec::new());
                flags_of_face(&quad, (0, &triangles), |flags| own.push(flags));
                flags_of_any(&quad, (0, &triangles), |flags| expected.push(flags));
                prop_assert_eq!(own, expected, "from the first: {}", from_first);
            }
        }
    }

    #[test]
    fn a_cube_shows_twelve_edges_and_no_diagonal() {
        let cube = trigon_mesh::primitives::cube(1.0);
        let flags = flags_of_mesh(&cube);
        let shown: usize =
            flags.iter().map(|flags| (0..3).filter(|&edge| flags.contains(edge)).count()).sum();
        assert_eq!((flags.len(), shown), (12, 24), "each edge is seen from its two faces");
    }
}
