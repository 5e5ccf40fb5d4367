//! The cross-section of a bevel: points on a superellipse.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, LN_2};

use trigon_math::{DVec2, elementary};

/// Below this profile the curve cannot be told from its two tangents any more.
const LEAST: f64 = 1e-6;

/// Points at even distances on `x^r + y^r = 1` from (1, 0) to (0, 1).
///
/// Where the two rims of a bevel are at (1, 0) and (0, 1), the edge that it replaces is at (1, 1).
#[derive(Debug, Clone)]
pub(super) struct Profile {
    points: Vec<DVec2>,
    exponent: f64,
}

impl Profile {
    /// With `r = -2 ln 2 / ln p` the middle of the curve is at (√p, √p): 0.25 is a line, 0.5 a
    /// circle, 1 the old edge; less than 0.25 is hollow.
    pub(super) fn new(segments: usize, profile: f64) -> Self {
        let exponent =
            if profile >= 1.0 { f64::INFINITY } else { -2.0 * LN_2 / elementary::ln(profile.max(LEAST)) };
        let curve = Curve { exponent };
        let mut points: Vec<DVec2> = if profile == 0.5 {
            (0..=segments).map(|i| circle(i as f64 / segments as f64)).collect()
        } else if profile == 0.25 {
            (0..=segments).map(|i| line(i as f64 / segments as f64)).collect()
        } else {
            curve.even_points(segments)
        };
        // Exactly the same from both ends.
        for i in 0..segments.div_ceil(2) {
            points[segments - i] = DVec2::new(points[i].y, points[i].x);
        }
        if segments.is_multiple_of(2) {
            let middle = &mut points[segments / 2];
            middle.y = middle.x;
        }
        Self { points, exponent }
    }

    pub(super) fn segments(&self) -> usize {
        self.points.len() - 1
    }

    pub(super) fn point(&self, i: usize) -> DVec2 {
        self.points[i]
    }

    /// By what to divide coordinates of which none is larger than 1 and one is 1, so that they lie
    /// on the surface on which the sum of their powers is 1.
    pub(super) fn norm(&self, coordinates: impl Iterator<Item = f64>) -> f64 {
        if self.exponent == f64::INFINITY {
            return 1.0;
        }
        if self.exponent == 2.0 {
            return coordinates.map(|x| x * x).sum::<f64>().sqrt();
        }
        let sum: f64 = coordinates.map(|x| elementary::pow(x, self.exponent)).sum();
        elementary::pow(sum, 1.0 / self.exponent)
    }
}

fn circle(part: f64) -> DVec2 {
    let (sin, cos) = elementary::sin_cos(part * FRAC_PI_2);
    DVec2::new(cos, sin)
}

fn line(part: f64) -> DVec2 {
    DVec2::new(1.0 - part, part)
}

struct Curve {
    exponent: f64,
}

impl Curve {
    /// How finely the length of the half curve is measured.
    const SAMPLES: usize = 512;

    /// The point at a part of the half curve from (1, 0) to its middle. Equal parts are not of
    /// equal length.
    fn at(&self, part: f64) -> DVec2 {
        let r = self.exponent;
        if r == f64::INFINITY {
            return DVec2::new(1.0, part);
        }
        if r < 1.0 {
            let power = |base: f64| elementary::pow(base, 1.0 / r);
            return DVec2::new(power(1.0 - 0.5 * part), power(0.5 * part));
        }
        // By direction; with the ratio of sides no power overflows.
        let ratio = elementary::tan(part * FRAC_PI_4);
        let x = elementary::pow(1.0 + elementary::pow(ratio, r), -1.0 / r);
        DVec2::new(x, x * ratio)
    }

    /// Points of which the first half divides the half curve evenly; the others are for the caller.
    fn even_points(&self, segments: usize) -> Vec<DVec2> {
        let sample = |i: usize| self.at(i as f64 / Self::SAMPLES as f64);
        let mut lengths = vec![0.0];
        for i in 0..Self::SAMPLES {
            lengths.push(lengths[i] + sample(i).distance(sample(i + 1)));
        }
        let step = 2.0 * lengths[Self::SAMPLES] / segments as f64;
        let mut points = vec![DVec2::ZERO; segments + 1];
        for (i, point) in points.iter_mut().enumerate().take(segments / 2 + 1) {
            let wanted = step * i as f64;
            let after = lengths.partition_point(|&length| length < wanted).clamp(1, Self::SAMPLES);
            let (low, high) = (lengths[after - 1], lengths[after]);
            let within = if high > low { ((wanted - low) / (high - low)).clamp(0.0, 1.0) } else { 0.0 };
            *point = self.at(((after - 1) as f64 + within) / Self::SAMPLES as f64);
        }
        points
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_lie_evenly_on_the_superellipse_and_the_same_from_both_ends() {
        for profile in [0.0, 0.1, 0.25, 0.4, 0.5, 0.7, 0.95, 1.0] {
            for segments in [1, 2, 3, 8, 15] {
                let points = Profile::new(segments, profile).points;
                assert_eq!(points[0], DVec2::new(1.0, 0.0), "the first rim");
                for (one, other) in points.iter().zip(points.iter().rev()) {
                    assert_eq!((one.x, one.y), (other.y, other.x), "profile {profile}, {segments} segments");
                }
                let middle = profile.max(LEAST).sqrt();
                if segments % 2 == 0 {
                    let at = points[segments / 2].x;
                    assert!((at - middle).abs() < 1e-9, "profile {profile}: {at}, rounded f64");
                }
                if (0.3..0.9).contains(&profile) && segments > 4 {
                    let lengths: Vec<f64> = points.windows(2).map(|pair| pair[0].distance(pair[1])).collect();
                    let mean = lengths.iter().sum::<f64>() / segments as f64;
                    // Chords of equal arcs differ where the curve bends.
                    assert!(lengths.iter().all(|length| (length / mean - 1.0).abs() < 0.05), "{lengths:?}");
                }
            }
        }
    }
}
