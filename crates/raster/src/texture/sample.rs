//! The look-up itself, for one point: level, texels, weights.
//!
//! Every step is total: any coordinate and any gradient, finite or not, gives
//! an index in range and a finite value. This is the definition that the look-up
//! for lanes repeats bit for bit.

use super::axis::{reduced, texel};
use super::detail::{Footprint, log2_of_root};
use super::sampler::{decode, full_scale};
use super::strips::Strips;
use super::{Filter, MipFilter, Sampler, Texture};
use trigon_math::{Vec2, Vec4};

impl Texture {
    /// The value at `uv` in linear light, alpha straight, filtered as the `sampler` says. `ddx` and `ddy`
    /// span the footprint: the change of `uv` for one internal pixel (half a pixel with two samples per
    /// axis).
    ///
    /// Any coordinate is safe: one that is not finite counts as 0, a gradient
    /// that is not finite selects the last level.
    #[inline]
    #[must_use]
    pub fn sample(&self, uv: Vec2, ddx: Vec2, ddy: Vec2, sampler: &Sampler) -> Vec4 {
        sample(self, uv, ddx, ddy, sampler)
    }
}

fn sample(texture: &Texture, uv: Vec2, ddx: Vec2, ddy: Vec2, sampler: &Sampler) -> Vec4 {
    let uv = Vec2::new(reduced(uv.x, sampler.wrap_u), reduced(uv.y, sampler.wrap_v));
    let footprint = Footprint::new(texture, ddx, ddy, sampler);
    let lookup = |uv: Vec2| Lookup::new(texture, uv, footprint.square, sampler).value();
    let value = if footprint.probes == 1.0 {
        lookup(uv)
    } else {
        mean(&footprint, |shift| {
            let at = uv + shift;
            lookup(Vec2::new(reduced(at.x, sampler.wrap_u), reduced(at.y, sampler.wrap_v)))
        })
    };
    value / full_scale(texture.format)
}

/// The mean of the values at all probes of a footprint.
fn mean(footprint: &Footprint, at: impl Fn(Vec2) -> Vec4) -> Vec4 {
    let mut sum = Vec4::ZERO;
    let mut index = 1.0;
    while index <= footprint.probes {
        sum += at(footprint.axis * footprint.offset(index));
        index += 1.0;
    }
    sum / footprint.probes
}

/// A look-up at one point.
struct Lookup<'a> {
    texture: &'a Texture,
    sampler: &'a Sampler,
    /// Reduced to the first period.
    uv: Vec2,
    filter: Filter,
    /// The finer level, and the weight of the next one.
    finer: u32,
    next_weight: f32,
}

impl<'a> Lookup<'a> {
    #[inline]
    fn new(texture: &'a Texture, uv: Vec2, square: f32, sampler: &'a Sampler) -> Self {
        let last = texture.strips.last_level;
        let (whole, rest) = log2_of_root(square);
        // A level that is clamped to the texture's range has no next level: at the last one nothing
        // follows, and below 0 the base level is magnified.
        let (level, rest) = match u32::try_from(whole) {
            Ok(level) if level < last => (level, rest),
            Ok(_) => (last, 0.0),
            Err(_) => (0, 0.0),
        };
        let (finer, next_weight) = match sampler.mip {
            MipFilter::None => (0, 0.0),
            MipFilter::Nearest => (level + u32::from(rest >= 0.5), 0.0),
            MipFilter::Linear | MipFilter::Anisotropic(_) => (level, rest),
        };
        let filter = if square > 1.0 { sampler.minification } else { sampler.magnification };
        Self { texture, sampler, uv, filter, finer, next_weight }
    }

    #[inline]
    fn value(&self) -> Vec4 {
        let value = self.level(self.finer);
        if self.next_weight == 0.0 {
            return value;
        }
        mix(value, self.level(self.finer + 1), self.next_weight)
    }

    #[inline]
    fn level(&self, level: u32) -> Vec4 {
        let strips = &self.texture.strips;
        let [start, width, height, _] = strips.level(level).map(i32::cast_unsigned);
        let (x, s) = texel(self.uv.x, width as f32, self.sampler.wrap_u, self.filter);
        let (y, t) = texel(self.uv.y, height as f32, self.sampler.wrap_v, self.filter);
        let index = start + Strips::index(height, [x, y]);
        let [top, bottom] = strips.quads().at(index);
        mix(self.row(top, s), self.row(bottom, s), t)
    }

    /// Mixes neighbours.
    #[inline]
    fn row(&self, pair: u64, weight: f32) -> Vec4 {
        let texel = |bits: u32| decode(bits.to_le_bytes(), self.texture.format);
        mix(texel(pair as u32), texel((pair >> 32) as u32), weight)
    }
}

