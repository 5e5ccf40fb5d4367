//! The trait that a user of the rasterizer implements: where vertices come
//! from, and what colour a sample gets.

use crate::{Fragment, Varyings};
use trigon_math::Vec4;

/// One vertex after the vertex stage.
#[derive(Clone, Copy, Debug)]
pub struct VertexOutput<V> {
    /// Clip space: x and y within `-w..=w` are on the screen, y up; z within
    /// `0..=w`, z = w at the near plane, 0 at the far plane (reversed).
    ///
    /// Nothing is required of the values: a triangle with a coordinate that is
    /// not finite or beyond ±2^100 is dropped, all others are drawn.
    pub position: Vec4,
    /// What is interpolated for the fragments.
    pub varyings: V,
}

/// A draw's own program: vertices in, colours out.
///
/// The trait is called statically inside loops over many vertices or
/// fragments; only those loops are reached through a virtual call.
pub trait Pipeline: Sync {
    /// What is interpolated from the vertices to the fragments.
    type Varyings: Varyings;

    /// How many vertices there are; indices beyond are dropped with their
    /// triangle.
    fn vertex_count(&self) -> usize;

    /// The vertex `index`, below [`vertex_count`](Self::vertex_count). Called
    /// at most once per frame and draw for each vertex, on any thread; for those
    /// that the draw's indices name, and perhaps for some between them.
    fn vertex(&self, index: usize) -> VertexOutput<Self::Varyings>;

    /// The colour of a visible sample: linear light, premultiplied by its
    /// alpha. A component that is not finite counts as 0; what overflows when
    /// finite colours are blended or averaged is held to the largest number.
    fn fragment(&self, fragment: &Fragment<Self::Varyings>) -> Vec4;

    /// Whether the sample exists at all. Asked only for
    /// [`Surface::Masked`](crate::Surface::Masked), before depth is written.
    fn mask(&self, _fragment: &Fragment<Self::Varyings>) -> bool {
        true
    }
}
