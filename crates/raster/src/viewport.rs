//! From clip space to the grid of internal pixels.
//!
//! Inside the rasterizer a "pixel" is an *internal pixel*: with supersampling
//! ([`Target::samples_per_axis`](crate::Target::samples_per_axis)) the stages draw a finer grid than
//! the image's, and only the resolve combines its pixels into those of the image. Samples of
//! multisampling lie within an internal pixel.

use trigon_math::{Band, Fixed, FixedPoint, Vec4};

/// How far from the viewport's centre, in internal pixels, geometry goes unclipped.
pub(crate) const GUARD_BAND: f64 = 32768.0;

/// The grid of internal pixels of a frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Viewport {
    /// Width in internal pixels.
    pub(crate) width: u32,
    /// Height in internal pixels.
    pub(crate) height: u32,
}

impl Viewport {
    /// The largest |x / w| and |y / w| within the guard band: the largest powers
    /// of two that keep to it.
    pub(crate) fn guard(self) -> [Band; 2] {
        // At least 1, as no side has more than 65536 internal pixels.
        let widest = |side: u32| Band::at_most((2.0 * GUARD_BAND / f64::from(side)) as f32);
        [self.width, self.height].map(|side| widest(side).unwrap_or(Band::VIEW))
    }

    /// Snaps a clip-space position with w > 0 to the sub-pixel grid (1/256 of an internal pixel);
    /// `None` if it is out of the grid's range.
    ///
    /// In f64, so that the only rounding that matters is the one to the grid: to nearest, ties to
    /// even, with the same bits as `snap` in `vertex/snap.rs`, which snaps vertices that are not cut.
    #[inline]
    pub(crate) fn snap(self, position: Vec4) -> Option<FixedPoint> {
        let inverse_w = 1.0 / f64::from(position.w);
        let [x, y] = self.position([position.x, position.y].map(f64::from), inverse_w);
        Some(FixedPoint::new(Fixed::from_f64(x)?, Fixed::from_f64(y)?))
    }

    /// The position of a point in clip space, in pixels: within 2^-34 pixel of the
    /// exact one as long as that is within the guard band.
    #[inline(always)]
    pub(crate) fn position(self, [x, y]: [f64; 2], inverse_w: f64) -> [f64; 2] {
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
