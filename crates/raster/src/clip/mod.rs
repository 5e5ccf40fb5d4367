//! Cuts primitives that reach beyond w = [`W_MIN`], the near plane or the guard band. Most primitives do not and are
//! never passed to this module.
//!
//! The far plane cuts nothing: samples behind it are dropped by their depth. The sides of the view cut nothing,
//! because the tiles end there. The cutting itself, with its guarantees for shared edges, is
//! [`trigon_math::clip_triangle`].

mod outcode;

pub(crate) use outcode::{COORDINATE_MAX, Outcode, W_MIN};

use crate::viewport::Viewport;
use trigon_math::{ClipPolygon, ClipVolume, HalfSpace, Vec4, clip_triangle};

/// Everything that may be drawn without being cut.
pub(crate) fn volume(viewport: Viewport) -> ClipVolume {
    let before_the_eye = ClipVolume::before_the_eye(W_MIN).expect("the least w is a normal number");
    let [horizontal, vertical] = viewport.guard();
    before_the_eye.with(HalfSpace::NEAR).with_bands(horizontal, vertical)
}

/// The most vertices that are left of a triangle: one more for w >= [`W_MIN`], the near
/// plane and each side of the guard band.
pub(crate) const MOST_VERTICES: usize = 3 + 6;

/// What is left of a triangle.
pub(crate) struct CutTriangle {
    pub(crate) polygon: ClipPolygon,
    /// Which corner of the triangle each weight of the polygon is for.
    pub(crate) order: [u8; 3],
    /// -1 if `order` turns the triangle over, else 1.
    pub(crate) winding: i64,
}

/// Cuts a triangle. Its corners are sorted by their coordinates first, so that
/// the result does not depend on how they were given.
pub(crate) fn cut_triangle(positions: [Vec4; 3], volume: &ClipVolume) -> CutTriangle {
    let (order, winding) = sorted(positions);
    let polygon = clip_triangle(order.map(|corner| positions[usize::from(corner)]), volume);
    CutTriangle { polygon, order, winding }
}

/// The order of the corners by their coordinates, and whether it is an even
/// permutation (1) or an odd one (-1).
fn sorted(positions: [Vec4; 3]) -> ([u8; 3], i64) {
    let mut order = [0_u8, 1, 2];
    let mut winding = 1;
    let follows = |a: u8, b: u8| {
        let (a, b) = (positions[usize::from(a)].to_array(), positions[usize::from(b)].to_array());
        let differing = a.iter().zip(&b).map(|(a, b)| a.total_cmp(b)).find(|order| order.is_ne());
        differing.is_some_and(std::cmp::Ordering::is_gt)
    };
    for (i, j) in [(0, 1), (1, 2), (0, 1)] {
        if follows(order[i], order[j]) {
            order.swap(i, j);
            winding = -winding;
        }
    }
    (order, winding)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const VIEWPORT: Viewport = Viewport { width: 100, height: 50 };

    fn position() -> impl Strategy<Value = Vec4> {
        let coordinate = prop_oneof![-4.0_f32..4.0, -4e5_f32..4e5];
        (coordinate.clone(), coordinate, -3.0_f32..3.0, -2.0_f32..2.0)
            .prop_map(|(x, y, z, w)| Vec4::new(x, y, z, w))
    }

    proptest! {
        #[test]
        fn the_order_of_the_corners_does_not_matter(positions in [position(), position(), position()]) {
            let points = |positions| {
                let cut = cut_triangle(positions, &volume(VIEWPORT));
                let bits = |position: Vec4| position.to_array().map(f32::to_bits);
                cut.polygon.vertices().iter().map(|v| bits(v.position)).collect::<Vec<_>>()
            };
            let [a, b, c] = positions;
            prop_assert_eq!(points([a, b, c]), points([c, a, b]));
            prop_assert_eq!(points([a, b, c]), points([b, a, c]));
        }

        #[test]
        fn outcodes_agree_with_the_volume(position in position()) {
            let ours = Outcode::new(position, VIEWPORT.guard());
            let theirs = volume(VIEWPORT).outcode(position);
            prop_assert_eq!(ours.cuts(), theirs != trigon_math::Outcode::INSIDE);
        }
    }
}
