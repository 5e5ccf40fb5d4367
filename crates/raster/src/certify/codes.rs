//! Whether a colour has the same bytes if it is off by a given bound.

use crate::Target;
use crate::fragments::Encoding;
use trigon_math::{Vec4, color};

/// The encodings of a target, and by how much colours may be off.
pub(super) struct TargetCodes {
    srgb8: bool,
    unorm8: bool,
    bound: f32,
}

impl TargetCodes {
    pub(super) fn of(target: &Target<'_>, bound: f32) -> Self {
        Self { srgb8: target.srgb8().is_some(), unorm8: target.unorm8().is_some(), bound }
    }

    /// Whether there are any bytes.
    pub(super) fn is_requested(&self) -> bool {
        self.srgb8 || self.unorm8
    }

    /// Whether all colours within the bound have the same bytes.
    pub(super) fn are_settled(&self, value: Vec4) -> bool {
        let [low, high] = [-self.bound, self.bound].map(|by| (value + by).to_array());
        let low = low.map(f32::next_down);
        let high = high.map(f32::next_up);
        (!self.unorm8 || unorm8_agrees(low, high)) && (!self.srgb8 || srgb8_agrees(low, high))
    }
}

/// Each component separately; none decreases as its colour increases.
fn unorm8_agrees(low: [f32; 4], high: [f32; 4]) -> bool {
    let encode = |color| Encoding::Unorm8.encode(Vec4::from_array(color));
    encode(low) == encode(high)
}

/// The same after the division by alpha, which is least and greatest at the ends
/// of both ranges. Where alpha may be 0, nothing is known of the quotient.
fn srgb8_agrees(low: [f32; 4], high: [f32; 4]) -> bool {
    let alpha = [low[3], high[3]];
    if alpha[0] <= 0.0 {
        return alpha[1] <= 0.0;
    }
    let settled = |i: usize| {
        let least = low[i] / if low[i] < 0.0 { alpha[0] } else { alpha[1] };
        let greatest = high[i] / if high[i] < 0.0 { alpha[1] } else { alpha[0] };
        color::linear_to_srgb8(least.next_down()) == color::linear_to_srgb8(greatest.next_up())
    };
    (0..3).all(settled) && color::unit_to_u8(alpha[0]) == color::unit_to_u8(alpha[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn settled_colours_keep_their_bytes(
            value: [f32; 4],
            unit in [0.0_f32..1.0, 0.0..1.0, 0.0..1.0, 0.0..1.0],
            share in [-1.0_f32..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0],
            bound in 0.0_f32..0.002,
        ) {
            let codes = TargetCodes { srgb8: true, unorm8: true, bound };
            for value in [Vec4::from_array(value), Vec4::from_array(unit)] {
                prop_assume!(value.is_finite());
                let moved = value + Vec4::from_array(share) * bound;
                let agrees = |e: Encoding| e.encode(value) == e.encode(moved);
                let same = agrees(Encoding::Srgb8) && agrees(Encoding::Unorm8);
                prop_assert!(same || !codes.are_settled(value), "{value} and {moved}");
            }
        }
    }

    #[test]
    fn only_colours_near_a_threshold_are_unsettled() {
        let codes = TargetCodes { srgb8: true, unorm8: true, bound: 1e-5 };
        let grays = (0..1000).map(|i| Vec4::splat(i as f32 / 1000.0).with_w(1.0));
        let settled = grays.filter(|&gray| codes.are_settled(gray)).count();
        assert!(settled > 950, "{settled} of 1000");
    }
}
