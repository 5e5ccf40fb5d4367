//! Points and directions in homogeneous coordinates.

use glam::{DVec3, DVec4};

/// `(x, y, z, w)`: the point `(x, y, z) / w`, or, with `w` = 0, the direction
/// `(x, y, z)`. All coordinates are finite and at least one is not zero.
///
/// ```
/// use trigon_math::{DVec3, DVec4, HomogeneousPoint};
///
/// let point = HomogeneousPoint::new(DVec4::new(2.0, 4.0, 6.0, 2.0)).unwrap();
/// assert_eq!(point.to_point(), Some(DVec3::new(1.0, 2.0, 3.0)));
/// let same = HomogeneousPoint::from_point(DVec3::new(1.0, 2.0, 3.0)).unwrap();
/// assert!(point.is_same_point(&same));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HomogeneousPoint(DVec4);

impl HomogeneousPoint {
    /// The point with these coordinates; `None` if all are zero or one is not
    /// finite.
    #[must_use]
    pub fn new(coordinates: DVec4) -> Option<Self> {
        (coordinates.is_finite() && coordinates != DVec4::ZERO).then_some(Self(coordinates))
    }

    /// A point of space, with `w` = 1; `None` if it is not finite.
    #[must_use]
    pub fn from_point(point: DVec3) -> Option<Self> {
        Self::new(point.extend(1.0))
    }

    /// A direction, with `w` = 0; `None` if it is zero or not finite.
    #[must_use]
    pub fn from_direction(direction: DVec3) -> Option<Self> {
        Self::new(direction.extend(0.0))
    }

    /// The coordinates.
    #[must_use]
    pub fn coordinates(&self) -> DVec4 {
        self.0
    }

    /// Whether this is a direction: `w` is zero.
    #[must_use]
    pub fn is_direction(&self) -> bool {
        self.0.w == 0.0
    }

    /// The length of a direction, or a point's distance from the origin.
    #[must_use]
    pub fn length(&self) -> f64 {
        let length = self.0.truncate().length();
        if self.is_direction() { length } else { length / self.0.w.abs() }
    }

    /// The same point with `w` = 1; `None` for a direction, and for a point too far away for `f64`.
    #[must_use]
    pub fn normalized(&self) -> Option<Self> {
        Self::from_point(self.to_point()?)
    }

    /// The point in space; `None` as in [`HomogeneousPoint::normalized`].
    #[must_use]
    pub fn to_point(&self) -> Option<DVec3> {
        // Division is correctly rounded; multiplying by 1/w would round twice.
        let point = self.0.truncate() / self.0.w;
        (!self.is_direction() && point.is_finite()).then_some(point)
    }

    /// Whether both represent the same point, or the same or opposite directions: all four
    /// coordinates are proportional. Exact.
    #[must_use]
    pub fn is_same_point(&self, other: &Self) -> bool {
        proportional(&self.0.to_array(), &other.0.to_array())
    }

    /// Whether the vectors `(x, y, z)` of both lie on one line through the
    /// origin. Exact. The zero vector is collinear with all.
    #[must_use]
    pub fn is_collinear(&self, other: &Self) -> bool {
        let [a, b] = [self, other].map(|point| point.0.truncate().to_array());
        proportional(&a, &b)
    }

    /// Whether both lie in the same direction from the origin: collinear and on
    /// the same side. Exact. A point's side follows from the sign of its `w`;
    /// the origin has no direction.
    #[must_use]
    pub fn is_same_direction(&self, other: &Self) -> bool {
        let with_positive_w = |point: &Self| if point.0.w < 0.0 { -point.0 } else { point.0 };
        let (a, b) = (with_positive_w(self).truncate(), with_positive_w(other).truncate());
        // Of collinear vectors all products of coordinates have the same sign.
        let same_side =
            (0..3).any(|axis| (a[axis] > 0.0 && b[axis] > 0.0) || (a[axis] < 0.0 && b[axis] < 0.0));
        same_side && self.is_collinear(other)
    }
}

/// Whether two vectors are multiples of one vector: every 2×2 minor is exactly zero.
fn proportional<const N: usize>(a: &[f64; N], b: &[f64; N]) -> bool {
    (0..N).all(|i| (0..i).all(|j| exact_product(a[i], b[j]) == exact_product(a[j], b[i])))
}

/// The product of two finite numbers without rounding, in a form in which equal values are equal:
/// sign, odd integer, and power of two. No product overflows, underflows or needs wider floats.
fn exact_product(a: f64, b: f64) -> (bool, u128, i32) {
    let ((a_integer, a_exponent), (b_integer, b_exponent)) = (decomposed(a), decomposed(b));
    let integer = u128::from(a_integer) * u128::from(b_integer);
    if integer == 0 {
        return (false, 0, 0);
    }
    let zeros = integer.trailing_zeros();
    let exponent = a_exponent + b_exponent + zeros as i32;
    let negative = a.is_sign_negative() != b.is_sign_negative();
    (negative, integer >> zeros, exponent)
}

