//! Directions in space: unit vectors, angles between vectors, and what a linear map does to directions.

use std::f64::consts::PI;

use glam::{DMat3, DVec3, Vec3};

/// The direction of a vector, or zero if the vector has none: its length is zero or not finite.
#[must_use]
#[inline]
pub fn unit_or_zero(vector: DVec3) -> DVec3 {
    let length = vector.length();
    if length > 0.0 && length.is_finite() { vector / length } else { DVec3::ZERO }
}

/// The vector, or `other` if the vector is zero.
#[must_use]
#[inline]
pub fn or_if_zero(vector: Vec3, other: Vec3) -> Vec3 {
    if vector == Vec3::ZERO { other } else { vector }
}

/// acos(x) / √(1 − x) for x from 0 to 1, by powers of x: within 2·10⁻⁸
/// (M. Abramowitz and I. Stegun, "Handbook of Mathematical Functions", 1964,
/// 4.4.46).
const ARC_COSINE: [f64; 8] = [
    1.570_796_305_0,
    -0.214_598_801_6,
    0.088_978_987_4,
    -0.050_174_304_6,
    0.030_891_881_0,
    -0.017_088_125_6,
    0.006_670_090_1,
    -0.001_262_491_1,
];

/// The angle between two vectors in radians, 0 if one of them is zero. Within
/// 10⁻⁷ away from 0 and π, which is plenty for a weight, and several times
/// faster than the exact one.
///
/// ```
/// use trigon_math::{DVec3, angle};
///
/// let right = angle(DVec3::X * 3.0, DVec3::Y);
/// assert!((right - std::f64::consts::FRAC_PI_2).abs() < 1e-7);
/// ```
#[must_use]
#[inline]
pub fn angle(a: DVec3, b: DVec3) -> f64 {
    let squares = a.length_squared() * b.length_squared();
    if squares <= 0.0 {
        return 0.0;
    }
    let cosine = a.dot(b) / squares.sqrt();
    let size = cosine.abs();
    // No number counts as 1, too.
    let x = if size < 1.0 { size } else { 1.0 };
    let series = ARC_COSINE.iter().rev().fold(0.0, |series, factor| series * x + factor);
    let acute = (1.0 - x).sqrt() * series;
    if cosine < 0.0 { PI - acute } else { acute }
}

/// The matrix of cofactors: determinant times inverse transpose, but defined
/// without an inverse. It maps area vectors.
#[must_use]
pub fn cofactors(matrix: &DMat3) -> DMat3 {
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y))
}

/// A direction after a linear map, as a unit vector; zero if the map leaves none of it.
#[must_use]
#[inline]
pub fn transformed_direction(matrix: &DMat3, direction: Vec3) -> Vec3 {
    unit_or_zero(*matrix * direction.as_dvec3()).as_vec3()
}

/// What is to be added to a transformed direction, which becomes a unit vector,
/// so that the sum points where the transformed sum did.
#[must_use]
#[inline]
pub fn transformed_delta(matrix: &DMat3, base: Vec3, delta: Vec3) -> Vec3 {
    let length = (*matrix * base.as_dvec3()).length();
    let scale = if length > 0.0 && length.is_finite() { 1.0 / length } else { 1.0 };
    (*matrix * delta.as_dvec3() * scale).as_vec3()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elementary;

    #[test]
    fn angles_are_as_close_as_they_say() {
        for step in 0..=1000 {
            let exact = PI * f64::from(step) / 1000.0;
            let (sin, cos) = elementary::sin_cos(exact);
            let found = angle(DVec3::X * 3.0, DVec3::new(cos, sin, 0.0) * 0.1);
            assert!((found - exact).abs() < 1e-7, "{found} for {exact}");
        }
        assert_eq!(angle(DVec3::ZERO, DVec3::X), 0.0, "no direction, no weight");
    }

    #[test]
    fn what_has_no_direction_has_no_unit_vector() {
        assert_eq!(unit_or_zero(DVec3::Y * -2.0), DVec3::NEG_Y, "of length one");
        for vector in [DVec3::ZERO, DVec3::splat(f64::NAN), DVec3::INFINITY, DVec3::splat(1e300)] {
            assert_eq!(unit_or_zero(vector), DVec3::ZERO, "no direction: {vector}");
        }
    }

    #[test]
    fn cofactors_map_area_vectors() {
        let map = DMat3::from_cols(DVec3::new(2.0, 1.0, 0.0), DVec3::new(0.0, -1.0, 3.0), DVec3::ONE);
        let (a, b) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(-1.0, 0.5, 2.0));
        assert_eq!(cofactors(&map) * a.cross(b), (map * a).cross(map * b), "small whole numbers and halves");
    }

    #[test]
    fn a_transformed_delta_leads_where_the_transformed_sum_points() {
        let map = DMat3::from_diagonal(DVec3::new(4.0, 1.0, 2.0));
        let (base, delta) = (Vec3::new(0.6, 0.8, 0.0), Vec3::new(0.0, 0.0, 0.5));
        let sum = transformed_direction(&map, base) + transformed_delta(&map, base, delta);
        let expected = transformed_direction(&map, base + delta);
        assert!(sum.normalize().distance(expected) < 1e-6, "{sum} points elsewhere than {expected}");
    }
}
