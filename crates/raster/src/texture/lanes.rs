//! The look-up for eight samples at once: the same bits in every lane as for
//! one sample.
//!
//! Levels, addresses and weights are computed in lanes, each lane with a mip
//! level of its own. Only the texels are read lane by lane, two at a time. Then
//! each of the four texels of a footprint is a vector of eight, and so is each
//! channel after it: the filter's arithmetic needs no shuffle.

use super::axis::{Filters, reduced_lanes, texel_lanes};
use super::blocks::{AREA, Footprint, PITCH, SIDE};
use super::channels::{ALPHA, Channels, Color, Data, Texels, mix};
use super::detail::FootprintLanes;
use super::{MipFilter, Sampler, Texture, TextureFormat};
use crate::simd::prelude::*;
use crate::simd::{Each, F32, I32, LANES, Simd, U32, lesser};
use fearless_simd::{f32x4, u64x2};

#[inline(always)]
pub(super) fn sample<S: Simd>(
    simd: S,
    texture: &Texture,
    uv: [F32<S>; 2],
    ddx: [F32<S>; 2],
    ddy: [F32<S>; 2],
    sampler: &Sampler,
) -> Channels<S> {
    let uv = reduced(uv, sampler);
    let probes = Probes { simd, texture, uv, sampler };
    let footprint = FootprintLanes::new(simd, texture, ddx, ddy, sampler);
    // Decided once: the two have nothing in common after the texels are read.
    match texture.format {
        TextureFormat::Linear => {
            let [red, green, blue, alpha] = probes.value::<Data>(&footprint);
            let [green, blue] = [green / f32::from(255_u16 << 8), blue / (255 << 16) as f32];
            [red / 255.0, green, blue, alpha / 255.0]
        }
        TextureFormat::Srgb => {
            let [red, green, blue, alpha] = probes.value::<Color>(&footprint);
            [red, green, blue, alpha / 255.0]
        }
    }
}

#[inline(always)]
fn reduced<S: Simd>([u, v]: [F32<S>; 2], sampler: &Sampler) -> [F32<S>; 2] {
    [reduced_lanes(u, sampler.wrap_u), reduced_lanes(v, sampler.wrap_v)]
}

/// The look-ups of a footprint.
#[derive(Clone, Copy)]
struct Probes<'a, S: Simd> {
    simd: S,
    texture: &'a Texture,
    /// Reduced to the first period.
    uv: [F32<S>; 2],
    sampler: &'a Sampler,
}

impl<S: Simd> Probes<'_, S> {
    #[inline(always)]
    fn value<T: Texels>(self, footprint: &FootprintLanes<S>) -> Channels<S> {
        if self.sampler.most_probes() > 1.0 {
            self.mean::<T>(footprint)
        } else {
            self.at::<T>(self.uv, footprint.detail)
        }
    }

    /// The value at one point, in a function of its own: it is long, and there
    /// are many callers.
    #[inline(always)]
    fn at<T: Texels>(&self, uv: [F32<S>; 2], detail: F32<S>) -> Channels<S> {
        self.simd.vectorize(
            #[inline(always)]
            || Lookup::new(self, uv, detail).value::<T>(),
        )
    }

    /// The mean of the values at all probes of each lane's footprint.
    #[inline(always)]
    fn mean<T: Texels>(self, footprint: &FootprintLanes<S>) -> Channels<S> {
        let zero = F32::splat(self.simd, 0.0);
        let FootprintLanes { detail, probes, axis } = *footprint;
        let mut sum = [zero; 4];
        let mut index = 1.0;
        loop {
            let wanted = probes.simd_ge(index);
            if !wanted.any_true() {
                return [sum[0] / probes, sum[1] / probes, sum[2] / probes, sum[3] / probes];
            }
            let offset = wanted.select(footprint.offset(index), zero);
            let uv = [self.uv[0] + axis[0] * offset, self.uv[1] + axis[1] * offset];
            let value = self.at::<T>(reduced(uv, self.sampler), detail);
            for (sum, value) in sum.iter_mut().zip(value) {
                *sum = wanted.select(*sum + value, *sum);
            }
            index += 1.0;
        }
    }
}

/// A look-up at eight points.
struct Lookup<'a, S: Simd> {
    simd: S,
    texture: &'a Texture,
    sampler: &'a Sampler,
    uv: [F32<S>; 2],
    filters: Filters<S>,
    finer: F32<S>,
    share: F32<S>,
}

impl<'a, S: Simd> Lookup<'a, S> {
    #[inline(always)]
    fn new(of: &Probes<'a, S>, uv: [F32<S>; 2], detail: F32<S>) -> Self {
        let Probes { simd, texture, sampler, .. } = *of;
        let zero = F32::splat(simd, 0.0);
        let minified = detail.simd_gt(0.0);
        let held = minified.select(lesser(detail, last_level(simd, texture)), zero);
        let level = match sampler.mip {
            MipFilter::None => zero,
            MipFilter::Nearest => minified.select(held + 0.5, zero),
            MipFilter::Linear | MipFilter::Anisotropic(_) => held,
        };
        let finer = level.to_int::<I32<S>>().to_float::<F32<S>>();
        let share = match sampler.mip {
            MipFilter::None | MipFilter::Nearest => zero,
            MipFilter::Linear | MipFilter::Anisotropic(_) => level - finer,
        };
        let filters = match (sampler.minification, sampler.magnification) {
            (minification, magnification) if minification == magnification => Filters::Uniform(minification),
            (super::Filter::Linear, _) => Filters::Linear(minified),
            _ => Filters::Linear(!minified),
        };
        Self { simd, texture, sampler, uv, filters, finer, share }
    }

