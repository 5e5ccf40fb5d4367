//! Anti-aliased lines and points: coverage by distance, the same from either end,
//! each joint once.

use crate::coverage_support::{SIDE, Samples, Values, clip_position, levels, pixel, rasterizer};
use crate::effort::cases;
use proptest::prelude::*;
use std::num::NonZeroUsize;
use trigon_raster::{
    ExecuteSettings, Lines, Output, Pass, PointShape, Points, Smoothing, TargetImages, TileSize,
};
use trigon_study::oracle::GridPoint;

fn inside() -> impl Strategy<Value = GridPoint> {
    let coordinate = 4 * 256..(SIDE - 4) * 256;
    [coordinate.clone(), coordinate]
}

fn lines<'a>(pipeline: &'a Values, segments: &'a [[u32; 2]], width: f32) -> Pass<'a> {
    let mut pass = Pass::new();
    pass.lines(Lines { width, smoothing: Smoothing::AntiAliased, ..Lines::new(pipeline, segments) });
    pass
}

fn draw(pass: &Pass<'_>, samples: Samples, settings: &ExecuteSettings) -> TargetImages {
    let outputs = [Output::Linear, Output::Depth, Output::Object];
    let mut target = samples.target([SIDE as u32; 2], &outputs);
    rasterizer(settings).draw(pass, &mut target);
    target.into_images()
}

/// The coverage of each pixel: a layer adds its share of 1.
fn coverage(points: &[GridPoint], segments: &[[u32; 2]], width: f32) -> Vec<f32> {
    let pipeline = Values::on_grid(points);
    let images = draw(&lines(&pipeline, segments, width), Samples::ONE, &ExecuteSettings::default());
    images.linear.expect("asked for").iter().map(|color| color.x).collect()
}

