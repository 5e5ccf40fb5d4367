//! Alpha masks: asked once for each pixel, or at every sample.

use crate::coverage::triangle;
use crate::coverage_support::{SIDE, Samples, clip_position, levels, pixel, rasterizer};
use crate::effort::cases;
use proptest::prelude::*;
use trigon_math::Vec4;
use trigon_raster::{
    BlendMode, Culling, Draw, ExecuteSettings, Fragment, Output, Pass, Pipeline, TargetImages, VertexOutput,
};
use trigon_study::oracle::GridPoint;
use trigon_study::oracle::coverage::{covers, pixel_center, sample_points};

/// White on one side of a line across the screen: that on which a linear varying
/// is positive.
#[derive(Clone, Debug)]
struct HalfPlane {
    corners: [GridPoint; 3],
    /// The value is `[0] x + [1] y + [2]`, x and y in pixels.
    line: [f64; 3],
}

impl HalfPlane {
    fn value(&self, [x, y]: GridPoint) -> f64 {
        let [a, b, c] = self.line;
        a * f64::from(x) / 256.0 + b * f64::from(y) / 256.0 + c
    }
}

impl Pipeline for HalfPlane {
    type Varyings = f32;

    fn vertex_count(&self) -> usize {
        3
    }

    fn vertex(&self, index: usize) -> VertexOutput<f32> {
        let corner = self.corners[index];
        VertexOutput { position: clip_position(corner, 0.5), varyings: self.value(corner) as f32 }
    }

    fn fragment(&self, _: &Fragment<f32>) -> Vec4 {
        Vec4::ONE
    }

    fn mask(&self, fragment: &Fragment<f32>) -> bool {
        fragment.varyings > 0.0
    }
}

fn half_plane() -> impl Strategy<Value = HalfPlane> {
    let slope = -1.0_f64..1.0;
    (triangle(), slope.clone(), slope, [8.0_f64..56.0, 8.0..56.0])
        .prop_map(|(corners, a, b, [x, y])| HalfPlane { corners, line: [a, b, -(a * x + b * y)] })
}

fn draw(shape: &HalfPlane, surface: BlendMode, samples: u32, settings: &ExecuteSettings) -> TargetImages {
    let outputs = [Output::Linear, Output::Depth];
    let mut target = Samples { per_axis: 1, per_pixel: samples }.target([SIDE as u32; 2], &outputs);
    let mut pass = Pass::new();
    pass.triangles(Draw { blend_mode: surface, culling: Culling::None, ..Draw::new(shape, &[[0, 1, 2]]) });
    rasterizer(settings).draw(&pass, &mut target);
    target.into_images()
}

/// A varying is a weighted mean of values below 2^8 pixels in size (corners may lie
/// far outside): each of some ten roundings is off by 2^-24 of the largest.
fn is_close_to_the_line(shape: &HalfPlane, point: GridPoint) -> bool {
    let largest = shape.corners.iter().map(|&corner| shape.value(corner).abs()).fold(0.0, f64::max);
    shape.value(point).abs() <= largest * 16.0 / f64::from(1 << 24)
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn a_mask_per_sample_is_that_of_each_samples_place(
        shape in half_plane(),
        samples in prop_oneof![Just(1_u32), Just(2), Just(4), Just(8), Just(16)],
    ) {
        let linear = draw(&shape, BlendMode::MaskedPerSample, samples, &ExecuteSettings::default()).linear;
        for (index, color) in linear.expect("asked for").iter().enumerate() {
            let points = || sample_points(samples, pixel(index)).filter(|&point| covers(shape.corners, point));
            if points().any(|point| is_close_to_the_line(&shape, point)) {
                continue;
            }
            let kept = points().filter(|&point| shape.value(point) > 0.0).count();
            prop_assert_eq!(color.w, kept as f32 / samples as f32, "at {:?}", pixel(index));
        }
    }

    /// At the centre, or if the triangle does not cover it at the first sample that
    /// it covers.
    #[test]
    fn a_mask_per_pixel_keeps_all_or_none(shape in half_plane(), samples in prop_oneof![Just(2_u32), Just(8)]) {
        let linear = draw(&shape, BlendMode::Masked, samples, &ExecuteSettings::default()).linear;
        for (index, color) in linear.expect("asked for").iter().enumerate() {
            let covered: Vec<_> =
                sample_points(samples, pixel(index)).filter(|&point| covers(shape.corners, point)).collect();
            let Some(&first) = covered.first() else { continue };
            let centre = pixel_center(pixel(index));
            let place = if covers(shape.corners, centre) { centre } else { first };
            if is_close_to_the_line(&shape, place) {
                continue;
            }
            let share = if shape.value(place) > 0.0 { covered.len() as f32 / samples as f32 } else { 0.0 };
            prop_assert_eq!(color.w, share, "at {:?}", pixel(index));
        }
    }

    #[test]
    fn masks_per_sample_are_the_same_at_every_level(shape in half_plane()) {
        let image = |simd| {
            draw(&shape, BlendMode::MaskedPerSample, 8, &ExecuteSettings { simd, ..Default::default() })
        };
        let reference = image(None);
        for level in levels() {
            prop_assert!(image(Some(level)) == reference, "{level}");
        }
    }
}
