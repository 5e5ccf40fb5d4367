//! What does it cost to mix colours as bytes of a file? Half of each of two greys: averaged as sRGB bytes, in
//! linear light stored in 8 bits, and in linear light in floating point.

#[cfg(test)]
mod tests;

use crate::metric::Difference;
use trigon_math::color::{linear_to_srgb8, srgb8_to_linear};

/// The form in which light is mixed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mixing {
    /// sRGB bytes.
    GammaBytes,
    /// Linear light, stored in bytes.
    LinearBytes,
    /// Linear light in `f32`.
    Linear,
}

impl Mixing {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::GammaBytes, Self::LinearBytes, Self::Linear];

    /// The name in tables and plots.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::GammaBytes => "sRGB bytes",
            Self::LinearBytes => "linear, 8 bit",
            Self::Linear => "linear, f32",
        }
    }

    /// The sRGB byte of a mixture of two greys, half of each.
    #[must_use]
    pub fn mix(self, one: u8, other: u8) -> u8 {
        match self {
            Self::GammaBytes => (u16::from(one) + u16::from(other)).div_ceil(2) as u8,
            Self::LinearBytes => {
                let [one, other] = [one, other].map(|byte| (srgb8_to_linear(byte) * 255.0 + 0.5) as u16);
                linear_to_srgb8(f32::from((one + other).div_ceil(2) as u8) / 255.0)
            }
            Self::Linear => linear_to_srgb8((srgb8_to_linear(one) + srgb8_to_linear(other)) / 2.0),
        }
    }

    /// The errors of the mixtures of all pairs of bytes.
    #[must_use]
    pub fn error(self) -> Difference {
        let light = |byte: u8| f64::from(srgb8_to_linear(byte));
        let pairs = (0..=255).flat_map(|one| (0..=one).map(move |other| (one, other)));
        Difference::of(
            pairs.map(|(one, other)| [light(self.mix(one, other)), (light(one) + light(other)) / 2.0]),
        )
    }
}
