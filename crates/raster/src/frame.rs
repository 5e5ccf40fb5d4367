//! A frame on its way: the pass after set-up and binning, as the tiles see it.

use crate::Surface;
use crate::bin::{Bins, Grid};
use crate::clip;
use crate::geometry::{Geometry, Shape};
use crate::line::LineStyle;
use crate::pass::{Background, Recorded};
use crate::point::PointStyle;
use crate::pool::Workers;
use crate::setup::{CutWeights, Setup, SetupBatch, SetupTriangle};
use crate::shade::{ShadeContext, Shader, Span};
use crate::tile::TileArea;
use crate::vertex::{UsedVertices, VertexStore};
use crate::viewport::Viewport;
use crate::{Culling, Stats};
use std::cmp::Ordering;
use std::num::NonZeroU32;
use std::ops::Range;
use trigon_math::Vec4;

/// How many primitives a worker sets up at a time.
const SETUP_CHUNK: usize = 4096;

/// One draw of the pass with its vertices done.
pub(crate) struct PreparedDraw<'f> {
    geometry: &'f Geometry<'f>,
    used: UsedVertices,
    shader: Box<dyn Shader + 'f>,
}

/// Everything that tiles read.
pub(crate) struct Frame<'f> {
    pub(crate) background: Background<'f>,
    pub(crate) samples_per_axis: NonZeroU32,
    pub(crate) wants_color: bool,
    draws: Vec<PreparedDraw<'f>>,
    pub(crate) triangles: Vec<SetupTriangle>,
    weights: Vec<CutWeights>,
    pub(crate) opaque: Bins,
    pub(crate) masked: Bins,
    pub(crate) translucent: Bins,
}

/// What a frame is made for.
#[derive(Clone, Copy)]
pub(crate) struct FrameSettings<'f> {
    pub(crate) background: Background<'f>,
    pub(crate) samples_per_axis: NonZeroU32,
    pub(crate) wants_color: bool,
    pub(crate) grid: Grid,
}

impl<'f> Frame<'f> {
    /// Runs vertices, clipping, set-up and binning.
    pub(crate) fn new(
        settings: FrameSettings<'f>,
        recorded: &'f [Recorded<'f>],
        workers: &Workers,
    ) -> (Self, Stats) {
        let grid = settings.grid;
        let mut draws = Vec::with_capacity(recorded.len());
        let mut all = SetupBatch::default();
        let mut by_surface = [Vec::new(), Vec::new(), Vec::new()];
        for (index, recorded) in recorded.iter().enumerate() {
            let geometry = &recorded.geometry;
            let used = UsedVertices::new(geometry.indices(), recorded.pipeline.vertex_count());
            all.stats.vertices += used.len() as u64;
            let (positions, shader) = recorded.pipeline.run_vertices(&used, workers);
            let vertices = VertexStore::new(&used, positions, grid.viewport);
            let start = all.triangles.len() as u32;
            let set_up = |range| set_up(geometry, index as u32, &vertices, settings, range);
            for batch in workers.map_chunks(geometry.len(), SETUP_CHUNK, set_up) {
                all.append(batch);
            }
            let bin = match geometry.surface {
                Surface::Opaque => 0,
                Surface::Masked => 1,
                Surface::Translucent => 2,
            };
            by_surface[bin].extend(start..all.triangles.len() as u32);
            draws.push(PreparedDraw { geometry, used, shader });
        }
        let [opaque, masked, translucent] = by_surface.map(|list| Bins::new(grid, &all.triangles, &list));
        all.stats.binned = (opaque.len() + masked.len() + translucent.len()) as u64;
        let frame = Self {
            background: settings.background,
            samples_per_axis: settings.samples_per_axis,
            wants_color: settings.wants_color,
            draws,
            triangles: all.triangles,
            weights: all.weights,
            opaque,
            masked,
            translucent,
        };
        (frame, all.stats)
    }

    /// The recorded draw that a triangle belongs to.
    pub(crate) fn geometry(&self, triangle: &SetupTriangle) -> &'f Geometry<'f> {
        self.draws[triangle.draw as usize].geometry
    }

    /// The order of two triangles at equal depth: the smaller (object, face) is
    /// seen. Within a face, and only there, the smaller index, then the earlier
    /// draw.
    #[inline]
    pub(crate) fn compare(&self, a: u32, b: u32) -> Ordering {
        let key = |ordinal: u32| {
            let triangle = &self.triangles[ordinal as usize];
            let geometry = self.geometry(triangle);
            (geometry.object, geometry.face(triangle.primitive), triangle.primitive, triangle.draw)
        };
        key(a).cmp(&key(b))
    }

    /// Whether `a` is seen before `b` at equal depth.
    #[inline]
    pub(crate) fn precedes(&self, a: u32, b: u32) -> bool {
        self.compare(a, b).is_lt()
    }

    /// Shades the spans' samples, draw by draw.
    pub(crate) fn shade(&self, area: TileArea, spans: &[Span], colors: &mut [Vec4]) {
        self.for_each_draw(area, spans, |shader, context, spans| shader.shade(context, spans, colors));
    }

    /// Asks the spans' masks, draw by draw.
    pub(crate) fn mask(&self, area: TileArea, spans: &[Span], kept: &mut [bool]) {
        self.for_each_draw(area, spans, |shader, context, spans| shader.mask(context, spans, kept));
    }

    fn for_each_draw(
        &self,
        area: TileArea,
        spans: &[Span],
        mut visit: impl FnMut(&dyn Shader, &ShadeContext<'_>, &[Span]),
    ) {
        let draw = |span: &Span| self.triangles[span.triangle as usize].draw;
        for run in spans.chunk_by(|a, b| draw(a) == draw(b)) {
            let prepared = &self.draws[draw(&run[0]) as usize];
            let context = ShadeContext {
                triangles: &self.triangles,
                weights: &self.weights,
                geometry: prepared.geometry,
                used: &prepared.used,
                area,
                samples_per_axis: self.samples_per_axis,
            };
            visit(&*prepared.shader, &context, run);
        }
    }
}

/// Sets up some primitives of one draw.
fn set_up(
    geometry: &Geometry<'_>,
    draw: u32,
    vertices: &VertexStore<'_>,
    settings: FrameSettings<'_>,
    range: Range<usize>,
) -> SetupBatch {
    let viewport: Viewport = settings.grid.viewport;
    let samples = settings.samples_per_axis;
    let batch = SetupBatch::default();
    let volume = &clip::volume(viewport);
    let mut setup = Setup { viewport, volume, vertices, draw, culling: Culling::None, batch };
    match geometry.shape {
        Shape::Triangles { triangles, culling, .. } => {
            setup.culling = culling;
            for index in range {
                setup.triangle(index as u32, triangles[index]);
            }
        }
        Shape::Lines { segments, width, toward_eye } => {
            let style = LineStyle::new(width, toward_eye, samples);
            for index in range {
                setup.segment(index as u32, segments[index], style);
            }
        }
        Shape::Points { points, size, shape, toward_eye } => {
            let style = PointStyle::new(size, shape, toward_eye, samples);
            for index in range {
                setup.point(index as u32, points[index], style);
            }
        }
    }
    setup.batch
}
