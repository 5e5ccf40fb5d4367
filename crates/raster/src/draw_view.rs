//! One draw of a frame, with access to its triangles by the references that tiles list.

use crate::bin::{Chunk, TriangleRef};
use crate::geometry::{Geometry, Shape};
use crate::point::PlainPoints;
use crate::primitive::{Quad, SetupTriangle};
use crate::simd::InlineMap;
use crate::vertex::{DrawVertices, ScreenVertex};

/// Looks up the triangles of one draw.
#[derive(Clone, Copy)]
pub(crate) struct DrawView<'f> {
    pub(crate) geometry: &'f Geometry<'f>,
    pub(crate) vertices: DrawVertices<'f>,
    /// Ordinal of its first primitive in the frame.
    pub(crate) first: u32,
    /// How its points look, if they are drawn from their vertices.
    pub(crate) points: Option<&'f PlainPoints>,
    /// Those of the whole frame, in the order of their ordinals.
    pub(crate) chunks: &'f [Chunk],
}

impl<'f> DrawView<'f> {
    /// The primitive of the draw that a triangle belongs to.
    #[inline(always)]
    pub(crate) fn primitive(&self, triangle: TriangleRef) -> u32 {
        triangle.ordinal - self.first
    }

    /// A triangle, ready; the first half of a point.
    #[inline]
    pub(crate) fn triangle(&self, triangle: TriangleRef) -> SetupTriangle {
        if let Some(square) = self.square(triangle) {
            return square.half(0);
        }
        if !triangle.is_whole()
            && let Some(made) = self.chunk_of(triangle).made(triangle)
        {
            return made;
        }
        SetupTriangle::whole(self.corners(triangle).each(|vertex| *vertex), triangle.ordinal)
    }

    /// The square around a point that is drawn from its vertex.
    #[inline]
    pub(crate) fn square(&self, triangle: TriangleRef) -> Option<Quad> {
        let Shape::Points { points, sizes, .. } = &self.geometry.shape else { return None };
        let plain = self.points.filter(|_| triangle.is_point())?;
        let primitive = self.primitive(triangle);
        let center = self.vertices.get(points[primitive as usize]);
        Some(plain.square(sizes, primitive, triangle.ordinal, *center))
    }

    /// The vertices of a primitive.
    #[inline(always)]
    pub(crate) fn corners(&self, triangle: TriangleRef) -> [&'f ScreenVertex; 3] {
        self.geometry.corners(self.primitive(triangle)).each(
            #[inline(always)]
            |index| self.vertices.get(index),
        )
    }

    /// The chunk that a triangle belongs to.
    pub(crate) fn chunk_of(&self, triangle: TriangleRef) -> &'f Chunk {
        Chunk::of(self.chunks, triangle)
    }
}
