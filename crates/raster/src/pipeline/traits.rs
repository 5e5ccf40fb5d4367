//! The traits that a user of the rasterizer implements: where vertices come
//! from, and what colour a visible pixel gets.

use crate::fragments::RawFragment;
use crate::simd::{F32, LANES, Mask, Simd, prelude::*};
use crate::{Fragment, FragmentLanes, Varyings, VertexLanes};
use trigon_math::Vec4;

/// One vertex after the vertex stage.
#[derive(Clone, Copy, Debug)]
pub struct VertexOutput<V> {
    /// Clip space: x and y within `-w..=w` are on the screen, y up; z within
    /// `0..=w`, z = w at the near plane, 0 at the far plane (reversed).
    ///
    /// Any values are allowed: a triangle with a coordinate that is not finite or
    /// beyond ±2^100 is dropped, all others are drawn.
    pub position: Vec4,
    /// What is interpolated for the fragments.
    pub varyings: V,
}

/// The program of a draw, written for one vertex and one fragment at a time. This is
/// the convenient form; [`LanePipeline`] is the fast one.
///
/// The trait is called statically inside loops over many vertices or
/// fragments; only those loops are reached through a virtual call.
pub trait Pipeline: Sync {
    /// What is interpolated from the vertices to the fragments.
    type Varyings: Varyings;

    /// Whether [`fragment`](Self::fragment) is called only once per visible primitive; see
    /// [`LanePipeline::FLAT`]. Only the ids of the fragment are meaningful then.
    const FLAT: bool = false;

    /// How many vertices there are; indices beyond are dropped with their
    /// triangle.
    fn vertex_count(&self) -> usize;

    /// The vertex `index`, below [`vertex_count`](Self::vertex_count). Called
    /// on any thread; once per frame and draw for each vertex that the draw's
    /// indices name, and perhaps for some that they do not. Asked again where
    /// a triangle is cut, so it must be a function of the index alone.
    fn vertex(&self, index: usize) -> VertexOutput<Self::Varyings>;

    /// The colour of a visible pixel: linear light, premultiplied by its alpha. A
    /// component that is not finite counts as 0. If finite colours overflow when they
    /// are blended or averaged, the result is clamped to the largest number.
    fn fragment(&self, fragment: &Fragment<Self::Varyings>) -> Vec4;

    /// Whether the fragment exists at all. Called only for
    /// [`BlendMode::Masked`](crate::BlendMode::Masked), before depth is written.
    fn mask(&self, _fragment: &Fragment<Self::Varyings>) -> bool {
        true
    }
}

/// A [`Pipeline`] without its type. Each call does enough work to hide the virtual dispatch.
#[doc(hidden)]
pub trait ScalarPipeline: Sync {
    /// A vertex's position; its varyings go to the row.
    fn run_vertex(&self, index: usize, varyings: &mut [f32]) -> [f32; 4];
    /// A fragment's colour.
    fn run_fragment(&self, fragment: &RawFragment<'_>) -> [f32; 4];
    /// Whether a fragment exists.
    fn run_mask(&self, fragment: &RawFragment<'_>) -> bool;
}

impl<P: Pipeline> ScalarPipeline for P {
    fn run_vertex(&self, index: usize, varyings: &mut [f32]) -> [f32; 4] {
        let output = self.vertex(index);
        output.varyings.store(varyings);
        output.position.to_array()
    }

    fn run_fragment(&self, fragment: &RawFragment<'_>) -> [f32; 4] {
        self.fragment(&fragment.typed()).to_array()
    }

    fn run_mask(&self, fragment: &RawFragment<'_>) -> bool {
        self.mask(&fragment.typed())
    }
}

/// The program of a draw, written with vectors of eight lanes at every
/// [`SimdLevel`](crate::simd::SimdLevel). Every [`Pipeline`] is a `LanePipeline`.
///
/// Write each method `#[inline(always)]`, and everything that it calls on
/// vectors, too: a call that is not inlined loses the level's instructions.
/// Lanes must not look at each other, and only operations that round the same
/// everywhere keep the promise of equal bytes: `+ - * /`, square root,
/// comparison and selection; no fused multiply-add.
pub trait LanePipeline: Sync {
    /// How many f32 are interpolated from the vertices to the fragments; see
    /// [`varyings`](Self::varyings).
    const VARYINGS: usize;

    /// Whether [`fragments`](Self::fragments) is evaluated only once per tile for each
    /// visible triangle or part of a clipped one: flat colours.
    const FLAT: bool = false;

    /// Whether [`masks`](Self::masks) is implemented.
    const MASKED: bool = false;

    /// How many f32 this draw interpolates: [`VARYINGS`](Self::VARYINGS), unless the
    /// pipeline knows only when it is made. At most
    /// [`MAX_VARYINGS`](crate::MAX_VARYINGS), and always the same.
    #[inline(always)]
    fn varyings(&self) -> usize {
        Self::VARYINGS
    }

    /// How many vertices there are; indices beyond are dropped with their
    /// triangle.
    fn vertex_count(&self) -> usize;

    /// Clip-space positions (see [`VertexOutput::position`]) of up to eight
    /// consecutive vertices, and their varyings by [`VertexLanes::set`]. Lanes
    /// beyond the count are ignored.
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4];

    /// The colours of up to eight visible pixels: linear light, premultiplied;
    /// see [`Pipeline::fragment`]. For a [`FLAT`](Self::FLAT) pipeline only the ids
    /// of the fragments have a meaning: each lane is the colour of its triangle.
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4];

    /// Whether the fragments exist at all; see [`Pipeline::mask`]. Called only if
    /// [`MASKED`](Self::MASKED).
    #[inline(always)]
    fn masks<S: Simd>(&self, simd: S, _fragments: &FragmentLanes<'_, S>) -> Mask<S> {
        Mask::splat(simd, true)
    }

    /// The pipeline as one that does one thing at a time, so that its code is
    /// compiled once and not for every level.
    #[doc(hidden)]
    const SCALAR: bool = false;

    #[doc(hidden)]
    fn as_scalar(&self) -> Option<&dyn ScalarPipeline> {
        None
    }
}

impl<P: Pipeline> LanePipeline for P {
    const VARYINGS: usize = P::Varyings::COMPONENTS;
    const FLAT: bool = P::FLAT;
    const SCALAR: bool = true;

    fn as_scalar(&self) -> Option<&dyn ScalarPipeline> {
        Some(self)
    }

    fn vertex_count(&self) -> usize {
        P::vertex_count(self)
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        let mut positions = [[0.0; LANES]; 4];
        for lane in 0..vertices.count() {
            let position = self.run_vertex(vertices.first() + lane, vertices.of(lane));
            for (column, value) in positions.iter_mut().zip(position) {
                column[lane] = value;
            }
        }
        positions.map(|column| F32::simd_from(simd, column))
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let mut colors = [[0.0; LANES]; 4];
        fragments.for_each(|lane, fragment| {
            for (column, value) in colors.iter_mut().zip(self.run_fragment(&fragment)) {
                column[lane] = value;
            }
        });
        colors.map(|column| F32::simd_from(simd, column))
    }

    #[inline(always)]
    fn masks<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> Mask<S> {
        let mut passed = [0.0_f32; LANES];
        fragments.for_each(|lane, fragment| passed[lane] = f32::from(u8::from(self.run_mask(&fragment))));
        F32::simd_from(simd, passed).simd_gt(F32::splat(simd, 0.5))
    }
}
