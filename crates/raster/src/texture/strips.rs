//! Where texels lie in memory: every mip level is stored in strips of 8 columns, each with a border, one level after the
//! other.
//!
//! A row of a strip has 9 texels: its own 8, and the one to their right. Below the last row there is one more row, the
//! next one of the image. The 2 by 2 texels of a bilinear look-up whose first texel lies in the strip are therefore two
//! short runs in that strip, wherever the first texel is. No look-up needs a special case at an edge, and neighbours in
//! the image share cache lines in both directions. The border costs an eighth of the memory, and one row.
//!
//! After the last column or row the first one follows, as [`Wrap::Repeat`] needs. The other modes never read it: they
//! clamp the position to the centres of the outermost texels, where the next texel has weight 0.
//!
//! Mip levels are made by an exact box filter in linear light. [`Texels`] turns the bytes of texels into channels that can
//! be mixed, in lanes.
//!
//! [`Wrap::Repeat`]: super::Wrap::Repeat

use super::sampler::{TextureFormat, decode, full_scale};
use crate::simd::{F32, I32, LANES, Simd, U32, prelude::*};
use trigon_math::color::srgb8_to_linear;
use trigon_math::{Vec4, color};

/// Columns of a strip, a power of two.
pub(super) const COLUMNS: u32 = 8;
/// Texels from a row of a strip to the next.
pub(super) const PITCH: u32 = COLUMNS + 1;
/// Texels in memory from the first to the last of a [`TexelQuad`], both counted.
const SPAN: usize = PITCH as usize + 2;
/// More than the 15 levels of the largest texture, and a power of two: a number
/// below it needs no check.
const MAX_LEVELS: usize = 16;

/// Where a level starts, counted from the base level, its width, its height, and the texels
/// of as many rows of a strip.
pub(super) type Level = [i32; 4];

/// All levels of a texture.
#[derive(Clone, Debug)]
pub(super) struct Strips {
    pub(super) width: u32,
    pub(super) height: u32,
    /// The number of the last level, which is one texel.
    pub(super) last_level: u32,
    /// 16384² texels with their levels and borders are fewer than 2³¹.
    levels: [Level; MAX_LEVELS],
    texels: Vec<[u8; 4]>,
}

/// The texel of a look-up and its right neighbour, then the two below, each as
/// bytes red, green, blue, alpha, red … from the lowest on.
pub(super) type TexelQuad = [u64; 2];

impl Strips {
    /// The base level first; each next half as wide and high.
    pub(super) fn new(base: LevelRows, smaller: impl Fn(&LevelRows) -> Option<LevelRows>) -> Self {
        let (width, height) = (base.width, base.height);
        let levels = [[0; 4]; MAX_LEVELS];
        let mut strips = Self { width, height, last_level: 0, levels, texels: Vec::new() };
        strips.texels.reserve_exact(stored_texels(width, height));
        strips.push(&base);
        let mut last = base;
        while let Some(rows) = smaller(&last) {
            strips.last_level += 1;
            strips.push(&rows);
            last = rows;
        }
        strips
    }

    fn push(&mut self, rows: &LevelRows) {
        self.levels[self.last_level as usize] =
            [self.texels.len() as u32, rows.width, rows.height, rows.height * PITCH].map(u32::cast_signed);
        for left in (0..rows.width).step_by(COLUMNS as usize) {
            for y in 0..=rows.height {
                self.texels.extend(run(rows.row(y % rows.height), left));
            }
        }
    }

    /// The position within a level of `height` rows of its texel (x, y).
    #[inline]
    pub(super) fn index(height: u32, [x, y]: [u32; 2]) -> u32 {
        (x / COLUMNS * (height + 1) + y) * PITCH + x % COLUMNS
    }

    /// A texel of the base level.
    pub(super) fn base_texel(&self, at: [u32; 2]) -> [u8; 4] {
        self.texels[Self::index(self.height, at) as usize]
    }

    /// A level by its number.
    #[inline(always)]
    pub(super) fn level(&self, number: u32) -> &Level {
        &self.levels[number as usize % MAX_LEVELS]
    }

    /// The texels of bilinear look-ups.
    #[inline(always)]
    pub(super) fn quads(&self) -> TexelQuads<'_> {
        let last = self.texels.len().checked_sub(SPAN).expect("the smallest texture has a border");
        TexelQuads { texels: &self.texels, last }
    }
}

/// The 2×2 texels of bilinear look-ups, in all levels.
#[derive(Clone, Copy)]
pub(super) struct TexelQuads<'t> {
    texels: &'t [[u8; 4]],
    /// The last index that may be looked up: one comparison checks all four texels.
    last: usize,
}

impl TexelQuads<'_> {
    /// The texel at an index counted from the start of the base level, its right
    /// neighbour and the two below.
    #[inline(always)]
    pub(super) fn at(&self, index: u32) -> TexelQuad {
        let first = index as usize;
        assert!(first <= self.last, "a look-up beyond the last texel");
        let texels = &self.texels[first..first + SPAN];
        [pair(texels[0], texels[1]), pair(texels[SPAN - 2], texels[SPAN - 1])]
    }
}

