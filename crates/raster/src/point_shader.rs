//! Shades surfaces where something other than the rasterizer finds them, such as rays through a lens that no matrix
//! describes: the vertex stage of a pass, and then its pipelines' colours and masks at given points of triangles.

use crate::draw::{BlendMode, Culling};
use crate::draw_view::DrawView;
use crate::fragments::{DrawVaryings, PointScratch, ShadeContext, SurfacePoint};
use crate::geometry::Shape;
use crate::pass::{Pass, RecordedDraw};
use crate::pool::Workers;
use crate::simd::Token;
use crate::tile_buffer::{MAX_SIDE, TileArea};
use crate::vertex::{DrawVertices, ScreenVertex, UsedVertices, VertexDestination};
use crate::viewport::{SamplePattern, Viewport};
use std::ops::Range;

/// Vertices that a worker runs at a time.
const VERTICES: usize = 2048;

/// The varyings of a pass, ready to be shaded at any points. Made by
/// [`Rasterizer::point_shader`](crate::Rasterizer::point_shader).
pub struct PointShader<'p> {
    pass: &'p [RecordedDraw<'p>],
    token: Token,
    samples_per_axis: u32,
    /// For each draw its vertices, and where their varyings are.
    used: Vec<(UsedVertices, Range<usize>)>,
    listed: Vec<u32>,
    varyings: Vec<f32>,
}

/// What decides whether a point of a draw is visible.
#[derive(Clone, Copy, Debug)]
pub struct ShadedDraw<'p> {
    /// The corners of its triangles.
    pub triangles: &'p [[u32; 3]],
    /// Its [`Draw::object`](crate::Draw::object).
    pub object: u32,
    /// The sides that are not drawn.
    pub culling: Culling,
    /// How it covers what is behind.
    pub blend_mode: BlendMode,
}

/// Some vertices of a draw, to be run.
struct VertexTask<'a> {
    draw: usize,
    slots: Range<usize>,
    varyings: &'a mut [f32],
}

impl<'p> PointShader<'p> {
    pub(crate) fn new(pass: &'p Pass<'p>, token: Token, workers: &Workers, samples_per_axis: u32) -> Self {
        let (mut used, mut listed, mut end) = (Vec::new(), Vec::new(), 0);
        for draw in &pass.draws {
            let (count, stride) = (draw.pipeline.vertex_count(), draw.pipeline.stride());
            let vertices = UsedVertices::new(draw.geometry.indices(), count, &mut listed);
            let start = end;
            end += vertices.len() * stride;
            used.push((vertices, start..end));
        }
        let varyings = vec![0.0; end];
        let mut shader = Self { pass: &pass.draws, token, samples_per_axis, used, listed, varyings };
        shader.run_vertices(workers);
        shader
    }

    fn run_vertices(&mut self, workers: &Workers) {
        let mut varyings = std::mem::take(&mut self.varyings);
        let tasks = self.tasks(&mut varyings);
        workers.share(tasks.into_iter(), |VertexTask { draw, slots, varyings }| {
            let mut vertices = vec![ScreenVertex::default(); slots.len()];
            let out = VertexDestination { vertices: &mut vertices, varyings };
            let viewport = Viewport { width: 1, height: 1 };
            let used = self.used[draw].0.slots(&self.listed);
            self.pass[draw].pipeline.run_vertices(self.token, used, slots, viewport, out);
        });
        self.varyings = varyings;
    }

    /// Draws without varyings run no vertices.
    fn tasks<'a>(&self, mut varyings: &'a mut [f32]) -> Vec<VertexTask<'a>> {
        let mut tasks = Vec::new();
        for (draw, (used, _)) in self.used.iter().enumerate() {
            let stride = self.pass[draw].pipeline.stride();
            let starts = (0..used.len()).step_by(VERTICES).filter(|_| stride > 0);
            for start in starts {
                let slots = start..used.len().min(start + VERTICES);
                let (own, others) = std::mem::take(&mut varyings).split_at_mut(slots.len() * stride);
                varyings = others;
                tasks.push(VertexTask { draw, slots, varyings: own });
            }
        }
        tasks
    }

    /// The draws in the order of recording. `None` for lines and points, and for pipelines that shade one fragment at a
    /// time: those depend on where they are on a screen.
    pub fn draws(&self) -> impl Iterator<Item = Option<ShadedDraw<'p>>> {
        self.pass.iter().map(|draw| match draw.geometry.shape {
            Shape::Triangles { triangles, culling, .. } if !draw.pipeline.reads_all() => {
                let (object, blend_mode) = (draw.geometry.object, draw.geometry.blend_mode);
                Some(ShadedDraw { triangles, object, culling, blend_mode })
            }
            _ => None,
        })
    }

    /// The colours of points of a draw: linear light, premultiplied, one for each point. Black if the draw cannot be
    /// shaded. Points of triangles that the draw does not have are left out.
    pub fn shade(
        &self,
        draw: usize,
        points: &[SurfacePoint],
        scratch: &mut PointScratch,
        colors: &mut [[f32; 4]],
    ) {
        if let Some(context) = self.context(draw, points) {
            self.pass[draw].pipeline.shade_points(self.token, &context, scratch, points, colors);
        } else {
            colors.fill([0.0; 4]);
        }
    }

    /// Whether points of a draw exist: those of [`BlendMode::Masked`] may be holes.
    pub fn mask(
        &self,
        draw: usize,
        points: &[SurfacePoint],
        scratch: &mut PointScratch,
        passed: &mut [bool],
    ) {
        if let Some(context) = self.context(draw, points) {
            self.pass[draw].pipeline.mask_points(self.token, &context, scratch, points, passed);
        } else {
            passed.fill(false);
        }
    }

    /// `None` for points that are not the draw's.
    fn context(&self, draw: usize, points: &[SurfacePoint]) -> Option<ShadeContext<'_>> {
        let RecordedDraw { geometry, pipeline } = self.pass.get(draw)?;
        let (used, varyings) = &self.used[draw];
        let slots = used.slots(&self.listed);
        let exists = |point: &SurfacePoint| {
            let is_listed = (point.triangle as usize) < geometry.len();
            is_listed && geometry.corners(point.triangle).iter().all(|&corner| slots.of(corner) < used.len())
        };
        if !points.iter().all(exists) {
            return None;
        }
        let vertices = DrawVertices { slots, screen_vertices: &[], pipeline: *pipeline, token: self.token };
        Some(ShadeContext {
            draw: DrawView { geometry, vertices, first: 0, points: None, chunks: &[] },
            varyings: DrawVaryings {
                slots,
                values: &self.varyings[varyings.clone()],
                stride: pipeline.stride(),
            },
            varying_count: pipeline.varyings(),
            is_flat: pipeline.is_flat(),
            reads_all: pipeline.reads_all(),
            frame_ink: None,
            pattern: SamplePattern::SINGLE,
            supersampling: self.samples_per_axis,
            area: TileArea { origin: [0; 2], size: [MAX_SIDE; 2], margin: [0; 2] },
            triangles: &[],
            outer: None,
        })
    }
}
