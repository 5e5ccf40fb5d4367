//! Homogeneous clipping of triangles and segments, before the division by `w`.
//!
//! The scheme is that of I. Sutherland and G. Hodgman, "Reentrant Polygon Clipping" (1974), in homogeneous
//! coordinates (J. Blinn and M. Newell, "Clipping Using Homogeneous Coordinates", 1978). It clips at one
//! half-space after the other, always in the order of [`ClipVolume`]. Positions are linear in the corners'
//! weights, so every vertex carries the weights of the original triangle and attributes need no clipping.
//!
//! # What holds
//! Exactly, whatever the input:
//! 1. Every output vertex is inside every half-space of the volume. Vertices at distance zero are
//!    inside, too.
//! 2. A shared edge is cut at the same bits, for either triangle, in either direction and from any
//!    first vertex; and a segment is cut like the edge of a triangle.
//! 3. Corners inside the volume are unchanged.
//! 4. A triangle gets at most one additional vertex per half-space.
//! 5. A coordinate or weight that is equal at both ends of an edge stays so, and none leaves the
//!    range of the corners' values, except where a plane sets it.
//!
//! Within bounds: weights are in `[0, 1]` and sum to 1 within 2⁻²³. A vertex is where its weights place it within
//! `2⁻²²·m + 2⁻⁴⁴·(m + b·w)`, with `m` the largest magnitude of that coordinate and `w` that of `w` among the
//! corners, and `b` the largest [`Band`] (1 for depth).
//!
//! # Why
//! All arithmetic is in `f64`, with one cast to `f32` at the end. A cut goes from the vertex inside to the vertex
//! outside, `p = s·inside + t·outside`, and then sets the coordinate that the plane fixes: `w` to its minimum, `z`
//! to `w` or 0, `x` or `y` to a band times `w`. With the same `s` and `t >= 0` for all coordinates, and because
//! rounding is monotone, `z <= w` at both ends gives `z <= w` at the cut. Because bands are powers of two, the
//! same holds for `x` against `b·w`. The cast preserves both. So a cut never pushes a vertex out of an earlier
//! half-space.
//!
//! If both ends of an edge lie on one side of a later half-space, so does the cut. Setting `w` to
//! its minimum rounds, which could move the cut to the other side, so there the side is restored. Of
//! the corners of a triangle at most two neighbouring pairs differ in side; cuts add none, so
//! property 4 needs no tolerance.
//!
//! Polygons of more than three corners are not supported: a rounded quadrilateral is rarely planar,
//! and its triangles can be clipped instead; their shared diagonal is an edge like any other.

mod cut;
mod half_space;
mod polygon;
mod segment;
mod volume;

pub use half_space::{Band, HalfSpace};
pub use polygon::{ClipPolygon, ClipVertex, clip_triangle};
pub use segment::clip_segment;
pub use volume::{ClipVolume, Outcode};

#[cfg(test)]
mod tests;
