//! How many samples does an edge need? A star of needles, compared with the exact area in each pixel.

mod analytic;
mod engine;
mod star;

#[cfg(test)]
mod tests;

pub use star::Star;

use crate::metric::Difference;
use trigon_classic::Field;

/// A method of anti-aliasing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum AntiAliasing {
    /// The engine with this many samples per pixel, at the standard positions.
    Samples(u32),
    /// The engine on a grid that is finer by this factor along both axes.
    Finer(u32),
    /// The exact area.
    Analytic,
}

impl AntiAliasing {
    /// All methods that are compared.
    pub const ALL: [Self; 9] = [
        Self::Samples(1),
        Self::Samples(2),
        Self::Samples(4),
        Self::Samples(8),
        Self::Samples(16),
        Self::Finer(2),
        Self::Finer(3),
        Self::Finer(4),
        Self::Analytic,
    ];

    /// The name in tables and plots.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Self::Samples(1) => "1 sample".to_owned(),
            Self::Samples(count) => format!("{count} samples"),
            Self::Finer(axis) => format!("supersampling {axis}x{axis}"),
            Self::Analytic => "analytic area".to_owned(),
        }
    }

    /// The fraction of each pixel that the star covers.
    #[must_use]
    pub fn draw(self, star: &Star) -> Field<f64> {
        match self.samples() {
            Some([samples, axis]) => {
                let mut drawer = engine::Drawer::new(star, samples, axis);
                drawer.draw();
                drawer.shares()
            }
            None => analytic::draw(star),
        }
    }

    /// Returns a closure that draws the star repeatedly and keeps everything that can be kept.
    #[must_use]
    pub fn repeated(self, star: &Star) -> Box<dyn FnMut() + '_> {
        match self.samples() {
            Some([samples, axis]) => {
                let mut drawer = engine::Drawer::new(star, samples, axis);
                Box::new(move || drawer.draw())
            }
            None => Box::new(|| drop(analytic::draw(star))),
        }
    }

    /// The engine's samples per pixel, and the factor by which its grid is finer.
    fn samples(self) -> Option<[u32; 2]> {
        match self {
            Self::Samples(samples) => Some([samples, 1]),
            Self::Finer(axis) => Some([1, axis]),
            Self::Analytic => None,
        }
    }

    /// The difference from the exact areas, in partly covered pixels.
    #[must_use]
    pub fn error(self, star: &Star, exact: &Field<f64>) -> Difference {
        let drawn = self.draw(star);
        let partly = exact.pixels().filter(|(_, share)| (1e-9..1.0 - 1e-9).contains(*share));
        Difference::of(partly.map(|(place, &share)| [drawn[place], share]))
    }
}

/// The exact area in each pixel, in `f64`.
#[must_use]
pub fn exact(star: &Star) -> Field<f64> {
    analytic::draw(star)
}
