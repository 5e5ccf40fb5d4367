//! What the vertex stage hands to the fragment stage: values that can be
//! interpolated over a triangle, as a row of f32 components.

use trigon_math::{Vec2, Vec3, Vec4};

/// The most varyings that a pipeline may have.
pub const MAX_VARYINGS: usize = 64;

/// Values that the rasterizer interpolates, perspective-correct, over a
/// triangle or along a line.
///
/// Each component is interpolated on its own: the result lies within the range
/// of that component at the three vertices, and three equal values give exactly
/// that value.
///
/// Provided for `()`, `f32`, [`Vec2`], [`Vec3`], [`Vec4`], arrays and tuples of
/// up to six; for a struct of those, [`impl_varyings!`](crate::impl_varyings)
/// writes the implementation.
pub trait Varyings: Copy + Send + Sync {
    /// How many components there are.
    const COMPONENTS: usize;

    /// Writes the components to the first [`COMPONENTS`](Self::COMPONENTS)
    /// entries of `components`.
    fn store(&self, components: &mut [f32]);

    /// The value with these components.
    fn load(components: &[f32]) -> Self;
}

impl Varyings for f32 {
    const COMPONENTS: usize = 1;

    #[inline(always)]
    fn store(&self, components: &mut [f32]) {
        components[0] = *self;
    }

    #[inline(always)]
    fn load(components: &[f32]) -> Self {
        components[0]
    }
}

impl Varyings for () {
    const COMPONENTS: usize = 0;

    #[inline(always)]
    fn store(&self, _: &mut [f32]) {}

    #[inline(always)]
    fn load(_: &[f32]) -> Self {}
}

impl<V: Varyings, const N: usize> Varyings for [V; N] {
    const COMPONENTS: usize = N * V::COMPONENTS;

    #[inline(always)]
    fn store(&self, components: &mut [f32]) {
        for (i, value) in self.iter().enumerate() {
            value.store(&mut components[i * V::COMPONENTS..]);
        }
    }

    #[inline(always)]
    fn load(components: &[f32]) -> Self {
        std::array::from_fn(|i| V::load(&components[i * V::COMPONENTS..]))
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
/// impl_varyings!(Surface { normal: Vec3, uv: Vec2 });
/// ```
#[macro_export]
macro_rules! impl_varyings {
    ($type:ty { $($field:ident: $kind:ty),* $(,)? }) => {
        impl $crate::Varyings for $type {
            const COMPONENTS: usize = 0 $(+ <$kind as $crate::Varyings>::COMPONENTS)*;

            #[inline(always)]
            fn store(&self, components: &mut [f32]) {
                let rest = components;
                $(
                    let (own, rest) = rest.split_at_mut(<$kind as $crate::Varyings>::COMPONENTS);
                    $crate::Varyings::store(&self.$field, own);
                )*
                let _ = rest;
            }

            #[inline(always)]
            fn load(components: &[f32]) -> Self {
                let rest = components;
                $(
                    let (own, rest) = rest.split_at(<$kind as $crate::Varyings>::COMPONENTS);
                    let $field = <$kind as $crate::Varyings>::load(own);
                )*
                let _ = rest;
                Self { $($field),* }
            }
        }
    };
}

macro_rules! vector_varyings {
    ($($type:ty: $count:literal),*) => {$(
        impl Varyings for $type {
            const COMPONENTS: usize = $count;

            #[inline(always)]
            fn store(&self, components: &mut [f32]) {
                self.to_array().store(components);
            }

            #[inline(always)]
            fn load(components: &[f32]) -> Self {
                Self::from_array(<[f32; $count]>::load(components))
            }
        }
    )*};
}

vector_varyings!(Vec2: 2, Vec3: 3, Vec4: 4);

macro_rules! tuple_varyings {
    ($($name:ident $member:ident $index:tt),*) => {
        impl<$($name: Varyings),*> Varyings for ($($name,)*) {
            const COMPONENTS: usize = 0 $(+ $name::COMPONENTS)*;

            #[inline(always)]
            fn store(&self, components: &mut [f32]) {
                let rest = components;
                $(
                    let (own, rest) = rest.split_at_mut($name::COMPONENTS);
                    self.$index.store(own);
                )*
                let _ = rest;
            }

            #[inline(always)]
            fn load(components: &[f32]) -> Self {
                let rest = components;
                $(
                    let (own, rest) = rest.split_at($name::COMPONENTS);
                    let $member = $name::load(own);
                )*
                let _ = rest;
                ($($member,)*)
            }
        }
    };
}

tuple_varyings!(A a 0);
tuple_varyings!(A a 0, B b 1);
tuple_varyings!(A a 0, B b 1, C c 2);
tuple_varyings!(A a 0, B b 1, C c 2, D d 3);
tuple_varyings!(A a 0, B b 1, C c 2, D d 3, E e 4);
tuple_varyings!(A a 0, B b 1, C c 2, D d 3, E e 4, F f 5);

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Clone, Copy, Debug, PartialEq)]
    struct Surface {
        normal: Vec3,
        uvs: [Vec2; 2],
        rest: (f32, (), Vec4),
    }
    impl_varyings!(Surface { normal: Vec3, uvs: [Vec2; 2], rest: (f32, (), Vec4) });

    #[test]
    fn composites_are_rows_of_components() {
        let surface = Surface {
            normal: Vec3::new(1.0, 2.0, 3.0),
            uvs: [Vec2::new(4.0, 5.0), Vec2::new(6.0, 7.0)],
            rest: (8.0, (), Vec4::new(9.0, 10.0, 11.0, 12.0)),
        };
        let mut components = [0.0; Surface::COMPONENTS];
        surface.store(&mut components);
        let expected: Vec<f32> = (1..=12_u8).map(f32::from).collect();
        assert_eq!(components.as_slice(), expected, "in the order of the fields");
        assert_eq!(Surface::load(&components), surface, "and back");
    }
}
