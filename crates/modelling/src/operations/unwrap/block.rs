//! Entries of sparse matrices: linear maps of the plane.

use std::ops::{AddAssign, SubAssign};

use trigon_math::{DMat2, DVec2};

use super::factor::{conjugate, times};

/// What the entries of a matrix are: linear maps of the plane.
pub(super) trait Block: Copy + AddAssign + SubAssign {
    /// The map of all points to the origin.
    const NOTHING: Self;
    /// `self` after `before`.
    fn product(self, before: Self) -> Self;
    /// The image of a point.
    fn apply(self, point: DVec2) -> DVec2;
    /// The transposed conjugate.
    fn adjoint(self) -> Self;
    /// For a Hermitian block: the inverse L⁻¹ of its factor L Lᴴ. `None` if it is not positive definite, but for
    /// rounding that is relative to `whole`, of which it is what elimination left.
    fn inverse_factor(self, whole: Self) -> Option<Self>;
}

/// What is less than this part of a diagonal is rounding.
const LEAST_PIVOT: f64 = 1e-15;

/// 1 / √`pivot`.
fn inverse_root(pivot: f64, whole: f64) -> Option<f64> {
    (pivot > LEAST_PIVOT * whole && pivot > 0.0).then(|| 1.0 / pivot.sqrt())
}

/// A complex number.
impl Block for DVec2 {
    const NOTHING: Self = DVec2::ZERO;

    fn product(self, before: Self) -> Self {
        times(self, before)
    }

    fn apply(self, point: DVec2) -> DVec2 {
        times(self, point)
    }

    fn adjoint(self) -> Self {
        conjugate(self)
    }

    fn inverse_factor(self, whole: Self) -> Option<Self> {
        Some(DVec2::new(inverse_root(self.x, whole.x)?, 0.0))
    }
}

/// Two rows of real numbers.
impl Block for DMat2 {
    const NOTHING: Self = DMat2::ZERO;

    fn product(self, before: Self) -> Self {
        self * before
    }

    fn apply(self, point: DVec2) -> DVec2 {
        self * point
    }

    fn adjoint(self) -> Self {
        self.transpose()
    }

    fn inverse_factor(self, whole: Self) -> Option<Self> {
        let first = inverse_root(self.x_axis.x, whole.x_axis.x)?;
        let below = self.x_axis.y * first;
        let second = inverse_root(self.y_axis.y - below * below, whole.y_axis.y)?;
        Some(DMat2::from_cols(DVec2::new(first, -below * first * second), DVec2::new(0.0, second)))
    }
}
