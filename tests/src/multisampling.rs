//! Several samples in a pixel, each at its standard place, shaded together: which
//! samples a triangle covers, against exact integers, and what colour they get.

use crate::coverage::{fan_triangles, grid_triangles, triangle};
use crate::coverage_support::{SIDE, Samples, Values, clip_position, pixel, rasterizer};
use crate::effort::cases;
use crate::random::Random;
use proptest::prelude::*;
use trigon_math::{UVec2, Vec4};
use trigon_raster::{
    BlendMode, Culling, Draw, ExecuteSettings, Fragment, Output, Pass, Pipeline, TargetImages, VertexOutput,
};
use trigon_study::oracle::coverage::{covers, mask, pixel_center, sample_points, standard_positions};

fn pattern() -> impl Strategy<Value = u32> {
    prop_oneof![Just(2_u32), Just(4), Just(8), Just(16)]
}

/// All images of a pass with so many samples, [`SIDE`] by [`SIDE`] pixels.
fn draw(pass: &Pass<'_>, per_pixel: u32) -> TargetImages {
    let outputs = [Output::Linear, Output::Depth, Output::Triangle];
    let mut target = Samples { per_axis: 1, per_pixel }.target([SIDE as u32; 2], &outputs);
    rasterizer(&ExecuteSettings::default()).draw(pass, &mut target);
    target.into_images()
}

/// How much light the pixels hold on average over their samples, if every layer
/// adds 1 to each sample that it covers.
pub(crate) fn light(pipeline: &Values, triangles: &[[u32; 3]], samples: u32) -> Vec<f32> {
    let mut pass = Pass::new();
    let surface = BlendMode::Translucent;
    pass.triangles(Draw { blend_mode: surface, culling: Culling::None, ..Draw::new(pipeline, triangles) });
    draw(&pass, samples).linear.expect("asked for").iter().map(|color| color.x).collect()
}

/// The pixels of which [`Beacons`] tell every sample apart.
const LIT: std::ops::Range<i32> = 26..38;

/// For each sample of each pixel in [`LIT`] a square that covers it and nothing
/// else. Its light is a power of two, so that the sum over a pixel tells which
/// of them are seen.
struct Beacons {
    values: Values,
    triangles: Vec<[u32; 3]>,
}

impl Beacons {
    fn new(samples: u32) -> Self {
        let pixels = LIT.flat_map(|y| LIT.map(move |x| [x, y]));
        let mut vertices = Vec::new();
        for pixel in pixels {
            for (sample, [x, y]) in sample_points(samples, pixel).enumerate() {
                // The mean divides by the number of samples.
                let light = (1_u64 << sample) as f32 * samples as f32;
                let corners = [[x - 1, y - 1], [x - 1, y + 1], [x + 1, y + 1], [x + 1, y - 1]];
                vertices.extend(corners.map(|corner| (clip_position(corner, 0.25), light)));
            }
        }
        let quads = 0..vertices.len() as u32 / 4;
        let triangles = quads.flat_map(|i| [[4 * i, 4 * i + 1, 4 * i + 2], [4 * i, 4 * i + 2, 4 * i + 3]]);
        Self { triangles: triangles.collect(), values: Values { vertices } }
    }
}

