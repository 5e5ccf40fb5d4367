//! Boxes around points.

use std::ops::Range;

use trigon_math::{Bounds3, Vec3};

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

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

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
}
