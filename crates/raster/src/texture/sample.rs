//! The look-up itself: level, addresses, weights.
//!
//! Every step is total: any coordinate and any gradient, finite or not, gives
//! an index in range and a finite value.

use super::{Filter, Level, MipFilter, Sampler, Texture, Wrap, decode};
use trigon_math::{Vec2, Vec4};

pub(super) fn sample(texture: &Texture, uv: Vec2, ddx: Vec2, ddy: Vec2, sampler: &Sampler) -> Vec4 {
    let lookup = Lookup { texture, uv, sampler };
    let mips = sampler.mip != MipFilter::None;
    if !mips && sampler.magnification == sampler.minification {
        return lookup.level(0, sampler.magnification);
    }
    let detail = level_of_detail(&texture.levels[0], ddx, ddy);
    if detail <= 0.0 {
        return lookup.level(0, sampler.magnification);
    }
    let last = texture.levels.len() - 1;
    let detail = if detail < last as f32 { detail } else { last as f32 };
    match sampler.mip {
        MipFilter::None => lookup.level(0, sampler.minification),
        MipFilter::Nearest => lookup.level((detail + 0.5) as usize, sampler.minification),
        MipFilter::Linear => {
            let finer = detail as usize;
            let share = detail - finer as f32;
            let value = lookup.level(finer, sampler.minification);
            if share == 0.0 {
                return value;
            }
            value + (lookup.level(finer + 1, sampler.minification) - value) * share
        }
    }
}

/// The binary logarithm of the longer side of the footprint in texels of the
/// base level; at most 64, whatever the gradient.
fn level_of_detail(base: &Level, ddx: Vec2, ddy: Vec2) -> f32 {
    let size = Vec2::new(base.width as f32, base.height as f32);
    let (x, y) = (ddx * size, ddy * size);
    let (x, y) = (x.x * x.x + x.y * x.y, y.x * y.x + y.y * y.y);
    let square = if y > x { y } else { x };
    // Also when it is not a number.
    if !(x + y).is_finite() {
        return 64.0;
    }
    0.5 * log2(square)
}

/// The binary logarithm of a finite `x` >= 0, within 0.00005; below -126 for 0
/// and for numbers too small to matter.
///
/// The exponent and a polynomial in the mantissa: only additions and
/// multiplications, so the same on every machine.
fn log2(x: f32) -> f32 {
    let bits = x.to_bits();
    let exponent = (bits >> 23) as f32 - 127.0;
    let t = f32::from_bits(bits & 0x007f_ffff | 0x3f80_0000) - 1.0;
    // Interpolates log2(1 + t) at both ends; the inner coefficients are a
    // least-squares fit.
    let polynomial = t * (1.0 + (1.0 - t) * (0.441_74 - t * (0.266_03 - t * (0.146_31 - t * 0.044))));
    exponent + polynomial
}

struct Lookup<'a> {
    texture: &'a Texture,
    uv: Vec2,
    sampler: &'a Sampler,
}

impl Lookup<'_> {
    #[inline]
    fn level(&self, index: usize, filter: Filter) -> Vec4 {
        let level = &self.texture.levels[index];
        let u = Axis { size: level.width, wrap: self.sampler.wrap_u, coordinate: self.uv.x };
        let v = Axis { size: level.height, wrap: self.sampler.wrap_v, coordinate: self.uv.y };
        match filter {
            Filter::Nearest => self.texel(level, u.nearest(), v.nearest()),
            Filter::Linear => {
                let ([x0, x1], s) = u.pair();
                let ([y0, y1], t) = v.pair();
                let top = mix(self.texel(level, x0, y0), self.texel(level, x1, y0), s);
                let bottom = mix(self.texel(level, x0, y1), self.texel(level, x1, y1), s);
                mix(top, bottom, t)
            }
        }
    }

    #[inline]
    fn texel(&self, level: &Level, x: u32, y: u32) -> Vec4 {
        decode(level.texels[(y * level.width + x) as usize], self.texture.format)
    }
}

#[inline]
fn mix(a: Vec4, b: Vec4, share: f32) -> Vec4 {
    a + (b - a) * share
}

/// One axis of a look-up.
struct Axis {
    size: u32,
    wrap: Wrap,
    coordinate: f32,
}

