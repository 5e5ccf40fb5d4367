//! Precision of models far from the origin: positions arrive in f64 and leave as f32.
//!
//! Ten million metres from the origin, f32 would have steps of a metre. So positions are stored
//! relative to an offset near the model's middle, and the offset goes into the node's f64
//! translation.

use trigon_math::DVec3;

/// How many times its own size a model may be away from the origin before it is rebased: up to here
/// f32 loses at most 4 of its 24 bits, and the file's own numbers stay recognizable.
const FAR: f64 = 16.0;

/// The offset to subtract from all positions; zero unless the model is far away. It is a multiple
/// of a power of two near the model's size, so that the subtraction in f64 is exact for all numbers
/// that f64 itself resolves.
pub(crate) fn offset_for(positions: impl Iterator<Item = DVec3>) -> DVec3 {
    let mut finite = positions.filter(|position| position.is_finite());
    let Some(first) = finite.next() else { return DVec3::ZERO };
    let (low, high) =
        finite.fold((first, first), |(low, high), position| (low.min(position), high.max(position)));
    let size = (high - low).max_element();
    let reach = low.abs().max(high.abs()).max_element();
    if !size.is_finite() || reach <= FAR * size {
        return DVec3::ZERO;
    }
    let step = power_of_two_below(if size > 0.0 { size } else { reach });
    let center = low + (high - low) * 0.5;
    (center / step).round() * step
}

/// The largest power of two that is not above a positive normal number.
fn power_of_two_below(value: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    let power = f64::from_bits(value.to_bits() & EXPONENT);
    if power > 0.0 { power } else { f64::MIN_POSITIVE }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn offset_of(positions: &[DVec3]) -> DVec3 {
        offset_for(positions.iter().copied())
    }

    #[test]
    fn near_models_stay_where_they_are() {
        assert_eq!(offset_of(&[DVec3::ZERO, DVec3::ONE]), DVec3::ZERO, "at the origin");
        assert_eq!(offset_of(&[DVec3::splat(10.0), DVec3::splat(11.0)]), DVec3::ZERO, "a little off");
        assert_eq!(offset_of(&[]), DVec3::ZERO, "nothing");
        assert_eq!(
            offset_of(&[DVec3::splat(f64::NAN), DVec3::splat(f64::MAX), DVec3::splat(f64::MIN)]),
            DVec3::ZERO,
            "absurd"
        );
    }

    #[test]
    fn far_models_are_moved_exactly() {
        let at = 1e7 + 0.001;
        let positions = [DVec3::new(at, 0.0, 0.0), DVec3::new(at + 1.0, 1.0, 1.0)];
        let offset = offset_of(&positions);
        assert_eq!(offset, DVec3::new(1e7 + 1.0, 1.0, 1.0).with_y(offset.y).with_z(offset.z), "tidy");
        for position in positions {
            assert_eq!((position - offset) + offset, position, "nothing is lost");
            assert!((position - offset).abs().max_element() <= 1.5, "near the origin now");
        }
    }

    #[test]
    fn a_single_far_point_moves_to_the_origin() {
        let offset = offset_of(&[DVec3::splat(1e9)]);
        assert!((DVec3::splat(1e9) - offset).abs().max_element() < 1e9, "nearer than before: {offset}");
    }
}
