//! Targets: plain bytes, images in the caller's memory, extreme shapes, and what
//! is refused.

use crate::coverage_support::{Samples, rasterizer};
use crate::effort::cases;
use crate::programs::{Lanes, Vertices};
use proptest::prelude::*;
use trigon_math::Vec4;
use trigon_raster::{BlendMode, Culling, Draw, ExecuteSettings, Output, Pass, Target, TargetError};

/// A triangle over most of the view and one that covers half of it.
fn vertices(colors: [Vec4; 3]) -> Vertices {
    let mut vertices = Vertices::default();
    let corners = [[-1.0, -1.0], [1.0, -1.0], [0.0, 3.0], [-1.0, 1.0], [-1.0, -3.0], [3.0, 1.0]];
    for (i, [x, y]) in corners.into_iter().enumerate() {
        let color = colors[i % 3] * if i < 3 { 1.0 } else { 0.5 };
        vertices.push(Vec4::new(x, y, 0.5 + 0.05 * i as f32, 1.0), color);
    }
    vertices
}

const TRIANGLES: [[u32; 3]; 2] = [[0, 1, 2], [3, 4, 5]];

fn draw(vertices: &Vertices, surface: BlendMode, target: &mut Target<'_>) {
    let pipeline = Lanes(vertices);
    let mut pass = Pass::new();
    pass.triangles(Draw { blend_mode: surface, culling: Culling::None, ..Draw::new(&pipeline, &TRIANGLES) });
    rasterizer(&ExecuteSettings::default()).draw(&pass, target);
}

fn color() -> impl Strategy<Value = Vec4> {
    let channel = -0.2_f32..1.4;
    [channel.clone(), channel.clone(), channel, 0.0_f32..1.0].prop_map(Vec4::from_array)
}

fn surface() -> impl Strategy<Value = BlendMode> {
    prop_oneof![Just(BlendMode::Opaque), Just(BlendMode::Translucent)]
}

proptest! {
    #![proptest_config(cases(60))]

    /// In whatever company an image is asked for: each takes another path.
    #[test]
    fn plain_bytes_are_the_nearest_to_linear_light(
        colors in [color(), color(), color()],
        surface in surface(),
        samples in Samples::any(),
    ) {
        let vertices = vertices(colors);
        let image = |outputs: &[Output]| {
            let mut target = samples.target([40, 30], outputs);
            draw(&vertices, surface, &mut target);
            target.into_images()
        };
        let both = image(&[Output::Unorm8, Output::Linear, Output::Srgb8]);
        let codes = both.unorm8.expect("asked for");
        prop_assert!(image(&[Output::Unorm8]).unorm8.expect("asked for") == codes, "alone");
        prop_assert!(image(&[Output::Srgb8]).srgb8 == both.srgb8, "sRGB alone");
        for (code, color) in codes.iter().zip(both.linear.expect("asked for")) {
            for (&code, value) in code.iter().zip(color.to_array()) {
                let error = f64::from(value.clamp(0.0, 1.0)) * 255.0 - f64::from(code);
                // A half, and the rounding of the product.
                prop_assert!(error.abs() <= 0.5 + 2e-5, "{value} as {code}");
            }
        }
    }

    #[test]
    fn images_in_the_callers_memory_hold_the_same_bytes(
        colors in [color(), color(), color()],
        surface in surface(),
        samples in Samples::any(),
    ) {
        let vertices = vertices(colors);
        let mut owned = samples.target([40, 30], &[Output::Srgb8, Output::Unorm8]);
        draw(&vertices, surface, &mut owned);
        let (mut srgb8, mut unorm8) = ([[7; 4]; 1200], [[7; 4]; 1200]);
        let target = samples.target([40, 30], &[]).with_srgb8(&mut srgb8).expect("as many as needed");
        let mut target = target.with_unorm8(&mut unorm8).expect("as many as needed");
        draw(&vertices, surface, &mut target);
        prop_assert!(target.srgb8() == owned.srgb8() && target.unorm8() == owned.unorm8());
        let images = target.into_images();
        prop_assert!(images.srgb8.is_none() && images.unorm8.is_none(), "they are the caller's");
        prop_assert!(owned.srgb8() == Some(srgb8.as_slice()), "and there");
    }
}

#[test]
fn memory_of_another_size_is_refused() {
    for given in [0, 11, 13] {
        let (mut srgb8, mut unorm8) = (vec![[0; 4]; given], vec![[0; 4]; given]);
        let target = || Target::new(4, 3, &[]).expect("a size in range");
        let expected = Some(TargetError::Length { given, needed: 12 });
        assert_eq!(target().with_srgb8(&mut srgb8).err(), expected, "{given} pixels");
        assert_eq!(target().with_unorm8(&mut unorm8).err(), expected, "{given} pixels");
    }
}

#[test]
fn sizes_and_samples_out_of_range_are_refused() {
    for (width, height) in [(0, 1), (1, 0), (16385, 1), (1, 16385)] {
        let made = Target::new(width, height, &[]).err();
        assert_eq!(made, Some(TargetError::Size { width, height }), "{width} by {height}");
    }
    let target = || Target::new(4, 4, &[]).expect("a size in range");
    for samples in [0, 3, 5, 32] {
        assert_eq!(target().with_samples(samples).err(), Some(TargetError::Samples { samples }), "{samples}");
    }
    for samples_per_axis in [0, 5] {
        let expected = Some(TargetError::SamplesPerAxis { samples_per_axis });
        assert_eq!(target().with_samples_per_axis(samples_per_axis).err(), expected, "{samples_per_axis}");
    }
}

/// The widest and the highest target, covered up to the last pixel.
#[test]
fn a_target_can_be_a_single_row_or_column() {
    let vertices = vertices([Vec4::ONE; 3]);
    for [width, height] in [[16384, 1], [1, 16384]] {
        for per_pixel in [1, 4] {
            let samples = Samples { per_axis: 1, per_pixel };
            let mut target = samples.target([width, height], &[Output::Linear, Output::Object]);
            draw(&vertices, BlendMode::Opaque, &mut target);
            // The second triangle covers what lies above the other diagonal: half of a row or column.
            let objects = target.objects().expect("asked for");
            let covered = objects.iter().filter(|&&object| object == 0).count();
            assert!((8192..=16384).contains(&covered), "{covered} of {width} by {height}");
            assert_eq!(objects[0], 0, "the first pixel of {width} by {height}");
        }
    }
}
