//! Which cells of a square are too near to the islands that were laid so far.
//!
//! All positions in a row are tested at once: each bit of a word stands for one of them.

use super::mask::{CellRun, Mask};

/// A square of cells, most of them blocked in the end.
pub(super) struct Occupancy {
    side: usize,
    /// How many words the bits of a row take.
    words: usize,
    levels: usize,
    /// By row and level: a bit for each cell, 1 if one of 2ᶫᵉᵛᵉˡ cells from it on is blocked; then `BEYOND` words of zeros.
    blocked: Vec<u64>,
    /// By row: how many free cells lie next to one another at most.
    open: Vec<usize>,
    /// The distance of islands from one another and from the border, in cells.
    margin: f64,
    /// A bit for each position of a mask in a row: 1 if it is blocked there.
    conflicts: Vec<u64>,
    /// The runs of a mask: first those that were blocked last, as they often are in the next row, too.
    runs: Vec<CellRun>,
}

/// Where the lower left cell of a mask lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Cell {
    pub(super) x: usize,
    pub(super) y: usize,
}

/// An island in one of its turns.
pub(super) struct LaidMask {
    /// How many quarters it is turned.
    pub(super) quarters: usize,
    pub(super) cell: Cell,
}

const BITS: usize = u64::BITS as usize;
/// Bits of the last positions that are moved down come from so many words beyond the end of their row.
const BEYOND: usize = 1;

impl Occupancy {
    pub(super) fn new(side: usize, margin: f64) -> Self {
        let words = side.div_ceil(BITS);
        let levels = side.ilog2() as usize + 1;
        let blocked = vec![0; side * levels * (words + BEYOND)];
        let (open, conflicts) = (vec![side; side], vec![0; words]);
        Self { side, words, levels, blocked, open, margin, conflicts, runs: Vec::new() }
    }

    /// Where the bits of a row begin.
    fn start(&self, row: usize, level: usize) -> usize {
        (row * self.levels + level) * (self.words + BEYOND)
    }

    /// The turn and the position in which the upper side is lowest, of those not below a row for each mask.
    pub(super) fn best(&mut self, masks: &[Mask], lowest: impl Fn(&Mask) -> usize) -> Option<LaidMask> {
        let mut best = None;
        let mut end = usize::MAX;
        for (quarters, mask) in masks.iter().enumerate() {
            if let Some(cell) = self.lowest(mask, lowest(mask), end) {
                end = cell.y + mask.height;
                best = Some(LaidMask { quarters, cell });
            }
        }
        best
    }

    /// The lowest position of a mask that is not below a row and not as high as `end` with its upper side, and there the
    /// leftmost.
    fn lowest(&mut self, mask: &Mask, row: usize, end: usize) -> Option<Cell> {
        let border = self.margin.ceil() as usize;
        let free = self.side.checked_sub(2 * border)?;
        let last_x = border + free.checked_sub(mask.width)?;
        let last_y = (border + free.checked_sub(mask.height)?).min(end.checked_sub(mask.height + 1)?);
        let widest = mask.widest;
        self.runs.clone_from(&mask.runs);
        (row.max(border)..=last_y).find_map(|y| {
            if self.open[y + widest.row] < widest.to - widest.from {
                return None;
            }
            let x = self.leftmost(y, border, last_x)?;
            Some(Cell { x, y })
        })
    }

    /// The leftmost position of the runs in a row, from `first` to `last`.
    fn leftmost(&mut self, y: usize, first: usize, last: usize) -> Option<usize> {
        let last_word = last / BITS;
        self.conflicts[..=last_word].fill(0);
        let mut x = first;
        for at in 0..self.runs.len() {
            let run = self.runs[at];
            let length = run.to - run.from;
            let level = length.ilog2() as usize;
            let start = self.start(y + run.row, level);
            let row = &self.blocked[start..start + self.words + BEYOND];
            let first_word = x / BITS;
            let conflicts = &mut self.conflicts[first_word..=last_word];
            add_shifted(conflicts, &row[first_word..], run.from);
            // Two overlapping stretches of the level's length are the whole run.
            if length > 1 << level {
                add_shifted(conflicts, &row[first_word..], run.to - (1 << level));
            }
            x = first_free(&self.conflicts, x);
            if x > last {
                self.runs[..=at].rotate_right(1);
                return None;
            }
        }
        Some(x)
    }

