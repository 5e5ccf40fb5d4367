//! Which groups of a tile an outline may cross.

use crate::primitive::Quad;
use crate::samples::SamplePattern;
use crate::tile_buffer::TileArea;

/// Between which pixels across the major axis an outline may lie, group by group along it.
pub(super) struct OutlineStrip {
    /// The first and the last pixel from the tile's, times 2^24.
    first: i64,
    last: i64,
    /// What both change by from group to group.
    step: i64,
}

impl OutlineStrip {
    /// From a group on, that with this number along the major axis.
    #[inline(always)]
    pub(super) fn new(
        quad: &Quad,
        pattern: SamplePattern,
        area: &TileArea,
        major: usize,
        group: i32,
    ) -> Self {
        const UNIT: f64 = (1 << 16) as f64;
        // In 1/256 pixel: the corners were rounded to this grid, by at most one; all that is rounded below is
        // less than one.
        const SLACK: i32 = 2;
        let minor = 1 - major;
        let pixels = 1 << SHIFT[major];
        let [least, greatest] = pattern.reach();
        let [[a, b], [d, c]] = quad.corners;
        let slope = f64::from(d[minor] - a[minor]) / f64::from(d[major] - a[major]);
        let along = (area.origin[major] + group * pixels) * 256 + least;
        let low = f64::from(a[minor] - area.origin[minor] * 256) + slope * f64::from(along - a[major]);
        let rise = slope * f64::from((pixels - 1) * 256 + greatest - least);
        let (below, above) = if rise < 0.0 { (rise, 0.0) } else { (0.0, rise) };
        let width = (b[minor] - a[minor]).max(c[minor] - d[minor]);
        Self {
            first: ((low + below + f64::from(255 - greatest - SLACK)) * UNIT) as i64,
            last: ((low + above + f64::from(width + SLACK - least)) * UNIT) as i64,
            step: (slope * f64::from(pixels * 256) * UNIT) as i64,
        }
    }

    /// The groups of the next pixels along the major axis, within a range of pixels across.
    #[inline(always)]
    pub(super) fn next(&mut self, [first, last]: [i32; 2], shift: i32) -> std::ops::Range<i32> {
        let first = ((self.first >> 24) as i32).max(first);
        let last = ((self.last >> 24) as i32).min(last);
        self.first += self.step;
        self.last += self.step;
        first >> shift..(last >> shift) + 1
    }
}

/// Bits of the number of a pixel's column and row that tell it from others of its group.
pub(super) const SHIFT: [i32; 2] = [2, 1];
