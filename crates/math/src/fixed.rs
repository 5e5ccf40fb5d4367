//! Fixed-point sub-pixel coordinates: the grid on which coverage is decided.

/// A coordinate in 1/256 pixel (24.8 fixed point).
///
/// Its magnitude is at most [`Fixed::LIMIT`] pixels, which every constructor
/// checks, so that [`orientation_fixed`](crate::orientation_fixed) cannot
/// overflow.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Fixed(i32);

impl Fixed {
    /// Zero.
    pub const ZERO: Self = Self(0);
    /// One pixel.
    pub const ONE: Self = Self(1 << Self::FRACTION_BITS);
    /// Fractional bits: 8, as Direct3D 11 requires and Vulkan requests of devices.
    pub const FRACTION_BITS: u32 = 8;
    /// The largest magnitude in pixels: 2²². The difference of two raw values is then within ±2³¹, and
    /// twice the area of any triangle fits into `i64`. The clipper's guard band (±32768 px) is far
    /// inside.
    pub const LIMIT: i32 = 1 << 22;

    /// Rounds a coordinate in pixels to the grid: to nearest, ties to even, the
    /// same on both sides of zero.
    ///
    /// `None` for NaN and beyond ±[`Fixed::LIMIT`]: the caller drops such geometry before any cast
    /// can wrap or saturate.
    #[must_use]
    #[inline]
    pub fn from_f32(pixels: f32) -> Option<Self> {
        Self::from_f64(f64::from(pixels))
    }

    /// As [`Fixed::from_f32`], for a coordinate in higher precision.
    #[must_use]
    #[inline]
    pub fn from_f64(pixels: f64) -> Option<Self> {
        // The product with a power of two is exact.
        let raw = (pixels * f64::from(Self::ONE.0)).round_ties_even();
        // NaN fails the comparison.
        (raw.abs() <= f64::from(Self::LIMIT_RAW)).then_some(Self(raw as i32))
    }

    /// The coordinate that is `raw` times 1/256 pixel.
    ///
    /// # Panics
    /// It is beyond ±[`Fixed::LIMIT`] pixels.
    #[must_use]
    #[inline]
    pub const fn from_raw(raw: i32) -> Self {
        assert!(
            -Self::LIMIT_RAW <= raw && raw <= Self::LIMIT_RAW,
            "a fixed-point coordinate is within ±2^22 pixels"
        );
        Self(raw)
    }

    /// The coordinate in units of 1/256 pixel.
    #[must_use]
    #[inline]
    pub const fn raw(self) -> i32 {
        self.0
    }

    /// The coordinate in pixels, exactly.
    #[must_use]
    #[inline]
    pub fn to_f64(self) -> f64 {
        f64::from(self.0) / f64::from(Self::ONE.0)
    }

    /// [`Fixed::LIMIT`] in units of 1/256 pixel.
    const LIMIT_RAW: i32 = Self::LIMIT << Self::FRACTION_BITS;
}

/// A point on the sub-pixel grid of the screen: origin top-left, `y` down.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct FixedPoint {
    /// To the right.
    pub x: Fixed,
    /// Down.
    pub y: Fixed,
}

impl FixedPoint {
    /// The point with these coordinates.
    #[must_use]
    #[inline]
    pub const fn new(x: Fixed, y: Fixed) -> Self {
        Self { x, y }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn raw(pixels: f32) -> Option<i32> {
        Fixed::from_f32(pixels).map(Fixed::raw)
    }

    #[test]
    fn ties_go_to_the_even_neighbour_on_both_sides_of_zero() {
        for (half_units, expected) in [(1.0, 0), (3.0, 2), (5.0, 2), (7.0, 4), (511.0, 256)] {
            let pixels = half_units / 512.0;
            assert_eq!(raw(pixels), Some(expected), "{half_units} half units");
            assert_eq!(raw(-pixels), Some(-expected), "-{half_units} half units");
        }
    }

    /// Hard case 10: such values are dropped; nothing saturates or wraps.
    #[test]
    fn what_has_no_place_on_the_grid_is_dropped() {
        let limit = Fixed::LIMIT as f32;
        for pixels in [
            f32::NAN,
            f32::INFINITY,
            f32::NEG_INFINITY,
            1e9,
            -1e9,
            f32::MAX,
            limit.next_up(),
            -limit.next_up(),
            2_147_483_648.0 / 256.0,
        ] {
            assert_eq!(raw(pixels), None, "{pixels} is not on the grid");
        }
        assert_eq!(raw(limit), Some(1 << 30), "the limit itself is");
        assert_eq!(raw(-limit), Some(-(1 << 30)), "and its opposite");
        assert_eq!(raw(-0.0), Some(0), "zero has one representation");
        assert_eq!(raw(f32::from_bits(1)), Some(0), "denormals are zero");
    }

    #[test]
    #[should_panic(expected = "within")]
    fn raw_values_are_checked() {
        let _ = Fixed::from_raw((1 << 30) + 1);
    }

    proptest! {
        /// Hard case 11: translation by whole pixels translates the result.
        #[test]
        fn whole_pixels_translate_exactly(raw in -(1 << 20)..(1 << 20_i32), offset in -500..500_i32) {
            let pixels = f64::from(raw) / 1024.0;
            let moved = Fixed::from_f64(pixels + f64::from(offset)).unwrap().raw();
            prop_assert_eq!(moved, Fixed::from_f64(pixels).unwrap().raw() + 256 * offset);
        }

        #[test]
        fn rounding_is_to_the_nearest(pixels in -40_000.0_f32..40_000.0) {
            let fixed = Fixed::from_f32(pixels).unwrap();
            prop_assert!((fixed.to_f64() - f64::from(pixels)).abs() <= 1.0 / 512.0);
            prop_assert_eq!(Fixed::from_f64(fixed.to_f64()), Some(fixed));
        }
    }
}
