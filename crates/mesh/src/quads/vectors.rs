//! Vectors side by side.

/// A vector for each of several things, by axis: all x, all y, all z.
pub(super) type Vectors<const N: usize> = [[f64; N]; 3];

/// A value for each lane. As a loop: `std::array::from_fn` is not always inlined, and loses the instruction set then.
#[inline(always)]
pub(super) fn lanes<const N: usize, T: Copy + Default>(value: impl Fn(usize) -> T) -> [T; N] {
    let mut values = [T::default(); N];
    for (lane, own) in values.iter_mut().enumerate() {
        *own = value(lane);
    }
    values
}

#[inline(always)]
pub(super) fn each<const N: usize>(value: impl Fn(usize, usize) -> f64) -> Vectors<N> {
    let mut vectors = [[0.0; N]; 3];
    for (axis, values) in vectors.iter_mut().enumerate() {
        for (lane, own) in values.iter_mut().enumerate() {
            *own = value(axis, lane);
        }
    }
    vectors
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
    lanes(|lane| a[0][lane] * b[0][lane] + a[1][lane] * b[1][lane] + a[2][lane] * b[2][lane])
}
