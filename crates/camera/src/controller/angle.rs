//! Angles without drift: a fraction of a full turn in 64-bit fixed point.
//!
//! Addition is exact and wraps around. A million steps to the left and a million back end at the very same bits. A
//! full turn in a million steps is off by less than 10⁻¹² radians; a sum in f64 would accumulate the same rounding
//! a million times.

use std::f64::consts::TAU;

/// 2⁶⁴ steps make a full turn.
const STEPS: f64 = 18_446_744_073_709_551_616.0;

/// An angle in [−π, π).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Angle(i64);

impl Angle {
    pub(crate) const ZERO: Self = Self(0);
    /// A quarter of a turn.
    pub(crate) const QUARTER: Self = Self(1 << 62);

    /// The nearest angle; whole turns are dropped. Values that are not finite count as 0.
    pub(crate) fn from_radians(radians: f64) -> Self {
        let turns = radians / TAU;
        let fraction = turns - turns.round();
        // In [-0.5, 0.5]: the cast saturates at one half, and makes NaN zero.
        Self((fraction * STEPS) as i64)
    }

    pub(crate) fn radians(self) -> f64 {
        self.0 as f64 / STEPS * TAU
    }

    /// The sum, wrapped into a full turn.
    pub(crate) fn plus(self, other: Self) -> Self {
        Self(self.0.wrapping_add(other.0))
    }

    /// The sum, clamped to a quarter turn on either side; `radians` may be any amount, and NaN adds
    /// nothing.
    pub(crate) fn plus_up_to_quarter(self, radians: f64) -> Self {
        const HALF_TURN: f64 = std::f64::consts::PI;
        let step = match radians {
            r if r >= HALF_TURN => return Self::QUARTER,
            r if r <= -HALF_TURN => return Self(-Self::QUARTER.0),
            r => Self::from_radians(r),
        };
        let sum = self.0.saturating_add(step.0);
        Self(sum.clamp(-Self::QUARTER.0, Self::QUARTER.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_million_steps_make_a_turn_and_undo_exactly() {
        let step = Angle::from_radians(TAU / 1e6);
        let start = Angle::from_radians(0.3);
        let turned = (0..1_000_000).fold(start, |angle, _| angle.plus(step));
        let miss = (turned.radians() - 0.3).abs();
        assert!(miss < 1e-12, "a full turn missed by {miss}");
        let back = (0..1_000_000).fold(turned, |angle, _| angle.plus(Angle(-step.0)));
        assert_eq!(back, start, "undoing every step restores the bits");
    }

    #[test]
    fn elevation_stops_at_the_poles() {
        let up = Angle::ZERO.plus_up_to_quarter(1e9);
        assert_eq!(up, Angle::QUARTER, "any amount upwards ends at the pole");
        let down = up.plus_up_to_quarter(-3.0).plus_up_to_quarter(-3.0);
        assert_eq!(down.radians(), -std::f64::consts::FRAC_PI_2, "and downwards at the other");
        assert_eq!(down.plus_up_to_quarter(f64::NAN), down, "not a number adds nothing");
    }

    #[test]
    fn odd_numbers_are_harmless() {
        for radians in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(Angle::from_radians(radians), Angle::ZERO, "{radians}");
        }
        for radians in [TAU, -TAU, 1e6 * TAU] {
            assert!(Angle::from_radians(radians).radians().abs() < 1e-9, "{radians}");
        }
    }
}
