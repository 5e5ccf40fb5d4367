//! Where texels lie in memory: every mip level in blocks of 8 by 8 texels, each
//! with a border, one level after the other.
//!
//! A block stores 9 by 9 texels: its own, and the column and the row that
//! follow. So the 2 by 2 texels of a bilinear look-up whose first lies in the
//! block are two short runs of one block, wherever the first is: no look-up
//! meets an edge, and neighbours in the picture share cache lines in both
//! directions. The border costs 27 % of memory.
//!
//! What follows the last column is the first, as [`Wrap::Repeat`] wants it. The
//! other modes never see that: they hold the position to the centres of the
//! outermost texels, where the weight of what follows is 0.
//!
//! [`Wrap::Repeat`]: super::Wrap::Repeat

use super::mips::Rows;

/// Texels of a block's side, a power of two.
pub(super) const SIDE: u32 = 8;
/// Texels from a stored row of a block to the next.
pub(super) const PITCH: u32 = SIDE + 1;
/// Texels that a block stores.
pub(super) const AREA: u32 = PITCH * PITCH;
/// Texels from the first to the last of a footprint, in memory, both counted.
const SPAN: usize = PITCH as usize + 2;
/// More than the 15 levels of the largest texture, and a power of two: a number
/// below it needs no check.
const MAX_LEVELS: usize = 16;

/// All levels of a texture.
#[derive(Clone, Debug)]
pub(super) struct Blocks {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) level_count: u32,
    /// Where each level starts. 16384² texels with their levels and borders are
    /// fewer than 2³².
    starts: [u32; MAX_LEVELS],
    texels: Vec<[u8; 4]>,
}

/// The texel of a look-up and its right neighbour, then the two below, each as
/// bytes red, green, blue, alpha, red … from the lowest on.
pub(super) type Footprint = [u64; 2];

impl Blocks {
    /// The base level first; each next half as wide and high.
    pub(super) fn new(base: Rows, smaller: impl Fn(&Rows) -> Option<Rows>) -> Self {
        let (width, height) = (base.width, base.height);
        let mut blocks = Self { width, height, level_count: 0, starts: [0; MAX_LEVELS], texels: Vec::new() };
        blocks.texels.reserve_exact(stored_texels(width, height));
        let mut level = Some(base);
        while let Some(rows) = level {
            blocks.push(&rows);
            level = smaller(&rows);
        }
        blocks
    }

    fn push(&mut self, rows: &Rows) {
        self.starts[self.level_count as usize] = self.texels.len() as u32;
        self.level_count += 1;
        for top in (0..rows.height).step_by(SIDE as usize) {
            for left in (0..rows.width).step_by(SIDE as usize) {
                for y in top..top + PITCH {
                    self.texels.extend(run(rows.row(y % rows.height), left));
                }
            }
        }
    }

    /// The size of a level in texels.
    #[inline]
    pub(super) fn size(&self, level: u32) -> [u32; 2] {
        [(self.width >> level).max(1), (self.height >> level).max(1)]
    }

    /// The position within a level of `width` texels a row of its texel (x, y).
    #[inline]
    pub(super) fn index(width: u32, [x, y]: [u32; 2]) -> u32 {
        let block = (y / SIDE) * width.div_ceil(SIDE) + x / SIDE;
        block * AREA + (y % SIDE) * PITCH + x % SIDE
    }

    /// A texel of the base level.
    pub(super) fn base_texel(&self, place: [u32; 2]) -> [u8; 4] {
        self.texels[Self::index(self.width, place) as usize]
    }

    /// Where a level starts.
    #[inline(always)]
    pub(super) fn start(&self, level: u32) -> u32 {
        self.starts[level as usize % MAX_LEVELS]
    }

    /// The texel at an index counted from the start of the base level, its right
    /// neighbour and the two below.
    #[inline(always)]
    pub(super) fn footprint(&self, index: u32) -> Footprint {
        let first = index as usize;
        let texels: &[[u8; 4]] = &self.texels[first..first + SPAN];
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
    let stored = |[width, height]: [u32; 2]| (width.div_ceil(SIDE) * height.div_ceil(SIDE) * AREA) as usize;
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

    /// A picture whose texels hold their own coordinates.
    fn numbered(width: u32, height: u32) -> Blocks {
        let texels = (0..width * height).map(|i| at(i % width, i / width)).collect();
        Blocks::new(Rows { width, height, texels }, |_| None)
    }

    fn at(x: u32, y: u32) -> [u8; 4] {
        ((y << 16) | x).to_le_bytes()
    }

    #[test]
    fn every_footprint_is_two_runs_of_one_block() {
        for (width, height) in [(1, 1), (1, 9), (5, 3), (8, 8), (17, 16), (23, 31)] {
            let blocks = numbered(width, height);
            for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
                let (right, below) = ((x + 1) % width, (y + 1) % height);
                let expected = [pair(at(x, y), at(right, y)), pair(at(x, below), at(right, below))];
                assert_eq!(blocks.base_texel([x, y]), at(x, y), "the texel ({x}, {y}) of {width}x{height}");
                let got = blocks.footprint(Blocks::index(width, [x, y]));
                assert_eq!(got, expected, "at ({x}, {y}) of {width}x{height}");
            }
        }
    }

    #[test]
    fn the_largest_texture_fits_its_indices_and_its_budget() {
        let side = super::super::MAX_TEXTURE_SIZE;
        let stored = stored_texels(side, side);
        assert!(u32::try_from(stored + SPAN).is_ok(), "{stored} texels are addressed by 32 bits");
        let raw = side as usize * side as usize * 4 / 3;
        assert!(stored * 100 < raw * 128, "{stored} texels for {raw}: the border costs 27 %");
    }
}
