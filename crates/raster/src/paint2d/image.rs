//! Images that triangles are painted with, and the colour of an image at a position.
//!
//! Positions are fixed-point numbers of texels with 32 bits after the point. A position is first rounded to 1/4096
//! texel, so that a position computed with a small error still counts as the middle of its texel. This changes a
//! linearly filtered channel by less than 1/16 level.

use super::blend::{LevelChannels, unpack};
use super::{Rect, SizeError};
use crate::simd::{F32, I32, InlineMap, LANES, U32, prelude::*};
use crate::texture::{Filter, Wrap};
use std::ops::Range;

/// An image in gamma space, premultiplied by alpha, which comes last; never
/// empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    size: [i32; 2],
    texels: Vec<[u8; 4]>,
    /// The colour between the middles of texels.
    pub filter: Filter,
    /// The colour beyond the edges.
    pub wrap: Wrap,
}

impl Image {
    /// The image with these row-major texels from the top left.
    ///
    /// # Errors
    /// If a side is 0 or above [`MAX_SIZE`](super::MAX_SIZE), or the number of
    /// texels is not `width * height`.
    pub fn new(width: u32, height: u32, texels: Vec<[u8; 4]>) -> Result<Self, SizeError> {
        let size = SizeError::check(width, height, texels.len())?;
        Ok(Self { size, texels, filter: Filter::default(), wrap: Wrap::ClampToEdge })
    }

    /// Width and height in texels.
    pub fn size(&self) -> [u32; 2] {
        self.size.map(i32::cast_unsigned)
    }

    /// All texels, row-major from the top left.
    #[must_use]
    pub fn texels(&self) -> &[[u8; 4]] {
        &self.texels
    }

    /// Replaces the texels of `area` by others, row-major.
    ///
    /// # Errors
    /// If `area` is empty or not within the image, or the number of texels is not
    /// that of the area; nothing is replaced then.
    pub fn update(&mut self, area: Rect, texels: &[[u8; 4]]) -> Result<(), SizeError> {
        let side = |axis: usize| {
            let length = i64::from(area.max[axis]) - i64::from(area.min[axis]);
            u32::try_from(length).unwrap_or(0)
        };
        let [width, height] = [side(0), side(1)];
        if !self.bounds().contains(area) {
            return Err(SizeError { width, height, pixels: texels.len() });
        }
        SizeError::check(width, height, texels.len())?;
        let [left, top] = area.min.map(|v| v as usize);
        let rows = self.texels.chunks_exact_mut(self.size[0] as usize).skip(top);
        for (row, texels) in rows.zip(texels.chunks_exact(width as usize)) {
            row[left..left + texels.len()].copy_from_slice(texels);
        }
        Ok(())
    }

    /// All texels' positions.
    pub(super) fn bounds(&self) -> Rect {
        Rect::new([0, 0], self.size)
    }

    /// From a texel, which is inside, to the end of the image.
    #[inline(always)]
    pub(super) fn texels_from(&self, x: i32, y: i32) -> &[[u8; 4]] {
        &self.texels[y as usize * self.size[0] as usize + x as usize..]
    }

    /// The texel at a column and a row, wherever these are.
    #[inline(always)]
    pub(super) fn texel(&self, column: i32, row: i32) -> u32 {
        let [x, y] = [self.wrap.index(column, self.size[0]), self.wrap.index(row, self.size[1])];
        u32::from_le_bytes(self.texels_from(x, y)[0])
    }
}

impl Wrap {
    /// Which of `size` texels is at `index`.
    #[inline(always)]
    fn index(self, index: i32, size: i32) -> i32 {
        match self {
            Self::ClampToEdge => index.clamp(0, size - 1),
            Self::Repeat => index.rem_euclid(size),
            Self::MirroredRepeat => {
                let twice = index.rem_euclid(2 * size);
                if twice < size { twice } else { 2 * size - 1 - twice }
            }
        }
    }
}

/// Bits behind the point of a position.
const FRACTION_BITS: u32 = 32;
/// Bits that are left of them.
const WEIGHT_BITS: u32 = 12;
const ONE: i64 = 1 << WEIGHT_BITS;

