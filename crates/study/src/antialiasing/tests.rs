//! What the report claims of anti-aliasing.

use super::*;
use crate::oracle::area;
use num_traits::ToPrimitive;

#[test]
fn the_analytic_area_is_that_of_rational_numbers() {
    let star = Star::new(24);
    let found = exact(&star);
    for y in (0..24).step_by(3) {
        for x in 0..24 {
            let sum: f64 = star
                .triangles
                .iter()
                .map(|&triangle| area::in_pixel(triangle, [x, y]).to_f64().unwrap())
                .sum();
            let found = found[[x as usize, y as usize]];
            // Points of the polygon are rounded by a few 2⁻⁵³ times the needle's size over
            // the pixel's, 12, and again over its width.
            assert!((found - sum).abs() < 1e-11, "at {x}, {y}: {found} instead of {sum}");
        }
    }
}

#[test]
fn every_doubling_of_samples_brings_edges_nearer() {
    let star = Star::new(128);
    let exact = exact(&star);
    let errors = [1, 2, 4, 8, 16].map(|samples| AntiAliasing::Samples(samples).error(&star, &exact).rmse());
    assert!(errors.is_sorted_by(|more, less| *less < 0.85 * *more), "{errors:?}");
}

/// The standard places help edges that are nearly upright or level; over all directions a
/// grid of two by two is as near, but is shaded four times.
#[test]
fn four_samples_are_as_good_at_standard_places_as_two_by_two() {
    let star = Star::new(128);
    let exact = exact(&star);
    let [standard, grid] =
        [AntiAliasing::Samples(4), AntiAliasing::Finer(2)].map(|way| way.error(&star, &exact).rmse());
    assert!((0.8..1.25).contains(&(standard / grid)), "{standard} and {grid}");
}
