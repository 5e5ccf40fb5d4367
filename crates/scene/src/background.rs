//! Backgrounds: what a frame shows where nothing is drawn.

use trigon_math::{Vec3, Vec4};

/// What a frame shows where nothing is drawn. Colours are linear RGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Background {
    /// One colour.
    Color(Vec3),
    /// A gradient from one colour at the top edge of the image to another at the bottom.
    Gradient {
        /// The colour at the top edge.
        top: Vec3,
        /// The colour at the bottom edge.
        bottom: Vec3,
    },
    /// Nothing: the image's alpha is 0 there.
    Transparent,
    /// The [environment](crate::EffectSettings::environment) that lights the scene, black without
    /// one. Like the light of surfaces, it is subject to exposure and tone mapping, but not to fog.
    Environment,
}

impl Default for Background {
    /// A neutral grey-blue gradient on which light and dark models both stand out.
    fn default() -> Self {
        Self::Gradient { top: Vec3::new(0.16, 0.19, 0.24), bottom: Vec3::new(0.52, 0.55, 0.58) }
    }
}

impl Background {
    /// The colours at the top and the bottom edge of the image; black where it has no colour.
    pub(crate) fn edges(&self) -> [Vec3; 2] {
        match *self {
            Self::Color(color) => [color; 2],
            Self::Gradient { top, bottom } => [top, bottom],
            Self::Transparent | Self::Environment => [Vec3::ZERO; 2],
        }
    }

    /// Premultiplied linear colour of row `y` of `height`. Transparent if there are no rows.
    pub(crate) fn row(&self, y: u32, height: u32) -> Vec4 {
        match *self {
            Self::Color(color) => color.extend(1.0),
            Self::Gradient { top, bottom } => {
                let down = (y as f32 + 0.5) / height as f32;
                (top + (bottom - top) * down).extend(1.0)
            }
            Self::Transparent | Self::Environment => Vec4::ZERO,
        }
    }
}
