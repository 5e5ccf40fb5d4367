//! Boxes around points: around all points of a mesh, and around the vertices that a drag does not move
//! ([`StillBounds`]).
//!
//! [`Blocks`] are bounding boxes of 64 consecutive triangles each, and of eight triangles within each 64. Consecutive
//! triangles are mostly neighbours, so a query about a small part of space skips most triangles 64 at a time, and then
//! eight at a time.

use std::ops::Range;

use rayon::prelude::*;
use trigon_math::{Bounds3, Vec3};
use trigon_mesh::Mesh;

use super::Geometry;

/// The smallest and the largest of some numbers, ignoring NaN. Several at a time, because updates of large
/// meshes wait for it.
pub(super) fn range(values: &[f32]) -> [f32; 2] {
    const AT_A_TIME: usize = 16;
    let (mut least, mut greatest) = ([f32::INFINITY; AT_A_TIME], [f32::NEG_INFINITY; AT_A_TIME]);
    let (chunks, rest) = values.as_chunks::<AT_A_TIME>();
    let mut include = |lane: usize, value: f32| {
        least[lane] = if value < least[lane] { value } else { least[lane] };
        greatest[lane] = if value > greatest[lane] { value } else { greatest[lane] };
    };
    for chunk in chunks {
        (0..AT_A_TIME).for_each(|lane| include(lane, chunk[lane]));
    }
    rest.iter().for_each(|&value| include(0, value));
    let least_of = |a: f32, b: f32| if b < a { b } else { a };
    let greatest_of = |a: f32, b: f32| if b > a { b } else { a };
    [
        least.into_iter().fold(f32::INFINITY, least_of),
        greatest.into_iter().fold(f32::NEG_INFINITY, greatest_of),
    ]
}

/// The same without the numbers at some indices, which increase.
pub(super) fn range_without(values: &[f32], indices: &[u32]) -> [f32; 2] {
    let ranges = runs_without(values.len(), indices).map(|run| range(&values[run]));
    ranges.fold([f32::INFINITY, f32::NEG_INFINITY], |[least, greatest], [low, high]| {
        [if low < least { low } else { least }, if high > greatest { high } else { greatest }]
    })
}

/// The runs of numbers below `count` between those that are left out, which increase.
pub(crate) fn runs_without(count: usize, left_out: &[u32]) -> impl Iterator<Item = Range<usize>> {
    let ends = left_out.iter().map(|&number| number as usize).chain([count]);
    let mut start = 0;
    ends.map(move |end| {
        let end = end.min(count);
        let run = start.min(end)..end;
        start = end + 1;
        run
    })
}

/// The smallest box around points. Its bits do not depend on their order: zeros in it are
/// positive. A NaN coordinate is skipped.
pub(crate) fn box_around(points: impl Iterator<Item = Vec3>) -> Bounds3 {
    let (mut min, mut max) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for point in points {
        for (axis, value) in point.to_array().into_iter().enumerate() {
            min[axis] = if value < min[axis] { value } else { min[axis] };
            max[axis] = if value > max[axis] { value } else { max[axis] };
        }
    }
    box_between(Vec3::from_array(min), Vec3::from_array(max))
}

/// The box with the smallest and the largest coordinate of each axis.
pub(super) fn box_of_ranges([x, y, z]: [[f32; 2]; 3]) -> Bounds3 {
    let [min, max] = [0, 1].map(|end| Vec3::new(x[end], y[end], z[end]));
    box_between(min, max)
}

fn box_between(min: Vec3, max: Vec3) -> Bounds3 {
    // Adding zero makes zeros positive and changes nothing else.
    let [min, max] = [min, max].map(|corner| (corner + Vec3::ZERO).as_dvec3());
    Bounds3 { min, max }
}

/// The vertices that moved last, and the box around all others. That is the same as long as no others move, so a drag
/// finds it once.
#[derive(Clone, Debug, Default)]
pub(crate) struct StillBounds {
    moved: Vec<u32>,
    /// `None` until somebody asks for it.
    others: Option<Bounds3>,
}

