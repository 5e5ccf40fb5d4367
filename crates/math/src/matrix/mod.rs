//! Small dense matrices of any shape, and linear systems.
//!
//! For the shapes that glam has (2 to 4 square), use glam when drawing: it is faster, and
//! conversions go both ways. This type is for what glam lacks: other shapes, linear systems, and an
//! inverse that reports singular matrices.

mod convert;
mod solve;
mod transform;

use std::ops::{Index, IndexMut, Mul};

/// A matrix of `N` rows and `M` columns that acts on column vectors.
///
/// Indexed by `[[row, column]]`. Products are summed in the order of the inner index.
///
/// ```
/// use trigon_math::Matrix;
///
/// // 2x + y = 5 and x - 3y = -1
/// let a = Matrix::from_rows([[2.0, 1.0], [1.0, -3.0]]);
/// let x = a.solve(&Matrix::from_rows([[5.0], [-1.0]])).unwrap();
/// assert_eq!(x, Matrix::from_rows([[2.0], [1.0]]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matrix<const N: usize, const M: usize> {
    rows: [[f64; M]; N],
}

impl<const N: usize, const M: usize> Matrix<N, M> {
    /// All entries zero.
    pub const ZERO: Self = Self { rows: [[0.0; M]; N] };

    /// The matrix with these rows.
    #[must_use]
    pub const fn from_rows(rows: [[f64; M]; N]) -> Self {
        Self { rows }
    }

    /// The rows.
    #[must_use]
    pub const fn rows(&self) -> &[[f64; M]; N] {
        &self.rows
    }

    /// The transposed matrix.
    #[must_use]
    pub fn transposed(&self) -> Matrix<M, N> {
        let column = |j: usize| std::array::from_fn(|i| self.rows[i][j]);
        Matrix::from_rows(std::array::from_fn(column))
    }
}

impl<const N: usize> Matrix<N, N> {
    /// Ones on the diagonal, zeros elsewhere.
    pub const IDENTITY: Self = {
        let mut identity = Self::ZERO;
        let mut i = 0;
        while i < N {
            identity.rows[i][i] = 1.0;
            i += 1;
        }
        identity
    };
}

impl<const N: usize, const M: usize> Index<[usize; 2]> for Matrix<N, M> {
    type Output = f64;
    fn index(&self, [row, column]: [usize; 2]) -> &f64 {
        &self.rows[row][column]
    }
}

impl<const N: usize, const M: usize> IndexMut<[usize; 2]> for Matrix<N, M> {
    fn index_mut(&mut self, [row, column]: [usize; 2]) -> &mut f64 {
        &mut self.rows[row][column]
    }
}

impl<const N: usize, const M: usize, const K: usize> Mul<Matrix<M, K>> for Matrix<N, M> {
    type Output = Matrix<N, K>;
    fn mul(self, other: Matrix<M, K>) -> Matrix<N, K> {
        let entry = |i: usize, j: usize| (0..M).map(|k| self.rows[i][k] * other.rows[k][j]).sum();
        Matrix::from_rows(std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j))))
    }
}

#[cfg(test)]
mod tests;
