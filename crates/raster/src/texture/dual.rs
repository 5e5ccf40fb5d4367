//! Numbers with their derivatives (dual numbers), for texture coordinates that are computed.

use crate::simd::prelude::*;
use crate::simd::{F32, Simd};
use std::ops::{Add, Div, Mul, Neg, Sub};
use trigon_math::Vec2;

/// A value and its two derivatives, for one internal pixel to the right and down.
///
/// A texture look-up needs the gradients of its coordinates. The gradients of a varying are given.
/// Coordinates that are computed from varyings get their gradients when the computation uses this type, by
/// the rules of calculus: no neighbouring sample is needed, and no seam shows at the end of a triangle. (Dual
/// numbers with two infinitesimal parts: Clifford, *Preliminary Sketch of Biquaternions*, 1873; as "automatic
/// differentiation, forward mode": Griewank and Walther, *Evaluating Derivatives*, 2008, chapter 3.)
///
/// `T` is `f32` for one sample and [`F32`] for eight. A plain `T` on the right
/// of an operator is a constant. Where a derivative does not exist (the root of
/// 0, a division by 0) it is not finite, and a look-up takes the last level.
///
/// ```
/// use trigon_math::Vec2;
/// use trigon_raster::Dual;
///
/// // A varying and its derivatives, as a fragment function has them.
/// let (uv, ddx, ddy) = (Vec2::new(0.5, 0.25), Vec2::new(0.01, 0.0), Vec2::new(0.0, 0.02));
/// let [u, v] = Dual::from_vec2(uv, ddx, ddy);
///
/// // Turned by a quarter about the middle of the texture, then seen through a
/// // lens.
/// let (x, y) = (u - 0.5, v - 0.5);
/// let bulge = (x * x + y * y + 1.0).sqrt();
/// let (u, v) = (-y / bulge + 0.5, x / bulge + 0.5);
///
/// let (uv, ddx, ddy) = Dual::into_vec2([u, v]);
/// assert!(ddx.x.abs() < 1e-6 && ddx.y > 0.0095, "to the right is now down: {ddx}");
/// assert!(ddy.x < -0.018 && ddy.y.abs() < 1e-6, "and down is to the left: {ddy}");
/// # assert!(uv.x > 0.7);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<T> {
    /// The value.
    pub value: T,
    /// Its change for one internal pixel to the right.
    pub dx: T,
    /// Its change for one internal pixel down.
    pub dy: T,
}

impl Dual<f32> {
    /// The square root; a negative value has none and gives NaN.
    #[must_use]
    pub fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        let double = root + root;
        Self { value: root, dx: self.dx / double, dy: self.dy / double }
    }

    /// Both components of a varying with its derivatives.
    #[must_use]
    pub fn from_vec2(value: Vec2, ddx: Vec2, ddy: Vec2) -> [Self; 2] {
        [Self { value: value.x, dx: ddx.x, dy: ddy.x }, Self { value: value.y, dx: ddx.y, dy: ddy.y }]
    }

    /// The value, the change to the right and the change down, as
    /// [`Texture::sample`](crate::Texture::sample) takes them.
    #[must_use]
    pub fn into_vec2([x, y]: [Self; 2]) -> (Vec2, Vec2, Vec2) {
        (Vec2::new(x.value, y.value), Vec2::new(x.dx, y.dx), Vec2::new(x.dy, y.dy))
    }
}

impl<S: Simd> Dual<F32<S>> {
    /// The square root; a negative value has none and gives NaN.
    #[inline(always)]
    #[must_use]
    pub fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        let double = root + root;
        Self { value: root, dx: self.dx / double, dy: self.dy / double }
    }
}

impl<T: Neg<Output = T>> Neg for Dual<T> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self { value: -self.value, dx: -self.dx, dy: -self.dy }
    }
}

impl<T: Add<Output = T>> Add for Dual<T> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, dx: self.dx + other.dx, dy: self.dy + other.dy }
    }
}

impl<T: Sub<Output = T>> Sub for Dual<T> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, dx: self.dx - other.dx, dy: self.dy - other.dy }
    }
}

impl<T: Copy + Add<Output = T> + Mul<Output = T>> Mul for Dual<T> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            dx: self.dx * other.value + self.value * other.dx,
            dy: self.dy * other.value + self.value * other.dy,
        }
    }
}

impl<T: Copy + Sub<Output = T> + Mul<Output = T> + Div<Output = T>> Div for Dual<T> {
    type Output = Self;

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self {
            value,
            dx: (self.dx - value * other.dx) / other.value,
            dy: (self.dy - value * other.dy) / other.value,
        }
    }
}

impl<T: Add<Output = T>> Add<T> for Dual<T> {
    type Output = Self;

