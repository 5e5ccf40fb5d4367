//! Shades surfaces where something other than the rasterizer finds them, such as rays through a lens that no matrix
//! describes: the vertex stage of a pass, and then its pipelines' colours and masks at given points of triangles.

use crate::draw::{BlendMode, Culling};
use crate::draw_view::DrawView;
use crate::fragments::{DrawVaryings, PointScratch, ShadeContext, ShadeOutput, SurfacePoint};
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
    /// For each draw.
    used: Vec<ShadedVertices>,
    listed: Vec<u32>,
    varyings: Vec<f32>,
}

/// The vertices of a draw, and where their varyings are.
struct ShadedVertices {
    vertices: UsedVertices,
    varyings: Range<usize>,
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

impl RecordedDraw<'_> {
    fn is_shaded(&self) -> bool {
        matches!(self.geometry.shape, Shape::Triangles { .. }) && !self.pipeline.reads_all()
    }
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
            used.push(ShadedVertices { vertices, varyings: start..end });
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
            let out = VertexDestination { vertices: &mut vertices, varyings, position: None };
            let viewport = Viewport { width: 1, height: 1 };
            let used = self.used[draw].vertices.slots(&self.listed);
            self.pass[draw].pipeline.run_vertices(self.token, used, slots, viewport, out);
        });
        self.varyings = varyings;
    }

    /// Draws without varyings run no vertices.
    fn tasks<'a>(&self, mut varyings: &'a mut [f32]) -> Vec<VertexTask<'a>> {
        let mut tasks = Vec::new();
        for (draw, ShadedVertices { vertices, .. }) in self.used.iter().enumerate() {
            let stride = self.pass[draw].pipeline.stride();
            let starts = (0..vertices.len()).step_by(VERTICES).filter(|_| stride > 0);
            for start in starts {
                let slots = start..vertices.len().min(start + VERTICES);
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
            Shape::Triangles { triangles, culling, .. } if draw.is_shaded() => {
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
            let (task, columns) = scratch.list(&context, points);
            let mut output = ShadeOutput::colors(colors);
            self.pass[draw].pipeline.shade(self.token, &context, &task, columns, &mut output);
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
            let (task, columns) = scratch.list(&context, points);
            let mut bytes = vec![0; points.len()];
            self.pass[draw].pipeline.mask(self.token, &context, &task, columns, &mut bytes);
            for (passed, byte) in passed.iter_mut().zip(bytes) {
                *passed = byte != 0;
            }
        } else {
            passed.fill(false);
        }
    }

    /// `None` for points that are not the draw's, and if it cannot be shaded.
    fn context(&self, draw: usize, points: &[SurfacePoint]) -> Option<ShadeContext<'_>> {
        let RecordedDraw { geometry, pipeline } = self.pass.get(draw).filter(|draw| draw.is_shaded())?;
        let ShadedVertices { vertices: used, varyings } = &self.used[draw];
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

#[cfg(test)]
mod tests {
    use crate::simd::{F32, Mask, Simd, prelude::*};
    use crate::{
        BlendMode, Culling, Draw, Fragment, FragmentLanes, LanePipeline, Pass, Pipeline, PointScratch,
        Rasterizer, SurfacePoint, VertexLanes, VertexOutput,
    };
    use trigon_math::Vec4;

    /// Shows the square of its vertices' numbers, the gradient, the triangle, and the side.
    struct Numbers;

    impl LanePipeline for Numbers {
        const VARYINGS: usize = 1;
        const MASKED: bool = true;

        fn vertex_count(&self) -> usize {
            5000
        }

        fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
            let squares: Vec<f32> = (0..5000).map(|number| (number * number) as f32).collect();
            let squares = vertices.load(simd, &squares);
            vertices.set(0, squares);
            [F32::splat(simd, f32::NAN); 4]
        }

        fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
            let [right, down] = fragments.gradient(0);
            let side = fragments.front_facing().select(F32::splat(simd, 1.0), F32::splat(simd, 2.0));
            [fragments.varying(0), right + down * 0.5, fragments.position()[1], side]
        }

        fn masks<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> Mask<S> {
            fragments.varying(0).simd_gt(F32::splat(simd, 10.0))
        }
    }

    fn point(triangle: u32, weights: [f32; 3]) -> SurfacePoint {
        let slopes = [[0.5, 0.25], [-1.0, 0.5]];
        SurfacePoint { triangle, front_facing: triangle == 1, weights, slopes, sample: [7, 2 * triangle + 1] }
    }

    /// More points than lanes, and few of many vertices, so that their slots are listed.
    #[test]
    fn points_are_interpolated_between_their_corners() {
        let triangles = [[0_u32, 1, 2], [4000, 2, 4999], [3, 3, 1]];
        let mut pass = Pass::new();
        pass.triangles(Draw { blend_mode: BlendMode::Masked, object: 9, ..Draw::new(&Numbers, &triangles) });
        let shader = Rasterizer::default().point_shader(&pass, 2);
        let draw = shader.draws().next().flatten().expect("it can be shaded");
        assert_eq!((draw.object, draw.culling, draw.blend_mode), (9, Culling::Back, BlendMode::Masked));
        let weights = [[0.5, 0.25, 0.25], [0.0, 0.0, 1.0], [0.25, 0.75, 0.0]];
        let points: Vec<SurfacePoint> =
            (0..11).map(|number| point(number % 3, weights[number as usize / 4])).collect();
        let (mut colors, mut passed) = (vec![[0.0; 4]; 11], vec![false; 11]);
        shader.shade(0, &points, &mut PointScratch::default(), &mut colors);
        shader.mask(0, &points, &mut PointScratch::default(), &mut passed);
        for ((point, color), passed) in points.iter().zip(colors).zip(passed) {
            let [a, b, c] = triangles[point.triangle as usize].map(|vertex| (vertex * vertex) as f32);
            let [u, v, w] = point.weights;
            let value = a * u + b * v + c * w;
            let [right, down] = point.slopes.map(|[v, w]| (b - a) * v + (c - a) * w);
            // From samples to pixels.
            let row = (point.sample[1] as f32 + 0.5) / 2.0;
            let expected = [value, right + down * 0.5, row, if point.triangle == 1 { 1.0 } else { 2.0 }];
            assert_eq!(color, expected, "{point:?}");
            assert_eq!(passed, value > 10.0, "{point:?}");
        }
    }

    struct OneAtATime;

    impl Pipeline for OneAtATime {
        type Varyings = ();

        fn vertex_count(&self) -> usize {
            3
        }

        fn vertex(&self, _: usize) -> VertexOutput<()> {
            VertexOutput { position: Vec4::ONE, varyings: () }
        }

        fn fragment(&self, _: &Fragment<()>) -> Vec4 {
            Vec4::ONE
        }
    }

    #[test]
    fn what_cannot_be_shaded_is_black() {
        let mut pass = Pass::new();
        // Vertex 5000 does not exist.
        pass.triangles(Draw::new(&Numbers, &[[0, 1, 5000]])).triangles(Draw::new(&OneAtATime, &[[0, 1, 2]]));
        let shader = Rasterizer::default().point_shader(&pass, 1);
        assert!(shader.draws().nth(1).expect("recorded").is_none(), "it shades one fragment at a time");
        let points = [point(0, [1.0, 0.0, 0.0])];
        for (draw, points) in
            [(0, points), (0, [SurfacePoint { triangle: 1, ..points[0] }]), (1, points), (2, points)]
        {
            let (mut colors, mut passed) = ([[9.0; 4]], [true]);
            shader.shade(draw, &points, &mut PointScratch::default(), &mut colors);
            assert_eq!(colors, [[0.0; 4]], "draw {draw}");
            shader.mask(draw, &points, &mut PointScratch::default(), &mut passed);
            assert!(!passed[0], "draw {draw}");
        }
    }
}
