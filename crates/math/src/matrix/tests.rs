//! Matrices against exact integers, rationals and glam.

use glam::{DMat4, DVec2, DVec3, DVec4};
use num_rational::BigRational;
use num_traits::{FromPrimitive, ToPrimitive, Zero};
use proptest::prelude::*;

use super::*;

/// Small integers: products and sums are exact in `f64`.
fn integers<const N: usize, const M: usize>() -> impl Strategy<Value = Matrix<N, M>> {
    prop::collection::vec(-9..=9_i32, N * M).prop_map(|entries| {
        let entry = |i: usize, j: usize| f64::from(entries[i * M + j]);
        Matrix::from_rows(std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j))))
    })
}

/// The determinant by expansion along the first row, in exact rationals.
fn exact_determinant(rows: &[Vec<BigRational>]) -> BigRational {
    if rows.is_empty() {
        return BigRational::from_i32(1).unwrap();
    }
    let mut sum = BigRational::zero();
    for column in 0..rows.len() {
        let minor: Vec<Vec<BigRational>> =
            rows[1..].iter().map(|row| [&row[..column], &row[column + 1..]].concat()).collect();
        let term = &rows[0][column] * exact_determinant(&minor);
        sum = if column % 2 == 0 { sum + term } else { sum - term };
    }
    sum
}

fn exact<const N: usize>(matrix: &Matrix<N, N>) -> Vec<Vec<BigRational>> {
    let rational = |entry: &f64| BigRational::from_f64(*entry).unwrap();
    matrix.rows().iter().map(|row| row.iter().map(rational).collect()).collect()
}

#[test]
fn shapes_multiply_and_transpose() {
    let a = Matrix::from_rows([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
    let b = Matrix::from_rows([[1.0], [0.0], [-1.0]]);
    assert_eq!(a * b, Matrix::from_rows([[-2.0], [-2.0]]), "2×3 times 3×1");
    assert_eq!(a.transposed()[[2, 1]], 6.0, "row and column change places");
    assert_eq!(a * Matrix::IDENTITY, a, "the identity changes nothing");
}

/// Source row A10: moving and rotation matrices.
#[test]
fn source_a10_movements() {
    let moved = Matrix::translation(DVec3::new(1.0, 2.0, 3.0)) * Matrix::from(DVec4::W);
    assert_eq!(DVec4::from(moved), DVec4::new(1.0, 2.0, 3.0, 1.0), "a point moves");
    let direction = Matrix::translation(DVec3::ONE) * Matrix::from(DVec4::X);
    assert_eq!(DVec4::from(direction), DVec4::X, "a direction does not");
    let quarter = Matrix::rotation(DVec3::Z * 5.0, std::f64::consts::FRAC_PI_2).unwrap();
    let turned = DVec4::from(quarter * Matrix::from(DVec4::X));
    assert!((turned - DVec4::Y).length() < 1e-15, "x turns to y, not {turned}");
    let inverse = quarter.inverse().unwrap();
    let difference = DMat4::from(inverse) - DMat4::from(quarter.transposed());
    assert!(difference.abs_diff_eq(DMat4::ZERO, 1e-15), "a rotation's inverse is its transpose");
    assert_eq!(Matrix::rotation(DVec3::ZERO, 1.0), None, "no axis");
    assert_eq!(Matrix::rotation(DVec3::X, f64::NAN), None, "no angle");
}

#[test]
fn singular_systems_have_no_solution() {
    let singular = Matrix::from_rows([[1.0, 2.0], [2.0, 4.0]]);
    assert_eq!(singular.inverse(), None, "the rows are parallel");
    assert_eq!(singular.determinant(), 0.0, "no area");
    assert_eq!(Matrix::<3, 3>::ZERO.inverse(), None, "nothing to divide by");
    let nan = Matrix::from_rows([[f64::NAN, 1.0], [1.0, 1.0]]);
    assert_eq!(nan.inverse(), None, "NaN has no inverse");
}

/// Without pivoting the first division is by zero, or by nearly zero: the second
/// system then loses every digit.
#[test]
fn pivoting_saves_small_pivots() {
    let zero_first = Matrix::from_rows([[0.0, 1.0], [1.0, 0.0]]);
    assert_eq!(zero_first.inverse(), Some(zero_first), "its own inverse");
    let tiny_first = Matrix::from_rows([[1e-20, 1.0], [1.0, 1.0]]);
    let solution = tiny_first.solve(&Matrix::from_rows([[1.0], [2.0]])).unwrap();
    let error = (DVec2::from(solution) - DVec2::ONE).length();
    assert!(error < 1e-15, "close to (1, 1), not {solution:?}");
}

#[test]
fn conversions_keep_rows_and_columns() {
    let rows =
        [[1.0, 2.0, 3.0, 4.0], [5.0, 6.0, 7.0, 8.0], [9.0, 10.0, 11.0, 12.0], [13.0, 14.0, 15.0, 16.0]];
    let matrix = Matrix::from_rows(rows);
    let glam = DMat4::from(matrix);
    assert_eq!(glam.row(1).to_array(), rows[1], "rows stay rows");
    assert_eq!(Matrix::from(glam), matrix, "and back");
}

proptest! {
    #[test]
    fn determinants_are_those_of_exact_expansion(matrix in integers::<5, 5>()) {
        let expected = exact_determinant(&exact(&matrix)).to_f64().unwrap();
        // Entries up to 9: every product of five is at most 9⁵, 120 of them.
        prop_assert!((matrix.determinant() - expected).abs() < 1e-7);
    }

    #[test]
    fn solutions_solve(matrix in integers::<4, 4>(), right in integers::<4, 2>()) {
        let singular = exact_determinant(&exact(&matrix)).is_zero();
        // An exactly singular matrix may pass by rounding; nothing is claimed then.
        if let (Some(solution), false) = (matrix.solve(&right), singular) {
            let product = matrix * solution;
            let largest = solution.rows().iter().flatten().fold(1.0_f64, |a, b| a.max(b.abs()));
            for (got, want) in product.rows().iter().flatten().zip(right.rows().iter().flatten()) {
                prop_assert!((got - want).abs() <= 1e-12 * largest, "{got} is not {want}");
            }
        } else {
            prop_assert!(singular, "a regular system was refused");
        }
    }

    #[test]
    fn products_agree_with_glam_and_transpose(a in integers::<4, 4>(), b in integers::<4, 4>()) {
        prop_assert_eq!(DMat4::from(a * b), DMat4::from(a) * DMat4::from(b));
        prop_assert_eq!((a * b).transposed(), b.transposed() * a.transposed());
    }
}
