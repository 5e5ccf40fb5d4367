//! The half-spaces that clipping uses, each with an exact test.

use glam::Vec4;

/// How far the clip volume extends beyond the view volume: `x` or `y` may be up to this factor
/// times `w`. A power of two from 1 to 65536, so that the product with `w` is exact.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Band(f32);

impl Band {
    /// The view volume itself: factor 1.
    pub const VIEW: Self = Self(1.0);
    /// The widest band: a viewport of one pixel, clipped at ±32768 pixels.
    pub const WIDEST: Self = Self(65536.0);

    /// The widest band that is not wider than `factor`. For a guard band of ±32768 pixels about the
    /// centre of a viewport, the factor is 65536 divided by its extent in pixels.
    ///
    /// `None` if `factor` is below 1 or NaN: clipping inside the view would cut
    /// off what is visible.
    #[must_use]
    pub fn at_most(factor: f32) -> Option<Self> {
        if factor >= Self::WIDEST.0 {
            return Some(Self::WIDEST);
        }
        // Without its fraction bits a number is the power of two below it.
        (factor >= 1.0).then(|| Self(f32::from_bits(factor.to_bits() & f32::INFINITY.to_bits())))
    }

    /// The factor.
    #[must_use]
    pub fn factor(self) -> f32 {
        self.0
    }
}

/// A half-space of clip space. It is closed: its boundary belongs to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace(Kind);

/// In the order in which they clip.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    MinimalW(f32),
    Near,
    Far,
    Left(Band),
    Right(Band),
    Bottom(Band),
    Top(Band),
}

impl HalfSpace {
    /// `z <= w`: beyond the near plane (depth is reversed).
    pub const NEAR: Self = Self(Kind::Near);
    /// `z >= 0`: in front of the far plane.
    pub const FAR: Self = Self(Kind::Far);

    /// `w >= minimum`: in front of the eye.
    ///
    /// `None` unless the minimum is a normal, positive, finite number.
    #[must_use]
    pub fn w_at_least(minimum: f32) -> Option<Self> {
        (minimum.is_normal() && minimum.is_sign_positive()).then_some(Self(Kind::MinimalW(minimum)))
    }

    /// `x >= -band·w`
    #[must_use]
    pub const fn left(band: Band) -> Self {
        Self(Kind::Left(band))
    }

    /// `x <= band·w`
    #[must_use]
    pub const fn right(band: Band) -> Self {
        Self(Kind::Right(band))
    }

    /// `y >= -band·w`
    #[must_use]
    pub const fn bottom(band: Band) -> Self {
        Self(Kind::Bottom(band))
    }

    /// `y <= band·w`
    #[must_use]
    pub const fn top(band: Band) -> Self {
        Self(Kind::Top(band))
    }

    /// Whether a position is inside or on the boundary, exactly. NaN is outside if the half-space
    /// depends on it.
    #[must_use]
    pub fn contains(self, position: Vec4) -> bool {
        self.distance(position.to_array().map(f64::from)) >= 0.0
    }

    /// The index in the clipping order, below [`HalfSpace::COUNT`].
    pub(super) fn order(self) -> usize {
        match self.0 {
            Kind::MinimalW(_) => 0,
            Kind::Near => 1,
            Kind::Far => 2,
            Kind::Left(_) => 3,
            Kind::Right(_) => 4,
            Kind::Bottom(_) => 5,
            Kind::Top(_) => 6,
        }
    }

    /// The number of kinds.
    pub(super) const COUNT: usize = 7;

    /// Positive inside, zero on the border, negative outside: the sign is
    /// exact, the value correctly rounded.
    pub(super) fn distance(self, [x, y, z, w]: [f64; 4]) -> f64 {
        match self.0 {
            Kind::MinimalW(minimum) => w - f64::from(minimum),
            Kind::Near => w - z,
            Kind::Far => z,
            Kind::Left(band) => band.times(w) + x,
            Kind::Right(band) => band.times(w) - x,
            Kind::Bottom(band) => band.times(w) + y,
            Kind::Top(band) => band.times(w) - y,
        }
    }

    /// Sets the coordinate that the boundary fixes, so that the distance is zero.
    pub(super) fn land(self, position: &mut [f64; 4]) {
        let [x, y, z, w] = position;
        match self.0 {
            Kind::MinimalW(minimum) => *w = f64::from(minimum),
            Kind::Near => *z = *w,
            Kind::Far => *z = 0.0,
            Kind::Left(band) => *x = -band.times(*w),
            Kind::Right(band) => *x = band.times(*w),
            Kind::Bottom(band) => *y = -band.times(*w),
            Kind::Top(band) => *y = band.times(*w),
        }
    }
}

impl Band {
    /// Exact: the factor is a power of two.
    fn times(self, w: f64) -> f64 {
        f64::from(self.0) * w
    }
}