fn length(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

/// The distance of a pixel's centre from a segment, in pixels.
fn distance([from, to]: [GridPoint; 2], pixel: GridPoint) -> f64 {
    let place = |point: GridPoint| point.map(|v| f64::from(v) / 256.0);
    let (a, b, p) = (place(from), place(to), place(pixel.map(|v| 256 * v + 128)));
    let (ab, ap) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let square = ab[0] * ab[0] + ab[1] * ab[1];
    let share = if square > 0.0 { ((ap[0] * ab[0] + ap[1] * ab[1]) / square).clamp(0.0, 1.0) } else { 0.0 };
    length(ap[0] - share * ab[0], ap[1] - share * ab[1])
}

/// What a coverage of at most 1 is off by: half a unit of f32, and as much again for what
/// is rounded in f64, a millionth of that.
const ROUNDED: f64 = 1.0 / (1 << 24) as f64;

/// What [`Smoothing::AntiAliased`] says of a line.
fn expected(distance: f64, width: f64) -> f64 {
    (width / 2.0 + 0.5 - distance).min(width).clamp(0.0, 1.0)
}

proptest! {
    #![proptest_config(cases(150))]

    #[test]
    fn a_polyline_covers_by_its_distance(
        points in proptest::collection::vec(inside(), 2..4),
        width in 0.0_f32..9.0,
    ) {
        let segments: Vec<_> = (1..points.len() as u32).map(|i| [i - 1, i]).collect();
        for (index, &found) in coverage(&points, &segments, width).iter().enumerate() {
            let distances = points.windows(2).map(|ends| distance([ends[0], ends[1]], pixel(index)));
            let expected = expected(distances.fold(f64::INFINITY, f64::min), f64::from(width));
            prop_assert!((f64::from(found) - expected).abs() < ROUNDED, "{found} instead of {expected} at {:?}", pixel(index));
        }
    }

    #[test]
    fn a_line_is_the_same_from_either_end(
        ends in [inside(), inside()],
        depths in [0.0_f32..1.0, 0.0..1.0],
        width in 0.1_f32..9.0,
        samples in Samples::any(),
    ) {
        let vertices = (0..2).map(|i| (clip_position(ends[i], depths[i]), depths[i] * 3.0)).collect();
        let pipeline = Values { vertices };
        let [there, back] = [[[0, 1]], [[1, 0]]].map(|segments| {
            draw(&lines(&pipeline, &segments, width), samples, &ExecuteSettings::default())
        });
        prop_assert!(there == back);
        prop_assert!(there.depth.iter().flatten().all(|&depth| depth == 0.0), "no depth is written");
        prop_assert!(there.objects.iter().flatten().all(|&object| object == u32::MAX), "no id is written");
    }

    /// Along the major axis, away from the ends, the pixels of a step add up to the
    /// line's width there, w / h with h the cosine of its slope. They sample the
    /// profile across the line at distances h apart: a function of straight pieces
    /// with four kinks of slope 1, up to 1 apart in pairs of opposite sign. The sum
    /// times h is the trapezoid rule; at a kink that lies at a share t of its cell it
    /// is off by h² t (1 - t) / 2, at most h² / 8, so a pair by at most as much, and
    /// both by h² / 4: a step's sum by h / 4. Each of its pixels is rounded once more.
    #[test]
    fn a_long_line_covers_its_width_times_its_length(
        from in [4 * 256..9 * 256, 20 * 256..44 * 256],
        to in [55 * 256..60 * 256, 12 * 256..52 * 256],
        width in 0.05_f32..9.0,
        turned in any::<bool>(),
    ) {
        let ends = [from, to].map(|[x, y]| if turned { [y, x] } else { [x, y] });
        let coverage = coverage(&ends, &[[0, 1]], width);
        let [dx, dy] = [0, 1].map(|axis| f64::from(to[axis] - from[axis]));
        prop_assume!(dy.abs() < dx);
        let cosine = dx / length(dx, dy);
        for step in 17..48 {
            let pixels = (0..SIDE).map(|other| if turned { step * SIDE + other } else { other * SIDE + step });
            let sum: f64 = pixels.map(|index| f64::from(coverage[index as usize])).sum();
            let error = (sum - f64::from(width) / cosine).abs();
            prop_assert!(error <= cosine / 4.0 + f64::from(SIDE) * ROUNDED, "{error} off in step {step}");
        }
    }

    #[test]
    fn segments_joined_in_a_vertex_paint_each_pixel_once(
        hub in inside(),
        tips in proptest::collection::vec(inside(), 1..9),
        width in 0.2_f32..9.0,
    ) {
        let points: Vec<_> = [hub].into_iter().chain(tips).collect();
        let segments: Vec<_> = (1..points.len() as u32).map(|i| [0, i]).collect();
        for (index, &found) in coverage(&points, &segments, width).iter().enumerate() {
            let nearest = points[1..].iter().map(|&tip| distance([hub, tip], pixel(index))).fold(f64::INFINITY, f64::min);
            let expected = expected(nearest, f64::from(width));
            prop_assert!((f64::from(found) - expected).abs() < ROUNDED, "{found} instead of {expected} at {:?}", pixel(index));
        }
    }
}

proptest! {
    #![proptest_config(cases(12))]

    #[test]
    fn settings_change_nothing(
        points in proptest::collection::vec((inside(), 0.0_f32..1.0), 2..40),
        width in 0.2_f32..7.0,
        samples in Samples::any(),
    ) {
        let vertices: Vec<_> = points.iter().map(|&(at, value)| (clip_position(at, value), value)).collect();
        let pipeline = Values { vertices };
        let segments: Vec<_> = (1..points.len() as u32).map(|i| [i - 1, i]).collect();
        let dots: Vec<u32> = (0..points.len() as u32).collect();
        let mut pass = lines(&pipeline, &segments, width);
        for (object, shape) in (1..).zip([PointShape::Round, PointShape::Square]) {
            let smoothing = Smoothing::AntiAliased;
            pass.points(Points { smoothing, shape, object, ..Points::new(&pipeline, &dots, width) });
        }
        let reference = draw(&pass, samples, &ExecuteSettings::default());
        let tiles = [TileSize::Pixels8, TileSize::Pixels16, TileSize::Pixels32, TileSize::Pixels64];
        let simd = levels().map(|level| ExecuteSettings { simd: Some(level), ..Default::default() });
        let tiles = tiles.map(|tile_size| ExecuteSettings { tile_size, ..Default::default() });
        let threads = [1, 2, 3].map(|threads| ExecuteSettings { threads: NonZeroUsize::new(threads), ..Default::default() });
        for settings in simd.chain(tiles).chain(threads) {
            prop_assert!(draw(&pass, samples, &settings) == reference, "{settings:?}");
        }
    }
}

/// A square point covers its area; each pixel of a round one what a line without length does.
#[test]
fn points_have_their_area() {
    let centre = [30 * 256 + 77, 31 * 256 + 200];
    let covered = |shape: PointShape, size: f32| {
        let pipeline = Values::on_grid(&[centre]);
        let mut pass = Pass::new();
        let smoothing = Smoothing::AntiAliased;
        pass.points(Points { smoothing, shape, ..Points::new(&pipeline, &[0], size) });
        draw(&pass, Samples::ONE, &ExecuteSettings::default()).linear.expect("asked for")
    };
    for size in [0.0_f32, 0.5, 3.25] {
        let sum: f64 = covered(PointShape::Square, size).iter().map(|color| f64::from(color.x)).sum();
        // Five pixels each way at most.
        let error = (sum - f64::from(size * size)).abs();
        assert!(error <= 25.0 * ROUNDED, "a square of {size}: {sum}");
    }
    for (index, color) in covered(PointShape::Round, 12.0).iter().enumerate() {
        let expected = expected(distance([centre; 2], pixel(index)), 12.0);
        let error = (f64::from(color.x) - expected).abs();
        assert!(error <= ROUNDED, "{} instead of {expected} at {:?}", color.x, pixel(index));
    }
}
