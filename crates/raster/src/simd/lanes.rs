//! Arrays of vectors, entry by entry; and rows that become columns of eight lanes, and back. Without `unsafe` there are no
//! gather instructions; loads and a transposition are as fast.

use super::{F32, I32, Simd, U32, is_avx512};
use fearless_simd::prelude::*;
use fearless_simd::{f32x4, i32x4, u64x2, u64x4};

/// As [`array::map`], and always inlined: what is not inlined loses the
/// instructions of its SIMD level. Give it closures with
/// `#[inline(always)]`, too.
pub trait InlineMap<T, const N: usize>: Sized {
    /// `f` of each entry.
    fn each<R>(self, f: impl FnMut(T) -> R) -> [R; N];
}

macro_rules! each {
    ($($count:literal: $($name:ident)*),*) => {$(
        impl<T> InlineMap<T, $count> for [T; $count] {
            #[inline(always)]
            fn each<R>(self, mut f: impl FnMut(T) -> R) -> [R; $count] {
                let [$($name),*] = self;
                [$(f($name)),*]
            }
        }
    )*};
}

each!(1: a, 2: a b, 3: a b c, 4: a b c d, 5: a b c d e, 6: a b c d e f, 7: a b c d e f g, 8: a b c d e f g h);

/// `f` of the numbers of all eight lanes: as [`std::array::from_fn`], and always
/// inlined.
#[inline(always)]
pub fn lanes_of<R>(mut f: impl FnMut(usize) -> R) -> [R; 8] {
    [f(0), f(1), f(2), f(3), f(4), f(5), f(6), f(7)]
}

/// A closure that is always inlined, as an expression: attributes are allowed
/// before arguments, and not before other expressions.
#[inline(always)]
pub fn inlined<A, R, F: Fn(A) -> R>(f: F) -> F {
    f
}

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

/// The eight colours of channels.
#[inline(always)]
pub(crate) fn colors_of<S: Simd>(simd: S, channels: [F32<S>; 4]) -> [[f32; 4]; 8] {
    let [r, g, b, a] = channels.each(
        #[inline(always)]
        |channel| simd.split_i32x8(channel.bitcast()),
    );
    let [[a, b, c, d], [e, f, g, h]] = [[r.0, g.0, b.0, a.0], [r.1, g.1, b.1, a.1]].each(
        #[inline(always)]
        |half| transposed_four(simd, half),
    );
    [a, b, c, d, e, f, g, h].each(
        #[inline(always)]
        |color| color.bitcast::<f32x4<S>>().into(),
    )
}

/// The lower and the upper halves of eight numbers.
#[inline(always)]
pub(crate) fn unzipped<S: Simd>(simd: S, [a, b, c, d, e, f, g, h]: [u64; 8]) -> [U32<S>; 2] {
    // As bits of floats: for those every level has a shuffle of two sources. (Of halves
    // AVX-512 would make a number of 512 bits, and all others would wait for that.)
    if is_avx512(simd) {
        let low = u64x4::simd_from(simd, [a, b, c, d]).bitcast::<F32<S>>();
        let high = u64x4::simd_from(simd, [e, f, g, h]).bitcast::<F32<S>>();
        return [low.unzip_low(high).bitcast(), low.unzip_high(high).bitcast()];
    }
    let [low, high] = [[a, b, c, d], [e, f, g, h]].each(
        #[inline(always)]
        |[a, b, c, d]| {
            let first = u64x2::simd_from(simd, [a, b]).bitcast::<f32x4<S>>();
            let second = u64x2::simd_from(simd, [c, d]).bitcast::<f32x4<S>>();
            [first.unzip_low(second), first.unzip_high(second)]
        },
    );
    [low[0].combine(high[0]).bitcast(), low[1].combine(high[1]).bitcast()]
}

/// Appends the first `count` of eight to a list: all of them, as that is one store, and
/// the others are forgotten again.
#[inline(always)]
pub(crate) fn append<T: Copy>(list: &mut Vec<T>, eight: &[T; 8], count: usize) {
    let length = list.len() + count;
    list.extend_from_slice(eight);
    list.truncate(length);
}

/// Stores the columns of eight rows of eight numbers: whole ones, as what is loaded soon
/// after it was stored in two halves has to wait.
#[inline(always)]
pub(crate) fn transpose<S: Simd>(simd: S, rows: [&Row; 8], to: &mut [Row; 8]) {
    for (half, to) in to.as_chunks_mut::<4>().0.iter_mut().enumerate() {
        let rows = rows.each(
            #[inline(always)]
            |row| i32x4::simd_from(simd, row.as_chunks().0[half]),
        );
        for (to, column) in to.iter_mut().zip(columns(simd, rows)) {
            *to = column.into();
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
                let floats = rows.map(|row| row.map(|number| number as f32));
                let back = colors_of(simd, channels(simd, floats.each_ref()));
                assert_eq!(back, floats, "there and back at {token:?}");
                let [low, high] = unzipped(simd, rows.map(|[a, b, ..]| a as u64 | (b as u64) << 32));
                let halves: [[u32; 8]; 2] = [low.into(), high.into()];
                let expected = [0, 1].map(|half| rows.map(|row| row[half] as u32));
                assert_eq!(halves, expected, "halves at {token:?}");
                let mut columns = [[0; 8]; 8];
                transpose(simd, wide.each_ref(), &mut columns);
                for (i, column) in columns.into_iter().enumerate() {
                    assert_eq!(column, wide.map(|row| row[i]), "column {i} of eight at {token:?}");
                }
            });
        }
    }
}