    #[inline(always)]
    fn value<T: Texels>(&self) -> Channels<S> {
        let finer = self.place(self.finer);
        if !self.share.simd_gt(0.0).any_true() {
            let texels = self.texels(&finer);
            return self.channels(
                #[inline(always)]
                |channel| finer.filtered::<T>(texels, channel),
            );
        }
        // Each step waits for the one before. So every step is taken for both
        // levels before the next one: the processor has twice as much to do.
        // Where there is no next level its share is 0.
        let next = self.place(lesser(self.finer + 1.0, last_level(self.simd, self.texture)));
        let (finer_texels, next_texels) = (self.texels(&finer), self.texels(&next));
        self.channels(
            #[inline(always)]
            |channel| {
                let value = finer.filtered::<T>(finer_texels, channel);
                mix(value, next.filtered::<T>(next_texels, channel), self.share)
            },
        )
    }

    /// All channels, but for alpha if it is the same everywhere.
    #[inline(always)]
    fn channels(&self, channel: impl Fn(u32) -> F32<S>) -> Channels<S> {
        let opaque = F32::splat(self.simd, 255.0);
        let alpha = if self.texture.opaque { opaque } else { channel(ALPHA) };
        [channel(0), channel(1), channel(2), alpha]
    }

    /// Where in a level the look-up goes.
    #[inline(always)]
    fn place(&self, level: F32<S>) -> Place<S> {
        let level = level.to_int::<I32<S>>();
        // 2 to the power of -level: a shift by another number of bits in each
        // lane is not to be had everywhere.
        let scale = ((127 - level) * (1 << 23)).bitcast::<F32<S>>();
        let width = side(self.texture.width(), scale);
        let height = side(self.texture.height(), scale);
        let (x, s) = texel_lanes(self.uv[0], width.to_float(), self.sampler.wrap_u, self.filters);
        let (y, t) = texel_lanes(self.uv[1], height.to_float(), self.sampler.wrap_v, self.filters);
        Place { level, index: index(width, [x, y]), s, t }
    }

    /// Top left and right, bottom left and right.
    #[inline(always)]
    fn texels(&self, place: &Place<S>) -> [[U32<S>; 2]; 2] {
        let blocks = &self.texture.blocks;
        let first = place.level.as_array()[0];
        let start = if place.level.simd_eq(first).all_true() {
            I32::splat(self.simd, blocks.start(first as u32) as i32)
        } else {
            I32::from_fn(self.simd, |lane| blocks.start(place.level.as_array()[lane] as u32) as i32)
        };
        let at = (start + place.index).to_array();
        let rows: [Footprint; LANES] = std::array::from_fn(|lane| blocks.footprint(at[lane] as u32));
        [neighbours(self.simd, &rows, 0), neighbours(self.simd, &rows, 1)]
    }
}

/// Where in a level a look-up goes.
struct Place<S: Simd> {
    level: I32<S>,
    /// Of the first texel, within the level.
    index: I32<S>,
    /// The share of the right texels, and of the lower ones.
    s: F32<S>,
    t: F32<S>,
}

impl<S: Simd> Place<S> {
    /// The bilinear filter, of one channel.
    #[inline(always)]
    fn filtered<T: Texels>(&self, texels: [[U32<S>; 2]; 2], channel: u32) -> F32<S> {
        let [top, bottom] = texels.each(
            #[inline(always)]
            |[left, right]| mix(T::channel(left, channel), T::channel(right, channel), self.s),
        );
        mix(top, bottom, self.t)
    }
}

/// A side of a level, given that of the base level.
#[inline(always)]
fn side<S: Simd>(base: u32, scale: F32<S>) -> I32<S> {
    (scale * base as f32).to_int::<I32<S>>().max(1)
}

/// [`Blocks::index`](super::blocks::Blocks::index), for lanes.
#[inline(always)]
fn index<S: Simd>(width: I32<S>, [x, y]: [I32<S>; 2]) -> I32<S> {
    const SHIFT: u32 = SIDE.trailing_zeros();
    const IN_BLOCK: i32 = SIDE as i32 - 1;
    let columns = (width + IN_BLOCK) >> SHIFT;
    let block = (y >> SHIFT) * columns + (x >> SHIFT);
    block * AREA as i32 + (y & IN_BLOCK) * PITCH as i32 + (x & IN_BLOCK)
}

#[inline(always)]
fn last_level<S: Simd>(simd: S, texture: &Texture) -> F32<S> {
    F32::splat(simd, (texture.blocks.level_count - 1) as f32)
}

/// The first and the second texels of one row of all footprints.
#[inline(always)]
fn neighbours<S: Simd>(simd: S, rows: &[Footprint; LANES], row: usize) -> [U32<S>; 2] {
    let [a, b, c, d, e, f, g, h] = rows;
    let low = unzipped(simd, [a[row], b[row]], [c[row], d[row]]);
    let high = unzipped(simd, [e[row], f[row]], [g[row], h[row]]);
    [low[0].combine(high[0]).bitcast(), low[1].combine(high[1]).bitcast()]
}

/// The lower and the upper halves, as bits of floats: for those every level has
/// a shuffle of two sources.
#[inline(always)]
fn unzipped<S: Simd>(simd: S, low: [u64; 2], high: [u64; 2]) -> [f32x4<S>; 2] {
    let low = u64x2::simd_from(simd, low).bitcast::<f32x4<S>>();
    let high = u64x2::simd_from(simd, high).bitcast::<f32x4<S>>();
    [low.unzip_low(high), low.unzip_high(high)]
}
