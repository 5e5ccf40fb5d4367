//! The error of an image relative to the exact one, separated by cause.

use super::{Exact, Pixel};
use crate::workloads::Scene;
use trigon_math::DVec3;

/// What is wrong with an image. Differences of colours are of 255.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// The root of the mean square against the mean light of each pixel that shows any surface.
    pub image: f64,
    /// What can be said of images with one sample a pixel, at its centre.
    pub centres: Option<Centres>,
}

/// Errors at the centres of pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Centres {
    /// Of a thousand pixels where surfaces meet: those that show another surface than the right one.
    pub wrong_at_outlines: f64,
    /// Of a million other pixels: those that show a hole; in flat colours also those that show another surface, which cannot
    /// be light there.
    pub wrong_within: f64,
    /// The root of the mean square within surfaces, without those.
    pub within: f64,
    /// The greatest difference there.
    pub worst_within: f64,
}

impl Errors {
    /// Of an image of the same size. `is_flat` tells that each surface has one colour.
    #[must_use]
    pub fn new(exact: &Exact, image: &[[u8; 4]], is_centred: bool, is_flat: bool) -> Self {
        let touched = exact.pixels.iter().zip(image).filter(|(pixel, _)| pixel.is_touched);
        let squares: Vec<f64> =
            touched.map(|(pixel, found)| (pixel.mean * 255.0 - color(*found)).length_squared()).collect();
        Self { image: root_mean(&squares), centres: is_centred.then(|| Centres::new(exact, image, is_flat)) }
    }
}

impl Centres {
    fn new(exact: &Exact, image: &[[u8; 4]], is_flat: bool) -> Self {
        let [mut outlines, mut wrong, mut inside, mut holes] = [0_u32; 4];
        let (mut squares, mut worst) = (Vec::new(), 0.0_f64);
        for (index, pixel) in exact.pixels.iter().enumerate() {
            let found = color(image[index]);
            let others: Vec<&Pixel> =
                exact.neighbours(index).filter(|other| is_other(pixel, other)).collect();
            if !others.is_empty() {
                outlines += 1;
                wrong += u32::from(shows_another(found, pixel, &others));
            } else if pixel.surface > 0 {
                let difference = (pixel.color * 255.0 - found).abs();
                inside += 1;
                let differs = is_flat && difference.max_element() > 0.5;
                if image[index] == Scene::BACKGROUND || differs {
                    holes += 1;
                } else {
                    squares.push(difference.length_squared());
                    worst = worst.max(difference.max_element());
                }
            }
        }
        Self {
            wrong_at_outlines: 1e3 * f64::from(wrong) / f64::from(outlines.max(1)),
            wrong_within: 1e6 * f64::from(holes) / f64::from(inside.max(1)),
            within: root_mean(&squares),
            worst_within: worst,
        }
    }
}

impl Exact {
    /// The pixels around one, up to eight.
    fn neighbours(&self, index: usize) -> impl Iterator<Item = &Pixel> {
        let [x, y] = [index % self.width, index / self.width];
        let rows = y.saturating_sub(1)..(y + 2).min(self.pixels.len() / self.width);
        let columns = x.saturating_sub(1)..(x + 2).min(self.width);
        rows.flat_map(move |row| columns.clone().map(move |column| &self.pixels[row * self.width + column]))
    }
}

/// Whether two pixels beside each other show different surfaces. One is another where it hides itself, too: no slope of the
/// workloads' surfaces, seen from where they are, takes a fiftieth of the distance in a pixel.
fn is_other(one: &Pixel, other: &Pixel) -> bool {
    const STEP: f64 = 0.02;
    one.surface != other.surface
        || (one.nearness - other.nearness).abs() > STEP * one.nearness.max(other.nearness)
}

/// Whether a colour is nearer to that of a neighbour on another surface than to the right one, and more than a rounding from
/// the latter.
fn shows_another(found: DVec3, pixel: &Pixel, others: &[&Pixel]) -> bool {
    const ROUNDING: f64 = 2.0;
    let from = |other: &Pixel| (other.color * 255.0 - found).length();
    from(pixel) > ROUNDING && others.iter().any(|other| from(other) < from(pixel))
}

fn color([r, g, b, _]: [u8; 4]) -> DVec3 {
    DVec3::new(f64::from(r), f64::from(g), f64::from(b))
}

