//! The footprint of a fragment on a texture: which mip level it needs and, with anisotropic
//! filtering, how many probes along its longer side. Each is written twice, for one fragment and
//! for eight lanes. The results that are used have the same bits.
//!
//! The gradients of the texture coordinates span a parallelogram in texels. With one probe its longer
//! side decides the level: at level `log2(side)` a texel is as large as the side. With several
//! probes, the longer side divided by their number decides. Squares of sides are compared, and the
//! logarithm takes half of the exponent, so that the level needs no root.
//!
//! The sides are the gradients themselves, not the axes of the ellipse that a round pixel covers: for
//! a sheared footprint that is an approximation, the usual one.

use super::{Sampler, Texture};
use crate::simd::prelude::*;
use crate::simd::{F32, I32, InlineMap, Simd, greater, lesser};
use trigon_math::Vec2;

/// The square for a gradient that is not finite or too large to square: beyond
/// the last level of any texture.
const COARSEST: f32 = (1_u64 << 60) as f32;

/// What one fragment covers of a texture.
pub(super) struct Footprint {
    /// The square of the side that one look-up covers (the longer side, divided by the number of
    /// probes), in texels of the base level: below 1 where a texel is larger than it; finite.
    pub(super) square: f32,
    /// How many probes, an integer from 1.
    pub(super) probes: f32,
    /// The longer side: the probes' direction. Finite.
    pub(super) axis: Vec2,
}

impl Footprint {
    /// The footprint spanned by `ddx` and `ddy`, with at most the sampler's number
    /// of probes. If the sampler needs no footprint, `square` is 0.
    ///
    /// The number of probes is the ratio of the sides, rounded up, at most that of the sampler. Each
    /// look-up covers the longer side divided by the number of probes: the formula of
    /// EXT_texture_filter_anisotropic (Khronos, 1999).
    #[inline]
    pub(super) fn new(texture: &Texture, ddx: Vec2, ddy: Vec2, sampler: &Sampler) -> Self {
        if !sampler.needs_detail() {
            return Self { square: 0.0, probes: 1.0, axis: Vec2::ZERO };
        }
        let most_probes = sampler.most_probes();
        let size = Vec2::new(texture.width() as f32, texture.height() as f32);
        let (x, y) = (ddx * size, ddy * size);
        let (x, y) = (x.x * x.x + x.y * x.y, y.x * y.x + y.y * y.y);
        // True for NaN as well.
        if !(x + y).is_finite() {
            return Self { square: COARSEST, probes: 1.0, axis: Vec2::ZERO };
        }
        let (longer, shorter, axis) = if y > x { (y, x, ddy) } else { (x, y, ddx) };
        if most_probes == 1.0 {
            return Self { square: longer, probes: 1.0, axis };
        }
        let ratio = (longer / shorter).sqrt();
        // If only the shorter side is zero, the ratio is infinite and becomes the sampler's number of
        // probes. If both are zero it is NaN, the first comparison is false, and it becomes 1.
        let ratio = if ratio > 1.0 { ratio } else { 1.0 };
        let ratio = if ratio < most_probes { ratio } else { most_probes };
        // Rounded up.
        let whole = ratio as i32 as f32;
        let probes = if whole < ratio { whole + 1.0 } else { whole };
        Self { square: longer / (probes * probes), probes, axis }
    }

    /// Where probe `index`, from 1 to `probes`, lies along the longer side: 0 is its middle, ±1/2 its ends.
    ///
    /// Probes are 1/(N + 1) of the side apart, but each covers 1/N of it: neighbours overlap a little.
    /// Both are the formulas of EXT_texture_filter_anisotropic.
    #[inline]
    pub(super) fn offset(&self, index: f32) -> f32 {
        index / (self.probes + 1.0) - 0.5
    }
}

/// [`Footprint`], for lanes.
pub(super) struct FootprintLanes<S: Simd> {
    pub(super) square: F32<S>,
    pub(super) probes: F32<S>,
    pub(super) axis: [F32<S>; 2],
}

