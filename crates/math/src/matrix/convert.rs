//! To and from glam, which stores columns where we store rows.

use glam::{DMat2, DMat3, DMat4, DVec2, DVec3, DVec4};

use super::Matrix;

macro_rules! square {
    ($n:literal, $type:ty) => {
        impl From<$type> for Matrix<$n, $n> {
            fn from(matrix: $type) -> Self {
                Self::from_rows(matrix.transpose().to_cols_array_2d())
            }
        }

        impl From<Matrix<$n, $n>> for $type {
            fn from(matrix: Matrix<$n, $n>) -> Self {
                Self::from_cols_array_2d(matrix.rows()).transpose()
            }
        }
    };
}

macro_rules! column {
    ($n:literal, $type:ty) => {
        impl From<$type> for Matrix<$n, 1> {
            fn from(vector: $type) -> Self {
                Self::from_rows(vector.to_array().map(|entry| [entry]))
            }
        }

        impl From<Matrix<$n, 1>> for $type {
            fn from(matrix: Matrix<$n, 1>) -> Self {
                Self::from_array(matrix.rows().map(|[entry]| entry))
            }
        }
    };
}

square!(2, DMat2);
square!(3, DMat3);
square!(4, DMat4);
column!(2, DVec2);
column!(3, DVec3);
column!(4, DVec4);
