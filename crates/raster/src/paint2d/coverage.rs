//! Which pixels a triangle covers: one span in each row, in exact integers.
//!
//! Both ends of a span are computed by the same function of an edge: the first pixel whose centre is on the edge or to
//! its right. The span begins at that pixel of the left edge and ends before that pixel of the right edge. This is the
//! top-left rule. Triangles that share an edge share this pixel, so there is no gap and no overlap.

use super::Rect;
use std::ops::Range;
use trigon_math::{Fixed, FixedPoint, orientation_fixed};

/// The first pixel, column or row, whose centre is at `coordinate` or beyond.
pub(super) fn first_center(coordinate: Fixed) -> i32 {
    const HALF: i32 = Fixed::ONE.raw() / 2;
    // Rounded up; the sum is within ±(2³⁰ + 2⁷).
    (coordinate.raw() + (HALF - 1)) >> Fixed::FRACTION_BITS
}

/// The centre of a pixel in 1/256 pixel.
pub(super) fn center(pixel: i32) -> i64 {
    i64::from(pixel) * i64::from(Fixed::ONE.raw()) + i64::from(Fixed::ONE.raw() / 2)
}

/// A triangle of nonzero area.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    /// Sorted by y, then by x: nothing depends on the order that was given.
    pub(super) points: [FixedPoint; 3],
    /// Twice the signed area; positive if the middle point is to the right of
    /// the edge from first to last.
    pub(super) area: i64,
}

impl Triangle {
    /// From sorted points; `None` if they lie on a line.
    #[inline(always)]
    pub(super) fn new(points: [FixedPoint; 3]) -> Option<Self> {
        let [top, middle, bottom] = points;
        let area = orientation_fixed(top, middle, bottom);
        (area != 0).then_some(Self { points, area })
    }

    /// Calls `paint` with each row that has pixels inside `clip`: the row's y and
    /// its span, which may reach far beyond `clip` to either side.
    #[inline(always)]
    pub(super) fn spans(&self, clip: Rect, mut paint: impl FnMut(i32, Range<i32>)) {
        let [top, middle, bottom] = self.points;
        let rows = |upper: FixedPoint, lower: FixedPoint| {
            first_center(upper.y).max(clip.min[1])..first_center(lower.y).min(clip.max[1])
        };
        let whole = rows(top, bottom);
        if whole.is_empty() || self.misses_columns(clip) {
            return;
        }
        let mut long = DescendingEdge::new(top, bottom, whole.start);
        for (upper, lower) in [(top, middle), (middle, bottom)] {
            let rows = rows(upper, lower);
            if rows.is_empty() {
                continue;
            }
            let mut short = DescendingEdge::new(upper, lower, rows.start);
            for y in rows {
                let [a, b] = [long.first(), short.first()];
                let span = if self.area > 0 { a..b } else { b..a };
                if !span.is_empty() {
                    paint(y, span);
                }
                long.advance();
                short.advance();
            }
        }
    }

    fn misses_columns(&self, clip: Rect) -> bool {
        let [a, b, c] = self.points.map(|point| first_center(point.x));
        let [first, end] = [a.min(b).min(c), a.max(b).max(c)];
        first >= end || end <= clip.min[0] || first >= clip.max[0]
    }
}

/// An edge on its way down: a quotient that is kept exact from row to row.
struct DescendingEdge {
    /// The edge's first pixel, and what is left of the dividend.
    quotient: i64,
    remainder: i64,
    /// What each row adds to them.
    slope: i64,
    slope_remainder: i64,
    /// The divisor.
    height: i64,
}

impl DescendingEdge {
    /// The edge from `upper` to `lower`, whose y is larger, at row y between
    /// them.
    ///
    /// A centre at column x is at the edge or to its right if
    /// (256 x + 128 − upper.x) · height ≥ width · (256 y + 128 − upper.y).
    /// Everything is within ±(2⁶² + 2⁶¹).
    #[inline(always)]
    fn new(upper: FixedPoint, lower: FixedPoint, y: i32) -> Self {
        let raw = |v: Fixed| i64::from(v.raw());
        let [width, height] = [raw(lower.x) - raw(upper.x), raw(lower.y) - raw(upper.y)];
        let bound = width * (center(y) - raw(upper.y)) + (raw(upper.x) - center(0)) * height;
        // x is at least bound / 256 / height, and rounding up twice is rounding
        // up once.
        let bound = ((bound + 255) >> Fixed::FRACTION_BITS) + height - 1;
        let (quotient, remainder) = divide(bound, height);
        let (slope, slope_remainder) = divide(width, height);
        Self { quotient, remainder, slope, slope_remainder, height }
    }

    #[inline(always)]
    fn first(&self) -> i32 {
        // Between the columns of the end points.
        self.quotient as i32
    }

    #[inline(always)]
    fn advance(&mut self) {
        let remainder = self.remainder + self.slope_remainder;
        // No branch: it would be taken at random.
        let carry = i64::from(remainder >= self.height);
        self.remainder = remainder - carry * self.height;
        self.quotient += self.slope + carry;
    }
}

/// Quotient rounded down, and remainder; the divisor is positive.
#[inline(always)]
fn divide(dividend: i64, divisor: i64) -> (i64, i64) {
    let quotient = dividend.div_euclid(divisor);
    (quotient, dividend - quotient * divisor)
}
