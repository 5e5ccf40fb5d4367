//! The difference between images, in linear light and in perceived lightness.

use trigon_math::elementary;

/// Differences of brightness, pixel by pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference {
    count: usize,
    squares: f64,
    lightness: f64,
    /// The greatest difference in linear light, white being 1.
    pub worst: f64,
}

impl Difference {
    /// Of pairs of found and correct values, in linear light, with white at 1.
    pub fn of(pairs: impl IntoIterator<Item = [f64; 2]>) -> Self {
        let mut difference = Self::default();
        for [found, right] in pairs {
            let error = (found - right).abs();
            difference.count += 1;
            difference.squares += error * error;
            difference.lightness += (lightness(found) - lightness(right)).abs();
            difference.worst = difference.worst.max(error);
        }
        difference
    }

    /// The root of the mean square in linear light.
    #[must_use]
    pub fn rmse(&self) -> f64 {
        (self.squares / self.count.max(1) as f64).sqrt()
    }

    /// The mean difference in lightness: ΔE of CIE 1976 for greys. Below about 1, few people can see it.
    #[must_use]
    pub fn delta_e(&self) -> f64 {
        self.lightness / self.count.max(1) as f64
    }
}

/// CIE 1976 lightness L*, 0 to 100, of linear light (CIE 15:2004, section 8.2.1).
#[must_use]
pub fn lightness(light: f64) -> f64 {
    const LINEAR_UP_TO: f64 = 216.0 / 24389.0;
    if light <= LINEAR_UP_TO {
        24389.0 / 27.0 * light.max(0.0)
    } else {
        116.0 * elementary::cbrt(light) - 16.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lightness_runs_from_black_to_white() {
        assert_eq!((lightness(0.0), lightness(1.0)), (0.0, 100.0), "the ends");
        // The grey card of photographers, 18 % of the light, is half as light as white.
        assert!((lightness(0.184) - 50.0).abs() < 0.1, "{}", lightness(0.184));
    }

    #[test]
    fn differences_are_summed_up() {
        let difference = Difference::of([[1.0, 1.0], [0.0, 1.0]]);
        assert_eq!((difference.worst, difference.delta_e()), (1.0, 50.0), "black instead of white once");
        assert_eq!(difference.rmse(), 0.5_f64.sqrt(), "in one of two pixels");
    }

    #[test]
    fn dark_light_is_linear_in_lightness() {
        // Up to 216/24389, where L* is 8.
        for (light, expected) in [(-1.0, 0.0), (216.0 / 24389.0, 8.0), (108.0 / 24389.0, 4.0)] {
            assert!((lightness(light) - expected).abs() < 1e-9, "{}", lightness(light));
        }
        assert!((lightness(8.0 / 27.0) - (116.0 * 2.0 / 3.0 - 16.0)).abs() < 1e-9, "then a cubic root");
        assert!((lightness(216.01 / 24389.0) - 8.0).abs() < 1e-3, "without a step");
    }

    #[test]
    fn means_are_over_all_pairs() {
        let difference = Difference::of([[0.5, 0.25], [0.25, 0.5], [0.0, 0.0], [0.5, 0.0]]);
        assert_eq!(difference.worst, 0.5);
        assert!((difference.rmse() - (0.375_f64 / 4.0).sqrt()).abs() < 1e-12, "either way");
        let [half, quarter] = [0.5, 0.25].map(lightness);
        let expected = (2.0 * (half - quarter) + half) / 4.0;
        assert!((difference.delta_e() - expected).abs() < 1e-12, "{}", difference.delta_e());
        let nothing = Difference::of([]);
        assert_eq!((nothing.rmse(), nothing.delta_e(), nothing.worst), (0.0, 0.0, 0.0));
    }
}