impl StillBounds {
    /// The box around all vertices but those that are about to move, if it is known. It is if the box around all, which
    /// is given, stays the same without them, or if they have moved last: then `others` finds it once, from their
    /// indices, which increase. Vertices without a place do not count.
    pub(crate) fn without(
        &mut self,
        bounds: Option<Bounds3>,
        moved: impl Iterator<Item = u32> + Clone,
        position: impl Fn(u32) -> Option<Vec3>,
        others: impl FnOnce(&[u32]) -> Bounds3,
    ) -> Option<Bounds3> {
        let is_repeated = self.moved.iter().copied().eq(moved.clone());
        if !is_repeated {
            *self = Self { moved: moved.clone().collect(), others: None };
        }
        let bounds = bounds?;
        let is_on_border = |vertex: u32| {
            let position = position(vertex).map(Vec3::as_dvec3);
            position.is_some_and(|position| (position.cmpeq(bounds.min) | position.cmpeq(bounds.max)).any())
        };
        if !moved.clone().any(is_on_border) {
            return Some(bounds);
        }
        is_repeated.then(|| {
            *self.others.get_or_insert_with(|| {
                let mut moved = self.moved.clone();
                moved.sort_unstable();
                others(&moved)
            })
        })
    }
}

/// Triangles per box.
const BLOCK: usize = 64;

/// Triangles in a part of a box. A part gets its own box when the whole one is near; it is far smaller where a row
/// of quads crosses waves.
const PART: usize = 8;

/// Boxes per task.
const SHARE: usize = 64;

/// Boxes around all triangles of a mesh, in its own space.
#[derive(Clone, Debug)]
pub(crate) struct Blocks {
    boxes: Vec<BlockBox>,
    triangles: usize,
    /// Faces with corners that no triangle has, because they cross themselves or have no area. Increasing.
    pub(crate) scant_faces: Vec<u32>,
}

/// The least and the greatest coordinates, leaving out NaN; infinite without any.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BlockBox {
    pub(crate) min: [f32; 3],
    pub(crate) max: [f32; 3],
}

impl Blocks {
    pub(super) fn new(source: &Mesh, geometry: &Geometry) -> Self {
        let (triangles, positions) = (&geometry.triangles, &geometry.columns.positions);
        let blocks = triangles.par_chunks(BLOCK).with_min_len(SHARE);
        Self {
            boxes: blocks.map(|block| BlockBox::around(block, positions)).collect(),
            triangles: triangles.len(),
            scant_faces: scant_faces(source, geometry),
        }
    }

    /// Triangles in boxes that pass a test, from the first one on, a few at a time.
    pub(crate) fn within(
        &self,
        geometry: &Geometry,
        may_hold: impl Fn(&BlockBox) -> bool + Copy,
    ) -> impl Iterator<Item = Range<usize>> {
        let parts = move |(start, block): (usize, &BlockBox)| {
            let end = if may_hold(block) { self.triangles.min(start + BLOCK) } else { start };
            (start..end).step_by(PART).map(move |start| start..end.min(start + PART))
        };
        let is_near = move |part: &Range<usize>| {
            let triangles = &geometry.triangles[part.clone()];
            may_hold(&BlockBox::around(triangles, &geometry.columns.positions))
        };
        let all = (0..self.triangles).step_by(BLOCK).zip(&self.boxes);
        all.flat_map(parts).filter(is_near)
    }
}

impl BlockBox {
    fn around(triangles: &[[u32; 3]], positions: &[Vec<f32>; 3]) -> Self {
        let (mut min, mut max) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        for &corner in triangles.as_flattened() {
            for axis in 0..3 {
                let value = positions[axis][corner as usize];
                min[axis] = if value < min[axis] { value } else { min[axis] };
                max[axis] = if value > max[axis] { value } else { max[axis] };
            }
        }
        Self { min, max }
    }
}

