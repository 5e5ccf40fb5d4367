//! Who has a sample where it is hardest to say: on edges, among very many
//! triangles, and where corners lie between the steps of the grid or nowhere.

use crate::coverage::grid_triangles;
use crate::coverage_support::{
    SIDE, Values, clip_position, clip_position_on, count, draw, draw_sized, pixel,
};
use crate::effort::cases;
use crate::random::Random;
use proptest::prelude::*;
use trigon_math::Vec4;
use trigon_raster::{BlendMode, Culling, Draw, ExecuteSettings, Pass};
use trigon_study::oracle::GridPoint;
use trigon_study::oracle::coverage::{covers, pixel_center};

/// The four directions in which edges run through the centres of many pixels.
const DIRECTIONS: [[i32; 2]; 4] = [[1, 0], [0, 1], [1, 1], [1, -1]];

/// A point in and around the image, in so many parts of a pixel.
fn anywhere(parts: i32) -> impl Strategy<Value = [i32; 2]> {
    let coordinate = -20 * parts..(SIDE + 20) * parts;
    [coordinate.clone(), coordinate]
}

proptest! {
    #![proptest_config(cases(200))]

    /// In the words of Direct3D (3.4.2.1), not in those of the oracle: a sample on
    /// an edge is covered if that is a left edge, or horizontal and above the others.
    #[test]
    fn a_sample_on_an_edge_belongs_to_left_and_top_edges(
        direction in prop::sample::select(&DIRECTIONS[..]),
        at in [1..SIDE - 1, 1..SIDE - 1],
        [before, after] in [1..3000_i32, 1..3000],
        along in -3000..3000_i32,
        away in prop_oneof![-3000..-1_i32, 1..3000_i32],
    ) {
        let sample = pixel_center(at);
        let moved = |steps: i32, [x, y]: [i32; 2]| [sample[0] + steps * x, sample[1] + steps * y];
        let across = [-direction[1], direction[0]];
        let apex = moved(along, direction);
        let apex = [apex[0] + away * across[0], apex[1] + away * across[1]];
        let pipeline = Values::on_grid(&[moved(-before, direction), moved(after, direction), apex]);
        let is_right_or_below = if direction[1] == 0 { away * across[1] > 0 } else { away * across[0] > 0 };
        let index = (at[1] * SIDE + at[0]) as usize;
        prop_assert_eq!(count(&pipeline, &[[0, 1, 2]])[index], u32::from(is_right_or_below));
        let mut pass = Pass::new();
        pass.triangles(Draw { culling: Culling::None, ..Draw::new(&pipeline, &[[0, 1, 2]]) });
        let seen = draw(&pass).triangles.expect("asked for")[index] == 0;
        prop_assert_eq!(seen, is_right_or_below, "opaque");
    }

    /// Corners between the steps of the grid go to the nearest, ties to the even one,
    /// on either side of the image's border.
    #[test]
    fn corners_go_to_the_nearest_step_and_ties_to_the_even_one(
        quarters in [anywhere(1024), anywhere(1024), anywhere(1024)],
        small in any::<bool>(),
    ) {
        // In quarters of a step; for triangles of a pixel or two, all decide.
        let quarters = quarters.map(|[x, y]| if small { [x % 1500 + 9000, y % 1500 + 9000] } else { [x, y] });
        let unit = (SIDE * 512) as f32;
        let exact = quarters.map(|[x, y]| Vec4::new(x as f32 / unit - 1.0, 1.0 - y as f32 / unit, 0.5, 1.0));
        let snapped: [GridPoint; 3] = quarters.map(|corner| corner.map(nearest_even));
        let counts = count(&Values::ones(exact), &[[0, 1, 2]]);
        for (index, &count) in counts.iter().enumerate() {
            prop_assert_eq!(count, u32::from(covers(snapped, pixel_center(pixel(index)))), "at {:?}", pixel(index));
        }
    }
}

/// A number of quarters, to the nearest whole and the even one of two.
fn nearest_even(quarters: i32) -> i32 {
    let whole = quarters.div_euclid(4);
    match quarters.rem_euclid(4) {
        0 | 1 => whole,
        2 => whole + (whole & 1),
        _ => whole + 1,
    }
}

proptest! {
    #![proptest_config(cases(4))]

    /// 80,000 triangles over an image of any size: far below a pixel each, to some
    /// pixels.
    #[test]
    fn eighty_thousand_triangles_tile_an_image(
        side in prop::sample::select(&[64, 128, 256, 512, 1024][..]),
        seed in any::<u64>(),
    ) {
        const CELLS: i32 = 200;
        let mut random = Random(seed);
        let (low, width) = (-100, side * 256 + 200);
        let reach = width / CELLS / 5;
        let mut place = |i: i32| {
            let jitter = if 0 < i && i < CELLS { random.within(reach) } else { 0 };
            low + width * i / CELLS + jitter
        };
        let mut points = Vec::new();
        for j in 0..=CELLS {
            points.extend((0..=CELLS).map(|i| [place(i), place(j)]));
        }
        let pipeline = Values::ones(points.into_iter().map(|point| clip_position_on(side, point, 0.5)));
        let triangles = grid_triangles(CELLS as u32, &mut random);
        let mut pass = Pass::new();
        let surface = BlendMode::Translucent;
        pass.triangles(Draw { blend_mode: surface, culling: Culling::None, ..Draw::new(&pipeline, &triangles) });
        let linear = draw_sized(&pass, [side; 2], &ExecuteSettings::default()).linear.expect("asked for");
        let wrong = linear.iter().position(|color| color.x != 1.0);
        prop_assert!(wrong.is_none(), "sample {wrong:?} of {side}² is not covered once");
    }
}

/// What is no place on any screen.
const NOWHERE: [f32; 5] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, -f32::MAX];

proptest! {
    #![proptest_config(cases(100))]

    /// A corner that is no place takes its own triangle along and nothing else.
    #[test]
    fn a_corner_that_is_no_place_drops_its_triangle_alone(
        points in proptest::collection::vec(anywhere(256), 9..60),
        bad in any::<prop::sample::Index>(),
        axis in 0..4_usize,
        value in prop::sample::select(&NOWHERE[..]),
        surface in prop::sample::select(&[BlendMode::Opaque, BlendMode::Masked, BlendMode::Translucent][..]),
    ) {
        let depth = |index: usize| 0.1 + index as f32 / 100.0;
        let positions = points.iter().enumerate().map(|(index, &point)| clip_position(point, depth(index)));
        let mut pipeline = Values::ones(positions);
        let triangles: Vec<_> = (0..points.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let bad = bad.index(triangles.len());
        let image = |pipeline: &Values, triangles: &[[u32; 3]]| {
            let mut pass = Pass::new();
            pass.triangles(Draw { blend_mode: surface, culling: Culling::None, ..Draw::new(pipeline, triangles) });
            draw(&pass)
        };
        let mut without = triangles.clone();
        without[bad] = [0; 3];
        let expected = image(&pipeline, &without);
        pipeline.vertices[3 * bad + 1].0[axis] = value;
        prop_assert!(image(&pipeline, &triangles) == expected, "the others stay as they are");
    }
}
