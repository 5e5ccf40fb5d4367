//! Rows of four numbers become columns of eight lanes. There is no gather
//! without `unsafe`; eight loads and a transposition are as fast.

use super::{Each, I32, Simd};
use fearless_simd::i32x4;
use fearless_simd::prelude::*;

/// The columns of eight rows.
#[inline(always)]
pub(crate) fn transposed<S: Simd>(simd: S, rows: [&[i32; 4]; 8]) -> [I32<S>; 4] {
    let [a, b, c, d, e, f, g, h] = rows.each(
        #[inline(always)]
        |row| i32x4::simd_from(simd, *row),
    );
    let low = transposed_four(simd, [a, b, c, d]);
    let high = transposed_four(simd, [e, f, g, h]);
    [0, 1, 2, 3].each(
        #[inline(always)]
        |column| simd.combine_i32x4(low[column], high[column]),
    )
}

#[inline(always)]
fn transposed_four<S: Simd>(simd: S, [a, b, c, d]: [i32x4<S>; 4]) -> [i32x4<S>; 4] {
    let (ac_low, ac_high) = (simd.zip_low_i32x4(a, c), simd.zip_high_i32x4(a, c));
    let (bd_low, bd_high) = (simd.zip_low_i32x4(b, d), simd.zip_high_i32x4(b, d));
    [
        simd.zip_low_i32x4(ac_low, bd_low),
        simd.zip_high_i32x4(ac_low, bd_low),
        simd.zip_low_i32x4(ac_high, bd_high),
        simd.zip_high_i32x4(ac_high, bd_high),
    ]
}

#[cfg(test)]
mod tests {
    use super::super::{SimdLevel, at_level};
    use super::*;

    #[test]
    fn rows_become_columns_at_every_level() {
        let rows: [[i32; 4]; 8] = std::array::from_fn(|row| std::array::from_fn(|i| (row * 10 + i) as i32));
        for token in SimdLevel::ALL.into_iter().filter_map(SimdLevel::token) {
            at_level!(token, simd => {
                let columns = transposed(simd, rows.each_ref());
                for (i, column) in columns.into_iter().enumerate() {
                    let column: [i32; 8] = column.into();
                    assert_eq!(column, rows.map(|row| row[i]), "column {i} at {token:?}");
                }
            });
        }
    }
}
