//! Sparse systems of linear equations with a Hermitian positive definite matrix.
//!
//! Texture coordinates are complex numbers here, u + iv: a conformal map then is a linear condition on them, and
//! the matrix has half as many rows as one of real numbers. They are stored as vectors, (re, im).
//!
//! The factor is computed row by row as in T. Davis, *Direct Methods for Sparse Linear Systems*, 2006, chapter 4.
//! A factor is exact where iterations are slow: the least eigenvalue of a conformal energy is tiny, because many
//! maps are almost conformal. Everything is done in one order, so that results have the same bits everywhere.

use trigon_math::DVec2;

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
pub(super) struct Entry {
    pub(super) row: u32,
    pub(super) column: u32,
    pub(super) value: DVec2,
}

/// Why a matrix has no factor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum NoFactor {
    /// It would take this many bytes of memory, which are not allowed.
    Memory(u64),
    /// It is not positive definite, but for rounding.
    NotPositive,
}

/// A factor of a matrix: with it, systems are solved.
#[derive(Debug)]
pub(super) struct Factor {
    /// The unknowns in the order of elimination.
    order: Vec<u32>,
    lower: Lower,
}

/// A lower triangle by columns; the diagonal comes first in each.
#[derive(Debug, Default)]
struct Lower {
    starts: Vec<usize>,
    rows: Vec<u32>,
    values: Vec<DVec2>,
}

/// An upper triangle by columns.
struct Upper {
    starts: Vec<usize>,
    entries: Vec<Entry>,
}

impl Upper {
    /// The triangle of a permuted matrix. Entries of one position are added up, in their order.
    fn new(size: usize, entries: &[Entry], position: &[u32]) -> Self {
        let permuted = |entry: &Entry| {
            let [row, column] = [entry.row, entry.column].map(|index| position[index as usize]);
            if row <= column {
                Entry { row, column, value: entry.value }
            } else {
                Entry { row: column, column: row, value: conjugate(entry.value) }
            }
        };
        let mut all: Vec<Entry> = entries.iter().map(permuted).collect();
        all.sort_by_key(|entry| (entry.column, entry.row));
        all.dedup_by(|next, first| {
            let is_same = (next.row, next.column) == (first.row, first.column);
            if is_same {
                first.value += next.value;
            }
            is_same
        });
        let mut starts = vec![0; size + 1];
        all.iter().for_each(|entry| starts[entry.column as usize + 1] += 1);
        for column in 0..size {
            starts[column + 1] += starts[column];
        }
        Self { starts, entries: all }
    }

    fn column(&self, column: usize) -> &[Entry] {
        &self.entries[self.starts[column]..self.starts[column + 1]]
    }
}

/// Finds in which columns a row of the factor has entries.
struct RowPattern {
    /// By column: the row of the first entry below its diagonal, the parent in the elimination tree.
    parent: Vec<u32>,
    /// By column: one more than the last row that reached it.
    reached: Vec<u32>,
    /// Columns of the row, each after those that it depends on.
    columns: Vec<u32>,
    path: Vec<u32>,
}

const NO_PARENT: u32 = u32::MAX;

impl RowPattern {
    fn new(upper: &Upper, size: usize) -> Self {
        let mut parent = vec![NO_PARENT; size];
        // Shortcuts to the root that is known so far.
        let mut ancestor = vec![NO_PARENT; size];
        for column in 0..size {
            for entry in upper.column(column) {
                let mut here = entry.row;
                while here != NO_PARENT && here < column as u32 {
                    let above = std::mem::replace(&mut ancestor[here as usize], column as u32);
                    if above == NO_PARENT {
                        parent[here as usize] = column as u32;
                    }
                    here = above;
                }
            }
        }
        Self { parent, reached: vec![0; size], columns: Vec::new(), path: Vec::new() }
    }

    fn find(&mut self, upper: &Upper, row: usize) {
        let mark = row as u32 + 1;
        self.columns.clear();
        self.reached[row] = mark;
        for entry in upper.column(row) {
            let mut here = entry.row;
            while self.reached[here as usize] != mark {
                self.reached[here as usize] = mark;
                self.path.push(here);
                here = self.parent[here as usize];
            }
            // Paths that were found later are needed earlier; each is read from its end.
            self.columns.extend(self.path.drain(..).rev());
        }
        self.columns.reverse();
    }
}