impl<S: Simd> FootprintLanes<S> {
    #[inline(always)]
    pub(super) fn new(
        simd: S,
        texture: &Texture,
        ddx: [F32<S>; 2],
        ddy: [F32<S>; 2],
        sampler: &Sampler,
    ) -> Self {
        let (zero, one) = (F32::splat(simd, 0.0), F32::splat(simd, 1.0));
        if !sampler.needs_detail() {
            return Self { square: zero, probes: one, axis: [zero; 2] };
        }
        let most_probes = sampler.most_probes();
        let size = [texture.width(), texture.height()].each(
            #[inline(always)]
            |side| I32::splat(simd, side as i32).to_float(),
        );
        let (x, y) = (squared_lanes(size, ddx), squared_lanes(size, ddy));
        let finite = (x + y).simd_lt(f32::INFINITY);
        // The lanes in which the longer side is the one downwards.
        let steep = y.simd_gt(x);
        let longer = steep.select(y, x);
        let coarsest = F32::splat(simd, COARSEST);
        if most_probes == 1.0 {
            return Self { square: finite.select(longer, coarsest), probes: one, axis: [zero; 2] };
        }
        let ratio = (longer / steep.select(x, y)).sqrt();
        let ratio = lesser(greater(ratio, one), F32::splat(simd, most_probes));
        let whole = ratio.to_int::<I32<S>>().to_float::<F32<S>>();
        let probes = finite.select(whole.simd_lt(ratio).select(whole + 1.0, whole), one);
        let square = finite.select(longer / (probes * probes), coarsest);
        let u = finite.select(steep.select(ddy[0], ddx[0]), zero);
        let v = finite.select(steep.select(ddy[1], ddx[1]), zero);
        Self { square, probes, axis: [u, v] }
    }

    #[inline(always)]
    pub(super) fn offset(&self, index: f32) -> F32<S> {
        index / (self.probes + 1.0) - 0.5
    }
}

/// The square of the length of a gradient in texels of the base level.
#[inline(always)]
fn squared_lanes<S: Simd>([width, height]: [F32<S>; 2], [u, v]: [F32<S>; 2]) -> F32<S> {
    let (u, v) = (u * width, v * height);
    u * u + v * v
}

/// The lowest bit of a biased exponent. The bias is odd, so where the bit is set the exponent
/// itself is even.
const LOWEST_EXPONENT_BIT: u32 = 1 << 23;

/// The binary logarithm of the root of a finite `square` >= 0, as a whole number and a
/// fraction from 0 to 1 whose error is below 0.000025: the mip level of a look-up and the weight
/// of the next one. Below -50 for 0 and for numbers too small to matter.
///
/// The whole number is half of the exponent, so that the level is known long before the
/// weight is; all that follows waits for the level. The fraction is a polynomial in the mantissa 1 + t:
/// only additions and multiplications, so the same on every machine. It approximates
/// log2(1 + t) / 2, plus 1/2 where the exponent is odd, and is exact for t = 0 and t = 1; the inner
/// coefficients are a least-squares fit, and their terms are added up by twos (G. Estrin, 1960).
pub(super) fn log2_of_root(square: f32) -> (i32, f32) {
    let bits = square.to_bits();
    // Half of the exponent, rounded down: its bias is odd.
    let whole = ((bits + LOWEST_EXPONENT_BIT) >> 24) as i32 - 64;
    let mantissa = f32::from_bits(bits & 0x007f_ffff | 0x3f80_0000);
    let t = mantissa - 1.0;
    let straight = if bits & LOWEST_EXPONENT_BIT == 0 { mantissa } else { t };
    let inner = (0.220_87 - t * 0.133_015) + t * t * (0.073_155 - t * 0.022);
    (whole, straight * 0.5 + t * (1.0 - t) * inner)
}

