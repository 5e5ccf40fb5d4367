//! Sparse systems of linear equations with a Hermitian positive definite matrix.
//!
//! Texture coordinates are complex numbers for conformal maps, u + iv: such a map then is a linear condition on them,
//! and the matrix has half as many rows as one of real numbers. They are stored as vectors, (re, im). Where the
//! equations of u and v differ, the entries are matrices of two rows: see `block`.
//!
//! The factor is computed row by row as in T. Davis, *Direct Methods for Sparse Linear Systems*, 2006, chapter 4.
//! A factor is exact where iterations are slow: the least eigenvalue of a conformal energy is tiny, because many
//! maps are almost conformal. Everything is done in one order, so that results have the same bits everywhere.

use trigon_math::DVec2;

use super::block::Block;
use super::lists::SortedLists;
use super::ordering::{Graph, elimination_order};

/// The product of two complex numbers.
pub(super) fn times(a: DVec2, b: DVec2) -> DVec2 {
    DVec2::new(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x)
}

/// The complex conjugate.
pub(super) fn conjugate(a: DVec2) -> DVec2 {
    DVec2::new(a.x, -a.y)
}

/// An entry of a matrix.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry<B = DVec2> {
    pub(super) row: u32,
    pub(super) column: u32,
    pub(super) value: B,
}

/// Why a matrix has no factor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum NoFactor {
    /// It would take this many bytes of memory, which are not allowed.
    Memory(u64),
    /// It is not positive definite, but for rounding.
    NotPositive,
}

/// Where a matrix and its factor have entries: matrices that differ only in values share it.
#[derive(Debug)]
pub(super) struct MatrixPattern {
    /// The unknowns in the order of elimination.
    order: Vec<u32>,
    /// By given entry: its position in the upper triangle.
    slots: Vec<EntrySlot>,
    /// By column: the rows of the upper triangle.
    upper: SortedLists,
    /// By column: the row of the first entry of the factor below its diagonal, the parent in the elimination tree.
    parents: Vec<u32>,
    /// By column: where its entries of the factor begin; one entry more.
    starts: Vec<usize>,
}

/// Where an entry goes, and whether transposed.
#[derive(Debug, Clone, Copy)]
struct EntrySlot {
    position: u32,
    is_adjoint: bool,
}

/// A factor of a matrix: with it, systems are solved.
#[derive(Debug)]
pub(super) struct Factor<B = DVec2> {
    order: Vec<u32>,
    lower: Lower<B>,
}

/// A lower triangle by columns; the inverse of the diagonal comes first in each.
#[derive(Debug)]
struct Lower<B> {
    starts: Vec<usize>,
    rows: Vec<u32>,
    values: Vec<B>,
}

/// Finds in which columns a row of the factor has entries.
struct RowSearch<'p> {
    upper: &'p SortedLists,
    parents: &'p [u32],
    /// By column: one more than the last row that reached it.
    reached: Vec<u32>,
    /// Columns of the row, each after those that it depends on.
    columns: Vec<u32>,
    path: Vec<u32>,
}

const NO_PARENT: u32 = u32::MAX;

fn elimination_tree(upper: &SortedLists, size: usize) -> Vec<u32> {
    let mut parents = vec![NO_PARENT; size];
    // Shortcuts to the root that is known so far.
    let mut ancestor = vec![NO_PARENT; size];
    for column in 0..size {
        for &row in upper.list(column) {
            let mut here = row;
            while here != NO_PARENT && here < column as u32 {
                let above = std::mem::replace(&mut ancestor[here as usize], column as u32);
                if above == NO_PARENT {
                    parents[here as usize] = column as u32;
                }
                here = above;
            }
        }
    }
    parents
}

impl<'p> RowSearch<'p> {
    fn new(upper: &'p SortedLists, parents: &'p [u32]) -> Self {
        Self { upper, parents, reached: vec![0; parents.len()], columns: Vec::new(), path: Vec::new() }
    }

    fn find(&mut self, row: usize) {
        let mark = row as u32 + 1;
        self.columns.clear();
        self.reached[row] = mark;
        for &column in self.upper.list(row) {
            let mut here = column;
            while self.reached[here as usize] != mark {
                self.reached[here as usize] = mark;
                self.path.push(here);
                here = self.parents[here as usize];
            }
            // Paths that were found later are needed earlier; each is read from its end.
            self.columns.extend(self.path.drain(..).rev());
        }
        self.columns.reverse();
    }
}

