//! The record of a triangle that is ready for its tiles.

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
