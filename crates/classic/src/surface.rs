//! A face prepared for pixels: its coverage and its depth plane.

use super::{Edges, Face, STEPS_PER_PIXEL, weighted};
use std::ops::RangeInclusive;

/// Edges and depth of a face.
pub struct Surface {
    edges: Edges,
    depths: [f64; 3],
}

impl Surface {
    /// None if the face is seen from its edge.
    #[must_use]
    pub fn new(face: &Face) -> Option<Self> {
        let corners = face.corners.map(|[x, y, _]| [x, y].map(i64::from));
        let edges = Edges::new(corners, STEPS_PER_PIXEL.into())?;
        let depths = edges.shares(face.corners.map(|corner| corner[2].into()));
        Some(Self { edges, depths })
    }

    /// How near the face's plane lies at the centre of a pixel, in 1/256 pixel. Where the face covers the
    /// pixel, it is exact to 2⁻³³: depths are below 2¹⁸, no weight is negative, and four roundings take part.
    #[inline]
    #[must_use]
    pub fn depth(&self, pixel: [i32; 2]) -> f64 {
        self.edges.interpolated(&self.depths, pixel)
    }

    /// Whether the face covers the centre of a pixel.
    #[inline]
    #[must_use]
    pub fn covers(&self, pixel: [i32; 2]) -> bool {
        self.edges.covers(pixel)
    }

    /// Whether one of the edges has all of some pixels' centres on its outer side.
    pub(super) fn misses(&self, pixels: &[[i32; 2]; 4]) -> bool {
        (0..3).any(|edge| pixels.iter().all(|&pixel| self.edges.is_beyond(edge, pixel)))
    }

    /// Columns and rows that the face can reach in an image of that size.
    #[must_use]
    pub fn bounding_box(&self, limits: [i32; 2]) -> [RangeInclusive<i32>; 2] {
        self.edges.bounding_box(limits)
    }

    /// Calls `visit` for each pixel that the face covers, with its [`depth`](Self::depth) there;
    /// returns how many were looked at.
    #[inline]
    pub fn each_pixel(&self, limits: [i32; 2], mut visit: impl FnMut([i32; 2], f64)) -> u64 {
        let pixels = self.bounding_box(limits);
        self.edges.each_covered(&pixels, |pixel, weights| visit(pixel, weighted(&self.depths, weights)));
        let [width, height] = pixels.map(Iterator::count);
        (width * height) as u64
    }
}