#[inline]
fn mix(a: Vec4, b: Vec4, weight: f32) -> Vec4 {
    a + (b - a) * weight
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{TextureFormat, Wrap};
    use proptest::prelude::*;
    use trigon_math::DVec2;

    const WRAPS: [Wrap; 3] = [Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge];

    const MIPS: [MipFilter; 4] =
        [MipFilter::None, MipFilter::Nearest, MipFilter::Linear, MipFilter::Anisotropic(16)];

    /// A row of texels with red 0, 10, 20 …
    fn row(width: u32) -> Texture {
        let texels = (0..width).map(|x| [(x * 10) as u8, 0, 0, 255]).collect();
        Texture::new(width, 1, texels, TextureFormat::Linear).unwrap()
    }

    fn nearest(texture: &Texture, u: f32, wrap: Wrap) -> u32 {
        let sampler =
            Sampler { wrap_u: wrap, wrap_v: wrap, magnification: Filter::Nearest, ..Sampler::default() };
        let value = texture.sample(Vec2::new(u, 0.5), Vec2::ZERO, Vec2::ZERO, &sampler);
        (value.x * 25.5).round() as u32
    }

    #[test]
    fn repeat_and_mirror_and_clamp() {
        let texture = row(4);
        let at = [-0.3, -0.01, 0.0, 0.26, 0.99, 1.0, 1.26, 2.01];
        let expected = [[2, 3, 0, 1, 3, 0, 1, 0], [1, 0, 0, 1, 3, 3, 2, 0], [0, 0, 0, 1, 3, 3, 3, 3]];
        for (wrap, expected) in WRAPS.into_iter().zip(expected) {
            let got = at.map(|u| nearest(&texture, u, wrap));
            assert_eq!(got, expected, "{wrap:?} at {at:?}");
        }
    }

    #[test]
    fn just_below_zero_repeats_into_the_last_texel() {
        assert_eq!(nearest(&row(4), -1e-30, Wrap::Repeat), 3, "-1e-30 lies in the last texel");
        assert_eq!(nearest(&row(4), -0.0, Wrap::Repeat), 0, "-0 is 0");
        assert_eq!(nearest(&row(4), 1.0 - f32::EPSILON / 2.0, Wrap::Repeat), 3, "just below 1");
    }

    #[test]
    fn not_a_number_is_the_first_texel() {
        for wrap in WRAPS {
            for u in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
                assert_eq!(nearest(&row(4), u, wrap), 0, "{u} with {wrap:?}");
            }
        }
    }

    #[test]
    fn bilinear_meets_the_texels_at_their_centres() {
        let texture = row(4);
        let sampler = Sampler { wrap_u: Wrap::ClampToEdge, ..Sampler::default() };
        for (u, expected) in [(0.125, 0.0), (0.375, 10.0), (0.25, 5.0), (0.0, 0.0), (1.0, 30.0)] {
            let value = texture.sample(Vec2::new(u, 0.5), Vec2::ZERO, Vec2::ZERO, &sampler);
            assert!((value.x * 255.0 - expected).abs() < 1e-3, "at {u}: {}", value.x * 255.0);
        }
    }

    /// An image of stripes that are `period` texels wide and run along v.
    fn stripes(side: u32, period: u32) -> Texture {
        let light = |x: u32| if (x / period).is_multiple_of(2) { 255 } else { 0 };
        let texels = (0..side * side).map(|i| [light(i % side), 0, 0, 255]).collect();
        Texture::new(side, side, texels, TextureFormat::Linear).unwrap()
    }

    #[test]
    fn probes_along_the_longer_side_keep_the_shorter_one_sharp() {
        let texture = stripes(64, 4);
        let (ddx, ddy) = (Vec2::new(1.0 / 64.0, 0.0), Vec2::new(0.0, 16.0 / 64.0));
        let contrast = |mip| {
            let sampler = Sampler { mip, ..Sampler::default() };
            let at = |texel: f32| texture.sample(Vec2::new(texel / 64.0, 0.5), ddx, ddy, &sampler).x;
            at(2.0) - at(6.0)
        };
        assert!(contrast(MipFilter::Linear) < 0.01, "one look-up blurs in both directions");
        assert_eq!(contrast(MipFilter::Anisotropic(16)), 1.0, "16 probes see the stripes");
        let some = contrast(MipFilter::Anisotropic(3));
        assert!(some > 0.01 && some < 1.0, "3 probes see some of them: {some}");
    }

    #[test]
    fn probes_average_what_the_longer_side_covers() {
        // 1/7 to 6/7 of a side of 16 texels, across 4 pairs of stripes.
        let texture = stripes(64, 2);
        let sampler = Sampler { mip: MipFilter::Anisotropic(16), ..Sampler::default() };
        let (ddx, ddy) = (Vec2::new(16.0 / 64.0, 0.0), Vec2::new(0.0, 1.0 / 64.0));
        let value = texture.sample(Vec2::splat(0.5), ddx, ddy, &sampler).x;
        assert!((value - 0.5).abs() < 0.1, "half the stripes are white: {value}");
    }

    #[test]
    fn a_single_probe_is_trilinear() {
        let texture = stripes(32, 3);
        let (uv, ddx, ddy) = (Vec2::new(0.3, 0.7), Vec2::new(0.05, 0.01), Vec2::new(0.0, 0.02));
        let with = |mip| texture.sample(uv, ddx, ddy, &Sampler { mip, ..Sampler::default() });
        assert_eq!(with(MipFilter::Anisotropic(1)), with(MipFilter::Linear), "at most one probe");
        assert_eq!(with(MipFilter::Anisotropic(0)), with(MipFilter::Linear), "0 counts as 1");
        assert_eq!(with(MipFilter::Anisotropic(99)), with(MipFilter::Anisotropic(16)), "99 as 16");
    }

    /// The bilinear filter in f64, with texels addressed one by one.
    fn reference(texels: &[[u8; 4]], side: u32, uv: Vec2, wrap: Wrap) -> f64 {
        let side_i = i64::from(side);
        let wrapped = |i: i64| match wrap {
            Wrap::Repeat => i.rem_euclid(side_i),
            Wrap::MirroredRepeat => {
                let i = i.rem_euclid(2 * side_i);
                if i < side_i { i } else { 2 * side_i - 1 - i }
            }
            Wrap::ClampToEdge => i.clamp(0, side_i - 1),
        };
        let position = DVec2::new(f64::from(uv.x), f64::from(uv.y)) * f64::from(side) - 0.5;
        let (first, share) = (position.floor(), position - position.floor());
        let texel = |dx: i64, dy: i64| {
            let (x, y) = (wrapped(first.x as i64 + dx), wrapped(first.y as i64 + dy));
            f64::from(texels[(y * side_i + x) as usize][0]) / 255.0
        };
        let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
        mix(mix(texel(0, 0), texel(1, 0), share.x), mix(texel(0, 1), texel(1, 1), share.x), share.y)
    }

    fn any_coordinate() -> impl Strategy<Value = f32> {
        prop_oneof![
            any::<f32>(),
            -3.0_f32..3.0,
            Just(1e7),
            Just(1e30),
            Just(-1e30),
            Just(f32::NAN),
            Just(f32::INFINITY),
        ]
    }

    proptest! {
        #[test]
        fn bilinear_equals_the_reference_far_from_zero(
            uv in prop_oneof![
                [-2.0_f32..2.0, -2.0_f32..2.0],
                [-2e5_f32..2e5, -2e5_f32..2e5],
                [-1e7_f32..1e7, -1e7_f32..1e7],
            ],
            side in 1_u32..40,
            wrap in 0_usize..3,
        ) {
            let wrap = WRAPS[wrap];
            let texels: Vec<_> =
                (0..side * side).map(|i| i.wrapping_mul(2_654_435_761).to_be_bytes()).collect();
            let texture = Texture::new(side, side, texels.clone(), TextureFormat::Linear).unwrap();
            let sampler = Sampler { wrap_u: wrap, wrap_v: wrap, ..Sampler::default() };
            let value = texture.sample(uv.into(), Vec2::ZERO, Vec2::ZERO, &sampler);
            let error = f64::from(value.x) - reference(&texels, side, uv.into(), wrap);
            // A neighbour differs by 1 at most: the error of the position on
            // both axes, and a little for the arithmetic.
            let bound = 2.0 * f64::from(side) * f64::from(f32::EPSILON) + 1e-6;
            prop_assert!(error.abs() <= bound, "{error:e} beyond {bound:e} at {uv:?}");
        }

        #[test]
        fn any_input_gives_a_value_in_range(
            uv in [any_coordinate(), any_coordinate()],
            ddx in [any_coordinate(), any_coordinate()],
            ddy in [any_coordinate(), any_coordinate()],
            size in (1_u32..9, 1_u32..9),
            modes in (0_usize..3, 0_usize..3, 0_usize..2, 0_usize..2, 0_usize..4),
        ) {
            let texels = vec![[51, 102, 153, 204]; (size.0 * size.1) as usize];
            let texture = Texture::new(size.0, size.1, texels, TextureFormat::Linear).unwrap();
            let filters = [Filter::Nearest, Filter::Linear];
            let sampler = Sampler {
                wrap_u: WRAPS[modes.0],
                wrap_v: WRAPS[modes.1],
                magnification: filters[modes.2],
                minification: filters[modes.3],
                mip: MIPS[modes.4],
            };
            let value = texture.sample(uv.into(), ddx.into(), ddy.into(), &sampler);
            let expected = Vec4::new(0.2, 0.4, 0.6, 0.8);
            prop_assert!((value - expected).abs().max_element() < 1e-5, "{value}");
        }
    }
}
