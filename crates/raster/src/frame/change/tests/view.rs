//! How surfaces are drawn.

use super::model::{ALL_POINTS, Model};
use crate::simd::SimdLevel;
use crate::{
    Background, BlendMode, Draw, ExecuteSettings, FaceEdges, Lines, MarkColors, MarkedPoints, Output, Pass,
    Points, Rasterizer, Smoothing, Stats, Target, TileSize,
};
use proptest::prelude::*;
use std::num::NonZeroUsize;
use trigon_math::{Vec3, Vec4};

/// How the images are drawn.
#[derive(Clone, Debug)]
pub(super) struct View {
    pub(super) size: [u32; 2],
    pub(super) samples: [u32; 2],
    pub(super) outputs: Vec<Output>,
    pub(super) edges: Option<f32>,
    pub(super) has_marks: bool,
    /// Lines share a chunk with opaque triangles, which then is set up again as a whole.
    pub(super) has_lines: bool,
    pub(super) has_points: bool,
    pub(super) background: usize,
    pub(super) settings: ExecuteSettings,
}

pub(super) fn view() -> impl Strategy<Value = View> {
    use Output::{Depth, Face, Linear, Object, Srgb8, Triangle, Unorm8};
    let samples = prop::sample::select(vec![[1, 1], [1, 1], [1, 4], [1, 8], [2, 1], [3, 2]]);
    let outputs = prop_oneof![
        Just(vec![Srgb8]),
        Just(vec![Srgb8, Unorm8, Linear, Depth, Object, Face, Triangle]),
        prop::sample::subsequence(vec![Srgb8, Unorm8, Linear, Depth, Object, Face, Triangle], 1..7),
    ];
    let tile_size = prop::sample::select(vec![
        TileSize::Automatic,
        TileSize::Pixels8,
        TileSize::Pixels16,
        TileSize::Pixels32,
    ]);
    let levels: Vec<_> = SimdLevel::ALL.into_iter().filter(|level| level.token().is_some()).collect();
    let settings =
        (1..4_usize, tile_size, prop::sample::select(levels)).prop_map(|(threads, tile_size, level)| {
            let (threads, simd) = (NonZeroUsize::new(threads), Some(level));
            ExecuteSettings { threads, simd, tile_size, ..ExecuteSettings::default() }
        });
    let edges = prop_oneof![Just(None), (0.5_f32..5.0).prop_map(Some)];
    let has = [any::<bool>(), any::<bool>(), any::<bool>()];
    ([1_u32..130, 1_u32..100], samples, outputs, edges, has, 0..3_usize, settings).prop_map(
        |(size, samples, outputs, edges, [has_marks, has_lines, has_points], background, settings)| View {
            size,
            samples,
            outputs,
            edges,
            has_marks,
            has_lines,
            has_points,
            background,
            settings,
        },
    )
}

/// Three marks with colours of their own; the others cannot be seen.
pub(super) fn mark_colors() -> MarkColors {
    let mut colors = MarkColors::NONE;
    for (mark, color) in [Vec3::X, Vec3::Y, Vec3::Z].into_iter().enumerate() {
        colors.edges[mark + 1] = color.extend(0.9);
        colors.faces[mark + 1] = color.extend(0.4);
    }
    colors
}

pub(super) fn row(y: u32) -> Vec4 {
    Vec3::new(0.1, (y % 50) as f32 / 50.0, 0.4).extend(1.0)
}

impl View {
    pub(super) fn target(&self) -> Target<'static> {
        let target = Target::new(self.size[0], self.size[1], &self.outputs).expect("a size");
        let target = target.with_samples_per_axis(self.samples[0]).expect("a number of samples");
        target.with_samples(self.samples[1]).expect("a number of samples")
    }

    pub(super) fn pass<'a>(&self, models: &'a [Model]) -> Pass<'a> {
        let mut pass = Pass::new();
        pass.background(match self.background {
            0 => Background::Color(Vec4::new(0.2, 0.3, 0.4, 1.0)),
            1 => Background::PerRow(&row),
            _ => Background::PerPixel(&|pixel| row(pixel.y + pixel.x)),
        });
        for (object, model) in (0..).zip(models) {
            model.record(object, &mut pass);
        }
        // Between others: its ordinals begin and end where theirs do.
        pass.triangles(Draw::new(&models[2], &[]));
        let segments: &[[u32; 2]] = if self.has_lines { &[[0, 11], [11, 30], [34, 35]] } else { &[] };
        let lines = Lines::new(&models[0], segments);
        pass.lines(Lines { object: 9, width: 3.0, ..lines });
        let points: &[u32] = if self.has_points { &[0, 12, 34, 60] } else { &[] };
        let (smoothing, blend_mode) = match self.background {
            0 => (Smoothing::AntiAliased, BlendMode::Opaque),
            _ => (Smoothing::Sharp, BlendMode::Overlay),
        };
        let marked = Some(MarkedPoints { set: &models[0].large, size: 7.0 });
        if self.background == 2 && self.has_points {
            let points = Points::new(&models[0].vertices, &ALL_POINTS, 4.0);
            pass.points(Points { object: 10, blend_mode, marked, ..points });
        } else {
            let points = Points { smoothing, blend_mode, marked, ..Points::new(&models[0], points, 4.0) };
            pass.points(Points { object: 10, ..points });
        }
        if let Some(width) = self.edges {
            pass.edges(FaceEdges { width, color: Vec3::X, opacity: 0.7 });
        }
        if self.has_marks {
            pass.marks(mark_colors());
        }
        pass
    }

    pub(super) fn fresh(&self, models: &[Model]) -> Target<'static> {
        let mut target = self.target();
        let one = ExecuteSettings { threads: NonZeroUsize::new(1), ..ExecuteSettings::default() };
        Rasterizer::new(one).expect("the best level").draw(&self.pass(models), &mut target);
        target
    }

    /// What a whole image counts up to its tiles.
    pub(super) fn counts(&self, models: &[Model]) -> [u64; 8] {
        let mut rasterizer = Rasterizer::new(self.settings).expect("a level that there is");
        up_to_tiles(&rasterizer.draw(&self.pass(models), &mut self.target()))
    }
}

pub(super) fn up_to_tiles(stats: &Stats) -> [u64; 8] {
    let Stats { primitives, vertices, invalid, outside, clipped, culled, set_up, binned, .. } = *stats;
    [primitives, vertices, invalid, outside, clipped, culled, set_up, binned]
}