impl MatrixPattern {
    /// The pattern of a matrix with entries at these rows and columns: on and above the diagonal, or for each of them
    /// its transposed one, but not both. Positions may occur several times. `memory` bounds the bytes that a factor
    /// with blocks of type `B` takes.
    pub(super) fn new<B: Block>(size: usize, positions: &[[u32; 2]], memory: u64) -> Result<Self, NoFactor> {
        let graph = Graph::new(size, positions.iter().copied());
        let order = elimination_order(&graph);
        let mut index = vec![0; size];
        for (position, &unknown) in (0..).zip(&order) {
            index[unknown as usize] = position;
        }
        let (upper, slots) = upper_triangle(size, positions, &index);
        let parents = elimination_tree(&upper, size);
        let mut pattern = Self { order, slots, upper, parents, starts: Vec::new() };
        pattern.starts = pattern.column_starts();
        let bytes = pattern.entries() as u64 * (size_of::<B>() + size_of::<u32>()) as u64;
        if bytes > memory {
            return Err(NoFactor::Memory(bytes));
        }
        Ok(pattern)
    }

    /// How many entries a factor has.
    fn entries(&self) -> usize {
        self.starts[self.order.len()]
    }

    fn column_starts(&self) -> Vec<usize> {
        let size = self.order.len();
        let mut starts = vec![0; size + 1];
        let mut search = RowSearch::new(&self.upper, &self.parents);
        for row in 0..size {
            search.find(row);
            starts[row + 1] += 1;
            search.columns.iter().for_each(|&column| starts[column as usize + 1] += 1);
        }
        for column in 0..size {
            starts[column + 1] += starts[column];
        }
        starts
    }

    /// Factors the matrix with these values, in the order of the positions. Those of one position are added up.
    pub(super) fn factor<B: Block>(&self, values: &[B]) -> Result<Factor<B>, NoFactor> {
        let mut upper = vec![B::NOTHING; self.upper.total()];
        for (slot, &value) in self.slots.iter().zip(values) {
            upper[slot.position as usize] += if slot.is_adjoint { value.adjoint() } else { value };
        }
        let count = self.entries();
        let mut lower =
            Lower { starts: self.starts.clone(), rows: vec![0; count], values: vec![B::NOTHING; count] };
        lower.compute(self, &upper)?;
        Ok(Factor { order: self.order.clone(), lower })
    }
}

/// The upper triangle of a permuted matrix, and where each entry is in it.
fn upper_triangle(size: usize, positions: &[[u32; 2]], index: &[u32]) -> (SortedLists, Vec<EntrySlot>) {
    let permuted = |position: &[u32; 2]| position.map(|unknown| index[unknown as usize]);
    let entries = positions.iter().map(|position| {
        let [row, column] = permuted(position);
        [row.max(column), row.min(column)]
    });
    let upper = SortedLists::new(size, entries);
    let slot = |position: &[u32; 2]| {
        let [row, column] = permuted(position);
        let (low, high) = (row.min(column), row.max(column) as usize);
        let offset = upper.list(high).partition_point(|&other| other < low);
        EntrySlot { position: (upper.start(high) + offset) as u32, is_adjoint: row > column }
    };
    let slots = positions.iter().map(slot).collect();
    (upper, slots)
}

impl<B: Block> Factor<B> {
    /// Factors a matrix of which the entries on and above the diagonal are given, or for each of them its
    /// transposed conjugate, but not both. Entries of one position are added up. `memory` bounds the bytes that
    /// the factor takes.
    pub(super) fn new(size: usize, entries: &[Entry<B>], memory: u64) -> Result<Self, NoFactor> {
        let positions: Vec<[u32; 2]> = entries.iter().map(|entry| [entry.row, entry.column]).collect();
        let values: Vec<B> = entries.iter().map(|entry| entry.value).collect();
        MatrixPattern::new::<B>(size, &positions, memory)?.factor(&values)
    }

    /// Solves a system: the right-hand side, by unknown.
    pub(super) fn solve(&self, right_hand_side: &[DVec2]) -> Vec<DVec2> {
        let mut values: Vec<DVec2> =
            self.order.iter().map(|&unknown| right_hand_side[unknown as usize]).collect();
        let Lower { starts, rows, values: factors } = &self.lower;
        for column in 0..values.len() {
            let (start, end) = (starts[column], starts[column + 1]);
            let value = factors[start].apply(values[column]);
            values[column] = value;
            for (&row, factor) in rows[start + 1..end].iter().zip(&factors[start + 1..end]) {
                values[row as usize] -= factor.apply(value);
            }
        }
        for column in (0..values.len()).rev() {
            let (start, end) = (starts[column], starts[column + 1]);
            let mut value = values[column];
            for (&row, factor) in rows[start + 1..end].iter().zip(&factors[start + 1..end]) {
                value -= factor.adjoint().apply(values[row as usize]);
            }
            values[column] = factors[start].adjoint().apply(value);
        }
        let mut solution = vec![DVec2::ZERO; values.len()];
        for (&unknown, value) in self.order.iter().zip(values) {
            solution[unknown as usize] = value;
        }
        solution
    }
}

