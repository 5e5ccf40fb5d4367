//! Points spread evenly over a disc, in the order of a spiral, and which of them each pixel takes.
//!
//! With [all](RayPart::All) of them, each pixel turns the disc by one of 16 angles. Otherwise pixels take a part of the
//! points each, and neighbours complete each other. The pixel's position in a square of four by four selects the angle or
//! the part: neighbours differ, and the image is reproducible.

use trigon_math::{Vec2, elementary};
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, I32, InlineMap, LANES, Simd, inlined};

use crate::effect_settings::RaySampling;

/// The number of angles, and of pixels that share all points.
const TURNS: usize = 16;

/// The golden angle in radians, by which points are spread most evenly.
pub(crate) const GOLDEN_ANGLE: f32 = 2.399_963_2;

/// Points on a disc of radius 1.
#[derive(Clone, Debug)]
pub(crate) struct DiscPattern {
    points: Vec<Vec2>,
    /// Sines and cosines of the turns.
    turns: [Vec2; TURNS],
}

/// Which of the points a pixel takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum RayPart {
    /// All, turned.
    All,
    /// Those of one in so many pixels, in a square of pixels: 2 or 4 is the square's side.
    OfSquare(usize),
}

impl DiscPattern {
    /// For a number of rays. If pixels share them, each gets as many as the others. The angle of a step is in radians.
    pub(crate) fn new(rays: u32, sampling: RaySampling, step: f32) -> Self {
        let count = match sampling {
            RaySampling::Full => rays,
            RaySampling::Shared => rays.next_multiple_of(TURNS as u32),
        };
        let point = |i: u32| {
            let (radius, angle) = (square_of(i, count).sqrt(), i as f32 * step);
            Vec2::new(elementary::cos_f32(angle), elementary::sin_f32(angle)) * radius
        };
        let turn = |i: usize| {
            // Bit-reversed: neighbours differ most.
            let angle = ((i as u8).reverse_bits() >> 4) as f32 / TURNS as f32 * std::f32::consts::TAU;
            Vec2::new(elementary::cos_f32(angle), elementary::sin_f32(angle))
        };
        Self { points: (0..count).map(point).collect(), turns: std::array::from_fn(turn) }
    }

    pub(crate) fn points(&self) -> &[Vec2] {
        &self.points
    }

    /// The square of the radius of a point.
    pub(crate) fn square(&self, index: usize) -> f32 {
        square_of(index as u32, self.points.len() as u32)
    }

    /// How the disc is turned in each pixel: the sine and the cosine, which are those of no turn where a part is taken.
    #[inline(always)]
    pub(crate) fn turns<S: Simd>(&self, pixels: [F32<S>; 2], part: RayPart) -> [Vec2; LANES] {
        match part {
            RayPart::All => numbers_in_square(pixels, 4).each(
                #[inline(always)]
                |number| self.turns[number],
            ),
            RayPart::OfSquare(_) => [Vec2::X; LANES],
        }
    }
}

/// The square of the radius of a point: the points are spread evenly over the area.
fn square_of(index: u32, count: u32) -> f32 {
    (index as f32 + 0.5) / count as f32
}

impl RayPart {
    /// One in so many points is taken.
    pub(crate) fn step(self) -> usize {
        match self {
            Self::All => 1,
            Self::OfSquare(side) => side * side,
        }
    }

    /// The number of the first point of each pixel.
    #[inline(always)]
    pub(crate) fn first<S: Simd>(self, pixels: [F32<S>; 2]) -> [usize; LANES] {
        match self {
            Self::All => [0; LANES],
            Self::OfSquare(side) => {
                let bits = (side * side).trailing_zeros();
                numbers_in_square(pixels, side).each(
                    #[inline(always)]
                    // Bit-reversed, as turns are.
                    |number| usize::from((number as u8).reverse_bits() >> (8 - bits)),
                )
            }
        }
    }
}

/// Where pixels lie in a square of pixels, row by row. Its side is a power of two.
#[inline(always)]
fn numbers_in_square<S: Simd>([x, y]: [F32<S>; 2], side: usize) -> [usize; LANES] {
    let within = inlined(
        #[inline(always)]
        |pixel: F32<S>| pixel.to_int::<I32<S>>() & (side - 1) as i32,
    );
    let numbers: [i32; LANES] = (within(y) * side as i32 + within(x)).into();
    numbers.each(
        #[inline(always)]
        |number| number as usize,
    )
}