/// The furthest position in texels, to either side: rounded ones fit 32 bits.
pub(super) const FURTHEST: f64 = (1 << 18) as f64;

/// A position in texels, both axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct TexelPosition(pub(super) [i64; 2]);

impl TexelPosition {
    /// From texels. What is out of range becomes any position.
    #[inline(always)]
    pub(super) fn new(texels: [f64; 2]) -> Self {
        const UNIT: f64 = (1_i64 << FRACTION_BITS) as f64;
        Self([(texels[0] * UNIT) as i64, (texels[1] * UNIT) as i64])
    }

    /// `count` steps further.
    #[inline(always)]
    fn stepped(self, step: Self, count: i64) -> Self {
        let along = |axis: usize| self.0[axis].wrapping_add(step.0[axis].wrapping_mul(count));
        Self([along(0), along(1)])
    }
}

/// Two neighbours on an axis: the first one's index, and how much of the colour
/// is the second one's, of [`ONE`].
#[inline(always)]
fn neighbours(position: i64, offset: i64) -> (i32, i32) {
    const CUT: u32 = FRACTION_BITS - WEIGHT_BITS;
    let position = (position.wrapping_add(1 << (CUT - 1)) >> CUT) - offset;
    ((position >> WEIGHT_BITS) as i32, (position & (ONE - 1)) as i32)
}

impl Image {
    /// The colours `steps` (at most eight) from `start`, in the first lanes; the
    /// others are transparent.
    #[inline(always)]
    pub(super) fn colors<S: Simd>(
        &self,
        simd: S,
        start: TexelPosition,
        step: TexelPosition,
        steps: Range<i64>,
    ) -> LevelChannels<S> {
        match self.filter {
            Filter::Nearest => self.nearest(simd, start, step, steps),
            Filter::Linear => self.linear(simd, start, step, steps),
        }
    }

    #[inline(always)]
    fn nearest<S: Simd>(
        &self,
        simd: S,
        start: TexelPosition,
        step: TexelPosition,
        steps: Range<i64>,
    ) -> LevelChannels<S> {
        let mut texels = [0; LANES];
        for (texel, count) in texels.iter_mut().zip(steps) {
            let TexelPosition([u, v]) = start.stepped(step, count);
            *texel = self.texel(neighbours(u, 0).0, neighbours(v, 0).0);
        }
        unpack(U32::simd_from(simd, texels))
    }

    #[inline(always)]
    fn linear<S: Simd>(
        &self,
        simd: S,
        start: TexelPosition,
        step: TexelPosition,
        steps: Range<i64>,
    ) -> LevelChannels<S> {
        let mut texels = [[0; LANES]; 4];
        let mut weights = [[0; LANES]; 2];
        for (lane, count) in steps.enumerate().take(LANES) {
            let TexelPosition([u, v]) = start.stepped(step, count);
            let (x, weight_x) = neighbours(u, ONE / 2);
            let (y, weight_y) = neighbours(v, ONE / 2);
            weights[0][lane] = weight_x;
            weights[1][lane] = weight_y;
            texels[0][lane] = self.texel(x, y);
            texels[1][lane] = self.texel(x + 1, y);
            texels[2][lane] = self.texel(x, y + 1);
            texels[3][lane] = self.texel(x + 1, y + 1);
        }
        let [x, y] = weights.each(
            #[inline(always)]
            |weights| F32::float_from(I32::simd_from(simd, weights)) * (1.0 / ONE as f32),
        );
        let [a, b, c, d] = texels.each(
            #[inline(always)]
            |texels| unpack(U32::simd_from(simd, texels)),
        );
        mix(mix(a, b, x), mix(c, d, x), y)
    }
}

/// (1 − weight) of one colour and `weight` of another; equal ones stay exactly
/// what they are.
#[inline(always)]
fn mix<S: Simd>(a: LevelChannels<S>, b: LevelChannels<S>, weight: F32<S>) -> LevelChannels<S> {
    let rest = 1.0 - weight;
    [
        a[0] * rest + b[0] * weight,
        a[1] * rest + b[1] * weight,
        a[2] * rest + b[2] * weight,
        a[3] * rest + b[3] * weight,
    ]
}
