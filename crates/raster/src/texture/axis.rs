//! One axis of a look-up: from a coordinate to a texel and the weight of the next texel, for one point and for eight
//! lanes.
//!
//! A coordinate is first reduced to its period, while it is still precise, and then multiplied by the size of a mip
//! level. From the coordinate to the position in texels the error is at most `size · 2⁻²³`, however far from zero the
//! coordinate is: less than 1/500 of a texel for the largest size.
//!
//! Both forms do the same operations in the same order, so they agree in every bit. `floor` is written as a conversion
//! to an integer and back. This is exact for the numbers here, and baseline x86-64 has no instruction for `floor`.

use super::{Filter, Wrap};
use crate::simd::prelude::*;
use crate::simd::{F32, I32, Mask, Simd, U32, greater, lesser};

/// Numbers from here on are integers: they have no fraction to look up.
const WHOLE: f32 = 8_388_608.0;
/// The largest `f32` below 1.
const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;

/// The coordinate in its first period: from 0 to below 1 for [`Wrap::Repeat`],
/// below 2 for [`Wrap::MirroredRepeat`], unchanged for [`Wrap::ClampToEdge`]. 0
/// for what is not finite. Reducing twice is the same as reducing once.
#[inline]
pub(super) fn reduced(coordinate: f32, wrap: Wrap) -> f32 {
    match wrap {
        Wrap::Repeat => fraction(coordinate),
        Wrap::MirroredRepeat => 2.0 * fraction(coordinate * 0.5),
        Wrap::ClampToEdge if coordinate.is_finite() => coordinate,
        Wrap::ClampToEdge => 0.0,
    }
}

/// [`reduced`], for lanes.
#[inline(always)]
pub(super) fn reduced_lanes<S: Simd>(coordinate: F32<S>, wrap: Wrap) -> F32<S> {
    match wrap {
        Wrap::Repeat => fraction_lanes(coordinate),
        Wrap::MirroredRepeat => fraction_lanes(coordinate * 0.5) * 2.0,
        Wrap::ClampToEdge => {
            let zero = F32::splat(coordinate.token(), 0.0);
            coordinate.abs().simd_lt(f32::INFINITY).select(coordinate, zero)
        }
    }
}

/// The distance to the next integer below, exact but for coordinates just below
/// an integer near 0; never 1.
#[inline]
fn fraction(x: f32) -> f32 {
    let x = if x.abs() < WHOLE { x } else { 0.0 };
    let rest = x - x as i32 as f32;
    let fraction = if rest < 0.0 { rest + 1.0 } else { rest };
    if fraction < BELOW_ONE { fraction } else { BELOW_ONE }
}

#[inline(always)]
fn fraction_lanes<S: Simd>(x: F32<S>) -> F32<S> {
    let zero = F32::splat(x.token(), 0.0);
    // What large numbers and those that are none give is left out at the end, and all that
    // can be is found side by side: a look-up waits for this.
    let rest = x - truncated(x);
    // Neither is a NaN or a zero of unknown sign, where it counts.
    let above = (rest + 1.0).min(BELOW_ONE);
    let fraction = rest.simd_lt(0.0).select(above, rest);
    x.abs().simd_lt(WHOLE).select(fraction, zero)
}

#[inline(always)]
fn truncated<S: Simd>(x: F32<S>) -> F32<S> {
    x.to_int::<I32<S>>().to_float()
}

/// The texel that a reduced coordinate lies in, or the first of the two whose
/// centres enclose it and the share of the second.
///
/// Only [`Wrap::Repeat`] ever needs what follows the last texel; the other modes
/// give it no share.
#[inline]
pub(super) fn texel(reduced: f32, size: f32, wrap: Wrap, filter: Filter) -> (u32, f32) {
    match filter {
        Filter::Nearest => (nearest(reduced, size, wrap), 0.0),
        Filter::Linear => linear(reduced, size, wrap),
    }
}

/// The texel that a coordinate lies in. One on the boundary belongs to the
/// texel that follows in the direction of the coordinate, in mirrored periods
/// as well.
#[inline]
fn nearest(reduced: f32, size: f32, wrap: Wrap) -> u32 {
    let position = reduced * size;
    let last = size - 1.0;
    match wrap {
        Wrap::Repeat => position as u32,
        Wrap::MirroredRepeat => {
            let texel = position as i32 as f32;
            (if texel < size { texel } else { last + size - texel }) as u32
        }
        Wrap::ClampToEdge => held(position, last) as u32,
    }
}

#[inline]
fn linear(reduced: f32, size: f32, wrap: Wrap) -> (u32, f32) {
    let last = size - 1.0;
    match wrap {
        Wrap::Repeat => {
            let position = reduced * size - 0.5;
            if position < 0.0 {
                return (last as u32, position + 1.0);
            }
            let first = position as u32;
            (first, position - first as f32)
        }
        Wrap::MirroredRepeat | Wrap::ClampToEdge => {
            let mirrored = wrap == Wrap::MirroredRepeat && reduced > 1.0;
            let reduced = if mirrored { 2.0 - reduced } else { reduced };
            let position = held(reduced * size - 0.5, last);
            let first = position as u32;
            (first, position - first as f32)
        }
    }
}

