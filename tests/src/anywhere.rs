//! Coverage, depth and values of a triangle anywhere in an image of a thousand tiles, against the same oracles that the other
//! properties use in images of one.

use crate::coverage_support::{Values, clip_position_on, rasterizer};
use crate::depth_plane::bound;
use crate::effort::cases;
use crate::hard_cases::slivers::sliver;
use num_traits::Signed;
use proptest::prelude::*;
use trigon_math::elementary::exp2;
use trigon_raster::{Culling, Draw, ExecuteSettings, Output, Pass, Target, TargetImages, TileSize};
use trigon_study::oracle::GridPoint;
use trigon_study::oracle::area::rational;
use trigon_study::oracle::coverage::{covers, doubled_area, pixel_center};
use trigon_study::oracle::depth::Plane;

/// Width and height of the image.
const SIDE: i32 = 2048;

/// Width and height of what is looked at closely, in pixels; every triangle lies in it.
const WINDOW: i32 = 64;

/// The first pixel of a window, often with borders of tiles through it, at the image's borders, or at a multiple of its size.
fn place() -> impl Strategy<Value = [i32; 2]> {
    let end = SIDE - WINDOW;
    let along = prop_oneof![3 => 0..=end, 1 => Just(0), 1 => Just(end), 1 => (0..=end / 64).prop_map(|tile| tile * 64)];
    [along.clone(), along]
}

/// A triangle in a window at the origin: of any shape, or a sliver with what of it lies there.
fn corners() -> impl Strategy<Value = [GridPoint; 3]> {
    let inside = || [0..WINDOW * 256, 0..WINDOW * 256];
    let clamped =
        |points: [GridPoint; 3]| points.map(|point| point.map(|along| along.clamp(0, WINDOW * 256)));
    prop_oneof![2 => [inside(), inside(), inside()], 1 => sliver().prop_map(clamped)]
}

fn tile_size() -> impl Strategy<Value = TileSize> {
    let all = [TileSize::Pixels8, TileSize::Pixels16, TileSize::Pixels32, TileSize::Pixels64];
    prop::sample::select(all.to_vec())
}

/// The images of one triangle that has been moved by whole pixels.
fn drawn(points: [GridPoint; 3], numbers: [[f32; 2]; 3], tile_size: TileSize) -> TargetImages {
    let vertex = |corner: usize| {
        let [depth, value] = numbers[corner];
        (clip_position_on(SIDE, points[corner], depth), value)
    };
    let pipeline = Values { vertices: [0, 1, 2].map(vertex).to_vec() };
    let mut pass = Pass::new();
    pass.triangles(Draw { culling: Culling::None, ..Draw::new(&pipeline, &[[0, 1, 2]]) });
    let outputs = [Output::Linear, Output::Depth, Output::Triangle];
    let mut target = Target::new(SIDE as u32, SIDE as u32, &outputs).expect("the size is in range");
    rasterizer(&ExecuteSettings { tile_size, ..Default::default() }).draw(&pass, &mut target);
    target.into_images()
}

fn moved(points: [GridPoint; 3], pixels: [i32; 2]) -> [GridPoint; 3] {
    points.map(|point| [0, 1].map(|axis| point[axis] + 256 * pixels[axis]))
}

/// The pixels of a window, with their place in the image.
fn window([left, top]: [i32; 2]) -> impl Iterator<Item = ([i32; 2], usize)> {
    let pixels = (top..top + WINDOW).flat_map(move |y| (left..left + WINDOW).map(move |x| [x, y]));
    pixels.map(|[x, y]| ([x, y], (y * SIDE + x) as usize))
}

proptest! {
    #![proptest_config(cases(20))]

    #[test]
    fn coverage_is_exact_anywhere(points in corners(), at in place(), tile_size in tile_size()) {
        let points = moved(points, at);
        let ids = drawn(points, [[0.5, 1.0]; 3], tile_size).triangles.expect("asked for");
        for (pixel, index) in window(at) {
            prop_assert_eq!(ids[index] == 0, covers(points, pixel_center(pixel)), "{:?} at {:?}", points, pixel);
        }
        let within = window(at).filter(|(_, index)| ids[*index] == 0).count();
        prop_assert_eq!(ids.iter().filter(|id| **id == 0).count(), within, "and nothing else is covered");
    }

    #[test]
    fn depths_and_values_are_exact_anywhere(
        points in corners(),
        at in place(),
        depths in [0.0_f32..=1.0, 0.0..=1.0, 0.0..=1.0],
        values in [-100.0_f32..100.0, -100.0..100.0, -100.0..100.0],
        tile_size in tile_size(),
    ) {
        /// What `interpolation` allows a value, relative to the largest of them: 13.5 roundings.
        const ROUNDED: f64 = 13.5 / (1 << 24) as f64;
        let points = moved(points, at);
        let plane = Plane { corners: points, depths };
        let images = drawn(points, [0, 1, 2].map(|corner| [depths[corner], values[corner]]), tile_size);
        let [ids, depth] = [images.triangles.is_some(), images.depth.is_some()];
        prop_assert!(ids && depth, "asked for");
        let (ids, depth) = (images.triangles.unwrap_or_default(), images.depth.unwrap_or_default());
        let colors = images.linear.unwrap_or_default();
        let largest = values.iter().fold(0.0, |largest: f64, value| largest.max(f64::from(value.abs())));
        // Rationals are slow: every seventh pixel.
        for (pixel, index) in window(at).filter(|(_, index)| ids[*index] == 0).step_by(7) {
            let exact = plane.at(pixel_center(pixel)).expect("what is seen has an area");
            let bound = rational(bound(&plane));
            // Half a unit of the last place of f32; less among the denormal ones.
            let rounded = rational(exp2(-24.0)) * (&exact + &bound) + rational(exp2(-150.0));
            let error = (rational(depth[index]) - exact).abs();
            prop_assert!(error <= bound + rounded, "{} of {plane:?} at {pixel:?}", depth[index]);
            let error = (f64::from(colors[index].x) - value_at(points, values, pixel_center(pixel))).abs();
            prop_assert!(error <= ROUNDED * largest, "{} of {values:?} at {pixel:?}", colors[index].x);
        }
    }
}

/// The mean of the corners' values, by areas that are whole numbers.
fn value_at([a, b, c]: [GridPoint; 3], values: [f32; 3], at: GridPoint) -> f64 {
    let shares = [[at, b, c], [a, at, c], [a, b, at]].map(|part| doubled_area(part) as f64);
    let sum: f64 = shares.iter().zip(values).map(|(share, value)| share * f64::from(value)).sum();
    sum / doubled_area([a, b, c]) as f64
}
