//! On which side of a plane a point is, without rounding.
//!
//! The sum of products is computed in parts that do not overlap (J. R. Shewchuk, "Adaptive Precision Floating-Point
//! Arithmetic and Fast Robust Geometric Predicates", 1997): their signs are exact.

use std::cmp::Ordering;

use trigon_math::DVec3;

/// The sign of `normal · (point - on)`: greater where the normal points to. Exact for numbers whose products are in range;
/// NaN counts as equal.
pub(super) fn side_of(normal: DVec3, on: DVec3, point: DVec3) -> Ordering {
    let value = normal.dot(point - on);
    // Three differences, products and sums, each rounded once.
    let bound = 8.0 * f64::EPSILON * normal.abs().dot(point.abs() + on.abs());
    if value > bound {
        Ordering::Greater
    } else if value < -bound {
        Ordering::Less
    } else if value.is_finite() {
        exact(normal, on, point)
    } else {
        Ordering::Equal
    }
}

fn exact(normal: DVec3, on: DVec3, point: DVec3) -> Ordering {
    let mut sum = Expansion::default();
    for axis in 0..3 {
        sum.add_product(normal[axis], point[axis]);
        sum.add_product(-normal[axis], on[axis]);
    }
    sum.sign()
}

/// A number as the sum of parts, the smallest first, which do not overlap.
#[derive(Default)]
struct Expansion {
    parts: [f64; 12],
    count: usize,
}

impl Expansion {
    fn add_product(&mut self, a: f64, b: f64) {
        let product = a * b;
        let ([high_a, low_a], [high_b, low_b]) = (halves(a), halves(b));
        // T. Dekker, 1971: what the product lost by rounding.
        let rest = low_a * low_b - (((product - high_a * high_b) - low_a * high_b) - high_a * low_b);
        self.add(rest);
        self.add(product);
    }

    fn add(&mut self, value: f64) {
        let mut carry = value;
        for part in &mut self.parts[..self.count] {
            let sum = carry + *part;
            let from_part = sum - carry;
            *part = (carry - (sum - from_part)) + (*part - from_part);
            carry = sum;
        }
        self.parts[self.count] = carry;
        self.count += 1;
    }

    /// That of the greatest part that is not zero.
    fn sign(&self) -> Ordering {
        let largest = self.parts[..self.count].iter().rev().find(|&&part| part != 0.0);
        largest.and_then(|part| part.partial_cmp(&0.0)).unwrap_or(Ordering::Equal)
    }
}

/// Two numbers of half the digits with this sum.
fn halves(value: f64) -> [f64; 2] {
    const SPLITTER: f64 = 134_217_729.0;
    let scaled = SPLITTER * value;
    let high = scaled - (scaled - value);
    [high, value - high]
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// The same in integers: coordinates are multiples of 2⁻²⁰.
    fn expected(normal: [i32; 3], on: [i32; 3], point: [i32; 3]) -> Ordering {
        let sum: i128 = (0..3)
            .map(|axis| i128::from(normal[axis]) * (i128::from(point[axis]) - i128::from(on[axis])))
            .sum();
        sum.cmp(&0)
    }

    proptest! {
        #[test]
        fn the_side_is_that_of_exact_numbers(
            normal in prop::array::uniform3(any::<i32>()),
            on in prop::array::uniform3(any::<i32>()),
            steps in prop::array::uniform2(-3i32..4),
            nudge in prop::array::uniform3(-1i32..2),
        ) {
            // On the plane, or nearly: along two directions across the normal, in integers.
            let [a, b, c] = normal.map(|value| value >> 20);
            let normal = [a, b, c];
            let point: [i32; 3] = std::array::from_fn(|axis| {
                let along = [[b, -a, 0], [0, c, -b]];
                (on[axis] >> 2) + steps[0] * along[0][axis] + steps[1] * along[1][axis] + nudge[axis]
            });
            let on = on.map(|value| value >> 2);
            let vector = |values: [i32; 3]| DVec3::from(values.map(f64::from)) / f64::from(1 << 20);
            prop_assert_eq!(side_of(vector(normal), vector(on), vector(point)), expected(normal, on, point));
        }
    }

    #[test]
    fn rounding_hides_no_side() {
        // A tenth is not exact: three times it is more than 0.3.
        let normal = DVec3::new(0.1, 0.1, 0.1);
        let tiny = f64::EPSILON / 2.0;
        assert_eq!(side_of(normal, DVec3::splat(1.0), DVec3::new(1.0 - tiny, 1.0, 1.0)), Ordering::Less);
        assert_eq!(
            side_of(normal, DVec3::splat(1e9), DVec3::new(1e9 - 1.0, 1e9 + 1.0, 1e9)),
            Ordering::Equal
        );
        assert_eq!(side_of(normal, DVec3::ZERO, DVec3::splat(f64::NAN)), Ordering::Equal);
    }
}
