//! The look-up for eight points at once: the same bits in every lane as `sample` gives for one point.
//!
//! Levels, addresses and weights are computed in lanes, each lane with a mip
//! level of its own. Only the texels are read lane by lane, two at a time. Then
//! each of the four texels of a bilinear look-up is a vector of eight, and so is each
//! channel after it: the filter's arithmetic needs no shuffle.

use super::axis::{Filters, reduced_lanes, texel_lanes};
use super::detail::{FootprintLanes, log2_of_root_lanes};
use super::strips::{ALPHA, COLUMNS, Channels, Color, Data, PITCH, Strips, TexelQuad, Texels, mix};
use super::{MipFilter, Sampler, Texture, TextureFormat};
use crate::simd::{F32, I32, InlineMap, LANES, Simd, U32, lanes_of, prelude::*, transposed, unzipped};

impl Texture {
    /// [`Self::sample`] for eight points: red, green, blue and alpha, in each
    /// lane the same bits as for that point alone.
    ///
    /// Fastest where neighbouring lanes look up neighbouring texels.
    #[inline(always)]
    pub fn sample_lanes<S: Simd>(
        &self,
        simd: S,
        uv: [F32<S>; 2],
        ddx: [F32<S>; 2],
        ddy: [F32<S>; 2],
        sampler: &Sampler,
    ) -> [F32<S>; 4] {
        sample(simd, self, uv, ddx, ddy, sampler)
    }
}

#[inline(always)]
fn sample<S: Simd>(
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

/// The look-ups of eight footprints.
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
    fn value<T: Texels>(&self, footprint: &FootprintLanes<S>) -> Channels<S> {
        if self.sampler.most_probes() > 1.0 {
            self.mean::<T>(footprint)
        } else {
            self.at::<T>(self.uv, footprint.square)
        }
    }

    /// The value at one point. A separate function, because it is long and has many callers.
    #[inline(always)]
    fn at<T: Texels>(&self, [u, v]: [F32<S>; 2], square: F32<S>) -> Channels<S> {
        // Two vectors, not one array of them: AVX-512 would copy that as one, and wait for
        // its halves to be stored.
        self.simd.vectorize(
            #[inline(always)]
            || LaneLookup::new(self, [u, v], square).value::<T>(),
        )
    }

    /// The mean of the values at all probes of each lane's footprint. Lanes have different numbers
    /// of probes: the loop runs as often as the largest needs, and lanes that are done keep their
    /// sum. A lane with one probe gets the bits of a plain look-up: its offset 1 / 2 - 0.5 is exactly
    /// 0, and its sum is divided by 1.
    #[inline(always)]
    fn mean<T: Texels>(&self, footprint: &FootprintLanes<S>) -> Channels<S> {
        let zero = F32::splat(self.simd, 0.0);
        let FootprintLanes { square, probes, axis } = *footprint;
        let mut sum = [zero; 4];
        let mut index = 1.0;
        loop {
            let wanted = probes.simd_ge(index);
            if !wanted.any_true() {
                return [sum[0] / probes, sum[1] / probes, sum[2] / probes, sum[3] / probes];
            }
            let offset = wanted.select(footprint.offset(index), zero);
            let uv = [self.uv[0] + axis[0] * offset, self.uv[1] + axis[1] * offset];
            let value = self.at::<T>(reduced(uv, self.sampler), square);
            for (sum, value) in sum.iter_mut().zip(value) {
                *sum = wanted.select(*sum + value, *sum);
            }
            index += 1.0;
        }
    }
}

/// A look-up at eight points.
struct LaneLookup<'a, S: Simd> {
    simd: S,
    texture: &'a Texture,
    sampler: &'a Sampler,
    uv: [F32<S>; 2],
    filters: Filters<S>,
    finer: Levels<S>,
    /// The weight of the next level.
    next_weight: F32<S>,
}

impl<'a, S: Simd> LaneLookup<'a, S> {
    #[inline(always)]
    fn new(of: &Probes<'a, S>, uv: [F32<S>; 2], square: F32<S>) -> Self {
        let Probes { simd, texture, sampler, .. } = *of;
        let (zero, nought) = (F32::splat(simd, 0.0), I32::splat(simd, 0));
        // Lanes in which a texel is smaller than the side that one look-up covers.
        let minified = square.simd_gt(1.0);
        let (whole, rest) = log2_of_root_lanes(square);
        let last = I32::splat(simd, texture.strips.last_level as i32);
        // Where the level was clamped to the range, the next level has no weight.
        let level = whole.min(last).max(nought);
        let rest = (whole.simd_eq(level) & level.simd_lt(last)).select(rest, zero);
        let (finer, next_weight) = match sampler.mip {
            MipFilter::None => (nought, zero),
            MipFilter::Nearest => (level + rest.simd_ge(0.5).select(I32::splat(simd, 1), nought), zero),
            MipFilter::Linear | MipFilter::Anisotropic(_) => (level, rest),
        };
        let finer = Levels::new(finer);
        let filters = match (sampler.minification, sampler.magnification) {
            (minification, magnification) if minification == magnification => Filters::Uniform(minification),
            (super::Filter::Linear, _) => Filters::Linear(minified),
            _ => Filters::Linear(!minified),
        };
        Self { simd, texture, sampler, uv, filters, finer, next_weight }
    }

