//! The intersection of an edge with a half-space, the only place where it is computed.

use glam::Vec4;

use super::{ClipVertex, ClipVolume, HalfSpace};

/// An intermediate vertex: in `f64`, so that several cuts do not accumulate rounding.
#[derive(Clone, Copy)]
pub(super) struct Vertex<const CORNERS: usize> {
    pub(super) position: [f64; 4],
    weights: [f64; CORNERS],
}

impl<const CORNERS: usize> Vertex<CORNERS> {
    /// A corner of the original shape.
    pub(super) fn corner(index: usize, position: Vec4) -> Self {
        let mut weights = [0.0; CORNERS];
        weights[index] = 1.0;
        Self { position: position.to_array().map(f64::from), weights }
    }

    /// The vertex as it leaves the clipper: the only rounding to `f32`.
    pub(super) fn rounded(self) -> ClipVertex<CORNERS> {
        // A coordinate set to a band times `w` may exceed f32 by rounding.
        const LARGEST: f64 = f32::MAX as f64;
        let round = |value: f64| value.clamp(-LARGEST, LARGEST) as f32;
        ClipVertex { position: Vec4::from_array(self.position.map(round)), weights: self.weights.map(round) }
    }
}

/// The intersection of the edge from `inside` to `outside` with the boundary of a half-space.
///
/// The roles are fixed by the sides and not by the direction of an edge, so both triangles at the
/// edge get the same bits. `inside` must be at a positive distance and `outside` at a negative one.
pub(super) fn cut<const CORNERS: usize>(
    inside: &Vertex<CORNERS>,
    outside: &Vertex<CORNERS>,
    half_space: HalfSpace,
    volume: &ClipVolume,
) -> Vertex<CORNERS> {
    let (depth, excess) = (half_space.distance(inside.position), -half_space.distance(outside.position));
    let total = depth + excess;
    let mix = Mix { inside: excess / total, outside: depth / total };
    let mut position = mix.each(inside.position, outside.position);
    half_space.land(&mut position);
    keep_sides(&mut position, inside, outside, volume.after(half_space));
    Vertex { position, weights: mix.each(inside.weights, outside.weights) }
}

/// Moves a cut point onto the boundary of each half-space that only rounding made it cross: neither
/// end of its edge is on that side.
fn keep_sides<const CORNERS: usize>(
    position: &mut [f64; 4],
    inside: &Vertex<CORNERS>,
    outside: &Vertex<CORNERS>,
    half_spaces: impl Iterator<Item = HalfSpace>,
) {
    for half_space in half_spaces {
        let ends = [inside, outside].map(|end| half_space.distance(end.position));
        let here = half_space.distance(*position);
        let left_inside = here < 0.0 && ends.iter().all(|&end| end >= 0.0);
        let left_outside = here > 0.0 && ends.iter().all(|&end| end <= 0.0);
        if left_inside || left_outside {
            half_space.land(position);
        }
    }
}

/// The weights of two ends for a point between them; not negative, with sum 1 up to rounding.
struct Mix {
    inside: f64,
    outside: f64,
}

impl Mix {
    /// Monotone in both ends, with rounding. The error of the sum, a few 2⁻⁵³, never shows after
    /// rounding to `f32`: next to a value that is an `f32`, the result is that value.
    fn each<const N: usize>(&self, inside: [f64; N], outside: [f64; N]) -> [f64; N] {
        std::array::from_fn(|index| inside[index] * self.inside + outside[index] * self.outside)
    }
}