impl Factor {
    /// Factors a matrix of which the entries on and above the diagonal are given, or for each of them its
    /// transposed conjugate, but not both. Entries of one position are added up. `memory` bounds the bytes that
    /// the factor takes.
    pub(super) fn new(size: usize, entries: &[Entry], memory: u64) -> Result<Self, NoFactor> {
        let graph = Graph::new(size, entries.iter().map(|entry| [entry.row, entry.column]));
        let order = elimination_order(&graph);
        let mut position = vec![0; size];
        for (index, &unknown) in (0..).zip(&order) {
            position[unknown as usize] = index;
        }
        let upper = Upper::new(size, entries, &position);
        let mut pattern = RowPattern::new(&upper, size);
        let lower = Lower::allocate(&upper, &mut pattern, memory)?;
        let lower = lower.compute(&upper, &mut pattern)?;
        Ok(Self { order, lower })
    }

    /// Solves a system: the right-hand side, by unknown.
    pub(super) fn solve(&self, right_hand_side: &[DVec2]) -> Vec<DVec2> {
        let mut values: Vec<DVec2> =
            self.order.iter().map(|&unknown| right_hand_side[unknown as usize]).collect();
        let Lower { starts, rows, values: factors } = &self.lower;
        for column in 0..values.len() {
            let (start, end) = (starts[column], starts[column + 1]);
            values[column] /= factors[start].x;
            let value = values[column];
            for entry in start + 1..end {
                values[rows[entry] as usize] -= times(factors[entry], value);
            }
        }
        for column in (0..values.len()).rev() {
            let (start, end) = (starts[column], starts[column + 1]);
            let mut value = values[column];
            for entry in start + 1..end {
                value -= times(conjugate(factors[entry]), values[rows[entry] as usize]);
            }
            values[column] = value / factors[start].x;
        }
        let mut solution = vec![DVec2::ZERO; values.len()];
        for (&unknown, value) in self.order.iter().zip(values) {
            solution[unknown as usize] = value;
        }
        solution
    }
}

impl Lower {
    fn allocate(upper: &Upper, pattern: &mut RowPattern, memory: u64) -> Result<Self, NoFactor> {
        let size = upper.starts.len() - 1;
        let mut counts = vec![1usize; size];
        let mut entries = size as u64;
        let bytes = (size_of::<DVec2>() + size_of::<u32>()) as u64;
        for row in 0..size {
            pattern.find(upper, row);
            pattern.columns.iter().for_each(|&column| counts[column as usize] += 1);
            entries += pattern.columns.len() as u64;
        }
        if entries * bytes > memory {
            return Err(NoFactor::Memory(entries * bytes));
        }
        pattern.reached.fill(0);
        let mut starts = vec![0; size + 1];
        for (column, count) in counts.into_iter().enumerate() {
            starts[column + 1] = starts[column] + count;
        }
        let count = entries as usize;
        Ok(Self { starts, rows: vec![0; count], values: vec![DVec2::ZERO; count] })
    }

    /// Row after row: each is the solution of a triangular system with the rows before.
    fn compute(mut self, upper: &Upper, pattern: &mut RowPattern) -> Result<Self, NoFactor> {
        let size = upper.starts.len() - 1;
        let mut ends = self.starts.clone();
        let mut row_values = vec![DVec2::ZERO; size];
        for row in 0..size {
            pattern.find(upper, row);
            upper.column(row).iter().for_each(|entry| row_values[entry.row as usize] = entry.value);
            let whole = std::mem::take(&mut row_values[row]).x;
            let mut diagonal = whole;
            for &column in &pattern.columns {
                let start = self.starts[column as usize];
                let value = std::mem::take(&mut row_values[column as usize]) / self.values[start].x;
                let end = ends[column as usize];
                for entry in start + 1..end {
                    row_values[self.rows[entry] as usize] -= times(self.values[entry], value);
                }
                diagonal -= value.length_squared();
                self.rows[end] = row as u32;
                self.values[end] = conjugate(value);
                ends[column as usize] += 1;
            }
            /// What is less than this part of the diagonal is rounding.
            const LEAST_PIVOT: f64 = 1e-15;
            if diagonal.is_nan() || diagonal <= LEAST_PIVOT * whole {
                return Err(NoFactor::NotPositive);
            }
            self.rows[ends[row]] = row as u32;
            self.values[ends[row]] = DVec2::new(diagonal.sqrt(), 0.0);
            ends[row] += 1;
        }
        Ok(self)
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