#[inline(always)]
fn pair(first: [u8; 4], second: [u8; 4]) -> u64 {
    u64::from(u32::from_le_bytes(first)) | u64::from(u32::from_le_bytes(second)) << 32
}

/// `PITCH` texels of a row from `left` on, and around its end.
fn run(row: &[[u8; 4]], left: u32) -> impl Iterator<Item = [u8; 4]> {
    (left as usize..).take(PITCH as usize).map(|x| row[x % row.len()])
}

/// Texels that all levels take in memory.
fn stored_texels(width: u32, height: u32) -> usize {
    let stored = |[width, height]: [u32; 2]| (width.div_ceil(COLUMNS) * (height + 1) * PITCH) as usize;
    let mut size = [width, height];
    let mut total = stored(size);
    while size != [1, 1] {
        size = size.map(|side| (side / 2).max(1));
        total += stored(size);
    }
    total
}

/// Red, green, blue and alpha.
pub(super) type Channels<S> = [F32<S>; 4];

/// The last channel.
pub(super) const ALPHA: u32 = 3;

/// What the bytes of texels mean.
pub(super) trait Texels {
    /// A channel, 0 to 3, of texels, ready to be mixed.
    fn channel<S: Simd>(texels: U32<S>, channel: u32) -> F32<S>;
}

/// [`TextureFormat::Linear`]. Each channel stays where it lies in the texel:
/// that is a factor, a power of two, which is taken out at the end without
/// rounding.
pub(super) struct Data;

impl Texels for Data {
    #[inline(always)]
    fn channel<S: Simd>(texels: U32<S>, channel: u32) -> F32<S> {
        // The highest byte would make the integer negative, so alpha is shifted down instead.
        float(if channel == ALPHA { texels >> 24 } else { texels & (0xff << (8 * channel)) })
    }
}

/// [`TextureFormat::Srgb`]: linear light, and alpha as data.
pub(super) struct Color;

impl Texels for Color {
    #[inline(always)]
    fn channel<S: Simd>(texels: U32<S>, channel: u32) -> F32<S> {
        if channel == ALPHA {
            return float(texels >> 24);
        }
        light(texels.token(), &texels.to_array(), 8 * channel)
    }
}

#[inline(always)]
fn float<S: Simd>(number: U32<S>) -> F32<S> {
    number.bitcast::<I32<S>>().to_float()
}

/// The light of the bytes at a `shift`.
#[inline(always)]
fn light<S: Simd>(simd: S, texels: &[u32; LANES], shift: u32) -> F32<S> {
    F32::simd_from(simd, std::array::from_fn(|lane| srgb8_to_linear((texels[lane] >> shift) as u8)))
}

#[inline(always)]
pub(super) fn mix<S: Simd>(a: F32<S>, b: F32<S>, share: F32<S>) -> F32<S> {
    a + (b - a) * share
}

/// One level as rows of texels, top row first.
#[derive(Clone, Debug)]
pub(super) struct LevelRows {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) texels: Vec<[u8; 4]>,
}

impl LevelRows {
    pub(super) fn row(&self, y: u32) -> &[[u8; 4]] {
        let width = self.width as usize;
        &self.texels[y as usize * width..][..width]
    }
}

/// The texels of one axis that a texel of the next level covers, and the weight
/// of each. An odd number of texels is not halved evenly: then a texel covers
/// parts of three.
#[derive(Clone, Copy)]
struct CoveredTexels {
    first: u32,
    weights: [f32; 3],
}

impl CoveredTexels {
    fn new(index: u32, from: u32, to: u32) -> Self {
        if from == to {
            return Self { first: index, weights: [1.0, 0.0, 0.0] };
        }
        if from == 2 * to {
            return Self { first: 2 * index, weights: [0.5, 0.5, 0.0] };
        }
        // from = 2 to + 1: in units of 1/to of a texel, texel `index` covers
        // [index * from, (index + 1) * from), texel k of the finer level
        // [k * to, (k + 1) * to).
        let whole = 1.0 / from as f32;
        let weights = [(to - index) as f32 * whole, to as f32 * whole, (index + 1) as f32 * whole];
        Self { first: 2 * index, weights }
    }
}

/// The next smaller level; `None` below a single texel.
pub(super) fn halved(from: &LevelRows, format: TextureFormat) -> Option<LevelRows> {
    if from.width == 1 && from.height == 1 {
        return None;
    }
    let (width, height) = ((from.width / 2).max(1), (from.height / 2).max(1));
    let columns: Vec<_> = (0..width).map(|x| CoveredTexels::new(x, from.width, width)).collect();
    let mut texels = Vec::with_capacity(width as usize * height as usize);
    for y in 0..height {
        let rows = CoveredTexels::new(y, from.height, height);
        for column in &columns {
            texels.push(mean(from, *column, rows, format));
        }
    }
    Some(LevelRows { width, height, texels })
}

