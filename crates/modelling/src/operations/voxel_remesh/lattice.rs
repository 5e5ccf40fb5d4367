//! A lattice of points, and which of them are inside a closed surface.

use trigon_math::{Bounds3, DVec3};

use super::OPERATION;
use super::lines::LineCrossing;
use crate::refusal::Refusal;

/// A box of points with equal distances. Those on its sides are outside the surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lattice {
    /// The position of the first point, in distances between points.
    first: [i64; 3],
    /// The number of points along each axis.
    pub(super) counts: [u64; 3],
    /// The distance between points.
    pub(super) step: f64,
}

impl Lattice {
    /// The most points: 256 MiB of bits. A cube of 1290 points each way.
    const MOST: u64 = 1 << 31;

    /// Around some bounds that are not empty. Points lie at multiples of the step, so that equal parts in equal positions
    /// have equal results whatever is beside them.
    ///
    /// # Errors
    /// There are too many points.
    pub(super) fn around(bounds: Bounds3, step: f64) -> Result<Self, Refusal> {
        let [low, high] = [(bounds.min / step).floor(), (bounds.max / step).ceil()];
        let sizes = (high - low + DVec3::splat(3.0)).to_array();
        // An index that is a sum of these is exact.
        let is_near = low.abs().max(high.abs()).max_element() < f64::from(1 << 30);
        if !is_near || sizes.iter().product::<f64>() > Self::MOST as f64 {
            let range = "larger: the grid would have more than 2147483648 points";
            let parameter = "the size of voxels";
            return Err(Refusal::OutOfRange { parameter, value: step, range });
        }
        let first = (low - DVec3::ONE).to_array().map(|at| at as i64);
        Ok(Self { first, counts: sizes.map(|size| size as u64), step })
    }

    pub(super) fn coordinate(&self, axis: usize, number: u64) -> f64 {
        (self.first[axis] + number as i64) as f64 * self.step
    }

    /// The number of the first point that is not before a coordinate, as if the lattice had no end.
    pub(super) fn number_from(&self, axis: usize, coordinate: f64) -> i64 {
        ((coordinate / self.step).ceil() as i64).saturating_sub(self.first[axis])
    }

    /// The numbers of a point along the axes, by its index: along x first, then along y, then along z.
    pub(super) fn numbers(&self, index: u64) -> [u64; 3] {
        let rest = index / self.counts[0];
        [index % self.counts[0], rest % self.counts[1], rest / self.counts[1]]
    }

    /// How far the indices of neighbours along an axis are apart.
    pub(super) fn stride(&self, axis: usize) -> u64 {
        [1, self.counts[0], self.counts[0] * self.counts[1]][axis]
    }

    /// The index of a line along an axis, from the numbers of its points along the two axes after it.
    pub(super) fn line(&self, axis: usize, [b, c]: [u64; 2]) -> u64 {
        b + self.counts[(axis + 1) % 3] * c
    }

    /// The memory of [`InsidePoints`] in bytes.
    pub(super) fn bytes(&self) -> u64 {
        self.words_per_row() * self.counts[1] * self.counts[2] * 8
    }

    fn words_per_row(&self) -> u64 {
        self.counts[0].div_ceil(64)
    }
}

/// Which points of a lattice are inside: a bit for each, with whole words for each row along x.
pub(super) struct InsidePoints {
    words: Vec<u64>,
    lattice: Lattice,
}

impl InsidePoints {
    /// Those around which a surface winds, by its crossings with the lines along x. These are sorted.
    ///
    /// # Errors
    /// None are inside.
    pub(super) fn new(lattice: Lattice, crossings: &[LineCrossing]) -> Result<Self, Refusal> {
        let words = vec![0; (lattice.bytes() / 8) as usize];
        let mut inside = Self { words, lattice };
        for row in crossings.chunk_by(|a, b| a.line == b.line) {
            let mut winding = 0_i64;
            for (crossing, next) in row.iter().zip(row.iter().skip(1)) {
                winding += i64::from(crossing.winding);
                if winding != 0 {
                    let ends = [crossing, next].map(|end| lattice.number_from(0, end.coordinate));
                    inside.fill(crossing.line, ends);
                }
            }
        }
        if inside.words.iter().all(|&word| word == 0) {
            let reason = "everything is thinner than a voxel: use smaller ones";
            return Err(Refusal::NotPossible { operation: OPERATION, reason });
        }
        Ok(inside)
    }

    fn fill(&mut self, line: u64, [from, to]: [i64; 2]) {
        // Rounding may not reach the sides.
        let last = self.lattice.counts[0] as i64 - 1;
        let start = line * self.lattice.words_per_row();
        for number in from.max(1)..to.min(last) {
            self.words[(start + number as u64 / 64) as usize] |= 1 << (number % 64);
        }
    }

    pub(super) fn contains(&self, [x, y, z]: [u64; 3]) -> bool {
        let row = (y + self.lattice.counts[1] * z) * self.lattice.words_per_row();
        self.words[(row + x / 64) as usize] >> (x % 64) & 1 != 0
    }

    /// Calls a function with each point of which exactly one of itself and the next one along an axis is inside, by index,
    /// and whether itself is.
    pub(super) fn for_each_change(&self, axis: usize, mut change: impl FnMut(u64, bool)) {
        let lattice = self.lattice;
        let words = lattice.words_per_row() as usize;
        let rows_to_next = [0, 1, lattice.counts[1] as usize][axis];
        for (number, row) in self.words.chunks(words).enumerate() {
            // The points of the last rows are outside, and have no next ones.
            let next = self.words.get((number + rows_to_next) * words..(number + rows_to_next + 1) * words);
            for (at, &word) in row.iter().enumerate() {
                let beside = match next {
                    Some(_) if axis == 0 => word >> 1 | row.get(at + 1).map_or(0, |next| next << 63),
                    Some(next) => next[at],
                    None => 0,
                };
                let mut changes = word ^ beside;
                while changes != 0 {
                    let bit = changes.trailing_zeros();
                    changes &= changes - 1;
                    let x = at as u64 * 64 + u64::from(bit);
                    change(x + lattice.counts[0] * number as u64, word >> bit & 1 != 0);
                }
            }
        }
    }
}
