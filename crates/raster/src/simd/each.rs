//! Arrays of vectors, entry by entry.

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
