//! Rows become columns of eight lanes, and columns rows. There is no gather
//! without `unsafe`; loads and a transposition are as fast.

use super::{Each, F32, I32, Simd};
use fearless_simd::prelude::*;
use fearless_simd::{f32x4, i32x4};

/// Eight numbers in memory.
pub(crate) type Row = [i32; 8];

/// The columns of eight rows.
#[inline(always)]
pub(crate) fn transposed<S: Simd>(simd: S, rows: [&[i32; 4]; 8]) -> [I32<S>; 4] {
    columns(
        simd,
        rows.each(
            #[inline(always)]
            |row| i32x4::simd_from(simd, *row),
        ),
    )
}

/// The channels of eight colours.
#[inline(always)]
pub(crate) fn channels<S: Simd>(simd: S, colors: [&[f32; 4]; 8]) -> [F32<S>; 4] {
    let rows = colors.each(
        #[inline(always)]
        |color| f32x4::simd_from(simd, *color).bitcast(),
    );
    columns(simd, rows).each(
        #[inline(always)]
        |channel| channel.bitcast(),
    )
}

#[inline(always)]
fn columns<S: Simd>(simd: S, [a, b, c, d, e, f, g, h]: [i32x4<S>; 8]) -> [I32<S>; 4] {
    let low = transposed_four(simd, [a, b, c, d]);
    let high = transposed_four(simd, [e, f, g, h]);
    [0, 1, 2, 3].each(
        #[inline(always)]
        |column| simd.combine_i32x4(low[column], high[column]),
    )
}

/// Stores the columns of eight rows of eight numbers.
#[inline(always)]
pub(crate) fn transpose<S: Simd>(simd: S, rows: [&Row; 8], columns: &mut [Row; 8]) {
    for (across, down) in [(0, 0), (0, 4), (4, 0), (4, 4)] {
        let quarter = [0, 1, 2, 3].each(
            #[inline(always)]
            |row| {
                let [a, b, c, d] = [0, 1, 2, 3].each(
                    #[inline(always)]
                    |i| rows[down + row][across + i],
                );
                i32x4::simd_from(simd, [a, b, c, d])
            },
        );
        for (column, values) in transposed_four(simd, quarter).into_iter().enumerate() {
            values.store_slice(&mut columns[across + column][down..down + 4]);
        }
    }
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
        let wide: [Row; 8] = std::array::from_fn(|row| std::array::from_fn(|i| (row * 10 + i) as i32));
        for token in SimdLevel::ALL.into_iter().filter_map(SimdLevel::token) {
            at_level!(token, simd => {
                let columns = transposed(simd, rows.each_ref());
                for (i, column) in columns.into_iter().enumerate() {
                    let column: [i32; 8] = column.into();
                    assert_eq!(column, rows.map(|row| row[i]), "column {i} at {token:?}");
                }
                let mut columns = [[0; 8]; 8];
                transpose(simd, wide.each_ref(), &mut columns);
                for (i, column) in columns.into_iter().enumerate() {
                    assert_eq!(column, wide.map(|row| row[i]), "column {i} of eight at {token:?}");
                }
            });
        }
    }
}