    /// Blocks the cells that are nearer than the margin to those of a mask.
    pub(super) fn lay(&mut self, mask: &Mask, at: Cell) {
        let reach = self.reach();
        for run in &mask.runs {
            for (offset, &width) in reach.iter().enumerate() {
                let row = at.y + run.row;
                let from = (at.x + run.from).saturating_sub(width);
                let to = (at.x + run.to + width).min(self.side);
                if row + offset < self.side {
                    self.block(row + offset, from, to);
                }
                if offset > 0 && row >= offset {
                    self.block(row - offset, from, to);
                }
            }
        }
        let beyond = reach.len() - 1;
        let rows = at.y.saturating_sub(beyond)..(at.y + mask.height + beyond).min(self.side);
        rows.for_each(|row| self.complete(row));
    }

    /// By distance in rows: to how many cells on either side there are points nearer than the margin.
    fn reach(&self) -> Vec<usize> {
        // Between cells one row apart there is no distance, between those two rows apart that of one.
        let gap = |cells: usize| cells.saturating_sub(1) as f64;
        let is_near = |x: usize, y: usize| {
            (x, y) == (0, 0) || gap(x) * gap(x) + gap(y) * gap(y) < self.margin * self.margin
        };
        let rows = (0..).take_while(|&y| is_near(0, y));
        rows.map(|y| (0..).take_while(|&x| is_near(x, y)).count() - 1).collect()
    }

    fn block(&mut self, row: usize, from: usize, to: usize) {
        let start = self.start(row, 0);
        for word in from / BITS..to.div_ceil(BITS) {
            let low = from.saturating_sub(word * BITS);
            let high = (to - word * BITS).min(BITS);
            self.blocked[start + word] |= (u64::MAX >> (BITS - (high - low))) << low;
        }
    }

    /// Computes all levels of a row from the first, and how open it is.
    fn complete(&mut self, row: usize) {
        for level in 1..self.levels {
            let by = 1 << (level - 1);
            let [start_below, start] = [level - 1, level].map(|level| self.start(row, level));
            let (before, this) = self.blocked.split_at_mut(start);
            let below = &before[start_below..];
            let this = &mut this[..self.words];
            this.copy_from_slice(&below[..self.words]);
            let within = self.words.saturating_sub(by / BITS);
            add_shifted(&mut this[..within], below, by);
        }
        let start = self.start(row, 0);
        self.open[row] = longest_free(&self.blocked[start..start + self.words], self.side);
    }
}

/// Adds bits that are moved down.
fn add_shifted(bits: &mut [u64], words: &[u64], by: usize) {
    let (from, shift) = (by / BITS, by % BITS);
    let low = &words[from..from + bits.len()];
    let high = &words[from + 1..from + 1 + bits.len()];
    for ((bits, &low), &high) in bits.iter_mut().zip(low).zip(high) {
        // In two steps, as a word cannot be moved by all of its bits.
        *bits |= low >> shift | (high << 1) << (BITS - 1 - shift);
    }
}

/// The first bit from `from` on that is 0; beyond the end if there is none.
fn first_free(words: &[u64], from: usize) -> usize {
    first_set(words.len(), from, |word| !words[word])
}

/// The first bit from `from` on that is 1; beyond the end if there is none.
fn first_blocked(words: &[u64], from: usize) -> usize {
    first_set(words.len(), from, |word| words[word])
}

fn first_set(words: usize, from: usize, bits: impl Fn(usize) -> u64) -> usize {
    let mut mask = u64::MAX << (from % BITS);
    for word in from / BITS..words {
        let found = bits(word) & mask;
        if found != 0 {
            return word * BITS + found.trailing_zeros() as usize;
        }
        mask = u64::MAX;
    }
    words * BITS
}

/// How many of the first bits are 0 next to one another, at most.
fn longest_free(words: &[u64], end: usize) -> usize {
    let (mut longest, mut from) = (0, 0);
    while from < end {
        let to = first_blocked(words, from).min(end);
        longest = longest.max(to - from);
        from = first_free(words, to + 1);
    }
    longest
}
