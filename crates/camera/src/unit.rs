//! Directions of length 1.

use trigon_math::DVec3;

/// The vector with length 1, or `fallback` if it has no direction. Scaled first, so that lengths
/// beyond 1e154 or below 1e-154 neither overflow nor vanish.
pub(crate) fn unit_or(vector: DVec3, fallback: DVec3) -> DVec3 {
    let largest = vector.abs().max_element();
    if !vector.is_finite() || largest < f64::MIN_POSITIVE {
        return fallback;
    }
    (vector / largest).normalize()
}