fn mean(from: &LevelRows, columns: CoveredTexels, rows: CoveredTexels, format: TextureFormat) -> [u8; 4] {
    let mut plain = Vec4::ZERO;
    let mut weighted = Vec4::ZERO;
    for (j, &row_weight) in (rows.first..from.height).zip(&rows.weights) {
        for (i, &column_weight) in (columns.first..from.width).zip(&columns.weights) {
            let texel = decode(from.texels[(j * from.width + i) as usize], format) / full_scale(format);
            let weight = row_weight * column_weight;
            plain += texel * weight;
            weighted += texel * (weight * texel.w);
        }
    }
    let alpha = plain.w;
    let rgb = if format == TextureFormat::Srgb && alpha > 0.0 { weighted / alpha } else { plain };
    encode(rgb.with_w(alpha), format)
}

fn encode(value: Vec4, format: TextureFormat) -> [u8; 4] {
    let byte = |v: f32| (v * 255.0 + 0.5) as u8;
    let code = |v: f32| match format {
        TextureFormat::Srgb => color::linear_to_srgb8(v),
        TextureFormat::Linear => byte(v),
    };
    [code(value.x), code(value.y), code(value.z), byte(value.w)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An image whose texels hold their own coordinates.
    fn numbered(width: u32, height: u32) -> Strips {
        let texels = (0..width * height).map(|i| at(i % width, i / width)).collect();
        Strips::new(LevelRows { width, height, texels }, |_| None)
    }

    fn at(x: u32, y: u32) -> [u8; 4] {
        ((y << 16) | x).to_le_bytes()
    }

    #[test]
    fn every_footprint_is_two_runs_of_one_strip() {
        for (width, height) in [(1, 1), (1, 9), (5, 3), (8, 8), (17, 16), (23, 31)] {
            let strips = numbered(width, height);
            for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
                let (right, below) = ((x + 1) % width, (y + 1) % height);
                let expected = [pair(at(x, y), at(right, y)), pair(at(x, below), at(right, below))];
                assert_eq!(strips.base_texel([x, y]), at(x, y), "the texel ({x}, {y}) of {width}x{height}");
                let got = strips.quads().at(Strips::index(height, [x, y]));
                assert_eq!(got, expected, "at ({x}, {y}) of {width}x{height}");
            }
        }
    }

    #[test]
    fn the_largest_texture_fits_its_indices_and_its_budget() {
        let side = super::super::MAX_TEXTURE_SIZE;
        let stored = stored_texels(side, side);
        assert!(i32::try_from(stored + SPAN).is_ok(), "{stored} texels are addressed by lanes of 32 bits");
        let raw = side as usize * side as usize * 4 / 3;
        assert!(stored * 100 < raw * 113, "{stored} texels for {raw}: the border costs an eighth");
    }

    fn level(width: u32, height: u32, value: impl Fn(u32, u32) -> u8) -> LevelRows {
        let texels = (0..width * height).map(|i| [value(i % width, i / width), 0, 0, 255]).collect();
        LevelRows { width, height, texels }
    }

    fn chain(base: LevelRows, format: TextureFormat) -> Vec<LevelRows> {
        std::iter::successors(Some(base), |rows| halved(rows, format)).collect()
    }

    #[test]
    fn every_size_ends_in_one_texel() {
        for (width, height, count) in [(1, 1, 1), (1, 4096, 13), (5, 3, 3), (7, 16, 5), (1000, 1, 10)] {
            let levels = chain(level(width, height, |_, _| 99), TextureFormat::Srgb);
            assert_eq!(levels.len(), count, "levels of {width}x{height}");
            assert!(
                levels.iter().all(|level| level.texels.iter().all(|t| *t == [99, 0, 0, 255])),
                "a constant stays constant at {width}x{height}"
            );
        }
    }

    #[test]
    fn an_odd_axis_is_shared_out_exactly() {
        for to in [1_u32, 2, 3, 50] {
            let from = 2 * to + 1;
            let mut total = vec![0.0_f32; from as usize];
            for index in 0..to {
                let covered = CoveredTexels::new(index, from, to);
                for (k, weight) in covered.weights.iter().enumerate() {
                    total[covered.first as usize + k] += weight;
                }
            }
            let expected = to as f32 / from as f32;
            assert!(
                total.iter().all(|t| (t - expected).abs() < 1e-6),
                "every texel of {from} counts the same: {total:?}"
            );
        }
    }

    #[test]
    fn black_and_white_meet_in_linear_light() {
        let checker = level(2, 2, |x, y| if (x + y) % 2 == 0 { 255 } else { 0 });
        let srgb = chain(checker.clone(), TextureFormat::Srgb);
        assert_eq!(srgb[1].texels[0][0], 188, "half the light is sRGB 188");
        let data = chain(checker, TextureFormat::Linear);
        assert_eq!(data[1].texels[0][0], 128, "half of 255, rounded up");
    }

    #[test]
    fn transparent_texels_do_not_bleed() {
        let texels = vec![[255, 0, 0, 255], [0, 255, 0, 0]];
        let levels = chain(LevelRows { width: 2, height: 1, texels }, TextureFormat::Srgb);
        assert_eq!(levels[1].texels[0], [255, 0, 0, 128], "only the red one is seen");
    }
}
