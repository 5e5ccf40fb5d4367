//! What do the same bytes on every machine cost? Lighting in each pixel, by the renderer's rules and with two
//! operations that these rule out because they differ between processors: fused multiply-add, and estimated
//! reciprocals.

mod arithmetic;
mod kernel;

#[cfg(test)]
mod tests;

use crate::metric::Difference;
use arithmetic::{Fast, Fused, Ours};
use fearless_simd::{Level, dispatch};
use trigon_classic::Field;

/// The rules by which light is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Rules {
    /// The renderer's: every product, sum, quotient and root is rounded by itself.
    SameBytes,
    /// Products and sums are rounded together where the processor has an instruction for it.
    Fused,
    /// The same, and reciprocals are the processor's estimates.
    FusedAndEstimated,
}

impl Rules {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::SameBytes, Self::Fused, Self::FusedAndEstimated];

    /// The name in tables and plots.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::SameBytes => "the same bytes everywhere",
            Self::Fused => "fused multiply-add",
            Self::FusedAndEstimated => "fused, estimated reciprocals",
        }
    }

    /// The light of each pixel, white being 1.
    #[must_use]
    pub fn draw(self) -> Field<f32> {
        let mut light = Field::new([kernel::SIDE; 2], 0.0);
        self.draw_into(&mut light);
        light
    }

    /// Returns a closure that draws the image repeatedly.
    #[must_use]
    pub fn repeated(self) -> Box<dyn FnMut()> {
        let mut light = Field::new([kernel::SIDE; 2], 0.0);
        Box::new(move || self.draw_into(std::hint::black_box(&mut light)))
    }

    fn draw_into(self, light: &mut Field<f32>) {
        let level = Level::new();
        match self {
            Self::SameBytes => dispatch!(level, simd => kernel::draw::<_, Ours>(simd, light.values_mut())),
            Self::Fused => dispatch!(level, simd => kernel::draw::<_, Fused>(simd, light.values_mut())),
            Self::FusedAndEstimated => {
                dispatch!(level, simd => kernel::draw::<_, Fast>(simd, light.values_mut()));
            }
        }
    }

    /// How far that is from the formula in `f64`.
    #[must_use]
    pub fn error(self) -> Difference {
        let drawn = self.draw();
        Difference::of(drawn.pixels().map(|(place, &light)| [light.into(), kernel::exact(place)]))
    }

    /// How many of a thousand pixels have another byte than by the renderer's rules.
    #[must_use]
    pub fn other_bytes_per_mille(self) -> f64 {
        let [here, ours] =
            [self, Self::SameBytes].map(|rules| rules.draw().map(|light| (light * 255.0 + 0.5) as u8));
        let others = here.values().iter().zip(ours.values()).filter(|(a, b)| a != b).count();
        1e3 * others as f64 / ours.values().len() as f64
    }
}

/// How many pixels an image has.
pub const PIXELS: usize = kernel::SIDE * kernel::SIDE;

/// Columns and rows of an image.
pub const SIZE: [usize; 2] = [kernel::SIDE; 2];
