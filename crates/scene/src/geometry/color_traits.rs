//! What is the same of all vertex colours of a mesh. It is found once, when a material first asks for it.

use std::sync::OnceLock;

use trigon_math::Vec3;

use super::Columns;
use crate::display::Display;
use crate::left_in::keeps_unseen;
use crate::material::{AlphaMode, Material};

/// What is the same of all vertex colours; each is searched when it is first asked for.
#[derive(Clone, Debug, Default)]
pub(crate) struct ColorTraits {
    /// Red, green and blue are 1.
    white: OnceLock<bool>,
    /// Alpha is 1.
    opaque: OnceLock<bool>,
    /// All are finite numbers, at least 0.
    positive: OnceLock<bool>,
}

impl Columns {
    /// Whether vertex colours show in a material whose alpha mode is the one that can be seen. Interpolated between
    /// equal values they are exactly these, so white ones change no byte.
    pub(crate) fn show_colors(&self, material: &Material, display: Display) -> bool {
        let shows_alpha = material.alpha_mode != AlphaMode::Opaque || display == Display::Alpha;
        let is_black = || material.base_color.truncate() == Vec3::ZERO && self.are_colors_positive();
        let shows = || !self.are_colors_white() && !is_black() || shows_alpha && !self.are_colors_opaque();
        self.colors.is_some() && (keeps_unseen() || shows())
    }

    /// Whether the red, green and blue of all vertex colours, if there are any, are 1.
    pub(crate) fn are_colors_white(&self) -> bool {
        *self.color_traits.white.get_or_init(|| self.all_of_colors(0..3, |value| value == 1.0))
    }

    /// Whether their alpha is 1.
    pub(crate) fn are_colors_opaque(&self) -> bool {
        *self.color_traits.opaque.get_or_init(|| self.all_of_colors(3..4, |value| value == 1.0))
    }

    /// Whether all of their values are finite and at least 0.
    pub(crate) fn are_colors_positive(&self) -> bool {
        let is_positive = |value: f32| value.is_finite() && value >= 0.0;
        *self.color_traits.positive.get_or_init(|| self.all_of_colors(0..4, is_positive))
    }

    fn all_of_colors(&self, channels: std::ops::Range<usize>, holds: impl Fn(f32) -> bool) -> bool {
        let Some(colors) = &self.colors else { return true };
        colors[channels].iter().flatten().all(|&value| holds(value))
    }
}
