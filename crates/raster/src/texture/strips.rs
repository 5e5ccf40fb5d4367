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
//! [`Wrap::Repeat`]: super::Wrap::Repeat

use super::mips::LevelRows;

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
}
