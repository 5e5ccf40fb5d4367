//! From clip space to the grid of internal pixels.
//!
//! Inside the rasterizer a "pixel" is an *internal pixel*: with supersampling
//! ([`Target::samples_per_axis`](crate::Target::samples_per_axis)) the stages draw a finer grid than
//! the image's, and only the resolve combines its pixels into those of the image. Samples of
//! multisampling lie within an internal pixel.
//!
//! [`SamplePattern`] says where the samples of a pixel lie.

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
    /// even, with the same bits as `snap` in `vertex/screen.rs`, which snaps vertices that are not cut.
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

/// The most samples that a pixel can have.
pub(crate) const MAX_SAMPLES: usize = 16;

/// The standard sample positions of Direct3D 11.3 (section 19.2.4) and Vulkan
/// (`standardSampleLocations`), in 1/256 pixel from the pixel's top left corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SamplePattern {
    offsets: &'static [[i32; 2]],
    /// The least and the greatest offset on either axis.
    reach: [i32; 2],
}

/// In sixteenths of a pixel, as the standards give them.
const fn sixteenths<const N: usize>(positions: [[i32; 2]; N]) -> [[i32; 2]; N] {
    let mut offsets = [[0; 2]; N];
    let mut i = 0;
    while i < N {
        offsets[i] = [positions[i][0] * 16, positions[i][1] * 16];
        i += 1;
    }
    offsets
}

const ONE: [[i32; 2]; 1] = sixteenths([[8, 8]]);
const TWO: [[i32; 2]; 2] = sixteenths([[12, 12], [4, 4]]);
const FOUR: [[i32; 2]; 4] = sixteenths([[6, 2], [14, 6], [2, 10], [10, 14]]);
const EIGHT: [[i32; 2]; 8] =
    sixteenths([[9, 5], [7, 11], [13, 9], [5, 3], [3, 13], [1, 7], [11, 15], [15, 1]]);
const SIXTEEN: [[i32; 2]; 16] = sixteenths([
    [9, 9],
    [7, 5],
    [5, 10],
    [12, 7],
    [3, 6],
    [10, 13],
    [13, 11],
    [11, 3],
    [6, 14],
    [8, 1],
    [4, 2],
    [2, 12],
    [0, 8],
    [15, 4],
    [14, 15],
    [1, 0],
]);

impl SamplePattern {
    /// One sample, in the middle.
    pub(crate) const SINGLE: Self = Self { offsets: &ONE, reach: [128, 128] };

    /// The pattern of 1, 2, 4, 8 or 16 samples.
    pub(crate) fn of(samples: u32) -> Option<Self> {
        Some(match samples {
            1 => Self::SINGLE,
            2 => Self { offsets: &TWO, reach: [64, 192] },
            4 => Self { offsets: &FOUR, reach: [32, 224] },
            8 => Self { offsets: &EIGHT, reach: [16, 240] },
            16 => Self { offsets: &SIXTEEN, reach: [0, 240] },
            _ => return None,
        })
    }

    /// How many samples a pixel has.
    #[inline(always)]
    pub(crate) fn count(self) -> usize {
        self.offsets.len()
    }

    /// Where they lie.
    #[inline(always)]
    pub(crate) fn offsets(self) -> &'static [[i32; 2]] {
        self.offsets
    }

    /// The least and the greatest offset on either axis.
    #[inline(always)]
    pub(crate) fn reach(self) -> [i32; 2] {
        self.reach
    }

    /// The first and the last pixel on an axis that may have a sample within
    /// `low..=high` in 1/256 pixel; `None` if none has.
    #[inline(always)]
    pub(crate) fn pixels_between(self, [low, high]: [i32; 2]) -> Option<[i32; 2]> {
        let first = (low - self.reach[1] + 255) >> 8;
        let last = (high - self.reach[0]) >> 8;
        (first <= last).then_some([first, last])
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

    #[test]
    fn the_middle_of_a_pixel_sits_at_half() {
        let single = |range| SamplePattern::SINGLE.pixels_between(range);
        assert_eq!(single([0, 256]), Some([0, 0]), "one pixel holds one centre");
        assert_eq!(single([128, 128]), Some([0, 0]), "a centre itself");
        assert_eq!(single([129, 383]), None, "between two centres");
        assert_eq!(single([-128, 384]), Some([-1, 1]), "both ends count");
    }

    #[test]
    fn patterns_reach_as_far_as_they_say_and_never_repeat_a_row() {
        for samples in [1, 2, 4, 8, 16] {
            let pattern = SamplePattern::of(samples).unwrap();
            assert_eq!(pattern.count(), samples as usize, "number of samples");
            for axis in 0..2 {
                let mut offsets: Vec<i32> = pattern.offsets().iter().map(|offset| offset[axis]).collect();
                offsets.sort_unstable();
                assert!(offsets[0] >= pattern.reach[0], "the least offset of {samples}");
                assert!(offsets[offsets.len() - 1] <= pattern.reach[1], "the greatest of {samples}");
                offsets.dedup();
                assert_eq!(offsets.len(), samples as usize, "each row and column is hit once: {samples}");
            }
        }
        assert_eq!(SamplePattern::of(3), None, "no such pattern");
    }
}
