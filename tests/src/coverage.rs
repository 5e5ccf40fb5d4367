//! Which pixels a triangle covers, against an oracle in exact integers; and that
//! meshes leave no gaps and cover nothing twice. Hard cases 1 to 9, 14, 15, 18.

use crate::coverage_support::{SIDE, Values, clip_position, count, draw, pixel};
use crate::effort::cases;
use crate::random::Random;
use proptest::prelude::*;
use trigon_math::perspective_infinite_reverse;
use trigon_math::{Mat4, Vec4, elementary};
use trigon_raster::{BlendMode, Culling, Draw, Output, Pass, Rasterizer, Target};
use trigon_study::oracle::GridPoint;
use trigon_study::oracle::coverage::{covers, pixel_center};

/// Points that meet pixel centres and each other often, anywhere in and around
/// the image, or far out in the guard band.
fn point() -> impl Strategy<Value = GridPoint> {
    let near = -20 * 256..(SIDE + 20) * 256;
    let half = (-8..2 * SIDE + 8).prop_map(|v| v * 128);
    let far = (-32700 * 256)..(32700 * 256);
    prop_oneof![
        3 => [near.clone(), near],
        2 => [half.clone(), half],
        1 => [far.clone(), far],
    ]
}

/// Any three points, or two and a third within a few units of the line through
/// them.
pub(crate) fn triangle() -> impl Strategy<Value = [GridPoint; 3]> {
    let sliver = (point(), point(), 0..=1000_i64, [-3..=3_i32, -3..=3]).prop_map(|(a, b, t, jitter)| {
        let along = |i: usize| {
            let (from, to) = (i64::from(a[i]), i64::from(b[i]));
            (from + (to - from) * t / 1000) as i32 + jitter[i]
        };
        [a, b, [along(0), along(1)]]
    });
    prop_oneof![2 => [point(), point(), point()], 1 => sliver]
}

fn check_against_oracle(points: [GridPoint; 3]) {
    let pipeline = Values::on_grid(&points);
    let counts = count(&pipeline, &[[0, 1, 2]]);
    let mut pass = Pass::new();
    pass.triangles(Draw { culling: Culling::None, ..Draw::new(&pipeline, &[[0, 1, 2]]) });
    let seen = draw(&pass).triangles.expect("asked for");
    for (index, (&count, &id)) in counts.iter().zip(&seen).enumerate() {
        let expected = covers(points, pixel_center(pixel(index)));
        assert_eq!(count, u32::from(expected), "translucent {points:?} at {:?}", pixel(index));
        assert_eq!(id == 0, expected, "opaque {points:?} at {:?}", pixel(index));
    }
}

