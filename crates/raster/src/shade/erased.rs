//! Pipelines of different types side by side: the type is forgotten once per
//! draw and remembered once per run of a draw's samples in a tile.

use super::interpolation::Interpolation;
use super::span::Span;
use crate::geometry::Geometry;
use crate::pool::Workers;
use crate::setup::{CutWeights, SetupTriangle};
use crate::tile::TileArea;
use crate::vertex::UsedVertices;
use crate::{EdgeFlags, Fragment, Pipeline, Varyings};
use std::num::NonZeroU32;
use trigon_math::{UVec2, Vec2, Vec4};

/// A pipeline without its type.
pub(crate) trait AnyPipeline: Sync {
    fn vertex_count(&self) -> usize;

    /// Runs the vertex stage over the `used` vertices: their positions, and
    /// what shades with their varyings.
    fn run_vertices<'s>(
        &'s self,
        used: &UsedVertices,
        workers: &Workers,
    ) -> (Vec<Vec4>, Box<dyn Shader + 's>);
}

/// What shades the samples of one draw.
pub(crate) trait Shader: Sync {
    /// Writes each sample's colour to its place in `colors`.
    fn shade(&self, context: &ShadeContext<'_>, spans: &[Span], colors: &mut [Vec4]);

    /// Writes whether each sample exists to its place in `kept`.
    fn mask(&self, context: &ShadeContext<'_>, spans: &[Span], kept: &mut [bool]);
}

/// What a shader has to know of the frame.
pub(crate) struct ShadeContext<'f> {
    pub(crate) triangles: &'f [SetupTriangle],
    pub(crate) weights: &'f [CutWeights],
    pub(crate) geometry: &'f Geometry<'f>,
    pub(crate) used: &'f UsedVertices,
    pub(crate) area: TileArea,
    pub(crate) samples_per_axis: NonZeroU32,
}

impl<P: Pipeline> AnyPipeline for &P {
    fn vertex_count(&self) -> usize {
        P::vertex_count(self)
    }

    fn run_vertices<'s>(
        &'s self,
        used: &UsedVertices,
        workers: &Workers,
    ) -> (Vec<Vec4>, Box<dyn Shader + 's>) {
        let pipeline: &'s P = self;
        let (positions, varyings) = workers.unzip(0..used.len(), |slot| {
            let vertex = pipeline.vertex(used.index(slot));
            (vertex.position, vertex.varyings)
        });
        (positions, Box::new(TypedShader { pipeline, varyings }))
    }
}

struct TypedShader<'s, P: Pipeline> {
    pipeline: &'s P,
    /// Of the used vertices, slot by slot.
    varyings: Vec<P::Varyings>,
}

impl<P: Pipeline> Shader for TypedShader<'_, P> {
    fn shade(&self, context: &ShadeContext<'_>, spans: &[Span], colors: &mut [Vec4]) {
        self.for_each_fragment(context, spans, |output, fragment| {
            colors[output] = finite(self.pipeline.fragment(fragment));
        });
    }

    fn mask(&self, context: &ShadeContext<'_>, spans: &[Span], kept: &mut [bool]) {
        self.for_each_fragment(context, spans, |output, fragment| {
            kept[output] = self.pipeline.mask(fragment);
        });
    }
}

/// A colour without anything that is not finite.
#[inline(always)]
fn finite(color: Vec4) -> Vec4 {
    if color.is_finite() {
        return color;
    }
    Vec4::from_array(color.to_array().map(|v| if v.is_finite() { v } else { 0.0 }))
}

impl<P: Pipeline> TypedShader<'_, P> {
    #[inline(always)]
    fn for_each_fragment(
        &self,
        context: &ShadeContext<'_>,
        spans: &[Span],
        mut visit: impl FnMut(usize, &Fragment<P::Varyings>),
    ) {
        for spans in spans.chunk_by(|a, b| a.triangle == b.triangle) {
            let common = Common::new(context, spans[0].triangle);
            let values = common.slots.map(|slot| &self.varyings[slot]);
            for span in spans {
                let y = context.area.origin[1] + i32::from(span.y);
                for i in 0..span.length {
                    let x = context.area.origin[0] + i32::from(span.x + i);
                    let fragment = common.fragment(values, [x, y]);
                    visit(span.output as usize + usize::from(i), &fragment);
                }
            }
        }
    }
}

/// What the fragments of one triangle have in common.
struct Common {
    interpolation: Interpolation,
    /// The slots of the vertices whose values are weighted, in the order of the
    /// weights.
    slots: [usize; 3],
    primitive: u32,
    face: u32,
    front_facing: bool,
    edge_flags: EdgeFlags,
    samples_per_axis: NonZeroU32,
}

impl Common {
    #[inline(always)]
    fn new(context: &ShadeContext<'_>, ordinal: u32) -> Self {
        let triangle = &context.triangles[ordinal as usize];
        let samples = context.samples_per_axis.get() as f32;
        let interpolation = Interpolation::new(triangle, context.weights, samples);
        let corners = context.geometry.corners(triangle.primitive);
        let slot = |index: u32| context.used.slot(index).expect("what is seen has its vertices");
        Self {
            slots: interpolation.corners.map(|corner| slot(corners[usize::from(corner)])),
            interpolation,
            primitive: triangle.primitive,
            face: context.geometry.face(triangle.primitive),
            front_facing: triangle.front_facing,
            edge_flags: context.geometry.edge_flags(triangle.primitive),
            samples_per_axis: context.samples_per_axis,
        }
    }

    #[inline(always)]
    fn fragment<V: Varyings>(&self, values: [&V; 3], sample: [i32; 2]) -> Fragment<V> {
        let place = self.interpolation.at(self.interpolation.edges.map(|edge| edge.at(sample)));
        let [x, y] = sample;
        let pixels = self.samples_per_axis.get() as f32;
        Fragment {
            varyings: V::weighted(values, place.weights),
            ddx: V::gradient(values, place.ddx),
            ddy: V::gradient(values, place.ddy),
            pixel: UVec2::new(x as u32 / self.samples_per_axis, y as u32 / self.samples_per_axis),
            position: Vec2::new((x as f32 + 0.5) / pixels, (y as f32 + 0.5) / pixels),
            depth: place.depth,
            inverse_w: place.inverse_w,
            triangle: self.primitive,
            face: self.face,
            front_facing: self.front_facing,
            edge_distances: place.edge_distances,
            edge_flags: self.edge_flags,
        }
    }
}
