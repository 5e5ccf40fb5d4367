//! The record of a triangle that is ready for its tiles; and eight triangles side by side, one in each lane, of which a
//! [`Column`] holds one vertex each.

use crate::simd::{F32, I32, InlineMap, LANES, Mask, Simd, prelude::*, transposed};
use crate::vertex::ScreenVertex;
use trigon_math::orientation_fixed;

/// What a triangle is part of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Triangle,
    Line,
    SquarePoint,
    /// Half of the square around a disc.
    RoundPoint,
    /// Half of the rectangle around an anti-aliased line or point.
    Stroke,
}

/// How the vertices of a set-up triangle come from the corners of the
/// primitive that was recorded.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Corners {
    /// Vertex `i` is corner `[i]`.
    Whole([u8; 3]),
    /// Cut: the weights of the corners are in the chunk's table at this index.
    Cut {
        /// Index into the table.
        weights: u32,
        /// The corner that column `i` of the weights is for.
        order: [u8; 3],
    },
    /// Made from a segment: the weights of its vertices are those at its ends, and
    /// column `i` of them is for vertex `[i]` of the segment.
    Ends([u8; 3]),
}

/// The weights of a primitive's corners at the vertices of a cut triangle:
/// `[vertex][corner]`.
pub(crate) type CutWeights = [[f32; 3]; 3];

/// A triangle with an area and, perhaps, samples inside.
///
/// Its vertices are sorted by (y, x), so that nothing computed from them depends on the order in which the
/// corners were given. Only triangles that are not simply three vertices of their draw are stored in this
/// form; the others are built when they are needed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SetupTriangle {
    pub(crate) vertices: [ScreenVertex; 3],
    /// The primitive's ordinal in the frame.
    pub(crate) ordinal: u32,
    pub(crate) corners: Corners,
    pub(crate) kind: Kind,
    pub(crate) front_facing: bool,
}

impl SetupTriangle {
    /// A triangle that was not cut, from its corners in their order.
    #[inline]
    pub(crate) fn whole(vertices: [ScreenVertex; 3], ordinal: u32) -> Self {
        let [a, b, c] = vertices.map(ScreenVertex::point);
        // Positive is clockwise on the screen.
        let front_facing = orientation_fixed(a, b, c) < 0;
        let order = sorted(vertices);
        let corners = Corners::Whole(order.map(|i| i as u8));
        Self { vertices: order.map(|i| vertices[i]), ordinal, corners, kind: Kind::Triangle, front_facing }
    }

    /// Twice the area in units of the grid, signed: positive if the sorted
    /// vertices run clockwise on the screen.
    #[inline]
    pub(crate) fn doubled_area(&self) -> i64 {
        let [a, b, c] = self.vertices.map(ScreenVertex::point);
        orientation_fixed(a, b, c)
    }

    /// The greatest depth of the vertices.
    #[inline]
    pub(crate) fn nearest(&self) -> f32 {
        let [a, b, c] = self.vertices.map(ScreenVertex::depth);
        let greater = |a: f32, b: f32| if b > a { b } else { a };
        greater(greater(a, b), c)
    }

    /// The least and the greatest coordinate of an axis in 1/256 pixel.
    #[inline]
    pub(crate) fn extent(&self, axis: usize) -> [i32; 2] {
        let [a, b, c] = self.vertices.map(|vertex| vertex.raw()[axis]);
        [a.min(b).min(c), a.max(b).max(c)]
    }
}

/// The order of three vertices by (y, x).
#[inline]
pub(crate) fn sorted(vertices: [ScreenVertex; 3]) -> [usize; 3] {
    let mut order = [0, 1, 2];
    let key = |i: usize| {
        let [x, y] = vertices[i].raw();
        (y, x)
    };
    for (i, j) in [(0, 1), (1, 2), (0, 1)] {
        if key(order[j]) < key(order[i]) {
            order.swap(i, j);
        }
    }
    order
}

#[cfg(test)]
impl SetupTriangle {
    /// For tests: a triangle at points in 1/256 pixel.
    pub(crate) fn on_grid(points: [[i32; 2]; 3]) -> Self {
        use trigon_math::{Fixed, FixedPoint};
        let vertex = |[x, y]: [i32; 2]| {
            ScreenVertex::new(FixedPoint::new(Fixed::from_raw(x), Fixed::from_raw(y)), 0.5, 1.0)
        };
        Self::whole(points.map(vertex), 0)
    }
}

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