    #[inline(always)]
    fn value<T: Texels>(&self) -> Channels<S> {
        let finer = self.address(&self.finer);
        if !self.next_weight.simd_gt(0.0).any_true() {
            let texels = self.texels(&finer);
            return self.channels(
                #[inline(always)]
                |channel| finer.filtered::<T>(texels, channel),
            );
        }
        // Each step waits for the one before. So every step is taken for both
        // levels before the next one: the processor has twice as much to do.
        // Where there is no next level its weight is 0.
        let next = self.address(&self.finer.next(self.texture.strips.last_level));
        let (finer_texels, next_texels) = (self.texels(&finer), self.texels(&next));
        self.channels(
            #[inline(always)]
            |channel| {
                let value = finer.filtered::<T>(finer_texels, channel);
                mix(value, next.filtered::<T>(next_texels, channel), self.next_weight)
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

    /// Where the texels of each lane's look-up lie in its level.
    #[inline(always)]
    fn address(&self, levels: &Levels<S>) -> Address<S> {
        let [start, width, height, strip] = levels.of(self.simd, &self.texture.strips);
        let (x, s) = texel_lanes(self.uv[0], width, self.sampler.wrap_u, self.filters);
        let (y, t) = texel_lanes(self.uv[1], height, self.sampler.wrap_v, self.filters);
        Address { index: index([start, strip], [x, y]), s, t }
    }

    /// Top left and right, bottom left and right.
    #[inline(always)]
    fn texels(&self, address: &Address<S>) -> [[U32<S>; 2]; 2] {
        let index: [u32; LANES] = address.index.bitcast::<U32<S>>().into();
        let quads = self.texture.strips.quads();
        let rows = lanes_of(
            #[inline(always)]
            |lane| quads.at(index[lane]),
        );
        [neighbours(self.simd, &rows, 0), neighbours(self.simd, &rows, 1)]
    }
}

/// The levels of eight look-ups.
struct Levels<S: Simd> {
    each: I32<S>,
    /// The one that most often all lanes share.
    shared: Option<u32>,
}

impl<S: Simd> Levels<S> {
    #[inline(always)]
    fn new(each: I32<S>) -> Self {
        // The level is found by counting up to it instead of reading it from a lane. A processor that
        // predicts the end of this loop continues before the levels are known; nothing else that most of a
        // look-up depends on takes as long.
        let mut level = 0;
        while each.simd_gt(level).any_true() {
            level += 1;
        }
        Self { each, shared: each.simd_eq(level).all_true().then_some(level as u32) }
    }

    /// The next ones, up to the last.
    #[inline(always)]
    fn next(&self, last: u32) -> Self {
        let each = (self.each + 1).min(last as i32);
        Self { each, shared: self.shared.map(|level| (level + 1).min(last)) }
    }

    /// Start, width, height and strip length of each level.
    #[inline(always)]
    fn of(&self, simd: S, strips: &Strips) -> [I32<S>; 4] {
        if let Some(level) = self.shared {
            return strips.level(level).each(
                #[inline(always)]
                |number| I32::splat(simd, number),
            );
        }
        let each: [i32; LANES] = self.each.into();
        let levels = lanes_of(
            #[inline(always)]
            |lane| strips.level(each[lane] as u32),
        );
        transposed(simd, levels)
    }
}

/// The texels of eight look-ups in one level.
struct Address<S: Simd> {
    /// The first texel's, counted from the start of the base level.
    index: I32<S>,
    /// The weight of the right texels, and of the lower ones.
    s: F32<S>,
    t: F32<S>,
}

impl<S: Simd> Address<S> {
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

/// [`Strips::index`](super::strips::Strips::index), for lanes, in levels that start there
/// and whose strips take so many texels without their border.
#[inline(always)]
fn index<S: Simd>([start, texels]: [I32<S>; 2], [x, y]: [I32<S>; 2]) -> I32<S> {
    let strip = x >> COLUMNS.trailing_zeros();
    // A strip has 9 · (height + 1) texels, of which `texels` counts 9 · height. The column within the
    // strip is x - 8 · strip, so 9 · strip - 8 · strip = strip is left to add to x.
    strip * texels + (start + (x + strip) + y * PITCH as i32)
}

/// The left and the right texels of one row of all quads.
#[inline(always)]
fn neighbours<S: Simd>(simd: S, rows: &[TexelQuad; LANES], row: usize) -> [U32<S>; 2] {
    unzipped(
        simd,
        rows.each(
            #[inline(always)]
            |row_of| row_of[row],
        ),
    )
}
