//! What do the same bytes on every machine cost? Lighting in each pixel, by the renderer's rules and with two
//! operations that these rule out because they differ between processors: fused multiply-add, and estimated
//! reciprocals.

use trigon_classic::Field;
use trigon_math::at_level;
use trigon_math::simd::Token;
use trigon_math::{DVec3, Vec3};
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, LANES, Simd, greater, inlined, lane_numbers};

use super::metric::Difference;

/// The rules by which light is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Rules {
    /// The renderer's: every product, sum, quotient and root is rounded by itself.
    SameBytes,
    /// Products and sums are rounded together where the processor has an instruction for it.
    Fused,
    /// The same, and reciprocals are the processor's estimates.
    FusedAndEstimated,
}

impl Rules {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::SameBytes, Self::Fused, Self::FusedAndEstimated];

    /// The name in tables and plots.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::SameBytes => "the same bytes everywhere",
            Self::Fused => "fused multiply-add",
            Self::FusedAndEstimated => "fused, estimated reciprocals",
        }
    }

    /// The light of each pixel, white being 1.
    #[must_use]
    pub fn draw(self) -> Field<f32> {
        let mut light = Field::new([SIDE; 2], 0.0);
        self.draw_into(&mut light);
        light
    }

    /// Returns a closure that draws the image repeatedly.
    #[must_use]
    pub fn repeated(self) -> Box<dyn FnMut()> {
        let mut light = Field::new([SIDE; 2], 0.0);
        Box::new(move || self.draw_into(std::hint::black_box(&mut light)))
    }

    fn draw_into(self, light: &mut Field<f32>) {
        let level = Token::best();
        match self {
            Self::SameBytes => at_level!(level, simd => draw::<_, Ours>(simd, light.values_mut())),
            Self::Fused => at_level!(level, simd => draw::<_, Fused>(simd, light.values_mut())),
            Self::FusedAndEstimated => {
                at_level!(level, simd => draw::<_, Fast>(simd, light.values_mut()));
            }
        }
    }

    /// How far that is from the formula in `f64`.
    #[must_use]
    pub fn error(self) -> Difference {
        let drawn = self.draw();
        Difference::of(drawn.pixels().map(|(pixel, &light)| [light.into(), exact(pixel)]))
    }

    /// How many of a thousand pixels have another byte than by the renderer's rules.
    #[must_use]
    pub fn other_bytes_per_mille(self) -> f64 {
        let [here, ours] =
            [self, Self::SameBytes].map(|rules| rules.draw().map(|light| (light * 255.0 + 0.5) as u8));
        let others = here.values().iter().zip(ours.values()).filter(|(a, b)| a != b).count();
        1e3 * others as f64 / ours.values().len() as f64
    }
}

/// How many pixels an image has.
pub const PIXELS: usize = SIDE * SIDE;

/// Columns and rows of an image.
pub const SIZE: [usize; 2] = [SIDE; 2];

/// Pixels in a row, and rows.
const SIDE: usize = 256;

/// One over the distance, then position and normal over the distance: steps to the right and
/// down, and the value in the corner.
const PLANES: [[f32; 3]; 7] = [
    [3e-4, 5e-4, 0.25],
    [3e-3, 0.0, -0.35],
    [0.0, -3e-3, 0.35],
    [-3e-4, -4e-4, 0.1],
    [2e-3, 3e-4, -0.2],
    [4e-4, -2e-3, 0.25],
    [1e-4, 2e-4, 0.25],
];

const EYE: Vec3 = Vec3::new(0.3, 0.4, 4.6);
/// Of unit length.
const LIGHT: Vec3 = Vec3::new(0.398_014_87, 0.696_526, 0.597_022_3);
const AMBIENT: f32 = 0.1;
const DIFFUSE: f32 = 0.5;
/// The exponent is 32: five squares.
const SPECULAR: f32 = 0.4;

/// The light of each pixel, row by row.
#[inline(always)]
fn draw<S: Simd, A: Arithmetic>(simd: S, light: &mut [f32]) {
    let numbers = lane_numbers(simd).to_float::<F32<S>>() + 0.5;
    for (group, pixels) in light.as_chunks_mut::<LANES>().0.iter_mut().enumerate() {
        let (x, y) = (numbers + (group * LANES % SIDE) as f32, (group * LANES / SIDE) as f32 + 0.5);
        let at = inlined(
            #[inline(always)]
            |plane: usize| {
                let [across, down, start] = PLANES[plane].map(
                    #[inline(always)]
                    |part| F32::splat(simd, part),
                );
                A::product_and_sum(x, across, A::product_and_sum(F32::splat(simd, y), down, start))
            },
        );
        let distance = A::reciprocal(at(0));
        let position = [at(1) * distance, at(2) * distance, at(3) * distance];
        let normal = [at(4) * distance, at(5) * distance, at(6) * distance];
        *pixels = lit::<S, A>(simd, position, normal).into();
    }
}

