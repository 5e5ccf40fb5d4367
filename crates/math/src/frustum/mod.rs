//! The view volume, for culling.

use glam::{DMat4, DVec3, DVec4};

use crate::{Bounds3, Plane};

/// One of the six sides of a [`Frustum`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FrustumSide {
    /// `x = -w`
    Left,
    /// `x = w`
    Right,
    /// `y = -w`
    Bottom,
    /// `y = w`
    Top,
    /// `z = w`, as depth is reversed
    Near,
    /// `z = 0`; may lie at infinity
    Far,
}

impl FrustumSide {
    /// All sides.
    pub const ALL: [Self; 6] = [Self::Left, Self::Right, Self::Bottom, Self::Top, Self::Near, Self::Far];
}

/// The points that a clip matrix maps into the view volume: `x` and `y` in `[-w, w]`, `z` in `[0,
/// w]` (reversed-Z: `w` is near, `0` is far).
///
/// Its results are one-sided proofs: `true` from [`Frustum::contains`] and `false` from
/// [`Frustum::intersects`] hold for the given matrix in exact arithmetic. So culling never drops
/// anything visible, and contained boxes need no clipping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frustum {
    /// Inside where `dot(side, (p, 1)) >= 0`, in the order of
    /// [`FrustumSide::ALL`].
    sides: [DVec4; 6],
}

/// Bounds the relative rounding error of one side's value at one point, relative to the sum of its
/// terms' magnitudes: one rounding in the coefficient, one in the product and three in the sum are
/// below 6 units of 2⁻⁵³; this is 8 of them.
const RELATIVE_ERROR: f64 = 4.0 * f64::EPSILON;

impl Frustum {
    /// The frustum of a matrix that maps points to clip space. A matrix with an infinite far plane
    /// has a far side that contains everything.
    #[must_use]
    pub fn from_clip_matrix(matrix: &DMat4) -> Self {
        let [x, y, z, w] = [0, 1, 2, 3].map(|row| matrix.row(row));
        Self { sides: [w + x, w - x, w + y, w - y, w - z, z] }
    }

    /// The plane of a side, its normal pointing inwards; `None` if it lies at infinity.
    #[must_use]
    pub fn plane(&self, side: FrustumSide) -> Option<Plane> {
        let coefficients = self.sides[side as usize];
        Plane::from_equation(coefficients.truncate(), coefficients.w)
    }

    /// Whether the whole box is certainly inside. An empty box is.
    ///
    /// May return `false` for a box within rounding of a side, about 2⁻⁵⁰ of the magnitudes
    /// involved.
    #[must_use]
    pub fn contains(&self, bounds: &Bounds3) -> bool {
        bounds.is_empty()
            || self.sides.iter().all(|&side| {
                let least = corner_towards(bounds, -side.truncate());
                value(side, least) >= error(side, bounds)
            })
    }

    /// Whether some point of the box may be inside; `false` is a proof that
    /// none is. An empty box does not intersect.
    ///
    /// `true` may be wrong for a box that is outside but crosses the planes of several sides near
    /// an edge of the frustum, because only the six planes are tested. A box with NaN or infinite
    /// corners counts as visible.
    #[must_use]
    pub fn intersects(&self, bounds: &Bounds3) -> bool {
        !bounds.is_empty()
            && !self.sides.iter().any(|&side| {
                let most = corner_towards(bounds, side.truncate());
                value(side, most) < -error(side, bounds)
            })
    }
}

/// The corner that lies farthest in a direction.
fn corner_towards(bounds: &Bounds3, direction: DVec3) -> DVec3 {
    DVec3::select(direction.cmpgt(DVec3::ZERO), bounds.max, bounds.min)
}

fn value(side: DVec4, point: DVec3) -> f64 {
    side.x * point.x + side.y * point.y + side.z * point.z + side.w
}

/// The largest error of [`value`] anywhere in the box.
fn error(side: DVec4, bounds: &Bounds3) -> f64 {
    let (low, high) = (bounds.min.abs(), bounds.max.abs());
    let farthest = DVec3::select(low.cmpgt(high), low, high);
    // The smallest normal number covers products that underflow.
    RELATIVE_ERROR * value(side.abs(), farthest) + f64::MIN_POSITIVE
}

#[cfg(test)]
mod tests;
