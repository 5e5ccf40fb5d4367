//! The cells that space is divided into, and how many triangles they leave.

use trigon_math::{Bounds3, DVec3, Vec3};

use super::SourceTriangles;

/// The most bits of a cell's coordinate along each axis: a set of cells takes 16 MB then, which fits into many caches.
const MOST_BITS: u32 = 9;

/// The cells along the longest side of the mesh in the finest grids: the fourth roots of two apart, so that of two
/// neighbours one leaves about 1.4 times as many triangles. From each of them follow the grids with cells of twice the
/// size, four times and so on.
const FINEST: [u32; 4] = [512, 430, 362, 304];

/// A grid of cubic cells around a mesh.
#[derive(Clone, Copy, Debug)]
pub(super) struct CellGrid {
    min: DVec3,
    /// The longest side of the mesh.
    size: f64,
    /// The finest cells along it.
    count: u32,
    /// The bits of the coordinates of these.
    bits: u32,
    /// How often the finest cells are doubled.
    level: u32,
}

impl CellGrid {
    /// The finest grid that leaves at most so many triangles, at least one.
    pub(super) fn with_at_most(source: &SourceTriangles<'_>, most: usize) -> Self {
        let points = source.corners().flatten().map(|corner| source.position(corner).as_dvec3());
        let bounds = Bounds3::from_points(points.filter(|point| point.is_finite()));
        let size = bounds.size().max_element().max(0.0);
        // Twice as many cells along a side as a square of so many triangles needs are enough.
        let bits = (2..MOST_BITS).find(|bits| 1 << (2 * bits) >= most.saturating_mul(4)).unwrap_or(MOST_BITS);
        let of = |count| Self { min: bounds.min, size, count: count >> (MOST_BITS - bits), bits, level: 0 };
        let finest = FINEST.into_iter().map(of).filter_map(|grid| {
            let level = grid.most_triangles(source).iter().position(|&count| count <= most)?;
            Some(Self { level: level as u32, ..grid })
        });
        finest.min_by(|a, b| a.cell_size().total_cmp(&b.cell_size())).expect("one cell leaves one triangle")
    }

    /// For each level, until one cell is left, the most triangles that can be left: those with corners in three cells,
    /// and one for each cell that has none of these. For the latter all cells are counted.
    fn most_triangles(&self, source: &SourceTriangles<'_>) -> Vec<usize> {
        let (mut counts, mut cells) = (vec![0; self.bits as usize + 1], CellSet::new(self.bits));
        for corners in source.corners() {
            let [a, b, c] = corners.map(|corner| self.cell(source.position(corner)));
            [a, b, c].into_iter().for_each(|cell| cells.insert(cell));
            let levels = self.levels_apart(a, b).min(self.levels_apart(b, c)).min(self.levels_apart(c, a));
            counts[..levels].iter_mut().for_each(|count| *count += 1);
        }
        for count in &mut counts {
            *count += cells.count();
            cells = cells.halved();
        }
        counts
    }

    /// At how many levels, from the finest on, two of the finest cells differ.
    fn levels_apart(&self, a: u32, b: u32) -> usize {
        let differences = a ^ b;
        let of_axes = differences | differences >> self.bits | differences >> (2 * self.bits);
        (u32::BITS - (of_axes & ((1 << self.bits) - 1)).leading_zeros()) as usize
    }

    /// The cells of this grid, none of them yet.
    pub(super) fn no_cells(&self) -> CellSet {
        CellSet::new(self.bits - self.level)
    }

    /// The cell of a position.
    pub(super) fn cell(&self, position: Vec3) -> u32 {
        let scale = if self.size > 0.0 { f64::from(self.count) / self.size } else { 0.0 };
        let cells = (position.as_dvec3() - self.min) * scale;
        // Negative ones and those that are no numbers become 0.
        let [x, y, z] = cells.to_array().map(|cell| (cell as u32).min(self.count - 1) >> self.level);
        packed([x, y, z], self.bits - self.level)
    }

    fn cell_size(&self) -> f64 {
        self.size / f64::from(self.count) * f64::from(1 << self.level)
    }

    pub(super) fn diagonal(&self) -> f64 {
        self.cell_size() * 3.0_f64.sqrt()
    }
}

/// A cell by its coordinates, each of so many bits.
fn packed([x, y, z]: [u32; 3], bits: u32) -> u32 {
    x | y << bits | z << (2 * bits)
}

/// Some cells of a grid, which it numbers in the order of their coordinates.
pub(super) struct CellSet {
    /// Of a coordinate.
    bits: u32,
    words: Vec<u64>,
}

impl CellSet {
    fn new(bits: u32) -> Self {
        Self { bits, words: vec![0; 1 << (3 * bits).saturating_sub(6)] }
    }

    pub(super) fn insert(&mut self, cell: u32) {
        self.words[cell as usize / 64] |= 1 << (cell % 64);
    }

    fn count(&self) -> usize {
        self.words.iter().map(|word| word.count_ones() as usize).sum()
    }

    fn iter(&self) -> impl Iterator<Item = u32> + '_ {
        let words = (0..).step_by(64).zip(&self.words).filter(|&(_, &word)| word != 0);
        words.flat_map(|(first, &word)| {
            (0..64).filter(move |bit| word >> bit & 1 == 1).map(move |bit| first + bit)
        })
    }

    /// The cells of twice the size that hold them.
    fn halved(&self) -> Self {
        let mut halved = Self::new(self.bits.saturating_sub(1));
        let coordinates = |cell| [0, 1, 2].map(|axis| cell >> (axis * self.bits) & ((1 << self.bits) - 1));
        self.iter().for_each(|cell| {
            halved.insert(packed(coordinates(cell).map(|coordinate| coordinate / 2), halved.bits));
        });
        halved
    }

    /// Numbers them.
    pub(super) fn numbered(self) -> NumberedCells {
        let mut before = Vec::with_capacity(self.words.len());
        let mut count = 0;
        for word in &self.words {
            before.push(count);
            count += word.count_ones();
        }
        NumberedCells { cells: self, before, count: count as usize }
    }
}

/// Cells with numbers from 0.
pub(super) struct NumberedCells {
    cells: CellSet,
    /// How many there are before each word of the set.
    before: Vec<u32>,
    pub(super) count: usize,
}

impl NumberedCells {
    /// The number of a cell of the set.
    pub(super) fn number(&self, cell: u32) -> usize {
        let word = cell as usize / 64;
        let lower = self.cells.words[word] & ((1 << (cell % 64)) - 1);
        (self.before[word] + lower.count_ones()) as usize
    }
}
