//! How many texels does a pixel need? The engine's filters on a floor that extends to the horizon, compared
//! with the mean over each pixel.

mod engine;
mod ground;

#[cfg(test)]
mod tests;

pub use engine::Drawer;
pub use ground::Ground;

use crate::metric::Difference;
use trigon_classic::Field;
use trigon_raster::{Filter, MipFilter, Sampler};

/// A way to look a texture up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TextureFilter {
    /// The texel in the middle.
    Nearest,
    /// Four texels of the base level.
    Bilinear,
    /// Four texels of each of two levels.
    Trilinear,
    /// So many such look-ups along the longer side of a pixel's footprint.
    Anisotropic(u8),
}

impl TextureFilter {
    /// All methods that are compared.
    pub const ALL: [Self; 6] = [
        Self::Nearest,
        Self::Bilinear,
        Self::Trilinear,
        Self::Anisotropic(2),
        Self::Anisotropic(4),
        Self::Anisotropic(16),
    ];

    /// The name in tables and plots.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Self::Nearest => "nearest".to_owned(),
            Self::Bilinear => "bilinear".to_owned(),
            Self::Trilinear => "trilinear".to_owned(),
            Self::Anisotropic(probes) => format!("anisotropic {probes}"),
        }
    }

    fn sampler(self) -> Sampler {
        let (filter, mip) = match self {
            Self::Nearest => (Filter::Nearest, MipFilter::None),
            Self::Bilinear => (Filter::Linear, MipFilter::None),
            Self::Trilinear => (Filter::Linear, MipFilter::Linear),
            Self::Anisotropic(probes) => (Filter::Linear, MipFilter::Anisotropic(probes)),
        };
        Sampler { magnification: filter, minification: filter, mip, ..Sampler::default() }
    }

    /// The light of each pixel.
    #[must_use]
    pub fn draw(self, ground: &Ground) -> Field<f64> {
        let mut drawer = Drawer::new(ground);
        drawer.draw(self);
        drawer.light()
    }

    /// How far that is from the mean of what each pixel sees.
    #[must_use]
    pub fn error(self, ground: &Ground, right: &Field<f64>) -> Difference {
        let drawn = self.draw(ground);
        Difference::of(right.pixels().map(|(place, &light)| [drawn[place], light]))
    }
}

/// The mean light of 16 by 16 points in each pixel, no filter at any.
#[must_use]
pub fn exact(ground: &Ground) -> Field<f64> {
    const POINTS: usize = 16;
    Field::from_fn(ground.size(), |[x, y]| {
        let place = |i: usize| (i as f64 + 0.5) / POINTS as f64;
        let points =
            (0..POINTS).flat_map(|j| (0..POINTS).map(move |i| [x as f64 + place(i), y as f64 + place(j)]));
        points.map(|point| ground.light(point)).sum::<f64>() / (POINTS * POINTS) as f64
    })
}