/// The magnitude of a finite number as an integer and a power of two.
fn decomposed(value: f64) -> (u64, i32) {
    const FRACTION_BITS: u32 = f64::MANTISSA_DIGITS - 1;
    // The exponent of the last place of subnormal numbers.
    const LOWEST: i32 = f64::MIN_EXP - f64::MANTISSA_DIGITS as i32;
    let bits = value.abs().to_bits();
    let fraction = bits & ((1 << FRACTION_BITS) - 1);
    match (bits >> FRACTION_BITS) as i32 {
        0 => (fraction, LOWEST),
        biased => (fraction | 1 << FRACTION_BITS, LOWEST + biased - 1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_rational::BigRational;
    use num_traits::FromPrimitive;
    use proptest::prelude::*;

    fn point(x: f64, y: f64, z: f64, w: f64) -> HomogeneousPoint {
        HomogeneousPoint::new(DVec4::new(x, y, z, w)).unwrap()
    }

    /// Source row A10: `Point4d`.
    #[test]
    fn source_a10_points_and_directions() {
        let p = point(3.0, 0.0, 4.0, 2.0);
        assert_eq!(p.length(), 2.5, "a point's distance");
        assert_eq!(p.normalized(), Some(point(1.5, 0.0, 2.0, 1.0)), "w becomes 1");
        let d = HomogeneousPoint::from_direction(DVec3::new(3.0, 0.0, 4.0)).unwrap();
        assert_eq!(d.length(), 5.0, "a direction's length");
        assert_eq!(d.normalized(), None, "a direction has no w to divide by");
        assert!(d.is_direction() && !p.is_direction(), "told apart by w");
        assert_eq!(point(1e300, 0.0, 0.0, 1e-300).to_point(), None, "too far away");
    }

    #[test]
    fn what_is_no_point_is_none() {
        assert_eq!(HomogeneousPoint::new(DVec4::ZERO), None, "stands for nothing");
        assert_eq!(HomogeneousPoint::new(DVec4::NAN), None, "not finite");
        assert_eq!(HomogeneousPoint::from_direction(DVec3::ZERO), None, "no direction");
        assert_eq!(HomogeneousPoint::from_point(DVec3::INFINITY), None, "not finite");
    }

    #[test]
    fn sides_follow_w() {
        let (ahead, back) = (point(1.0, 2.0, 3.0, 1.0), point(1.0, 2.0, 3.0, -1.0));
        assert!(ahead.is_collinear(&back), "one line");
        assert!(!ahead.is_same_direction(&back), "opposite sides");
        assert!(ahead.is_same_direction(&point(2.0, 4.0, 6.0, 0.0)), "its direction");
        assert!(back.is_same_point(&point(-2.0, -4.0, -6.0, 2.0)), "any multiple");
        let origin = point(0.0, 0.0, 0.0, 1.0);
        assert!(origin.is_collinear(&ahead), "the origin is on every line");
        assert!(!origin.is_same_direction(&ahead), "and in no direction");
    }

    /// If products underflow, overflow or round, floats give wrong answers.
    #[test]
    fn proportions_are_exact_at_both_ends_of_the_range() {
        let tiny = f64::from_bits(1);
        let a = point(tiny, tiny, 0.0, 0.0);
        assert!(!a.is_collinear(&point(tiny, 2.0 * tiny, 0.0, 0.0)), "underflow");
        let b = point(f64::MAX, f64::MAX, 0.0, 0.0);
        assert!(!b.is_collinear(&point(f64::MAX, f64::MAX / 2.0, 0.0, 0.0)), "overflow");
        assert!(a.is_collinear(&b), "the diagonal, short and long");
        let c = point(1.0, 1.0 + f64::EPSILON, 0.0, 0.0);
        let d = point(1.0 - f64::EPSILON / 2.0, 1.0 + f64::EPSILON / 2.0, 0.0, 0.0);
        assert!(!c.is_collinear(&d), "rounding");
    }

    proptest! {
        #[test]
        fn exact_products_are_equal_iff_rationals_are(
            a in any::<f64>(), b in any::<f64>(), c in any::<f64>(), shift in -40..40_i32,
        ) {
            prop_assume!(a.is_finite() && b.is_finite() && c.is_finite());
            let rational = |x: f64, y: f64| {
                BigRational::from_f64(x).unwrap() * BigRational::from_f64(y).unwrap()
            };
            let factor = crate::elementary::exp2(f64::from(shift));
            for (x, y) in [(b, c), (a, b), (a * factor, b / factor)] {
                prop_assume!(x.is_finite() && y.is_finite());
                let equal = rational(a, b) == rational(x, y);
                prop_assert_eq!(exact_product(a, b) == exact_product(x, y), equal);
            }
        }
    }
}