impl Axis {
    /// The coordinate in texels, brought near the texture while it is still
    /// precise: within `[0, 2 * size]`, or a texel outside when clamped.
    #[inline]
    fn position(&self) -> f32 {
        let c = if self.coordinate.is_finite() { self.coordinate } else { 0.0 };
        let near = match self.wrap {
            Wrap::Repeat => c - c.floor(),
            Wrap::MirroredRepeat => c - 2.0 * (c * 0.5).floor(),
            Wrap::ClampToEdge if c < 0.0 => 0.0,
            Wrap::ClampToEdge if c > 1.0 => 1.0,
            Wrap::ClampToEdge => c,
        };
        near * self.size as f32
    }

    /// The texel `index`, from -1 up to `2 * size`, wrapped into the texture.
    #[inline]
    fn wrapped(&self, index: i32) -> u32 {
        let size = self.size as i32;
        let inside = match self.wrap {
            Wrap::Repeat => match index {
                -1 => size - 1,
                _ if index >= size => index - size,
                _ => index,
            },
            Wrap::MirroredRepeat => {
                let index = match index {
                    -1 => 0,
                    _ if index >= 2 * size => index - 2 * size,
                    _ => index,
                };
                if index >= size { 2 * size - 1 - index } else { index }
            }
            Wrap::ClampToEdge => index,
        };
        inside.clamp(0, size - 1) as u32
    }

    #[inline]
    fn nearest(&self) -> u32 {
        let position = self.position();
        // A coordinate just below 0 rounds up to the whole size when it is
        // wrapped: it belongs to the last texel.
        if self.wrap == Wrap::Repeat && position >= self.size as f32 {
            return self.size - 1;
        }
        self.wrapped(position as i32)
    }

    /// The two texels whose centres enclose the coordinate, and the share of
    /// the second.
    #[inline]
    fn pair(&self) -> ([u32; 2], f32) {
        let position = self.position() - 0.5;
        let floor = position.floor();
        let first = floor as i32;
        ([self.wrapped(first), self.wrapped(first + 1)], position - floor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TextureFormat;
    use proptest::prelude::*;

    const WRAPS: [Wrap; 3] = [Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge];

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

    #[test]
    fn logarithm_is_close_enough() {
        for i in 1..20_000 {
            let x = i as f32 * 0.01;
            let error =
                f64::from(log2(x)) - trigon_math::elementary::ln(f64::from(x)) / std::f64::consts::LN_2;
            assert!(error.abs() < 5e-5, "log2({x}) is off by {error}");
        }
        assert!(log2(0.0) < -100.0, "0 selects the base level");
    }

    #[test]
    fn each_halving_moves_one_level_down() {
        let texels = vec![[200, 100, 50, 255]; 64 * 64];
        let texture = Texture::new(64, 64, texels, TextureFormat::Linear).unwrap();
        for k in 0..6 {
            let step = (1 << k) as f32 / 64.0;
            let detail = level_of_detail(&texture.levels[0], Vec2::new(step, 0.0), Vec2::ZERO);
            assert!((detail - k as f32).abs() < 1e-3, "a step of {} texels: {detail}", 1 << k);
        }
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
        fn any_input_gives_a_value_in_range(
            uv in [any_coordinate(), any_coordinate()],
            ddx in [any_coordinate(), any_coordinate()],
            ddy in [any_coordinate(), any_coordinate()],
            size in (1_u32..9, 1_u32..9),
            modes in (0_usize..3, 0_usize..3, 0_usize..2, 0_usize..2, 0_usize..3),
        ) {
            let texels = vec![[51, 102, 153, 204]; (size.0 * size.1) as usize];
            let texture = Texture::new(size.0, size.1, texels, TextureFormat::Linear).unwrap();
            let filters = [Filter::Nearest, Filter::Linear];
            let sampler = Sampler {
                wrap_u: WRAPS[modes.0],
                wrap_v: WRAPS[modes.1],
                magnification: filters[modes.2],
                minification: filters[modes.3],
                mip: [MipFilter::None, MipFilter::Nearest, MipFilter::Linear][modes.4],
            };
            let value = texture.sample(uv.into(), ddx.into(), ddy.into(), &sampler);
            let expected = Vec4::new(0.2, 0.4, 0.6, 0.8);
            prop_assert!((value - expected).abs().max_element() < 1e-5, "{value}");
        }
    }
}
