//! The input of a pipeline that shades one fragment at a time, and what the vertex stage hands to the fragment stage:
//! [`Varyings`], which can be interpolated over a triangle, as a row of f32 components.

use trigon_math::{UVec2, Vec2, Vec3, Vec4};

/// One visible fragment of a triangle, line or point.
///
/// Everything here depends on the primitive and the sample alone, never on
/// neighbours, tiles or threads.
#[derive(Clone, Copy, Debug)]
pub struct Fragment<V> {
    /// The interpolated varyings, perspective-correct, within the range of the
    /// vertices' values.
    pub varyings: V,
    /// The analytic derivative of the varyings to the right, for one internal pixel
    /// (one pixel when [`samples_per_axis`](crate::Target::samples_per_axis) is
    /// 1, half a pixel when it is 2): what a texture look-up needs.
    pub ddx: V,
    /// The derivative downwards.
    pub ddy: V,
    /// The pixel, from the top left.
    pub pixel: UVec2,
    /// The sample's position in pixels, x to the right, y down; the centre of
    /// the first pixel is (0.5, 0.5).
    pub position: Vec2,
    /// Reversed depth: 1 at the near plane, 0 at the far plane or infinity.
    pub depth: f32,
    /// 1/w, interpolated; > 0.
    pub inverse_w: f32,
    /// The index of the triangle, segment or point in its draw.
    pub triangle: u32,
    /// The face id that the draw gives to this triangle.
    pub face: u32,
    /// Whether the triangle's corners wind counter-clockwise on the screen.
    /// Lines and points are always front-facing.
    pub front_facing: bool,
    /// Distances in pixels, >= 0, to the lines through the triangle's edges:
    /// `[i]` to the edge from corner `i` to corner `i + 1 (mod 3)`, as the
    /// draw's index triple numbers them. Clipping does not change them. Infinite
    /// for lines and points.
    pub edge_distances: [f32; 3],
    /// Which of the three edges are edges of the face, from
    /// [`Draw::edge_flags`](crate::Draw::edge_flags).
    pub edge_flags: EdgeFlags,
}

impl<V> Fragment<V> {
    /// The distance in pixels to the nearest edge that is flagged as an edge
    /// of the face; infinite if none is.
    ///
    /// Painting a fragment dark where this is below half a line width draws a
    /// wireframe that cannot z-fight with its own surface.
    #[inline]
    pub fn nearest_edge(&self) -> f32 {
        let mut nearest = f32::INFINITY;
        for (edge, distance) in self.edge_distances.into_iter().enumerate() {
            if self.edge_flags.contains(edge) && distance < nearest {
                nearest = distance;
            }
        }
        nearest
    }
}

/// Which edges of a triangle are edges of the face that it belongs to, and
/// which are only diagonals of its triangulation.
///
/// Edge `i` runs from corner `i` to corner `i + 1 (mod 3)` of the triangle.
///
/// Beside the flags there is room for how large the face is beside its triangle: see
/// [`with_radius_ratio`](Self::with_radius_ratio).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct EdgeFlags(u8);

/// Powers of two in halves of the exponent, from 2^0 on.
const RADIUS_RATIOS: [f32; 32] = {
    let mut ratios = [1.0; 32];
    let mut step = 2;
    ratios[1] = std::f32::consts::SQRT_2;
    while step < 32 {
        ratios[step] = ratios[step - 2] * 2.0;
        step += 1;
    }
    ratios
};

impl EdgeFlags {
    /// No edge is an edge of the face.
    pub const NONE: Self = Self(0);
    /// All three are.
    pub const ALL: Self = Self(0b111);

    /// Flags from one truth value for each edge.
    #[must_use]
    pub const fn new(edges: [bool; 3]) -> Self {
        Self(edges[0] as u8 | (edges[1] as u8) << 1 | (edges[2] as u8) << 2)
    }

    /// The same flags with the size of the face relative to this triangle: how many times the
    /// triangle's own inner radius the face's inner radius is.
    ///
    /// An inner radius is twice an area over a perimeter; for the triangle, the perimeter counts its flagged
    /// sides only, or all if none is flagged. [`FaceEdges`](crate::FaceEdges) makes lines narrower on small
    /// faces, and the ratio distinguishes slivers of a large polygon from faces that are really small.
    ///
    /// Rounded down to half a power of two, from 1 to 2^15.5; 1 by default.
    #[must_use]
    pub fn with_radius_ratio(self, ratio: f32) -> Self {
        // The exponent in halves, from its bits: a search would be mispredicted often. NaN is none of the larger ones.
        let step = if ratio >= 1.0 {
            const MANTISSA: u32 = (1 << 23) - 1;
            let bits = ratio.to_bits();
            let is_upper_half = bits & MANTISSA >= std::f32::consts::SQRT_2.to_bits() & MANTISSA;
            (2 * ((bits >> 23) - 127) + u32::from(is_upper_half)).min(31)
        } else {
            0
        };
        Self(self.0 & 0b111 | (step as u8) << 3)
    }

    /// How many times the radius that the triangle shows its face has.
    #[inline]
    pub(crate) const fn radius_ratio(self) -> f32 {
        RADIUS_RATIOS[(self.0 >> 3) as usize]
    }

    /// The flags by the corners opposite the edges: bit `k` for the edge from corner
    /// `k + 1` to corner `k + 2`.
    #[inline]
    pub(crate) const fn opposite_corners(self) -> i32 {
        (self.0 >> 1 & 0b11 | (self.0 & 1) << 2) as i32
    }

    /// Whether edge `edge` (0, 1 or 2) is flagged.
    #[inline]
    #[must_use]
    pub const fn contains(self, edge: usize) -> bool {
        edge < 3 && self.0 >> edge & 1 != 0
    }
}

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
    use proptest::prelude::*;

    proptest! {
        /// Any number, and the steps themselves with their neighbours.
        #[test]
        fn a_ratio_is_rounded_down_to_a_step(bits: u32, step in 0..32_usize) {
            let near = RADIUS_RATIOS[step];
            for ratio in [f32::from_bits(bits), near.next_down(), near, near.next_up()] {
                let stored = EdgeFlags::ALL.with_radius_ratio(ratio).radius_ratio();
                let expected = RADIUS_RATIOS.into_iter().rev().find(|&step| step <= ratio).unwrap_or(1.0);
                prop_assert_eq!(stored, expected, "{}", ratio);
            }
        }
    }

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