proptest! {
    #![proptest_config(cases(40))]

    #[test]
    fn each_sample_is_covered_where_exact_arithmetic_says(points in triangle(), samples in pattern()) {
        let beacons = Beacons::new(samples);
        let shade = Values { vertices: points.map(|point| (clip_position(point, 0.75), 0.0)).to_vec() };
        let mut pass = Pass::new();
        pass.triangles(Draw { object: 1, ..Draw::new(&beacons.values, &beacons.triangles) });
        pass.triangles(Draw { object: 2, culling: Culling::None, ..Draw::new(&shade, &[[0, 1, 2]]) });
        let linear = draw(&pass, samples).linear.expect("asked for");
        for y in LIT {
            for x in LIT {
                let seen = linear[(y * SIDE + x) as usize].x as u32;
                let all = (1 << samples) - 1;
                let expected = all & !mask(points, samples, [x, y]);
                prop_assert_eq!(seen, expected, "samples {:#b} instead of {:#b} at {:?}", seen, expected, [x, y]);
            }
        }
    }

    #[test]
    fn translucent_and_opaque_cover_the_same_share(points in triangle(), samples in pattern()) {
        let pipeline = Values::on_grid(&points);
        let mut pass = Pass::new();
        pass.triangles(Draw { culling: Culling::None, ..Draw::new(&pipeline, &[[0, 1, 2]]) });
        let opaque = draw(&pass, samples).linear.expect("asked for");
        let translucent = light(&pipeline, &[[0, 1, 2]], samples);
        for index in 0..opaque.len() {
            let covered = sample_points(samples, pixel(index)).filter(|&point| covers(points, point));
            let expected = covered.count() as f32 / samples as f32;
            prop_assert_eq!(opaque[index].x, expected, "opaque at {:?}", pixel(index));
            prop_assert_eq!(translucent[index], expected, "translucent at {:?}", pixel(index));
        }
    }

    /// Depth, ids and colour of a triangle that covers all of a pixel.
    #[test]
    fn inside_a_triangle_the_colour_is_that_of_one_sample(
        points in triangle(),
        values in [0.0_f32..1.0, 0.0..1.0, 0.0..1.0],
        samples in pattern(),
    ) {
        let vertices = [0, 1, 2].map(|i| (clip_position(points[i], 0.2 + 0.5 * values[i]), values[i]));
        let pipeline = Values { vertices: vertices.to_vec() };
        let mut pass = Pass::new();
        pass.triangles(Draw { culling: Culling::None, ..Draw::new(&pipeline, &[[0, 1, 2]]) });
        let [single, several] = [1, samples].map(|samples| draw(&pass, samples).linear.expect("asked for"));
        for index in 0..single.len() {
            let inside = sample_points(samples, pixel(index))
                .chain(sample_points(1, pixel(index)))
                .all(|point| covers(points, point));
            prop_assert!(!inside || several[index] == single[index], "at {:?}", pixel(index));
        }
    }

    /// At the centre where the triangle covers it, else at the lowest-numbered
    /// sample that it covers.
    #[test]
    fn a_triangle_is_shaded_at_one_point_of_a_pixel(points in triangle(), samples in pattern()) {
        let pipeline = Whereabouts(points.map(|point| clip_position(point, 0.5)));
        let mut pass = Pass::new();
        pass.triangles(Draw { culling: Culling::None, ..Draw::new(&pipeline, &[[0, 1, 2]]) });
        let linear = draw(&pass, samples).linear.expect("asked for");
        for (index, color) in linear.iter().enumerate() {
            let covered: Vec<_> =
                sample_points(samples, pixel(index)).filter(|&point| covers(points, point)).collect();
            let Some(&lowest) = covered.first() else { continue };
            let centre = pixel_center(pixel(index));
            let expected = if covers(points, centre) { centre } else { lowest };
            let share = covered.len() as f32 / samples as f32;
            let place = [color.x, color.y].map(|v| v / share * 256.0);
            // Samples lie on whole steps of the grid: less than half of one tells them apart.
            let error = [0, 1].map(|axis| (place[axis] - expected[axis] as f32).abs());
            prop_assert!(error.iter().all(|&error| error < 0.5), "{place:?} instead of {expected:?}");
        }
    }

    /// A grid over the whole image, its inner vertices moved at random.
    #[test]
    fn a_tiled_image_holds_every_sample_once(
        cells in 2..24_i32,
        samples in pattern(),
        seed in any::<u64>(),
    ) {
        let mut random = Random(seed);
        let (low, side) = (-300, 64 * 256 + 600);
        let inner = |i: i32| 0 < i && i < cells;
        let mut points = Vec::new();
        for j in 0..=cells {
            for i in 0..=cells {
                let reach = side / cells / 5;
                let jitter = [inner(i), inner(j)].map(|free| if free { random.within(reach) } else { 0 });
                points.push([low + side * i / cells + jitter[0], low + side * j / cells + jitter[1]]);
            }
        }
        let triangles = grid_triangles(cells as u32, &mut random);
        let light = light(&Values::on_grid(&points), &triangles, samples);
        let wrong = light.iter().position(|&light| light != 1.0);
        prop_assert!(wrong.is_none(), "{} at {:?}", light[wrong.unwrap_or(0)], wrong.map(pixel));
    }
}

/// A fragment's colour is where it was shaded, in pixels.
struct Whereabouts([Vec4; 3]);

impl Pipeline for Whereabouts {
    type Varyings = ();

    fn vertex_count(&self) -> usize {
        3
    }

    fn vertex(&self, index: usize) -> VertexOutput<()> {
        VertexOutput { position: self.0[index], varyings: () }
    }

    fn fragment(&self, fragment: &Fragment<()>) -> Vec4 {
        fragment.position.extend(0.0).extend(1.0)
    }
}

/// A fan around a point, in one frame with thousands of needles.
#[test]
fn a_fan_of_needles_holds_every_sample_once() {
    let mut positions = vec![clip_position([8000, 8200], 0.5)];
    let count = 1000;
    for i in 0..count {
        let angle = f64::from(i) * std::f64::consts::TAU / f64::from(count);
        let (sine, cosine) = trigon_math::elementary::sin_cos(angle);
        positions.push(Vec4::new(cosine as f32 * 3.0, sine as f32 * 3.0, 0.5, 1.0));
    }
    for samples in [2, 4, 8, 16] {
        let light = light(&Values::ones(positions.iter().copied()), &fan_triangles(count), samples);
        assert!(light.iter().all(|&light| light == 1.0), "every sample exactly once of {samples}");
    }
}

/// Depth and ids come from the first sample, whatever the others see.
#[test]
fn depth_and_ids_are_those_of_the_first_sample() {
    for samples in [2, 4, 8, 16] {
        let [[x, y], ..] = *standard_positions(samples) else { panic!("a pattern has samples") };
        let (x, y) = (256 * 20 + 16 * x, 256 * 30 + 16 * y);
        let square = [[x - 1, y - 1], [x - 1, y + 1], [x + 1, y + 1], [x + 1, y - 1]];
        let wall = [[0, 0], [0, 16384], [16384, 16384], [16384, 0]];
        let vertices = square.map(|p| (clip_position(p, 0.75), 1.0)).into_iter();
        let vertices = vertices.chain(wall.map(|p| (clip_position(p, 0.5), 0.0)));
        let pipeline = Values { vertices: vertices.collect() };
        let triangles = [[4, 5, 6], [4, 6, 7], [0, 1, 2], [0, 2, 3]];
        let mut pass = Pass::new();
        pass.triangles(Draw::new(&pipeline, &triangles));
        let images = draw(&pass, samples);
        let at = |pixel: UVec2| (pixel.y * SIDE as u32 + pixel.x) as usize;
        let (depth, ids) = (images.depth.expect("asked for"), images.triangles.expect("asked for"));
        let (here, beside) = (at(UVec2::new(20, 30)), at(UVec2::new(21, 30)));
        assert_eq!((depth[here], ids[here] >= 2), (0.75, true), "the square lies on the first of {samples}");
        assert_eq!((depth[beside], ids[beside] >= 2), (0.5, false), "the wall beside it");
        let share = images.linear.expect("asked for")[here].x;
        assert_eq!(share, 1.0 / samples as f32, "and on no other");
    }
}
