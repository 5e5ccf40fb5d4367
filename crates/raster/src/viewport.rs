//! From clip space to the sample grid.
//!
//! Inside the rasterizer a "pixel" is a sample: with several samples per axis
//! everything happens on a finer grid, and only the resolve knows better.

use trigon_math::{Band, Fixed, FixedPoint, Vec4};

/// How far from the viewport's centre, in samples, geometry goes unclipped.
pub(crate) const GUARD_BAND: f64 = 32768.0;

/// The sample grid of a frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Viewport {
    /// Width in samples.
    pub(crate) width: u32,
    /// Height in samples.
    pub(crate) height: u32,
}

impl Viewport {
    /// The largest |x / w| and |y / w| within the guard band: the largest powers
    /// of two that keep to it.
    pub(crate) fn guard(self) -> [Band; 2] {
        // At least 1, as no side has more than 65536 samples.
        let widest = |side: u32| Band::at_most((2.0 * GUARD_BAND / f64::from(side)) as f32);
        [self.width, self.height].map(|side| widest(side).unwrap_or(Band::VIEW))
    }

    /// The point on the sub-sample grid where a clip-space position with w > 0
    /// lies; `None` if it is out of the grid's range.
    ///
    /// In f64, so that the only rounding that matters is the one to the grid.
    #[inline]
    pub(crate) fn snap(self, position: Vec4) -> Option<FixedPoint> {
        let inverse_w = 1.0 / f64::from(position.w);
        let [x, y] = self.place([position.x, position.y].map(f64::from), inverse_w);
        Some(FixedPoint::new(Fixed::from_f64(x)?, Fixed::from_f64(y)?))
    }

    /// Where a point in clip space lies, in pixels: within 2^-34 pixel of the
    /// exact place as long as that is within the guard band.
    #[inline(always)]
    pub(crate) fn place(self, [x, y]: [f64; 2], inverse_w: f64) -> [f64; 2] {
        [
            (x * inverse_w * 0.5 + 0.5) * f64::from(self.width),
            (0.5 - y * inverse_w * 0.5) * f64::from(self.height),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_of_clip_space_are_corners_of_the_grid() {
        let viewport = Viewport { width: 640, height: 480 };
        let at = |x, y| viewport.snap(Vec4::new(x, y, 0.0, 2.0)).map(|p| (p.x.raw(), p.y.raw()));
        assert_eq!(at(-2.0, 2.0), Some((0, 0)), "y points up in clip space, down on the grid");
        assert_eq!(at(2.0, -2.0), Some((640 * 256, 480 * 256)), "the far corner");
        assert_eq!(at(1e30, 0.0), None, "out of range");
        assert_eq!(at(f32::NAN, 0.0), None, "nowhere");
    }
}
