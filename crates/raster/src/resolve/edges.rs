//! The mean colours of pixels whose samples show different triangles.

use crate::fragments::Encoding;
use crate::pass::Background;
use crate::shade::{BEHIND, EdgeGroup, Shading};
use crate::simd::{LANES, Mask, Simd, U32, at_level, channels, inlined, prelude::*};
use crate::tile_buffer::TileArea;
use crate::view::FrameView;
use fearless_simd::{f32x4, mask32x4};
use trigon_math::Vec4;

/// Gives the pixels their bytes.
pub(super) fn average_codes(
    frame: &FrameView<'_>,
    area: &TileArea,
    shading: &mut Shading,
    encoding: Encoding,
) {
    at_level!(frame.token, simd => for_each_group(simd, frame, area, shading, #[inline(always)] |group, means, codes, _| {
        let codes: &mut [u32; LANES] = codes.first_chunk_mut().expect("groups are whole");
        let encoded = encoding.encode_lanes(simd, channels(simd, means.each_ref()));
        let mask = Mask::from_bitmask(simd, u64::from(group.lanes));
        *codes = mask.select(encoded, U32::simd_from(simd, *codes)).into();
    }));
}

/// Gives the pixels their colours in linear light.
pub(super) fn average_colors(frame: &FrameView<'_>, area: &TileArea, shading: &mut Shading) {
    at_level!(frame.token, simd => for_each_group(simd, frame, area, shading, #[inline(always)] |group, means, _, colors| {
        for lane in group.lanes() {
            colors[lane] = means[lane];
        }
    }));
}

/// Visits the groups that have such pixels, with the pixels' means; and where their bytes
/// or colours go.
#[inline(always)]
fn for_each_group<S: Simd>(
    simd: S,
    frame: &FrameView<'_>,
    area: &TileArea,
    shading: &mut Shading,
    mut visit: impl FnMut(EdgeGroup, &[[f32; 4]; LANES], &mut [u32], &mut [[f32; 4]]),
) {
    let Shading { edges, codes, colors, outer, .. } = shading;
    let varies = !matches!(frame.background, Background::Color(_)) || !outer.is_empty();
    colors[BEHIND] = frame.background_at(area, [0, 0]).to_array();
    let mut means = [[0.0; 4]; LANES];
    for (group, names) in edges.iter() {
        let first = group.number as usize * LANES;
        for lane in group.lanes() {
            if varies {
                let at = TileArea::pixel_at(first + lane);
                colors[BEHIND] = frame.lined_background_at(area, at, outer).to_array();
            }
            means[lane] = mean_of(simd, names, lane, colors);
        }
        visit(group, &means, &mut codes[first..], &mut colors[first..]);
    }
}

/// The mean of the colours that a lane's names refer to, computed as in [`mean`].
#[inline(always)]
fn mean_of<S: Simd>(simd: S, names: &[[u32; LANES]], lane: usize, colors: &[[f32; 4]]) -> [f32; 4] {
    let color = inlined(
        #[inline(always)]
        |names: &[u32; LANES]| f32x4::simd_from(simd, colors[names[lane] as usize]),
    );
    let first = color(&names[0]);
    let (mut sum, mut equal) = (first, mask32x4::splat(simd, true));
    for names in &names[1..] {
        let color = color(names);
        sum += color;
        equal &= color.simd_eq(first);
    }
    if equal.all_true() {
        return first.into();
    }
    // Infinity and NaN times zero are no numbers.
    if (sum * 0.0).simd_eq(0.0).all_true() {
        return (sum * (1.0 / names.len() as f32)).into();
    }
    large_mean(names, lane, colors)
}

/// Where sums overflow.
#[cold]
fn large_mean(names: &[[u32; LANES]], lane: usize, colors: &[[f32; 4]]) -> [f32; 4] {
    let of_samples = names.iter().map(|names| Vec4::from_array(colors[names[lane] as usize]));
    mean(of_samples, names.len()).to_array()
}

/// The mean of `count` colours. Equal ones are not rounded, so that a pixel
/// that shows only the background is the same in a tile that shows more.
#[inline]
pub(crate) fn mean(colors: impl Iterator<Item = Vec4> + Clone, count: usize) -> Vec4 {
    let mut rest = colors.clone();
    let first = rest.next().unwrap_or(Vec4::ZERO);
    let (mut sum, mut equal) = (first, true);
    for color in rest {
        sum += color;
        equal &= color == first;
    }
    let share = 1.0 / count as f32;
    if equal {
        first
    } else if sum.is_finite() {
        sum * share
    } else {
        saturated(colors.map(|color| color * share).sum())
    }
}

/// The largest number in place of infinity: what sums of finite colours can
/// reach. An infinity would be no number as soon as it met a factor of 0.
#[inline]
pub(crate) fn saturated(color: Vec4) -> Vec4 {
    if color.is_finite() {
        return color;
    }
    Vec4::from_array(color.to_array().map(|v| {
        if v.is_finite() {
            v
        } else if v > 0.0 {
            f32::MAX
        } else {
            f32::MIN
        }
    }))
}
