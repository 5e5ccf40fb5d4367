//! Triangles with next to no area: down to 2⁻¹⁶ square pixels, up to ten million
//! times as long as wide, and ten thousand of them around one corner.

use crate::coverage::fan_triangles;
use crate::coverage_support::{SIDE, Values, clip_position, count, draw, pixel};
use crate::effort::cases;
use crate::multisampling::light;
use proptest::prelude::*;
use trigon_math::{Vec4, elementary};
use trigon_raster::{Culling, Draw, Pass};
use trigon_study::oracle::GridPoint;
use trigon_study::oracle::coverage::{covers, doubled_area, mask, pixel_center};

/// A direction with no common divisor, so that the edge along it meets no points of
/// the grid between its ends.
fn direction() -> impl Strategy<Value = [i32; 2]> {
    let step = -9000..9000_i32;
    [step.clone(), step].prop_filter("not 0", |&d| d != [0, 0]).prop_map(|[x, y]| {
        let (divisor, ..) = divide(x, y);
        [x / divisor, y / divisor]
    })
}

/// The greatest common divisor g of two numbers, not negative, and s and t with
/// `s x + t y = g`: Euclid's algorithm.
fn divide(x: i32, y: i32) -> (i32, i32, i32) {
    let (mut rests, mut s, mut t) = ([x, y], [1, 0], [0, 1]);
    while rests[1] != 0 {
        let quotient = rests[0].div_euclid(rests[1]);
        let next = |[a, b]: [i32; 2]| [b, a - quotient * b];
        (rests, s, t) = (next(rests), next(s), next(t));
    }
    if rests[0] < 0 { (-rests[0], -s[0], -t[0]) } else { (rests[0], s[0], t[0]) }
}

/// A sliver with a sample on its long edge: the edge runs so many times its
/// direction to either side of it, and the third corner lies beside the first of
/// these steps, so near that twice the area is `thickness` for each.
fn at_sample(sample: GridPoint, [x, y]: [i32; 2], times: [i32; 2], thickness: i32) -> [GridPoint; 3] {
    let at = |steps: i32| [sample[0] + steps * x, sample[1] + steps * y];
    let (_, s, t) = divide(x, y);
    // x · s - y · -t = 1, and whole steps along the edge change nothing of it.
    let beside = [-thickness * t, thickness * s];
    let product = |[a, b]: [i32; 2]| i64::from(a) * i64::from(x) + i64::from(b) * i64::from(y);
    let steps = product(beside).div_euclid(product([x, y])) as i32;
    let first = at(-times[0] - steps);
    [at(-times[0]), at(times[1]), [first[0] + beside[0], first[1] + beside[1]]]
}

/// Slivers through the centre of a pixel, of either side and winding.
pub(crate) fn sliver() -> impl Strategy<Value = [GridPoint; 3]> {
    let thickness = prop_oneof![Just(1), Just(-1), -40..40_i32];
    ([0..SIDE, 0..SIDE], direction(), [1..3_i32, 1..3], thickness, any::<bool>()).prop_map(
        |(at, direction, times, thickness, turned)| {
            let [a, b, c] =
                at_sample(pixel_center(at), direction, times, if thickness == 0 { 1 } else { thickness });
            if turned { [a, c, b] } else { [a, b, c] }
        },
    )
}