/// [`log2_of_root`], for lanes.
#[inline(always)]
pub(super) fn log2_of_root_lanes<S: Simd>(square: F32<S>) -> (I32<S>, F32<S>) {
    let bits = square.to_bits().bitcast::<I32<S>>();
    let whole = ((bits + LOWEST_EXPONENT_BIT as i32) >> 24) - 64;
    let mantissa = (bits & 0x007f_ffff | 0x3f80_0000).bitcast::<F32<S>>();
    let t = mantissa - 1.0;
    // Set where the exponent is odd, that is where the bit is not set.
    let is_odd = (bits & LOWEST_EXPONENT_BIT as i32).simd_eq(I32::splat(square.token(), 0));
    let straight = is_odd.select(mantissa, t);
    let inner = (0.220_87 - t * 0.133_015) + t * t * (0.073_155 - t * 0.022);
    (whole, straight * 0.5 + t * (1.0 - t) * inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{MipFilter, TextureFormat};
    use proptest::prelude::*;

    fn level(square: f32) -> f64 {
        let (whole, rest) = log2_of_root(square);
        f64::from(whole) + f64::from(rest)
    }

    #[test]
    fn logarithm_is_close_enough() {
        for i in 1..20_000 {
            let x = i as f32 * 0.01;
            let exact = trigon_math::elementary::ln(f64::from(x)) / std::f64::consts::LN_2 / 2.0;
            let error = level(x) - exact;
            assert!(error.abs() < 2.5e-5, "the root of {x} is off by {error}");
        }
        assert!(level(0.0) < -50.0, "0 selects the base level");
    }

    proptest! {
        /// From one level to the next nothing jumps, and the share stays one.
        #[test]
        fn a_level_follows_the_one_before(exponent in -40..40_i32, below in 1_u32..200) {
            let whole = f32::from_bits(((127 + 2 * exponent) as u32) << 23);
            let (level, rest) = log2_of_root(f32::from_bits(whole.to_bits() - below));
            prop_assert_eq!(log2_of_root(whole), (exponent, 0.0));
            prop_assert_eq!(level, exponent - 1);
            prop_assert!((0.9999..=1.0).contains(&rest), "{}", rest);
        }
    }

    fn grey(side: u32) -> Texture {
        let texels = vec![[200, 100, 50, 255]; (side * side) as usize];
        Texture::new(side, side, texels, TextureFormat::Linear).unwrap()
    }

    fn at_most(probes: u8) -> Sampler {
        Sampler { mip: MipFilter::Anisotropic(probes), ..Sampler::default() }
    }

    #[test]
    fn each_halving_moves_one_level_down() {
        let texture = grey(64);
        for k in 0..6 {
            let step = (1 << k) as f32 / 64.0;
            let footprint = Footprint::new(&texture, Vec2::new(step, 0.0), Vec2::ZERO, &at_most(1));
            assert_eq!(level(footprint.square), f64::from(k), "a step of {} texels", 1 << k);
        }
    }

    #[test]
    fn probes_follow_the_ratio_of_the_sides() {
        let texture = grey(64);
        let texel = 1.0 / 64.0;
        // Sides in texels, probes allowed; probes taken and texels between them.
        let cases = [
            ([2.0, 2.0], 16, 1.0, 2.0),
            ([8.0, 2.0], 16, 4.0, 2.0),
            ([2.0, 8.0], 16, 4.0, 2.0),
            ([7.0, 2.0], 16, 4.0, 1.75),
            ([32.0, 1.0], 8, 8.0, 4.0),
            ([16.0, 0.0], 16, 16.0, 1.0),
        ];
        for ([x, y], most, probes, step) in cases {
            let footprint = Footprint::new(
                &texture,
                Vec2::new(x * texel, 0.0),
                Vec2::new(0.0, y * texel),
                &at_most(most),
            );
            assert_eq!(footprint.probes, probes, "{x} by {y} texels, at most {most}");
            let expected = trigon_math::elementary::ln(step) / std::f64::consts::LN_2;
            let level = level(footprint.square);
            assert!((level - expected).abs() < 1e-3, "level {level} for {x} by {y} texels");
        }
    }

    #[test]
    fn a_footprint_without_a_size_is_a_single_probe() {
        let texture = grey(64);
        for bad in [f32::NAN, f32::INFINITY, 1e30] {
            let footprint = Footprint::new(&texture, Vec2::new(bad, 0.0), Vec2::X, &at_most(16));
            assert_eq!((footprint.square, footprint.probes), (COARSEST, 1.0), "gradient {bad}");
            assert!(level(footprint.square) > 15.0, "beyond the last level of any texture");
        }
        let point = Footprint::new(&texture, Vec2::ZERO, Vec2::ZERO, &at_most(16));
        assert_eq!(point.probes, 1.0, "a point is as long as it is wide");
        assert!(point.square < 1.0, "and magnified");
    }
}
