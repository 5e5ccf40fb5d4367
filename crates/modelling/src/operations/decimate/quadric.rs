//! Sums of weighted squared distances from planes, as quadratic forms.
//!
//! M. Garland and P. Heckbert, "Surface Simplification Using Quadric Error Metrics", 1997.

use std::ops::AddAssign;

use trigon_math::DVec3;

/// The form `pᵀ A p + 2 b·p + c` of a point.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Quadric {
    /// The diagonal of A.
    square: DVec3,
    /// Of A: yz, zx, xy.
    mixed: DVec3,
    linear: DVec3,
    constant: f64,
    /// The sum of the planes' weights.
    pub(super) weight: f64,
}

impl Quadric {
    /// The squared distance from a plane, given by a point and its unit normal.
    pub(super) fn plane(point: DVec3, normal: DVec3, weight: f64) -> Self {
        Self { weight, ..Self::square_of(normal, -normal.dot(point), weight) }
    }

    /// The squared value of a linear function, without a weight of its own.
    pub(super) fn square_of(gradient: DVec3, constant: f64, factor: f64) -> Self {
        let scaled = gradient * factor;
        let DVec3 { x, y, z } = gradient;
        Self {
            square: gradient * scaled,
            mixed: DVec3::new(y * scaled.z, z * scaled.x, x * scaled.y),
            linear: scaled * constant,
            constant: constant * constant * factor,
            weight: 0.0,
        }
    }

    /// The value at a point; rounding can make it negative, then it is 0.
    pub(super) fn value(&self, point: DVec3) -> f64 {
        let DVec3 { x, y, z } = point;
        let turned = DVec3::new(y * z, z * x, x * y);
        let value = self.square.dot(point * point)
            + 2.0 * (self.mixed.dot(turned) + self.linear.dot(point))
            + self.constant;
        if value > 0.0 || value.is_nan() { value } else { 0.0 }
    }

    /// Where the value plus `pull` times the squared distance from a point is smallest. NaN where there is no such point.
    pub(super) fn lowest(&self, towards: DVec3, pull: f64) -> DVec3 {
        let DVec3 { x: a, y: b, z: c } = self.square + DVec3::splat(pull);
        let DVec3 { x: yz, y: zx, z: xy } = self.mixed;
        let right = towards * pull - self.linear;
        // Cramer's rule with the adjugate, which is symmetric.
        let (aa, bb, cc) = (b * c - yz * yz, a * c - zx * zx, a * b - xy * xy);
        let (ab, ac, bc) = (zx * yz - xy * c, xy * yz - zx * b, xy * zx - yz * a);
        let determinant = a * aa + xy * ab + zx * ac;
        DVec3::new(
            DVec3::new(aa, ab, ac).dot(right),
            DVec3::new(ab, bb, bc).dot(right),
            DVec3::new(ac, bc, cc).dot(right),
        ) / determinant
    }
}

impl AddAssign for Quadric {
    fn add_assign(&mut self, other: Self) {
        self.square += other.square;
        self.mixed += other.mixed;
        self.linear += other.linear;
        self.constant += other.constant;
        self.weight += other.weight;
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn vector() -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-1.0f64..1.0).prop_map(DVec3::from_array)
    }

    proptest! {
        /// Against the distances themselves, and against the values around the lowest point.
        #[test]
        fn a_sum_of_planes_is_that_of_their_squared_distances(
            planes in prop::collection::vec((vector(), vector(), 0.1f64..2.0), 1..8),
            at in vector(),
            step in vector(),
        ) {
            let mut sum = Quadric::default();
            let mut expected = 0.0;
            for (point, normal, weight) in planes {
                let Some(normal) = normal.try_normalize() else { continue };
                sum += Quadric::plane(point, normal, weight);
                expected += weight * normal.dot(at - point) * normal.dot(at - point);
            }
            prop_assert!((sum.value(at) - expected).abs() < 1e-12, "{} for {}", sum.value(at), expected);
            let lowest = sum.lowest(at, 0.1);
            let pulled = |point: DVec3| sum.value(point) + 0.1 * point.distance_squared(at);
            prop_assert!(pulled(lowest) <= pulled(lowest + step) + 1e-9);
        }
    }
}
