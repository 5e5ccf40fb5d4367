//! A set of half-spaces in the order in which they clip.

use std::ops::{BitAnd, BitOr};

use glam::Vec4;

use super::{Band, HalfSpace};

/// The half-spaces to clip by: always `w` at least a minimum, and optionally the near and far plane
/// and the four bands.
///
/// Half-spaces clip in the order `w`, near, far, left, right, bottom, top, whatever the order in which they
/// were added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClipVolume {
    half_spaces: [Option<HalfSpace>; HalfSpace::COUNT],
}

impl ClipVolume {
    /// Everything in front of the eye: `w` at least the minimum.
    ///
    /// `None` unless the minimum is a normal, positive, finite number.
    #[must_use]
    pub fn before_the_eye(minimal_w: f32) -> Option<Self> {
        let half_spaces = [None; HalfSpace::COUNT];
        Some(Self { half_spaces }.with(HalfSpace::w_at_least(minimal_w)?))
    }

    /// With one more half-space, replacing one of the same kind.
    #[must_use]
    pub fn with(mut self, half_space: HalfSpace) -> Self {
        self.half_spaces[half_space.order()] = Some(half_space);
        self
    }

    /// With all four sides, `x` within `horizontal` and `y` within `vertical`.
    #[must_use]
    pub fn with_bands(self, horizontal: Band, vertical: Band) -> Self {
        self.with(HalfSpace::left(horizontal))
            .with(HalfSpace::right(horizontal))
            .with(HalfSpace::bottom(vertical))
            .with(HalfSpace::top(vertical))
    }

    /// The half-spaces in clipping order.
    pub fn half_spaces(&self) -> impl Iterator<Item = HalfSpace> {
        self.half_spaces.iter().copied().flatten()
    }

    /// Which half-spaces a position is outside of, exactly. A position with NaN or an infinity is
    /// outside all of them.
    #[must_use]
    pub fn outcode(&self, position: Vec4) -> Outcode {
        if !position.is_finite() {
            return Outcode(u8::MAX);
        }
        let outside = |half_space: HalfSpace| u8::from(!half_space.contains(position)) << half_space.order();
        Outcode(self.half_spaces().map(outside).fold(0, BitOr::bitor))
    }

    /// The half-spaces that clip after this one.
    pub(super) fn after(&self, half_space: HalfSpace) -> impl Iterator<Item = HalfSpace> {
        self.half_spaces[half_space.order() + 1..].iter().copied().flatten()
    }
}

/// The half-spaces of a [`ClipVolume`] that a position is outside of, one bit
/// each.
///
/// If the `|` of a triangle's three is [`Outcode::INSIDE`], clipping changes
/// nothing; if their `&` is not, nothing is left.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Outcode(u8);

impl Outcode {
    /// Outside of none.
    pub const INSIDE: Self = Self(0);

    /// The bits, from the lowest: `w`, near, far, left, right, bottom, top.
    #[must_use]
    pub const fn bits(self) -> u8 {
        self.0
    }
}

impl BitOr for Outcode {
    type Output = Self;
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl BitAnd for Outcode {
    type Output = Self;
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}
