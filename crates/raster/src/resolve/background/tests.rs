//! The two ways to give a background, beside each other.

use crate::simd::SimdLevel;
use crate::{
    Background, BlendMode, Draw, EdgeFlags, ExecuteSettings, FaceEdges, Fragment, Output, Pass, Pipeline,
    Rasterizer, Rect, Target, VertexOutput,
};
use proptest::prelude::*;
use std::num::NonZeroUsize;
use trigon_math::{UVec2, Vec3, Vec4};

/// A triangle in one colour.
struct Triangle {
    corners: [[f32; 2]; 3],
    alpha: f32,
}

impl Pipeline for Triangle {
    type Varyings = ();

    fn vertex_count(&self) -> usize {
        3
    }

    fn vertex(&self, index: usize) -> VertexOutput<()> {
        let [x, y] = self.corners[index];
        VertexOutput { position: Vec4::new(x, y, 0.5, 1.0), varyings: () }
    }

    fn fragment(&self, _: &Fragment<()>) -> Vec4 {
        Vec3::new(0.8, 0.1, 0.3).extend(1.0) * self.alpha
    }
}

/// Every seventh row has no colour.
fn row(y: u32) -> Vec4 {
    let level = if y % 7 == 6 { f32::NAN } else { (y % 50) as f32 / 40.0 };
    Vec4::new(level, 0.4, 1.0 - level, 0.9)
}

#[derive(Clone, Debug)]
struct Case {
    size: [u32; 2],
    samples: [u32; 2],
    outputs: Vec<Output>,
    corners: [[f32; 2]; 3],
    blend_mode: BlendMode,
    edges: Option<f32>,
    scissor: Option<[i32; 4]>,
    settings: ExecuteSettings,
}

fn case() -> impl Strategy<Value = Case> {
    use Output::{Depth, Linear, Srgb8, Unorm8};
    let samples = prop::sample::select(vec![[1, 1], [1, 1], [1, 4], [2, 1], [3, 2]]);
    let outputs = prop_oneof![
        Just(vec![Srgb8]),
        Just(vec![Unorm8]),
        prop::sample::subsequence(vec![Srgb8, Unorm8, Linear, Depth], 1..5),
    ];
    let corners = prop::array::uniform3(prop::array::uniform2(-1.5_f32..1.5));
    let blend_mode = prop::sample::select(vec![BlendMode::Opaque, BlendMode::Translucent]);
    let levels: Vec<_> = SimdLevel::ALL.into_iter().filter(|level| level.is_supported()).collect();
    let settings = (1..4_usize, prop::sample::select(levels)).prop_map(|(threads, level)| ExecuteSettings {
        threads: NonZeroUsize::new(threads),
        simd: Some(level),
        ..ExecuteSettings::default()
    });
    let edges = prop::option::of(0.5_f32..5.0);
    let scissor = prop::option::of(prop::array::uniform4(-9..120));
    ([1_u32..200, 1_u32..150], samples, outputs, corners, blend_mode, edges, scissor, settings).prop_map(
        |(size, samples, outputs, corners, blend_mode, edges, scissor, settings)| Case {
            size,
            samples,
            outputs,
            corners,
            blend_mode,
            edges,
            scissor,
            settings,
        },
    )
}

impl Case {
    fn draw(&self, background: Background<'_>) -> Target<'static> {
        let alpha = if self.blend_mode == BlendMode::Translucent { 0.5 } else { 1.0 };
        let triangle = Triangle { corners: self.corners, alpha };
        let mut pass = Pass::new();
        pass.background(background);
        pass.triangles(Draw {
            edge_flags: Some(&[EdgeFlags::ALL]),
            blend_mode: self.blend_mode,
            culling: crate::Culling::None,
            ..Draw::new(&triangle, &[[0, 1, 2]])
        });
        if let Some(width) = self.edges {
            pass.edges(FaceEdges { width, color: Vec3::Y, opacity: 0.6 });
        }
        if let Some([left, top, right, bottom]) = self.scissor {
            pass.scissor(Rect::new([left, top], [right, bottom]));
        }
        let target = Target::new(self.size[0], self.size[1], &self.outputs).expect("a size");
        let target = target.with_samples_per_axis(self.samples[0]).expect("a number of samples");
        let mut target = target.with_samples(self.samples[1]).expect("a number of samples");
        Rasterizer::new(self.settings).expect("a level that there is").draw(&pass, &mut target);
        target
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]

    #[test]
    fn colours_of_rows_are_those_of_their_pixels(case in case()) {
        let [rows, pixels] =
            [Background::PerRow(&row), Background::PerPixel(&|UVec2 { y, .. }| row(y))].map(|way| case.draw(way));
        prop_assert!(rows.srgb8() == pixels.srgb8(), "bytes");
        prop_assert!(rows.unorm8() == pixels.unorm8(), "linear bytes");
        prop_assert!(rows.linear() == pixels.linear(), "light");
        prop_assert!(rows.depth() == pixels.depth(), "depth");
    }
}
