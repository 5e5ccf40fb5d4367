//! The record of a line or a point for the tiles: a quadrilateral of two triangles.
//!
//! One record and one entry in each tile represent both triangles. A triangle is built from the record when a caller
//! needs it.

use super::stroke::Stroke;
use super::triangle::{Corners, CutWeights, Kind, SetupTriangle, sorted};
use crate::simd::InlineMap;
use crate::vertex::ScreenVertex;

/// A quadrilateral around a segment or a point.
///
/// If its outline is sharp, the two sides across it are parallel to an axis. Its corners wind the
/// same way whatever its triangles, which share the diagonal from the first corner of the
/// first end to the second of the other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quad {
    /// x and y in 1/256 pixel, the two corners of each end: `[[a, b], [d, c]]`. Once around, their
    /// order is a, b, c, d, so that a and d lie on one side of the segment, b and c on the other.
    pub(crate) corners: [[[i32; 2]; 2]; 2],
    /// Reversed depths of the ends.
    pub(crate) depths: [f32; 2],
    pub(crate) inverse_w: [f32; 2],
    /// The primitive's ordinal in the frame.
    pub(crate) ordinal: u32,
    /// What few have, by its index among the chunk's details.
    pub(crate) detail: Option<DetailIndex>,
    pub(crate) kind: Kind,
    pub(crate) ends: Ends,
}

/// Which vertices of the primitive the ends of a [`Quad`] belong to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ends {
    /// Those of a segment, in their order.
    InOrder,
    /// Those of a segment, the second first.
    Swapped,
    /// Both the only one of a point.
    Point,
}

/// What only cut and anti-aliased lines and points have.
#[derive(Clone, Copy, Debug)]
pub(crate) struct QuadDetail {
    /// For each end the weights of the segment's vertices, that of the first end first.
    pub(crate) weights: [[f32; 3]; 2],
    /// What an anti-aliased one covers.
    pub(crate) stroke: Option<Stroke>,
}

impl QuadDetail {
    /// The weights of an uncut segment.
    pub(crate) const WHOLE: [[f32; 3]; 2] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
}

/// An index among a chunk's [`QuadDetail`]s, one more than it is: so that no index takes no
/// memory.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DetailIndex(std::num::NonZeroU32);

impl DetailIndex {
    /// An index that fits 32 bits.
    pub(crate) fn new(index: usize) -> Option<Self> {
        u32::try_from(index + 1).ok().and_then(std::num::NonZeroU32::new).map(Self)
    }

    /// The index.
    pub(crate) fn get(self) -> usize {
        self.0.get() as usize - 1
    }
}

/// The corners of both triangles, each by its end and its side.
const HALVES: [[[usize; 2]; 3]; 2] = [[[0, 0], [0, 1], [1, 1]], [[0, 0], [1, 1], [1, 0]]];

impl Quad {
    /// One of its two triangles.
    pub(crate) fn half(&self, half: usize) -> SetupTriangle {
        let (vertices, order) = self.sorted(half);
        let corners = match self.ends {
            Ends::InOrder => Corners::Ends([0, 1, 1]),
            Ends::Swapped => Corners::Ends([1, 0, 0]),
            Ends::Point => Corners::Whole([0; 3]),
        };
        SetupTriangle {
            vertices: order.map(|i| vertices[i]),
            ordinal: self.ordinal,
            corners,
            kind: self.kind,
            front_facing: true,
        }
    }

    /// The weights of the segment's vertices at the vertices of one of its triangles, from
    /// those at its ends; `None` for a point.
    pub(crate) fn weights(&self, half: usize, ends: [[f32; 3]; 2]) -> Option<CutWeights> {
        let (_, order) = self.sorted(half);
        (self.ends != Ends::Point).then(|| order.map(|i| ends[HALVES[half][i][0]]))
    }

    /// The vertices of one of its triangles and their order.
    #[inline(always)]
    pub(crate) fn sorted(&self, half: usize) -> ([ScreenVertex; 3], [usize; 3]) {
        let vertices = HALVES[half].each(
            #[inline(always)]
            |[end, side]| {
                let [x, y] = self.corners[end][side];
                ScreenVertex([x, y, self.depths[end].to_bits() as i32, self.inverse_w[end].to_bits() as i32])
            },
        );
        (vertices, sorted(vertices))
    }

    /// The least and the greatest coordinate of an axis in 1/256 pixel.
    #[inline(always)]
    pub(crate) fn extent(&self, axis: usize) -> [i32; 2] {
        let [[a, b], [c, d]] = self.corners;
        let [a, b, c, d] = [a[axis], b[axis], c[axis], d[axis]];
        [a.min(b).min(c.min(d)), a.max(b).max(c.max(d))]
    }

    /// The greatest depth.
    #[inline(always)]
    pub(crate) fn nearest(&self) -> f32 {
        let [a, b] = self.depths;
        if b > a { b } else { a }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a wireframe of 1.5 million edges takes is a multiple of it.
    #[test]
    fn a_record_fits_a_line_of_the_cache() {
        assert!(size_of::<Quad>() <= 64, "{} bytes", size_of::<Quad>());
    }
}