proptest! {
    #![proptest_config(cases(400))]

    #[test]
    fn slivers_cover_what_exact_arithmetic_says(points in sliver(), samples in prop_oneof![Just(1_u32), Just(4), Just(16)]) {
        let light = light(&Values::on_grid(&points), &[[0, 1, 2]], samples);
        for (index, &light) in light.iter().enumerate() {
            let expected = mask(points, samples, pixel(index)).count_ones();
            prop_assert_eq!(light * samples as f32, expected as f32, "{:?} at {:?}", points, pixel(index));
        }
    }

    /// A sliver on an edge that runs through a sample, and two triangles that fill what
    /// it leaves of a larger one: each pixel of that is covered by one of the three.
    #[test]
    fn what_a_sliver_takes_the_rest_does_not_have(
        points in sliver(),
        place in 0.2_f64..0.8,
        height in 0.1_f64..1.0,
    ) {
        let [a, b, c] = points;
        let along = [b[0] - a[0], b[1] - a[1]].map(f64::from);
        let side = doubled_area(points).signum() as f64;
        let across = [-along[1] * side, along[0] * side];
        let apex = [0, 1].map(|axis| a[axis] + (along[axis] * place + across[axis] * height) as i32);
        let whole = [a, b, apex];
        let turns = [points, [b, apex, c], [apex, a, c]].map(|part| doubled_area(part).signum());
        prop_assume!(turns == [doubled_area(whole).signum(); 3]);
        let parts = [[0, 1, 2], [1, 3, 2], [3, 0, 2]];
        let counts = count(&Values::on_grid(&[a, b, c, apex]), &parts);
        for (index, &count) in counts.iter().enumerate() {
            prop_assert_eq!(count, u32::from(covers(whole, pixel_center(pixel(index)))), "at {:?}", pixel(index));
        }
    }

    #[test]
    fn depths_and_values_of_slivers_stay_within_their_corners(
        points in sliver(),
        depths in [depth(), depth(), depth()],
        values in [-1e6_f32..1e6, -1e6..1e6, -1e6..1e6],
        level in 0..4_usize,
    ) {
        // Two corners alike, so that all but one are at an end of the range.
        let pair = |all: [f32; 3]| [0, 1, 2].map(|i| if level == 3 || i == level { all[i] } else { all[(level + 1) % 3] });
        let (depths, values) = (pair(depths), pair(values));
        let vertices = [0, 1, 2].map(|i| (clip_position(points[i], depths[i]), values[i]));
        let pipeline = Values { vertices: vertices.to_vec() };
        let mut pass = Pass::new();
        pass.triangles(Draw { culling: Culling::None, ..Draw::new(&pipeline, &[[0, 1, 2]]) });
        let images = draw(&pass);
        let within = |value: f32, [a, b, c]: [f32; 3]| a.min(b).min(c) <= value && value <= a.max(b).max(c);
        let ids = images.triangles.expect("asked for");
        let (depth, linear) = (images.depth.expect("asked for"), images.linear.expect("asked for"));
        for index in 0..ids.len() {
            let is_covered = covers(points, pixel_center(pixel(index)));
            prop_assert_eq!(ids[index] == 0, is_covered, "coverage at {:?}", pixel(index));
            if !is_covered {
                continue;
            }
            prop_assert!(within(depth[index], depths), "depth {} of {depths:?}", depth[index]);
            prop_assert!(within(linear[index].x, values), "{} of {values:?}", linear[index].x);
        }
    }
}

/// Also far from the eye, where depths have many more places than a plane's rise
/// from near the eye.
fn depth() -> impl Strategy<Value = f32> {
    prop_oneof![0.0_f32..1.0, 1e-9_f32..1e-6]
}

/// The generator keeps what it promises, and some of the slivers are seen: else the
/// properties above would hold of nothing.
#[test]
fn slivers_are_thin_and_hold_samples() {
    let mut seen = 0;
    for direction in [[5807, 7919], [-7919, 5807], [9000, 1], [3, -8999]] {
        for thickness in [1, -1] {
            let sample = pixel_center([SIDE / 2; 2]);
            let sliver = at_sample(sample, direction, [1, 1], thickness);
            // In square pixels: half of 2/65536.
            assert_eq!(doubled_area(sliver).abs(), 2, "{direction:?}: area 2^-16");
            let length = direction.map(|v| 2.0 * f64::from(v)).iter().map(|v| v * v).sum::<f64>();
            assert!(length / 2.0 > 1e7, "longer than wide by the square of the length over twice the area");
            seen += u32::from(covers(sliver, sample));
        }
    }
    assert_eq!(seen, 4, "of slivers on both sides of an edge, one has the sample");
}

/// Hard case 2, and more of it: every sample belongs to one triangle, also that in
/// the middle, where all of them meet.
#[test]
fn ten_thousand_triangles_around_one_corner_cover_each_sample_once() {
    let count_of_triangles = 10_000;
    for middle in [[32 * 256 + 128; 2], [32 * 256; 2], [8191, 8201]] {
        let mut positions = vec![clip_position(middle, 0.5)];
        for i in 0..count_of_triangles {
            let angle = std::f64::consts::TAU * f64::from(i) / f64::from(count_of_triangles);
            let (sine, cosine) = elementary::sin_cos(angle);
            positions.push(Vec4::new(2.0 * cosine as f32, 2.0 * sine as f32, 0.5, 1.0));
        }
        for samples in [1, 8] {
            let light =
                light(&Values::ones(positions.iter().copied()), &fan_triangles(count_of_triangles), samples);
            let wrong = light.iter().position(|&light| light != 1.0);
            assert!(wrong.is_none(), "{samples} samples around {middle:?}: wrong at {:?}", wrong.map(pixel));
        }
    }
}