proptest! {
    #![proptest_config(cases(300))]

    #[test]
    fn a_triangle_covers_what_exact_arithmetic_says(points in triangle()) {
        check_against_oracle(points);
    }

    #[test]
    fn two_triangles_share_the_pixels_on_their_edge(a in point(), b in point(), c in point(), d in point()) {
        let side = |p: GridPoint| {
            let [ab, ap] = [b, p].map(|q| [i128::from(q[0] - a[0]), i128::from(q[1] - a[1])]);
            (ab[0] * ap[1] - ab[1] * ap[0]).signum()
        };
        prop_assume!(side(c) * side(d) < 0);
        let triangles = [[0, 1, 2], [0, 1, 3]];
        let counts = count(&Values::on_grid(&[a, b, c, d]), &triangles);
        for (index, &count) in counts.iter().enumerate() {
            let expected = u32::from(covers([a, b, c], pixel_center(pixel(index)))) + u32::from(covers([a, b, d], pixel_center(pixel(index))));
            prop_assert_eq!(count, expected);
            prop_assert!(count <= 1, "covered twice at {:?}", pixel(index));
        }
    }

    #[test]
    fn the_order_and_winding_of_corners_change_nothing(points in triangle(), depths in [0.0_f32..1.0, 0.0..1.0, 0.0..1.0]) {
        let vertices = [0, 1, 2].map(|i| (clip_position(points[i], depths[i]), depths[i] * 7.0));
        let pipeline = Values { vertices: vertices.to_vec() };
        let images = [[0, 1, 2], [1, 2, 0], [2, 1, 0]].map(|corners| {
            let triangles = [corners];
            let mut pass = Pass::new();
            pass.triangles(Draw { culling: Culling::None, ..Draw::new(&pipeline, &triangles) });
            draw(&pass)
        });
        prop_assert!(images[0] == images[1], "rotated");
        prop_assert!(images[0] == images[2], "reversed");
        let triangles = images[0].triangles.as_ref().expect("asked for");
        for (index, &shown) in triangles.iter().enumerate() {
            prop_assert_eq!(shown == 0, covers(points, pixel_center(pixel(index))), "at {:?}", pixel(index));
        }
    }

    #[test]
    fn whole_pixels_move_the_image_exactly(points in triangle(), dx in -20..20_i32, dy in -20..20_i32) {
        let moved = points.map(|[x, y]| [x + 256 * dx, y + 256 * dy]);
        let [before, after] = [points, moved].map(|points| count(&Values::on_grid(&points), &[[0, 1, 2]]));
        for (index, &count) in before.iter().enumerate() {
            let [x, y] = pixel(index);
            prop_assert_eq!(count, u32::from(covers(points, pixel_center([x, y]))), "at {:?}", [x, y]);
            prop_assert_eq!(after[index], u32::from(covers(moved, pixel_center([x, y]))), "moved, at {:?}", [x, y]);
            if (0..SIDE).contains(&(x + dx)) && (0..SIDE).contains(&(y + dy)) {
                prop_assert_eq!(count, after[((y + dy) * SIDE + x + dx) as usize]);
            }
        }
    }

    /// A square tiled by a jittered grid, its cells split along either
    /// diagonal, in either winding.
    #[test]
    fn a_tiled_square_is_covered_once(
        cells in 1..24_i32,
        corner in [128..2000_i32, 128..2000],
        side in 3000..12000_i32,
        seed in any::<u64>(),
    ) {
        let mut random = Random(seed);
        let step = |i: i32| side * i / cells;
        let inner = |i: i32| 0 < i && i < cells;
        let mut points = Vec::new();
        for j in 0..=cells {
            for i in 0..=cells {
                let reach = side / cells / 5;
                let jitter = [inner(i), inner(j)].map(|free| if free { random.within(reach) } else { 0 });
                points.push([corner[0] + step(i) + jitter[0], corner[1] + step(j) + jitter[1]]);
            }
        }
        let triangles = grid_triangles(cells as u32, &mut random);
        let counts = count(&Values::on_grid(&points), &triangles);
        for (index, &count) in counts.iter().enumerate() {
            let inside = [0, 1].map(|axis| {
                let centre = 256 * pixel(index)[axis] + 128;
                (corner[axis]..corner[axis] + side).contains(&centre)
            });
            prop_assert_eq!(count, u32::from(inside == [true; 2]), "at {:?}", pixel(index));
        }
    }

    /// Hard cases 15 and 18: the ground below the camera, most of its triangles
    /// cut by the near plane or behind the eye.
    #[test]
    fn the_ground_ends_at_the_horizon(
        height in 0.01_f32..3.0,
        turn in -3.0_f32..3.0,
        cells in 1..12_u32,
        near in 0.001_f32..0.1,
        seed in any::<u64>(),
    ) {
        let mut random = Random(seed);
        let projection = perspective_infinite_reverse(1.2, 1.0, near);
        let view = projection * Mat4::from_rotation_y(turn);
        let reach = 1e6;
        let mut positions = Vec::new();
        for j in 0..=cells {
            for i in 0..=cells {
                let along = |k: u32| (k as f32 / cells as f32 * 2.0 - 1.0) * reach;
                positions.push(view * Vec4::new(along(i), -height, along(j), 1.0));
            }
        }
        let counts = count(&Values::ones(positions), &grid_triangles(cells, &mut random));
        // The lowest row that the near plane leaves: the ground at its distance.
        let tangent = elementary::tan(0.6);
        let horizon = f64::from(SIDE) / 2.0;
        let lowest = horizon * (1.0 + f64::from(height) / (f64::from(near) * tangent));
        // All corners have the same y, so rounding moves them along the ground only. Its far
        // edge, 10⁶ cos 0.6 away and more, lies 0.0002 pixel below the horizon; snapping, and
        // the cut at the guard band's rim, move it by 1/90 (see `hard_cases::huge`).
        let off = 1.0 / 80.0;
        for (index, &count) in counts.iter().enumerate() {
            let y = f64::from(pixel(index)[1]);
            prop_assert!(count <= 1, "covered twice at {:?}", pixel(index));
            if y + 0.5 > horizon + off && y + 0.5 < lowest - off {
                prop_assert_eq!(count, 1, "a hole at {:?}", pixel(index));
            }
            if y + 0.5 < horizon - off {
                prop_assert_eq!(count, 0, "ground in the sky at {:?}", pixel(index));
            }
        }
    }

    /// Triangles that reach beyond the guard band on any side, as a fan around a
    /// point that is seen.
    #[test]
    fn a_fan_beyond_the_guard_band_has_no_gaps(
        centre in [0..SIDE * 256, 0..SIDE * 256],
        radius in 100.0_f64..1e7,
        count_of_triangles in 3..40_u32,
        turn in 0.0_f64..7.0,
    ) {
        let mut positions = vec![clip_position(centre, 0.5)];
        for i in 0..count_of_triangles {
            let angle = turn + std::f64::consts::TAU * f64::from(i) / f64::from(count_of_triangles);
            let (sine, cosine) = elementary::sin_cos(angle);
            positions.push(Vec4::new((cosine * radius) as f32, (sine * radius) as f32, 0.5, 1.0));
        }
        let counts = count(&Values::ones(positions), &fan_triangles(count_of_triangles));
        prop_assert!(counts.iter().all(|&count| count == 1), "every pixel exactly once");
    }
}

