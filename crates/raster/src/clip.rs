//! Cuts primitives that reach beyond w = [`W_MIN`], the near plane or the guard band. Most primitives do not and are
//! never passed to this module.
//!
//! The far plane cuts nothing: samples behind it are dropped by their depth. The sides of the view cut nothing,
//! because the tiles end there. The cutting itself, with its guarantees for shared edges, is
//! [`trigon_math::clip_triangle`].
//!
//! Outcodes: which planes a vertex lies beyond. Outcodes tell without further arithmetic whether a primitive is
//! dropped, kept whole, or cut.

use crate::viewport::Viewport;
use trigon_math::{Band, ClipPolygon, ClipVolume, HalfSpace, Vec4, clip_triangle};

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

/// The least w that is drawn. Every perspective with a near plane above this
/// is cut by the near plane first; the bound keeps 1/w and all that is
/// multiplied by it finite.
pub(crate) const W_MIN: f32 = 1.0 / (1_u128 << 80) as f32;

/// Coordinates beyond this drop their triangle: it leaves room for every sum
/// and product on the way to the sub-pixel grid.
pub(crate) const COORDINATE_MAX: f32 = (1_u128 << 100) as f32;

/// A set of planes that a vertex lies beyond.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Outcode(u16);

impl Outcode {
    pub(crate) const W: Self = Self(1);
    pub(crate) const NEAR: Self = Self(1 << 1);
    pub(crate) const FAR: Self = Self(1 << 2);
    const SIDES: [u16; 4] = [1 << 3, 1 << 4, 1 << 5, 1 << 6];
    pub(crate) const GUARD: [Self; 4] = [Self(1 << 7), Self(1 << 8), Self(1 << 9), Self(1 << 10)];
    pub(crate) const INVALID: Self = Self(1 << 11);

    /// A triangle or a line that reaches beyond one of these planes (w, near, the guard band) is cut;
    /// a point whose centre lies beyond is not drawn.
    const CUTTING: u16 = 0b0111_1000_0011;
    /// A triangle with all its vertices beyond one of these planes is invisible.
    const HIDING: u16 = 0b0111_1111_1111;
    /// The same for lines and points. The sides of the view are not among them, because a line or a
    /// point extends beyond its vertices by half its width.
    const HIDING_WIDE: u16 = 0b0111_1000_0111;

    /// The planes that `position` lies beyond, exactly.
    #[inline]
    pub(crate) fn new(position: Vec4, guard: [Band; 2]) -> Self {
        let Vec4 { x, y, z, w } = position;
        // False for NaN, too.
        let valid = |v: f32| v.abs() <= COORDINATE_MAX;
        if !(valid(x) && valid(y) && valid(z) && valid(w)) {
            return Self::INVALID;
        }
        let bit = |beyond: bool, bit: u16| if beyond { bit } else { 0 };
        // Exact, as bands are powers of two.
        let [guard_x, guard_y] = guard.map(|band| band.factor() * w);
        Self(
            bit(w < W_MIN, Self::W.0)
                | bit(z > w, Self::NEAR.0)
                | bit(z < 0.0, Self::FAR.0)
                | bit(x < -w, Self::SIDES[0])
                | bit(x > w, Self::SIDES[1])
                | bit(y < -w, Self::SIDES[2])
                | bit(y > w, Self::SIDES[3])
                | bit(x < -guard_x, Self::GUARD[0].0)
                | bit(x > guard_x, Self::GUARD[1].0)
                | bit(y < -guard_y, Self::GUARD[2].0)
                | bit(y > guard_y, Self::GUARD[3].0),
        )
    }

    #[inline]
    pub(crate) const fn bits(self) -> u16 {
        self.0
    }

    /// The set that [`bits`](Self::bits) gave.
    #[inline]
    pub(crate) fn from_bits(bits: u16) -> Self {
        Self(bits)
    }

    #[inline]
    pub(crate) fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    #[inline]
    pub(crate) fn intersection(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    #[inline]
    pub(crate) fn contains(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }

    #[inline]
    pub(crate) fn is_invalid(self) -> bool {
        self.contains(Self::INVALID)
    }

    /// Whether a primitive with this union of outcodes must be cut.
    #[inline]
    pub(crate) fn cuts(self) -> bool {
        self.0 & Self::CUTTING != 0
    }

    /// Whether a triangle with this intersection of outcodes is out of sight.
    #[inline]
    pub(crate) fn hides(self) -> bool {
        self.0 & Self::HIDING != 0
    }

    /// The same for a line or a point.
    #[inline]
    pub(crate) fn hides_wide(self) -> bool {
        self.0 & Self::HIDING_WIDE != 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::viewport::Viewport;
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

    fn outcode(x: f32, y: f32, z: f32, w: f32) -> Outcode {
        let guard = Viewport { width: 64, height: 64 }.guard();
        Outcode::new(Vec4::new(x, y, z, w), guard)
    }

    #[test]
    fn each_plane_has_its_bit() {
        assert_eq!(outcode(0.0, 0.0, 0.5, 1.0), Outcode(0), "inside");
        assert!(outcode(0.0, 0.0, 1.5, 1.0).contains(Outcode::NEAR), "before the near plane");
        assert!(outcode(0.0, 0.0, -0.5, 1.0).hides(), "behind the far plane");
        assert!(!outcode(0.0, 0.0, -0.5, 1.0).cuts(), "which is no reason to cut");
        assert!(outcode(1.5, 0.0, 0.5, 1.0).hides(), "to the right");
        assert!(!outcode(1.5, 0.0, 0.5, 1.0).hides_wide(), "where a wide line may reach in");
        assert!(!outcode(1.5, 0.0, 0.5, 1.0).cuts(), "but within the guard band");
        assert!(outcode(1025.0, 0.0, 0.5, 1.0).cuts(), "beyond it");
        assert!(outcode(0.0, 0.0, 0.0, 0.0).contains(Outcode::W), "in the eye");
        assert!(outcode(0.0, 0.0, 0.0, -1.0).contains(Outcode::W), "behind the eye");
    }

    #[test]
    fn what_is_not_finite_is_invalid() {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e38, -1e38] {
            for slot in 0..4 {
                let mut position = [0.0, 0.0, 0.5, 1.0];
                position[slot] = bad;
                let [x, y, z, w] = position;
                assert!(outcode(x, y, z, w).is_invalid(), "{bad} in component {slot}");
            }
        }
    }
}