    #[inline(always)]
    fn add(self, constant: T) -> Self {
        Self { value: self.value + constant, ..self }
    }
}

impl<T: Sub<Output = T>> Sub<T> for Dual<T> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, constant: T) -> Self {
        Self { value: self.value - constant, ..self }
    }
}

impl<T: Copy + Mul<Output = T>> Mul<T> for Dual<T> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, constant: T) -> Self {
        Self { value: self.value * constant, dx: self.dx * constant, dy: self.dy * constant }
    }
}

impl<T: Copy + Div<Output = T>> Div<T> for Dual<T> {
    type Output = Self;

    #[inline(always)]
    fn div(self, constant: T) -> Self {
        Self { value: self.value / constant, dx: self.dx / constant, dy: self.dy / constant }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::{SimdLevel, at_level};
    use proptest::prelude::*;

    /// Uses every operation. A macro, so that the very same formula is computed
    /// with every type of number.
    macro_rules! formula {
        ($x:expr, $y:expr) => {{
            let (x, y) = ($x, $y);
            let root = (x * x + y * y + 1.0).sqrt();
            -(x / root) * 3.0 + (y - x * 0.5) / (y * y + 2.0) / 2.0 - root - 0.25
        }};
    }

    fn f64_formula(x: f64, y: f64) -> f64 {
        formula!(x, y)
    }

    fn dual(value: f32, [dx, dy]: [f32; 2]) -> Dual<f32> {
        Dual { value, dx, dy }
    }

    proptest! {
        #[test]
        fn derivatives_are_those_of_finite_differences(
            at in [-3.0_f32..3.0, -3.0_f32..3.0],
            x_slope in [-1.0_f32..1.0, -1.0_f32..1.0],
            y_slope in [-1.0_f32..1.0, -1.0_f32..1.0],
        ) {
            let result = formula!(dual(at[0], x_slope), dual(at[1], y_slope));
            let [x, y] = at.map(f64::from);
            let value = f64_formula(x, y);
            prop_assert!((f64::from(result.value) - value).abs() < 1e-5, "{} for {value}", result.value);
            for (axis, got) in [result.dx, result.dy].into_iter().enumerate() {
                let step = 1e-4;
                let (x_step, y_step) =
                    (step * f64::from(x_slope[axis]), step * f64::from(y_slope[axis]));
                let ahead = f64_formula(x + x_step, y + y_step);
                let behind = f64_formula(x - x_step, y - y_step);
                let expected = (ahead - behind) / (2.0 * step);
                prop_assert!((f64::from(got) - expected).abs() < 1e-5, "{got} for {expected}");
            }
        }

        #[test]
        fn lanes_have_the_bits_of_one_number(
            x in prop::array::uniform8([-3.0_f32..3.0, -1.0_f32..1.0, -1.0_f32..1.0]),
            y in prop::array::uniform8([-3.0_f32..3.0, -1.0_f32..1.0, -1.0_f32..1.0]),
        ) {
            for level in SimdLevel::ALL {
                let Some(token) = level.token() else { continue };
                let got: [[f32; 8]; 3] = at_level!(token, simd => in_lanes(simd, &x, &y));
                for lane in 0..8 {
                    let one = |[value, dx, dy]: [f32; 3]| Dual { value, dx, dy };
                    let expected = formula!(one(x[lane]), one(y[lane]));
                    let got = Dual { value: got[0][lane], dx: got[1][lane], dy: got[2][lane] };
                    prop_assert_eq!(got, expected, "lane {} at {}", lane, level);
                }
            }
        }
    }

    fn in_lanes<S: Simd>(simd: S, x: &[[f32; 3]; 8], y: &[[f32; 3]; 8]) -> [[f32; 8]; 3] {
        let lanes = |numbers: &[[f32; 3]; 8]| {
            let [value, dx, dy] = [0, 1, 2].map(|part| F32::from_fn(simd, |lane| numbers[lane][part]));
            Dual { value, dx, dy }
        };
        let constant = |number: f32| F32::splat(simd, number);
        let (x, y) = (lanes(x), lanes(y));
        let root = (x * x + y * y + constant(1.0)).sqrt();
        let result = -(x / root) * constant(3.0)
            + (y - x * constant(0.5)) / (y * y + constant(2.0)) / constant(2.0)
            - root
            - constant(0.25);
        [result.value, result.dx, result.dy].map(|part| part.to_array())
    }

    #[test]
    fn the_root_of_nothing_has_no_slope() {
        let root = dual(0.0, [1.0, 0.0]).sqrt();
        assert_eq!(root.value, 0.0, "the value is there");
        assert!(!root.dx.is_finite() && !root.dy.is_finite(), "the slope is not: {root:?}");
    }
}