/// Hard cases 2 and 5: fans around a pixel's centre.
#[test]
fn a_fan_covers_its_centre_once() {
    for count_of_triangles in (3..=16).chain([2000]) {
        let centre = [SIDE * 128 + 128; 2];
        let mut points = vec![centre];
        for i in 0..count_of_triangles {
            let angle = std::f64::consts::TAU * f64::from(i) / f64::from(count_of_triangles);
            let (sine, cosine) = elementary::sin_cos(angle);
            points.push([cosine, sine].map(|v| centre[0] + (v * 25.0 * 256.0) as i32));
        }
        let counts = count(&Values::on_grid(&points), &fan_triangles(count_of_triangles));
        let middle = (SIDE / 2 * SIDE + SIDE / 2) as usize;
        assert_eq!(counts[middle], 1, "the centre of {count_of_triangles} triangles");
        assert!(counts.iter().all(|&count| count <= 1), "no pixel twice");
        for (index, &count) in counts.iter().enumerate() {
            let [x, y] = pixel(index).map(|v| v - SIDE / 2);
            // The inner circle of a triangle with this circumference.
            if x * x + y * y < 12 * 12 {
                assert_eq!(count, 1, "a hole at {:?} among {count_of_triangles}", pixel(index));
            }
        }
    }
}

/// Hard case 8: the widest grid there is, 65536 samples, where the guard band is
/// the view itself; and the least target.
#[test]
fn targets_of_extreme_size_are_covered_once() {
    for ([width, height], samples) in
        [([16384, 2], 4), ([2, 16384], 4), ([16384, 3], 3), ([1, 1], 4), ([1, 1], 1)]
    {
        let mut positions = vec![Vec4::new(0.123, -0.456, 0.5, 1.0)];
        for i in 0..7 {
            let (sine, cosine) = elementary::sin_cos(f64::from(i) * std::f64::consts::TAU / 7.0);
            positions.push(Vec4::new(cosine as f32 * 5.0, sine as f32 * 3.0, 0.5, 1.0));
        }
        let pipeline = Values::ones(positions);
        let triangles = fan_triangles(7);
        let mut pass = Pass::new();
        let surface = BlendMode::Translucent;
        pass.triangles(Draw {
            blend_mode: surface,
            culling: Culling::None,
            ..Draw::new(&pipeline, &triangles)
        });
        let target = Target::new(width, height, &[Output::Linear]).expect("a size in range");
        let mut target = target.with_samples_per_axis(samples).expect("a number in range");
        Rasterizer::default().draw(&pass, &mut target);
        let once = target.linear().expect("asked for").iter().all(|color| color.x == 1.0);
        assert!(once, "every sample exactly once at {width}x{height} with {samples}");
    }
}

/// Hard case 7, along lines through the centres of pixels.
#[test]
fn triangles_without_area_cover_nothing() {
    let [near, middle, far] = [4, 20, 35].map(|pixel| 256 * pixel + 128);
    let points =
        [[near, near], [far, near], [near, near], [middle, near], [near, far], [middle; 2], [far; 2]];
    for corners in [[0, 1, 3], [1, 0, 3], [0, 2, 4], [0, 5, 6], [6, 5, 0], [0, 0, 0], [0, 1, 1]] {
        let counts = count(&Values::on_grid(&points), &[corners]);
        assert!(counts.iter().all(|&count| count == 0), "corners {corners:?}");
    }
}

pub(crate) fn fan_triangles(count: u32) -> Vec<[u32; 3]> {
    (0..count).map(|i| [0, 1 + i, 1 + (i + 1) % count]).collect()
}

/// Two triangles for each cell of a square grid, split and wound at random.
pub(crate) fn grid_triangles(cells: u32, random: &mut Random) -> Vec<[u32; 3]> {
    let mut triangles = Vec::new();
    for cell in 0..cells * cells {
        let a = cell / cells * (cells + 1) + cell % cells;
        let [a, b, c, d] = [a, a + 1, a + cells + 2, a + cells + 1];
        let halves = if random.within(1) == 0 { [[a, b, c], [a, c, d]] } else { [[b, c, d], [d, a, b]] };
        for [a, b, c] in halves {
            triangles.push(if random.within(1) == 0 { [a, b, c] } else { [a, c, b] });
        }
    }
    triangles
}