/// `position` within 0 and `last`.
#[inline]
fn held(position: f32, last: f32) -> f32 {
    let position = if position > 0.0 { position } else { 0.0 };
    if position < last { position } else { last }
}

/// Which filter each lane takes.
#[derive(Clone, Copy)]
pub(super) enum Filters<S: Simd> {
    /// All the same.
    Uniform(Filter),
    /// The bilinear filter where true, the nearest texel elsewhere.
    Linear(Mask<S>),
}

/// [`texel`], for lanes.
#[inline(always)]
pub(super) fn texel_lanes<S: Simd>(
    reduced: F32<S>,
    size: I32<S>,
    wrap: Wrap,
    filters: Filters<S>,
) -> (I32<S>, F32<S>) {
    let zero = F32::splat(size.token(), 0.0);
    match filters {
        Filters::Uniform(Filter::Nearest) => (nearest_lanes(reduced, size.to_float(), wrap), zero),
        Filters::Uniform(Filter::Linear) => linear_lanes(reduced, size, wrap),
        Filters::Linear(mask) => {
            let (first, share) = linear_lanes(reduced, size, wrap);
            let nearest = nearest_lanes(reduced, size.to_float(), wrap);
            (mask.select(first, nearest), mask.select(share, zero))
        }
    }
}

#[inline(always)]
fn nearest_lanes<S: Simd>(reduced: F32<S>, size: F32<S>, wrap: Wrap) -> I32<S> {
    let position = reduced * size;
    let last = size - 1.0;
    match wrap {
        Wrap::Repeat => position.to_int(),
        Wrap::MirroredRepeat => {
            let texel = truncated(position);
            texel.simd_lt(size).select(texel, last + size - texel).to_int()
        }
        Wrap::ClampToEdge => held_lanes(position, last).to_int(),
    }
}

#[inline(always)]
fn linear_lanes<S: Simd>(reduced: F32<S>, size: I32<S>, wrap: Wrap) -> (I32<S>, F32<S>) {
    let whole = size.to_float::<F32<S>>();
    match wrap {
        Wrap::Repeat => {
            let position = reduced * whole - 0.5;
            // The sign is -1 before the first centre: between the last texel, of which
            // -1 without a sign is the lesser, and the first.
            let first = position.to_int::<I32<S>>() + (position.bitcast::<I32<S>>() >> 31);
            let share = position - first.to_float::<F32<S>>();
            let last = (size - 1).bitcast::<U32<S>>();
            (first.bitcast::<U32<S>>().min(last).bitcast(), share)
        }
        Wrap::MirroredRepeat | Wrap::ClampToEdge => {
            let reduced = match wrap {
                Wrap::MirroredRepeat => reduced.simd_gt(1.0).select(2.0 - reduced, reduced),
                _ => reduced,
            };
            let position = held_lanes(reduced * whole - 0.5, whole - 1.0);
            let first = position.to_int::<I32<S>>();
            (first, position - first.to_float::<F32<S>>())
        }
    }
}

#[inline(always)]
fn held_lanes<S: Simd>(position: F32<S>, last: F32<S>) -> F32<S> {
    lesser(greater(position, F32::splat(last.token(), 0.0)), last)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// How far apart two positions are on a ring of `period` texels.
    fn distance(a: f64, b: f64, period: f64) -> f64 {
        let apart = (a - b).rem_euclid(period);
        apart.min(period - apart)
    }

    proptest! {
        #[test]
        fn positions_are_precise_however_far_from_zero(
            coordinate in prop_oneof![
                -1.5_f32..1.5,
                -1e5_f32..1e5,
                -8e6_f32..8e6,
                (0.0_f32..1e-3).prop_map(|x| -x),
            ],
            size in 1_u32..=16384,
        ) {
            let exact = f64::from(coordinate) * f64::from(size) - 0.5;
            let (first, share) =
                texel(reduced(coordinate, Wrap::Repeat), size as f32, Wrap::Repeat, Filter::Linear);
            prop_assert!(first < size && (0.0..=1.0).contains(&share), "texel {first} and {share}");
            let error = distance(f64::from(first) + f64::from(share), exact, f64::from(size));
            let bound = f64::from(size) * f64::from(f32::EPSILON);
            prop_assert!(error <= bound, "off by {error:e} texels, bound {bound:e}");
        }

        #[test]
        fn reducing_twice_is_reducing_once(coordinate in any::<f32>(), wrap in 0_usize..3) {
            let wrap = [Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge][wrap];
            let once = reduced(coordinate, wrap);
            prop_assert_eq!(reduced(once, wrap), once, "{} with {:?}", coordinate, wrap);
        }
    }
}
