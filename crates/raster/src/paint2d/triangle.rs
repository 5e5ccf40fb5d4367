//! Which pixels a triangle covers: one span in each row, in exact integers.
//!
//! Both ends of a span are computed by the same function of an edge: the first pixel whose centre is on the edge or to
//! its right. The span begins at that pixel of the left edge and ends before that pixel of the right edge. This is the
//! top-left rule. Triangles that share an edge share this pixel, so there is no gap and no overlap.
//!
//! [`Gradient`] holds colours and image coordinates that change across a triangle. In each row, values at the first covered pixel are weighted means of the corners' values, with weights from exact
//! areas; they are computed even if the scissor hides that pixel. From there they change by a constant for each pixel.
//! A value therefore lies between those of the corners (f32 stays within 1/1000 level), however thin the triangle is,
//! and the scissor cannot change it.

use super::blend::{LevelChannels, multiply, over};
use super::image::TexelPosition;
use super::{Canvas, Image, Rect, blend};
use crate::simd::{F32, LANES, lane_numbers, prelude::*};
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

/// An image on a triangle.
#[derive(Clone, Copy)]
pub(super) struct TriangleTexture<'a> {
    pub(super) image: &'a Image,
    /// The corners' positions in texels.
    pub(super) texel_positions: [[f64; 2]; 3],
}

/// How colour and position change across a triangle.
pub(super) struct Gradient<'a> {
    weights: Weights,
    color: Linear<4>,
    texture: Option<(&'a Image, Linear<2>)>,
}

impl<'a> Gradient<'a> {
    /// With the colours of the triangle's points in levels, and their positions.
    #[inline(always)]
    pub(super) fn new(
        triangle: &Triangle,
        colors: [[f64; 4]; 3],
        texture: Option<TriangleTexture<'a>>,
    ) -> Self {
        let weights = Weights::new(triangle);
        let color = Linear::new(colors, weights.step);
        let texture =
            texture.map(|texture| (texture.image, Linear::new(texture.texel_positions, weights.step)));
        Self { weights, color, texture }
    }

    /// Paints the part of a row's span that is inside `clip`.
    #[inline(always)]
    pub(super) fn paint<S: Simd>(
        &self,
        simd: S,
        canvas: &mut Canvas<'_>,
        clip: Rect,
        y: i32,
        span: Range<i32>,
    ) {
        let weights = self.weights.at(span.start, y);
        let color = self.color.at(weights);
        let texture = self.texture.map(|(image, linear)| {
            (image, TexelPosition::new(linear.at(weights)), TexelPosition::new(linear.step))
        });
        let [start, end] = [span.start.max(clip.min[0]), span.end.min(clip.max[0])];
        for x in (start..end).step_by(LANES) {
            let steps = x - span.start;
            let count = (end - x).min(LANES as i32);
            let mut source = eight_steps(simd, color, self.color.step, steps);
            if let Some((image, start, step)) = texture {
                let steps = i64::from(steps)..i64::from(steps + count);
                source = multiply(source, image.colors(simd, start, step, steps));
            }
            blend::change(
                simd,
                canvas.pixels_from(x, y),
                count,
                #[inline(always)]
                |below| over(source, below),
            );
        }
    }
}

/// The colours `steps` and up to seven more from `start`.
#[inline(always)]
fn eight_steps<S: Simd>(simd: S, start: [f64; 4], step: [f64; 4], steps: i32) -> LevelChannels<S> {
    let steps: F32<S> = F32::float_from(lane_numbers(simd) + steps);
    let channel = |c: usize| steps * step[c] as f32 + start[c] as f32;
    [channel(0), channel(1), channel(2), channel(3)]
}

/// The weights of a triangle's middle and last point; the first one's is what
/// they leave of 1.
struct Weights {
    /// From the first point to the others, in 1/256 pixel.
    to_middle: [i64; 2],
    to_last: [i64; 2],
    first: [i64; 2],
    per_area: f64,
    /// How much each pixel to the right adds.
    step: [f64; 2],
}

impl Weights {
    #[inline(always)]
    fn new(triangle: &Triangle) -> Self {
        let [first, middle, last] =
            triangle.points.map(|point| [point.x, point.y].map(Fixed::raw).map(i64::from));
        let from_first = |point: [i64; 2]| [point[0] - first[0], point[1] - first[1]];
        let [to_middle, to_last] = [from_first(middle), from_first(last)];
        let per_area = 1.0 / triangle.area as f64;
        let per_pixel = per_area * f64::from(Fixed::ONE.raw());
        let step = [to_last[1] as f64 * per_pixel, -to_middle[1] as f64 * per_pixel];
        Self { to_middle, to_last, first, per_area, step }
    }

    /// At the centre of a covered pixel. The areas are exact: they are parts of
    /// the triangle's, and that is within ±2⁶².
    #[inline(always)]
    fn at(&self, x: i32, y: i32) -> [f64; 2] {
        let [x, y] = [center(x) - self.first[0], center(y) - self.first[1]];
        let middle = x * self.to_last[1] - y * self.to_last[0];
        let last = self.to_middle[0] * y - self.to_middle[1] * x;
        [middle as f64 * self.per_area, last as f64 * self.per_area]
    }
}

/// N values that are linear across a triangle; where the corners' are equal,
/// they are exactly that.
#[derive(Clone, Copy)]
struct Linear<const N: usize> {
    first: [f64; N],
    to_middle: [f64; N],
    to_last: [f64; N],
    /// What each pixel to the right adds.
    step: [f64; N],
}

impl<const N: usize> Linear<N> {
    #[inline(always)]
    fn new([first, middle, last]: [[f64; N]; 3], step: [f64; 2]) -> Self {
        let mut linear = Self { first, to_middle: [0.0; N], to_last: [0.0; N], step: [0.0; N] };
        for i in 0..N {
            linear.to_middle[i] = middle[i] - first[i];
            linear.to_last[i] = last[i] - first[i];
            linear.step[i] = linear.to_middle[i] * step[0] + linear.to_last[i] * step[1];
        }
        linear
    }

    /// The values where the middle and the last point have these weights.
    #[inline(always)]
    fn at(&self, weights: [f64; 2]) -> [f64; N] {
        let mut values = self.first;
        for (i, value) in values.iter_mut().enumerate() {
            *value += self.to_middle[i] * weights[0] + self.to_last[i] * weights[1];
        }
        values
    }
}
