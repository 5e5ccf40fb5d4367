//! What the vertex stage hands to the fragment stage: values that can be
//! interpolated over a triangle.
//!
//! Two operations suffice. [`Varyings::weighted`] gives the value at a sample
//! and [`Varyings::gradient`] its exact derivative; they are separate because
//! the first is held to the range of the vertices' values and the second must
//! not be.

use trigon_math::{Vec2, Vec3, Vec4};

/// Values that the rasterizer interpolates, perspective-correct, over a
/// triangle or along a line.
///
/// Provided for `()`, `f32`, [`Vec2`], [`Vec3`], [`Vec4`], arrays and tuples of
/// up to six; for a struct of those, [`impl_varyings!`](crate::impl_varyings)
/// writes the implementation.
pub trait Varyings: Copy + Send + Sync {
    /// The convex combination of three vertices' values.
    ///
    /// `weights` are not negative and add up to 1 within rounding. Each
    /// component of the result lies within the range of that component at the
    /// three vertices, and three equal values give exactly that value.
    fn weighted(values: [&Self; 3], weights: [f32; 3]) -> Self;

    /// The linear combination of three vertices' values by `weights` that add
    /// up to 0 within rounding: a derivative, per sample step. Three equal
    /// values give exactly 0.
    fn gradient(values: [&Self; 3], weights: [f32; 3]) -> Self;
}

impl Varyings for f32 {
    #[inline(always)]
    fn weighted([a, b, c]: [&Self; 3], [u, v, w]: [f32; 3]) -> Self {
        let low = smaller(smaller(*a, *b), *c);
        let high = larger(larger(*a, *b), *c);
        smaller(larger(a * u + b * v + c * w, low), high)
    }

    #[inline(always)]
    fn gradient([a, b, c]: [&Self; 3], [_, v, w]: [f32; 3]) -> Self {
        (b - a) * v + (c - a) * w
    }
}

// Written as comparisons: `f32::min` leaves the sign of zero and the fate of a
// NaN to the platform.
#[inline(always)]
fn smaller(a: f32, b: f32) -> f32 {
    if b < a { b } else { a }
}

#[inline(always)]
fn larger(a: f32, b: f32) -> f32 {
    if b > a { b } else { a }
}

impl Varyings for () {
    #[inline(always)]
    fn weighted(_: [&Self; 3], _: [f32; 3]) -> Self {}

    #[inline(always)]
    fn gradient(_: [&Self; 3], _: [f32; 3]) -> Self {}
}

impl<V: Varyings, const N: usize> Varyings for [V; N] {
    #[inline(always)]
    fn weighted([a, b, c]: [&Self; 3], weights: [f32; 3]) -> Self {
        std::array::from_fn(|i| V::weighted([&a[i], &b[i], &c[i]], weights))
    }

    #[inline(always)]
    fn gradient([a, b, c]: [&Self; 3], weights: [f32; 3]) -> Self {
        std::array::from_fn(|i| V::gradient([&a[i], &b[i], &c[i]], weights))
    }
}

/// Implements [`Varyings`] for a struct, field by field.
///
/// ```
/// use trigon_raster::impl_varyings;
/// use trigon_math::{Vec2, Vec3};
///
/// #[derive(Clone, Copy)]
/// struct Surface { normal: Vec3, uv: Vec2 }
/// impl_varyings!(Surface { normal, uv });
/// ```
#[macro_export]
macro_rules! impl_varyings {
    ($type:ty { $($field:ident),* $(,)? }) => {
        impl $crate::Varyings for $type {
            #[inline(always)]
            fn weighted(values: [&Self; 3], weights: [f32; 3]) -> Self {
                let [a, b, c] = values;
                Self { $($field: $crate::Varyings::weighted([&a.$field, &b.$field, &c.$field], weights)),* }
            }

            #[inline(always)]
            fn gradient(values: [&Self; 3], weights: [f32; 3]) -> Self {
                let [a, b, c] = values;
                Self { $($field: $crate::Varyings::gradient([&a.$field, &b.$field, &c.$field], weights)),* }
            }
        }
    };
}

impl_varyings!(Vec2 { x, y });
impl_varyings!(Vec3 { x, y, z });

// Not by the macro: with glam's SIMD types a `Vec4` has no fields.
impl Varyings for Vec4 {
    #[inline(always)]
    fn weighted([a, b, c]: [&Self; 3], weights: [f32; 3]) -> Self {
        let [a, b, c] = [a.to_array(), b.to_array(), c.to_array()];
        Self::from_array(Varyings::weighted([&a, &b, &c], weights))
    }

    #[inline(always)]
    fn gradient([a, b, c]: [&Self; 3], weights: [f32; 3]) -> Self {
        let [a, b, c] = [a.to_array(), b.to_array(), c.to_array()];
        Self::from_array(Varyings::gradient([&a, &b, &c], weights))
    }
}

macro_rules! tuple_varyings {
    ($($name:ident $index:tt),*) => {
        impl<$($name: Varyings),*> Varyings for ($($name,)*) {
            #[inline(always)]
            fn weighted([a, b, c]: [&Self; 3], weights: [f32; 3]) -> Self {
                ($($name::weighted([&a.$index, &b.$index, &c.$index], weights),)*)
            }

            #[inline(always)]
            fn gradient([a, b, c]: [&Self; 3], weights: [f32; 3]) -> Self {
                ($($name::gradient([&a.$index, &b.$index, &c.$index], weights),)*)
            }
        }
    };
}

tuple_varyings!(A 0);
tuple_varyings!(A 0, B 1);
tuple_varyings!(A 0, B 1, C 2);
tuple_varyings!(A 0, B 1, C 2, D 3);
tuple_varyings!(A 0, B 1, C 2, D 3, E 4);
tuple_varyings!(A 0, B 1, C 2, D 3, E 4, F 5);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_stay_exact() {
        let value = 0.1_f32;
        let thirds = [0.333_333_34_f32; 3];
        assert_eq!(f32::weighted([&value; 3], thirds), value, "a constant is not rounded");
        assert_eq!(f32::gradient([&value; 3], [0.7, -0.3, -0.4]), 0.0, "a constant has no slope");
    }

    #[test]
    fn values_stay_within_the_vertices_range() {
        let (a, b, c) = (1.0_f32, 2.0, 3.0);
        let heavy = [0.1, 0.1, 1.0];
        assert_eq!(f32::weighted([&a, &b, &c], heavy), 3.0, "held to the largest value");
    }

    #[test]
    fn composites_go_component_by_component() {
        let a = (Vec3::new(1.0, 0.0, 0.0), Vec2::ZERO);
        let b = (Vec3::new(0.0, 1.0, 0.0), Vec2::X);
        let c = (Vec3::new(0.0, 0.0, 1.0), Vec2::Y);
        let (v3, v2) = Varyings::weighted([&a, &b, &c], [0.5, 0.25, 0.25]);
        assert_eq!(v3, Vec3::new(0.5, 0.25, 0.25), "a vector");
        assert_eq!(v2, Vec2::new(0.25, 0.25), "and the next member");
    }
}
