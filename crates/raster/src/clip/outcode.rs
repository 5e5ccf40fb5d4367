//! Outcodes: which planes a vertex lies beyond. Outcodes tell without further arithmetic whether a primitive is
//! dropped, kept whole, or cut.

use trigon_math::{Band, Vec4};

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
