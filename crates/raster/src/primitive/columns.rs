//! Eight triangles side by side, one in each lane: a [`Column`] holds one vertex of each.

use crate::simd::{F32, I32, InlineMap, LANES, Mask, Simd, prelude::*, transposed};
use crate::vertex::ScreenVertex;

/// Triangles whose bounding box is smaller than this on both axes, in 1/256 pixel,
/// have areas and edge functions within 32 bits, also a tile away.
pub(crate) const SMALL: i32 = 1 << 14;

/// A vertex of each lane's triangle.
#[derive(Clone, Copy)]
pub(crate) struct Column<S: Simd> {
    /// In 1/256 pixel.
    pub(crate) x: I32<S>,
    pub(crate) y: I32<S>,
    /// Bits of the depth.
    depth: I32<S>,
    /// Bits of 1/w.
    inverse_w: I32<S>,
    /// Which corner of the triangle it is.
    pub(crate) corner: I32<S>,
}

impl<S: Simd> Column<S> {
    /// Corner number `corner` of eight triangles.
    #[inline(always)]
    pub(crate) fn new(simd: S, vertices: [&ScreenVertex; LANES], corner: i32) -> Self {
        let [x, y, depth, inverse_w] = transposed(
            simd,
            vertices.each(
                #[inline(always)]
                |vertex| &vertex.0,
            ),
        );
        Self { x, y, depth, inverse_w, corner: I32::splat(simd, corner) }
    }

    #[inline(always)]
    pub(crate) fn depth(&self) -> F32<S> {
        self.depth.bitcast()
    }

    #[inline(always)]
    pub(crate) fn inverse_w(&self) -> F32<S> {
        self.inverse_w.bitcast()
    }

    /// Two vertices of each lane in the order of (y, x), and the lanes in which they were
    /// exchanged.
    #[inline(always)]
    fn ordered(a: Self, b: Self) -> (Self, Self, Mask<S>) {
        let swap = b.y.simd_lt(a.y) | (b.y.simd_eq(a.y) & b.x.simd_lt(a.x));
        (Self::selected(swap, b, a), Self::selected(swap, a, b), swap)
    }

    #[inline(always)]
    fn selected(mask: Mask<S>, a: Self, b: Self) -> Self {
        Self {
            x: mask.select(a.x, b.x),
            y: mask.select(a.y, b.y),
            depth: mask.select(a.depth, b.depth),
            inverse_w: mask.select(a.inverse_w, b.inverse_w),
            corner: mask.select(a.corner, b.corner),
        }
    }
}

/// The three vertices of each lane in the order of (y, x), and the lanes in which that is an odd
/// permutation: there the winding is reversed.
///
/// A sorting network of three comparisons. All lanes take the same steps, and every exchange is
/// a selection, so lanes may differ in their order without a branch.
#[inline(always)]
pub(crate) fn sorted_columns<S: Simd>([a, b, c]: [Column<S>; 3]) -> ([Column<S>; 3], Mask<S>) {
    let (a, b, first) = Column::ordered(a, b);
    let (b, c, second) = Column::ordered(b, c);
    let (a, b, third) = Column::ordered(a, b);
    ([a, b, c], first ^ second ^ third)
}

/// Which lanes hold a triangle whose bounding box is smaller than
/// `limit`, mostly [`SMALL`], on both axes.
#[inline(always)]
pub(crate) fn small_lanes<S: Simd>(simd: S, [a, b, c]: &[Column<S>; 3], limit: i32) -> Mask<S> {
    let limit = I32::splat(simd, limit);
    extent([a.x, b.x, c.x]).simd_lt(limit) & extent([a.y, b.y, c.y]).simd_lt(limit)
}

#[inline(always)]
fn extent<S: Simd>([a, b, c]: [I32<S>; 3]) -> I32<S> {
    a.max(b).max(c) - a.min(b).min(c)
}
