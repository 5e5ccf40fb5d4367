//! Elimination: linear systems, inverse, determinant.

use super::Matrix;

impl<const N: usize> Matrix<N, N> {
    /// The matrix `X` with `self · X = right`, one linear system per column.
    ///
    /// Gaussian elimination with partial pivoting. `None` if a column has no
    /// pivot but zero, or the result is not finite. A matrix that is singular
    /// only in exact arithmetic may, by rounding, still have a (huge) solution.
    #[must_use]
    pub fn solve<const K: usize>(&self, right: &Matrix<N, K>) -> Option<Matrix<N, K>> {
        let (mut left, mut right) = (*self, *right);
        for column in 0..N {
            let pivot = left.pivot_row(column)?;
            left.rows.swap(column, pivot);
            right.rows.swap(column, pivot);
            for row in column + 1..N {
                let factor = left[[row, column]] / left[[column, column]];
                left.subtract_row(row, column, factor);
                right.subtract_row(row, column, factor);
            }
        }
        for column in (0..N).rev() {
            for entry in &mut right.rows[column] {
                *entry /= left[[column, column]];
            }
            for row in 0..column {
                right.subtract_row(row, column, left[[row, column]]);
            }
        }
        right.is_finite().then_some(right)
    }

    /// The matrix whose product with this one is the identity; `None` as in
    /// [`Matrix::solve`].
    #[must_use]
    pub fn inverse(&self) -> Option<Self> {
        self.solve(&Self::IDENTITY)
    }

    /// The signed factor by which the matrix changes volumes, rounded; zero if
    /// elimination finds no pivot.
    #[must_use]
    pub fn determinant(&self) -> f64 {
        let mut left = *self;
        let mut determinant = 1.0;
        for column in 0..N {
            let Some(pivot) = left.pivot_row(column) else {
                return 0.0;
            };
            if pivot != column {
                left.rows.swap(column, pivot);
                determinant = -determinant;
            }
            determinant *= left[[column, column]];
            for row in column + 1..N {
                left.subtract_row(row, column, left[[row, column]] / left[[column, column]]);
            }
        }
        determinant
    }

    /// The row, from the diagonal down, with the largest entry of a column; the
    /// first of equals. `None` if there are only zeros and NaN.
    fn pivot_row(&self, column: usize) -> Option<usize> {
        let size = |row: usize| self.rows[row][column].abs();
        let mut best = None;
        let mut largest = 0.0;
        for row in column..N {
            if size(row) > largest {
                (best, largest) = (Some(row), size(row));
            }
        }
        best
    }
}

impl<const N: usize, const M: usize> Matrix<N, M> {
    /// Subtracts `factor` times one row from another.
    fn subtract_row(&mut self, from: usize, row: usize, factor: f64) {
        for column in 0..M {
            self.rows[from][column] -= factor * self.rows[row][column];
        }
    }

    fn is_finite(&self) -> bool {
        self.rows.iter().flatten().all(|entry| entry.is_finite())
    }
}