/// Faces with fewer triangles than their number of corners less two. With exactly that many, each triangle
/// cuts off one corner, and the last has three, so every corner has a triangle.
fn scant_faces(source: &Mesh, geometry: &Geometry) -> Vec<u32> {
    let mut counts = vec![0; source.face_count()];
    for (triangle, &[a, b, c]) in geometry.triangles.iter().enumerate() {
        counts[geometry.face(triangle) as usize] += usize::from(a != b || b != c);
    }
    let faces = (0..).zip(counts.iter().zip(source.faces()));
    faces.filter(|(_, (count, corners))| *count + 2 < corners.len()).map(|(face, _)| face).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use trigon_mesh::primitives;

    proptest! {
        #[test]
        fn runs_hold_all_numbers_but_those_left_out(
            count in 0..40_usize,
            mut left_out in prop::collection::vec(0..45_u32, 0..40),
        ) {
            left_out.sort_unstable();
            let expected: Vec<_> = (0..count).filter(|&number| !left_out.contains(&(number as u32))).collect();
            prop_assert_eq!(runs_without(count, &left_out).flatten().collect::<Vec<_>>(), expected);
        }

        #[test]
        fn ranges_without_some_are_those_of_the_rest(
            values in prop::collection::vec(prop_oneof![9 => -9.0_f32..9.0, 1 => Just(f32::NAN)], 0..40),
            indices in prop::collection::btree_set(0..45_u32, 0..40),
        ) {
            let indices: Vec<u32> = indices.into_iter().collect();
            let rest: Vec<f32> = (0..).zip(&values)
                .filter(|(index, _)| !indices.contains(index))
                .map(|(_, value)| *value)
                .collect();
            prop_assert_eq!(range_without(&values, &indices), range(&rest));
        }
    }

    #[test]
    fn a_box_around_points_is_that_of_all_of_them_in_any_order() {
        let numbers = (0..50).map(|i| ((i * 37 % 50) as f32 - 20.0) * 0.5).collect::<Vec<_>>();
        assert_eq!(range(&numbers), [-10.0, 14.5], "beyond whole groups, too");
        assert_eq!(range(&[f32::NAN, 3.0]), [3.0; 2], "without NaN");
        assert_eq!(range(&[]), [f32::INFINITY, f32::NEG_INFINITY], "of none");
        let points = [Vec3::new(-0.0, 1.0, f32::NAN), Vec3::new(0.0, -2.0, f32::NAN)];
        for points in [points, [points[1], points[0]]] {
            let Bounds3 { min, max } = box_around(points.into_iter());
            assert!(min.x.is_sign_positive() && max.x.is_sign_positive(), "one zero");
            assert_eq!([min.y, max.y], [-2.0, 1.0], "both points");
            assert!(min.z > max.z, "nothing is known of z");
        }
        assert_eq!(box_around(std::iter::empty()), Bounds3::EMPTY, "around nothing");
    }

    fn scant(mesh: &Mesh) -> Vec<u32> {
        scant_faces(mesh, &Geometry::new(mesh))
    }

    #[test]
    fn faces_whose_corners_all_have_triangles_are_not_scant() {
        for mesh in [primitives::cube(1.0), primitives::cone(1.0, 1.0, 9), primitives::icosphere(1.0, 1)] {
            assert!(scant(&mesh).is_empty(), "{:?}", scant(&mesh));
        }
    }

    #[test]
    fn boxes_hold_their_triangles() {
        let mesh = primitives::torus(1.0, 0.4, 40, 20);
        let geometry = Geometry::new(&mesh);
        let blocks = Blocks::new(&mesh, &geometry);
        let all: Vec<usize> = blocks.within(&geometry, |_| true).flatten().collect();
        assert!(all.iter().copied().eq(0..geometry.triangles.len()), "each once, in order");
        // Of those to the right all are found, and not many others.
        let is_right = |triangle: &usize| {
            let corners = geometry.triangles[*triangle];
            corners.iter().any(|&corner| geometry.columns.positions[0][corner as usize] > 1.2)
        };
        let found: Vec<usize> = blocks.within(&geometry, |part| part.max[0] > 1.2).flatten().collect();
        assert!((0..geometry.triangles.len()).filter(is_right).all(|triangle| found.contains(&triangle)));
        assert!(found.len() < all.len(), "{} of {}", found.len(), all.len());
        assert_eq!(blocks.within(&geometry, |_| false).count(), 0);
    }
}
