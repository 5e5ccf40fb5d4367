//! Where the samples of a pixel lie.

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