impl<B: Block> Lower<B> {
    /// Row after row: each is the solution of a triangular system with the rows before.
    fn compute(&mut self, pattern: &MatrixPattern, upper: &[B]) -> Result<(), NoFactor> {
        let size = pattern.order.len();
        let mut search = RowSearch::new(&pattern.upper, &pattern.parents);
        let mut ends = self.starts.clone();
        let mut row_values = vec![B::NOTHING; size];
        for row in 0..size {
            search.find(row);
            let start = pattern.upper.start(row);
            for (&column, &value) in pattern.upper.list(row).iter().zip(&upper[start..]) {
                row_values[column as usize] = value;
            }
            let whole = std::mem::replace(&mut row_values[row], B::NOTHING);
            let mut diagonal = whole;
            for &column in &search.columns {
                let column = column as usize;
                let (start, end) = (self.starts[column], ends[column]);
                let value =
                    self.values[start].product(std::mem::replace(&mut row_values[column], B::NOTHING));
                for (&row, factor) in self.rows[start + 1..end].iter().zip(&self.values[start + 1..end]) {
                    row_values[row as usize] -= factor.product(value);
                }
                let value = value.adjoint();
                diagonal -= value.product(value.adjoint());
                self.rows[end] = row as u32;
                self.values[end] = value;
                ends[column] += 1;
            }
            self.rows[ends[row]] = row as u32;
            self.values[ends[row]] = diagonal.inverse_factor(whole).ok_or(NoFactor::NotPositive)?;
            ends[row] += 1;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use trigon_math::SplitMix64;

    use super::*;

    /// A random matrix of which each row is dominated by its diagonal: it is positive definite.
    fn random(size: usize, per_row: usize, random: &mut SplitMix64) -> Vec<Entry> {
        let mut entries = Vec::new();
        let mut diagonals = vec![0.01; size];
        for row in 1..size {
            for _ in 0..per_row {
                let column = random.below(row);
                let value = DVec2::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
                entries.push(Entry { row: row as u32, column: column as u32, value });
                diagonals[row] += value.length();
                diagonals[column] += value.length();
            }
        }
        let diagonal = |(row, &value): (usize, &f64)| Entry {
            row: row as u32,
            column: row as u32,
            value: DVec2::new(value, 0.0),
        };
        entries.extend(diagonals.iter().enumerate().map(diagonal));
        entries
    }

    #[test]
    fn a_solution_fulfils_its_equations() {
        let mut numbers = SplitMix64::new(1);
        for (size, per_row) in [(1, 0), (2, 1), (60, 3), (400, 2)] {
            let entries = random(size, per_row, &mut numbers);
            let factor = Factor::new(size, &entries, u64::MAX).expect("positive definite");
            let wanted: Vec<DVec2> = (0..size).map(|_| DVec2::new(numbers.unit(), numbers.unit())).collect();
            let solution = factor.solve(&wanted);
            // The product by its definition.
            let mut product = vec![DVec2::ZERO; size];
            for entry in &entries {
                let (row, column) = (entry.row as usize, entry.column as usize);
                product[row] += times(entry.value, solution[column]);
                if row != column {
                    product[column] += times(conjugate(entry.value), solution[row]);
                }
            }
            for (product, wanted) in product.iter().zip(&wanted) {
                assert!(product.abs_diff_eq(*wanted, 1e-9), "{product} for {wanted} of {size}");
            }
        }
    }

    #[test]
    fn what_has_no_factor_is_refused() {
        let entry = |row, column, value| Entry { row, column, value: DVec2::new(value, 0.0) };
        let singular = [entry(0, 0, 1.0), entry(0, 1, 1.0), entry(1, 1, 1.0)];
        assert_eq!(Factor::new(2, &singular, u64::MAX).err(), Some(NoFactor::NotPositive), "dependent rows");
        assert_eq!(
            Factor::new(2, &singular, 50).err(),
            Some(NoFactor::Memory(60)),
            "three entries of 20 bytes"
        );
        let undefined = [entry(0, 0, f64::NAN)];
        assert_eq!(Factor::new(1, &undefined, u64::MAX).err(), Some(NoFactor::NotPositive), "NaN");
    }
}