/// Of sums of squares over three channels.
fn root_mean(squares: &[f64]) -> f64 {
    (squares.iter().sum::<f64>() / (3 * squares.len()).max(1) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A row of pixels: a surface, its distance and its light.
    fn exact(pixels: &[(u32, f64, f64)]) -> Exact {
        let pixel = |&(surface, distance, light): &(u32, f64, f64)| Pixel {
            color: DVec3::splat(light),
            surface,
            nearness: if surface == 0 { 0.0 } else { 1.0 / distance },
            mean: DVec3::splat(light),
            is_touched: surface != 0,
        };
        Exact { pixels: pixels.iter().map(pixel).collect(), width: pixels.len() }
    }

    fn grey(level: u8) -> [u8; 4] {
        [level, level, level, 255]
    }

    /// Three pixels of one surface between others: the middle one has no outline beside it.
    fn image() -> Exact {
        exact(&[(0, 0.0, 0.0), (1, 2.0, 0.2), (1, 2.0, 0.2), (1, 2.0, 0.2), (2, 2.0, 0.6)])
    }

    #[test]
    fn what_is_right_is_not_wrong() {
        let found = [0, 51, 51, 51, 153].map(grey);
        let Errors { image, centres } = Errors::new(&image(), &found, true, true);
        assert!(image < 1e-9, "{image}");
        let Centres { wrong_at_outlines, wrong_within, within, worst_within } = centres.expect("asked for");
        assert_eq!((wrong_at_outlines, wrong_within), (0.0, 0.0));
        assert!(within < 1e-9 && worst_within < 1e-9);
        assert_eq!(Errors::new(&self::image(), &found, false, true).centres, None, "not asked for");
    }

    #[test]
    fn a_neighbours_colour_is_wrong_at_an_outline() {
        // The fourth pixel shows the fifth's surface; four pixels lie at outlines.
        let found = [0, 51, 51, 153, 153].map(grey);
        let centres = Errors::new(&image(), &found, true, true).centres.expect("asked for");
        assert_eq!((centres.wrong_at_outlines, centres.wrong_within), (250.0, 0.0));
        let nearly = [0, 51, 51, 53, 153].map(grey);
        let centres = Errors::new(&image(), &nearly, true, true).centres.expect("asked for");
        assert_eq!(centres.wrong_at_outlines, 0.0, "nearer to its own");
    }

    #[test]
    fn within_a_surface_light_may_be_off() {
        let found = [0, 51, 55, 51, 153].map(grey);
        let centres = Errors::new(&image(), &found, true, false).centres.expect("asked for");
        assert_eq!((centres.wrong_at_outlines, centres.wrong_within), (0.0, 0.0));
        assert!((centres.within - 4.0).abs() < 1e-9 && (centres.worst_within - 4.0).abs() < 1e-9);
        let flat = Errors::new(&image(), &found, true, true).centres.expect("asked for");
        assert_eq!(flat.wrong_within, 1e6, "but not where the surface has one colour");
        let mut hole = found;
        hole[2] = Scene::BACKGROUND;
        let centres = Errors::new(&image(), &hole, true, false).centres.expect("asked for");
        assert_eq!((centres.wrong_within, centres.within), (1e6, 0.0), "a hole is no light");
    }

    #[test]
    fn pixels_that_show_a_surface_count() {
        // Of four pixels one is off by 8.
        let found = [99, 51, 51, 59, 153].map(grey);
        let error = Errors::new(&image(), &found, false, false).image;
        assert!((error - 4.0).abs() < 1e-9, "{error}: the background does not count");
    }

    #[test]
    fn neighbours_are_the_eight_around_a_pixel() {
        let nine = Exact {
            pixels: (0..12).map(|surface| Pixel { surface, ..Pixel::default() }).collect(),
            width: 4,
        };
        let around =
            |index: usize| -> Vec<u32> { nine.neighbours(index).map(|pixel| pixel.surface).collect() };
        assert_eq!(around(0), [0, 1, 4, 5], "with itself");
        assert_eq!(around(5), [0, 1, 2, 4, 5, 6, 8, 9, 10]);
        assert_eq!(around(7), [2, 3, 6, 7, 10, 11]);
        assert_eq!(around(11), [6, 7, 10, 11]);
    }

    #[test]
    fn a_surface_that_hides_itself_is_another() {
        let at = |distance: f64| Pixel { surface: 1, nearness: 1.0 / distance, ..Pixel::default() };
        assert!(!is_other(&at(100.0), &at(101.0)) && !is_other(&at(101.0), &at(100.0)), "a slope");
        assert!(is_other(&at(100.0), &at(103.0)) && is_other(&at(103.0), &at(100.0)), "a step");
        assert!(is_other(&at(1.0), &Pixel { surface: 2, ..at(1.0) }), "another number");
    }
}