/// The light of eight points; normals may have any length.
#[inline(always)]
fn lit<S: Simd, A: Arithmetic>(simd: S, position: [F32<S>; 3], normal: [F32<S>; 3]) -> F32<S> {
    let [eye, light] = [splat(simd, EYE), splat(simd, LIGHT)];
    let to_eye = [eye[0] - position[0], eye[1] - position[1], eye[2] - position[2]];
    let scale = inverse_length::<S, A>(to_eye);
    let half = inlined(
        #[inline(always)]
        |axis: usize| A::product_and_sum(to_eye[axis], scale, light[axis]),
    );
    let half = [half(0), half(1), half(2)];
    let shortness = inverse_length::<S, A>(normal);
    let zero = F32::splat(simd, 0.0);
    let cosine = dot::<S, A>(normal, half) * (shortness * inverse_length::<S, A>(half));
    let mut highlight = greater(cosine, zero);
    for _ in 0..5 {
        highlight *= highlight;
    }
    let diffuse = greater(dot::<S, A>(normal, light) * shortness, zero);
    let [ambient, share, specular] = [AMBIENT, DIFFUSE, SPECULAR].map(
        #[inline(always)]
        |value| F32::splat(simd, value),
    );
    A::product_and_sum(highlight, specular, A::product_and_sum(diffuse, share, ambient))
}

#[inline(always)]
fn inverse_length<S: Simd, A: Arithmetic>(vector: [F32<S>; 3]) -> F32<S> {
    A::reciprocal(dot::<S, A>(vector, vector).sqrt())
}

#[inline(always)]
fn dot<S: Simd, A: Arithmetic>(a: [F32<S>; 3], b: [F32<S>; 3]) -> F32<S> {
    A::product_and_sum(a[2], b[2], A::product_and_sum(a[1], b[1], a[0] * b[0]))
}

#[inline(always)]
fn splat<S: Simd>(simd: S, vector: Vec3) -> [F32<S>; 3] {
    [F32::splat(simd, vector.x), F32::splat(simd, vector.y), F32::splat(simd, vector.z)]
}

/// The same in `f64`, one pixel at a time.
fn exact([x, y]: [usize; 2]) -> f64 {
    let at = |plane: usize| {
        let [across, down, start] = PLANES[plane].map(f64::from);
        start + across * (x as f64 + 0.5) + down * (y as f64 + 0.5)
    };
    let position = DVec3::new(at(1), at(2), at(3)) / at(0);
    let normal = DVec3::new(at(4), at(5), at(6)).normalize();
    let light = LIGHT.as_dvec3();
    let half = ((EYE.as_dvec3() - position).normalize() + light).normalize();
    let mut highlight = normal.dot(half).max(0.0);
    for _ in 0..5 {
        highlight *= highlight;
    }
    let [ambient, diffuse, specular] = [AMBIENT, DIFFUSE, SPECULAR].map(f64::from);
    ambient + diffuse * normal.dot(light).max(0.0) + specular * highlight
}

/// How products are added, and how reciprocals are found.
trait Arithmetic {
    /// `a * b + c`.
    fn product_and_sum<S: Simd>(a: F32<S>, b: F32<S>, c: F32<S>) -> F32<S>;

    /// `1 / a`.
    fn reciprocal<S: Simd>(a: F32<S>) -> F32<S>;
}

/// Each operation rounded by itself: the same bits everywhere.
struct Ours;

/// Fused where the processor can.
struct Fused;

/// Fused, with the processor's estimates of reciprocals: about 12 bits on x86, 8 on aarch64.
struct Fast;

impl Arithmetic for Ours {
    #[inline(always)]
    fn product_and_sum<S: Simd>(a: F32<S>, b: F32<S>, c: F32<S>) -> F32<S> {
        a * b + c
    }

    #[inline(always)]
    fn reciprocal<S: Simd>(a: F32<S>) -> F32<S> {
        1.0 / a
    }
}

impl Arithmetic for Fused {
    #[inline(always)]
    fn product_and_sum<S: Simd>(a: F32<S>, b: F32<S>, c: F32<S>) -> F32<S> {
        a.mul_add(b, c)
    }

    #[inline(always)]
    fn reciprocal<S: Simd>(a: F32<S>) -> F32<S> {
        1.0 / a
    }
}

impl Arithmetic for Fast {
    #[inline(always)]
    fn product_and_sum<S: Simd>(a: F32<S>, b: F32<S>, c: F32<S>) -> F32<S> {
        a.mul_add(b, c)
    }

    #[inline(always)]
    fn reciprocal<S: Simd>(a: F32<S>) -> F32<S> {
        a.approximate_recip()
    }
}

#[cfg(test)]
mod tests;
