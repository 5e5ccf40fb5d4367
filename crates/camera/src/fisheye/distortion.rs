//! The polynomial `d(θ)` of a fisheye lens as far as it increases, and its inverse.

use std::f64::consts::PI;

/// `d(θ) = θ (1 + k₁θ² + k₂θ⁴ + k₃θ⁶ + k₄θ⁸)`, from 0 to the lens's greatest angle, where it increases.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Distortion {
    coefficients: [f64; 4],
    greatest_angle: f64,
}

impl Distortion {
    /// Up to the first angle at which the polynomial ceases to increase, or 180°.
    pub(super) fn new(coefficients: [f64; 4]) -> Self {
        let [k1, k2, k3, k4] = coefficients;
        // The slope, in the square of the angle.
        let slope = [1.0, 3.0 * k1, 5.0 * k2, 7.0 * k3, 9.0 * k4];
        let end = first_root(&slope, PI * PI).map_or(PI, f64::sqrt);
        Self { coefficients, greatest_angle: end.min(PI) }
    }

    /// The same, ending at this angle at the latest.
    pub(super) fn up_to(self, angle: f64) -> Self {
        Self { greatest_angle: self.greatest_angle.min(angle), ..self }
    }

    pub(super) fn coefficients(&self) -> [f64; 4] {
        self.coefficients
    }

    pub(super) fn greatest_angle(&self) -> f64 {
        self.greatest_angle
    }

    /// `None` beyond the greatest angle.
    pub(super) fn distorted(&self, angle: f64) -> Option<f64> {
        (angle <= self.greatest_angle).then(|| self.value(angle)).filter(|radius| radius.is_finite())
    }

    fn value(&self, angle: f64) -> f64 {
        let [k1, k2, k3, k4] = self.coefficients;
        angle * value(&[1.0, k1, k2, k3, k4], angle * angle)
    }

    /// The derivative of `d`.
    pub(super) fn slope(&self, angle: f64) -> f64 {
        let [k1, k2, k3, k4] = self.coefficients;
        value(&[1.0, 3.0 * k1, 5.0 * k2, 7.0 * k3, 9.0 * k4], angle * angle)
    }

    /// The angle that is drawn at a radius; `None` beyond the greatest. Newton's method, bisecting where it would leave
    /// the bracket: it ends when a step is no more than 2⁻⁵⁰ of the angle, or no number lies within the bracket.
    pub(super) fn angle(&self, radius: f64) -> Option<f64> {
        /// More than bisection needs for all bits.
        const MOST_STEPS: usize = 128;
        const SMALL: f64 = 4.0 * f64::EPSILON;
        let (mut low, mut high) = (0.0, self.greatest_angle);
        if self.coefficients == [0.0; 4] {
            return (radius <= high).then_some(radius);
        }
        // Coefficients of any size may overflow.
        let rim = self.value(high);
        if radius.is_nan() || !rim.is_finite() || radius > rim {
            return None;
        }
        let mut angle = if radius < high { radius } else { 0.5 * high };
        for _ in 0..MOST_STEPS {
            let excess = self.value(angle) - radius;
            if excess > 0.0 {
                high = angle;
            } else {
                low = angle;
            }
            let newton = angle - excess / self.slope(angle);
            let next = if newton >= low && newton <= high { newton } else { low + 0.5 * (high - low) };
            let step = (next - angle).abs();
            angle = next;
            if step <= SMALL * angle {
                break;
            }
        }
        Some(angle)
    }
}

/// A polynomial by its coefficients, the constant one first.
fn value(coefficients: &[f64], at: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, coefficient| sum * at + coefficient)
}

/// The last number before a polynomial that is positive at 0 becomes negative, up to `end`; `None` if it does not.
fn first_root(coefficients: &[f64], end: f64) -> Option<f64> {
    let mut low = 0.0;
    for high in turning_points(coefficients, end).into_iter().chain([end]) {
        if value(coefficients, high) < 0.0 {
            return Some(bisected(coefficients, low, high));
        }
        low = high;
    }
    None
}

/// Where the slope of a polynomial changes its sign between 0 and `end`, ascending.
fn turning_points(coefficients: &[f64], end: f64) -> Vec<f64> {
    let slope: Vec<f64> =
        coefficients.iter().zip(0_u32..).skip(1).map(|(c, power)| c * f64::from(power)).collect();
    if slope.len() < 2 {
        return Vec::new();
    }
    // Between the slope's own turning points it changes its sign once at most.
    let mut bounds = turning_points(&slope, end);
    bounds.insert(0, 0.0);
    bounds.push(end);
    let changes = |pair: &&[f64]| (value(&slope, pair[0]) < 0.0) != (value(&slope, pair[1]) < 0.0);
    bounds.windows(2).filter(changes).map(|pair| bisected(&slope, pair[0], pair[1])).collect()
}

/// The last number at which a polynomial has the sign that it has at `low`, if it changes once up to `high`.
fn bisected(coefficients: &[f64], mut low: f64, mut high: f64) -> f64 {
    let is_negative = value(coefficients, low) < 0.0;
    loop {
        let middle = low + 0.5 * (high - low);
        if middle <= low || middle >= high {
            return low;
        }
        if (value(coefficients, middle) < 0.0) == is_negative { low = middle } else { high = middle }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lens_ends_where_it_would_fold_back() {
        // d = θ − θ³/3 has the slope 1 − θ², which is 0 at 1.
        let folded = Distortion::new([-1.0 / 3.0, 0.0, 0.0, 0.0]);
        assert!((folded.greatest_angle() - 1.0).abs() < 1e-15, "{}", folded.greatest_angle());
        assert_eq!(folded.distorted(1.0001), None, "beyond");
        assert_eq!(folded.angle(0.667), None, "d is at most 2/3");
        assert!(folded.angle(0.666).is_some_and(|angle| angle < 1.0), "within");
        assert_eq!(Distortion::new([0.0; 4]).greatest_angle(), PI, "an equidistant lens sees everything");
    }

    #[test]
    fn of_several_turns_the_first_counts() {
        // The slope is (1 − s)(1 − s/2)(1 − s/4), which is negative between 1 and 2 and above 4.
        let slope = [1.0, -1.75, 0.875, -0.125];
        let [_, a, b, c] = slope;
        let twice = Distortion::new([a / 3.0, b / 5.0, c / 7.0, 0.0]);
        assert!((twice.greatest_angle() - 1.0).abs() < 1e-12, "{}", twice.greatest_angle());
        // (1 − s)² touches 0 but does not become negative.
        let touching = Distortion::new([-2.0 / 3.0, 1.0 / 5.0, 0.0, 0.0]);
        assert!(touching.greatest_angle() >= 1.0, "{}", touching.greatest_angle());
    }
}
