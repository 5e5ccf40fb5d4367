//! Corrections of numbers: sums that leave the range of all values come in again at its other end.

use crate::formats::gltf::broken::Broken;
use crate::formats::gltf::stream::Stream;

/// The range of all values.
#[derive(Clone, Copy)]
pub(super) struct Wrap {
    min: i32,
    max: i32,
    /// How many values are in the range.
    size: i32,
}

impl Wrap {
    pub(super) fn read(stream: &mut Stream<'_>) -> Result<Self, Broken> {
        let (min, max) = (i32::from_le_bytes(stream.array()?), i32::from_le_bytes(stream.array()?));
        let size = max.checked_sub(min).filter(|&size| size >= 0).and_then(|size| size.checked_add(1));
        Ok(Self { min, max, size: size.ok_or("an attribute has an impossible range")? })
    }

    /// Adds predicted numbers to corrections.
    pub(super) fn correct(self, predicted: &[i32], corrections: &mut [i32]) {
        for (&predicted, value) in predicted.iter().zip(corrections) {
            *value = self.inside(predicted.clamp(self.min, self.max).wrapping_add(*value));
        }
    }

    fn inside(self, value: i32) -> i32 {
        if value > self.max {
            value.wrapping_sub(self.size)
        } else if value < self.min {
            value.wrapping_add(self.size)
        } else {
            value
        }
    }
}
