//! What is seen where nothing is drawn.

use trigon_math::{Vec3, Vec4};

/// What is seen where nothing is drawn. Colours are linear RGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Background {
    /// One colour.
    Color(Vec3),
    /// From one colour at the top edge of the picture to another at the bottom.
    Gradient {
        /// At the upper edge.
        top: Vec3,
        /// At the lower edge.
        bottom: Vec3,
    },
    /// Nothing: the picture's alpha is 0 there.
    Transparent,
    /// The [environment](crate::EffectSettings::environment) that lights the scene,
    /// black where there is none. It is light like that of surfaces: exposure and tone
    /// mapping change it. Fog does not.
    Environment,
}

impl Default for Background {
    /// A quiet grey-blue gradient on which light and dark models both stand out.
    fn default() -> Self {
        Self::Gradient { top: Vec3::new(0.16, 0.19, 0.24), bottom: Vec3::new(0.52, 0.55, 0.58) }
    }
}

impl Background {
    /// Premultiplied linear colour of a row, `y` of `height`. Nothing for what has no
    /// rows.
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
