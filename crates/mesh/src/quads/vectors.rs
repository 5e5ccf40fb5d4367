//! Vectors side by side.

/// A vector for each of several things, by axis: all x, all y, all z.
pub(super) type Vectors<const N: usize> = [[f64; N]; 3];

#[inline(always)]
pub(super) fn each<const N: usize>(value: impl Fn(usize, usize) -> f64) -> Vectors<N> {
    std::array::from_fn(|axis| std::array::from_fn(|lane| value(axis, lane)))
}

#[inline(always)]
pub(super) fn difference<const N: usize>(to: &Vectors<N>, from: &Vectors<N>) -> Vectors<N> {
    each(|axis, lane| to[axis][lane] - from[axis][lane])
}

#[inline(always)]
pub(super) fn cross<const N: usize>(a: &Vectors<N>, b: &Vectors<N>) -> Vectors<N> {
    each(|axis, lane| {
        let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        a[next][lane] * b[last][lane] - b[next][lane] * a[last][lane]
    })
}

#[inline(always)]
pub(super) fn dot<const N: usize>(a: &Vectors<N>, b: &Vectors<N>) -> [f64; N] {
    std::array::from_fn(|lane| a[0][lane] * b[0][lane] + a[1][lane] * b[1][lane] + a[2][lane] * b[2][lane])
}
