//! Colours and image coordinates that change across a triangle.
//!
//! In each row, values at the first covered pixel are weighted means of the corners' values, with weights from exact
//! areas; they are computed even if the scissor hides that pixel. From there they change by a constant for each pixel.
//! A value therefore lies between those of the corners (f32 stays within 1/1000 level), however thin the triangle is,
//! and the scissor cannot change it.

use super::blend::{LevelChannels, multiply, over};
use super::coverage::{Triangle, center};
use super::texel::TexelPosition;
use super::{Canvas, Image, Rect, eight};
use crate::simd::prelude::*;
use crate::simd::{F32, LANES, lane_numbers};
use std::ops::Range;
use trigon_math::Fixed;

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
            eight::change(
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
