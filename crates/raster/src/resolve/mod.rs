//! Writes the pixels of a tile to the target: averages samples in linear light, encodes colours, writes ids.

mod background;
mod strip;

pub(crate) use strip::Strip;

use crate::fragments::Encoding;
use crate::pass::Background;
use crate::shade::{BEHIND, EdgeGroup, Shading};
use crate::simd::{LANES, Mask, Simd, U32, at_level, channels, inlined, prelude::*};
use crate::target::{Band, Bands};
use crate::tile::TileState;
use crate::tile_buffer::{MAX_SIDE, NO_TRIANGLE, TileArea, TileRows, VisibilityBuffer};
use crate::view::FrameView;
use background::fill_background;
use fearless_simd::{f32x4, mask32x4};
use std::ops::Range;
use trigon_math::Vec4;

/// How far the colours of a tile are.
#[derive(Clone, Copy)]
pub(crate) enum TileColors<'a> {
    /// Pixels that see one triangle are bytes already.
    Encoded(Encoding),
    /// The same, of those pixels that are asked for. The target holds all others.
    PartlyEncoded(Encoding, &'a TileRows),
    /// Pixels that see one triangle are in linear light.
    Shaded,
    /// All pixels are in linear light, the background's included.
    Blended,
}

/// Writes the outputs of colour of a tile, all of its bytes when tiles beside it are finished, too.
pub(crate) fn resolve(
    frame: &FrameView<'_>,
    area: &TileArea,
    colors: TileColors<'_>,
    shading: &mut Shading,
    strip: &mut Strip,
    bands: &Bands<'_>,
) {
    match colors {
        TileColors::Encoded(encoding) => {
            background::lay_codes(frame, area, shading, encoding);
            average_codes(frame, area, shading, encoding);
            return strip.push(frame, area, &mut shading.codes, bands);
        }
        TileColors::PartlyEncoded(encoding, requested) => {
            background::lay_codes(frame, area, shading, encoding);
            return strip::write_some(frame, area, requested, &shading.codes, bands);
        }
        TileColors::Shaded => {
            background::lay_colors(frame, area, shading);
            average_colors(frame, area, shading);
        }
        TileColors::Blended => {}
    }
    if let Some(encoding) = frame.wants.bytes {
        let Shading { colors, codes, .. } = &mut *shading;
        at_level!(frame.token, simd => encoding.encode_all(simd, &colors[..area.span()], codes));
        strip.push(frame, area, codes, bands);
    } else {
        store_colors(frame, area, &shading.colors, bands);
    }
}

/// Writes the outputs of colour, pixel by pixel.
fn store_colors(frame: &FrameView<'_>, area: &TileArea, colors: &[[f32; 4]], bands: &Bands<'_>) {
    let axis = frame.supersampling as usize;
    let color_of = |cell| Vec4::from_array(colors[TileArea::index_of(cell)]);
    for_each_drawn(frame, area, bands, |band, index, [x, y]| {
        let color = match axis {
            1 => color_of([x, y]),
            _ => {
                let cells = (0..axis * axis).map(|i| [x * axis + i % axis, y * axis + i / axis]);
                mean(cells.map(color_of), axis * axis)
            }
        };
        if let Some(pixel) = band.linear.get_mut(index) {
            *pixel = color;
        }
        if let Some(pixel) = band.srgb8.get_mut(index) {
            *pixel = Encoding::Srgb8.encode(color);
        }
        if let Some(pixel) = band.unorm8.get_mut(index) {
            *pixel = Encoding::Unorm8.encode(color);
        }
    });
}

/// Writes depth and ids, if they are requested, each from one sample of the pixel, row by row. Of ids, which take
/// longer, only those are written for which `requested` has a bit in their row, if it is given: the target holds all others.
pub(crate) fn store_visibility(
    frame: &FrameView<'_>,
    area: &TileArea,
    requested: Option<&TileRows>,
    state: &TileState,
    bands: &Bands<'_>,
) {
    if !(frame.wants.depth || frame.wants.ids) {
        return;
    }
    let (mut band, first) = bands.lock(area.own_origin().map(|v| v as u32 / frame.supersampling));
    let band = &mut *band;
    let [columns, rows] = frame.drawn_part(area);
    let [left, top] = area.margin.map(|side| side / frame.supersampling as usize);
    let own = left + columns.start..left + columns.end;
    for y in rows {
        let start = first + y * bands.width();
        let pixels = start + columns.start..start + columns.end;
        if frame.wants.depth {
            let depths = sampled_row(frame, &state.buffer, &state.buffer.depth, [own.end, top + y]);
            for (depth, &nearest) in band.depth[pixels.clone()].iter_mut().zip(&depths[own.clone()]) {
                // The background is behind 0; and -0 becomes 0.
                *depth = if nearest > 0.0 { nearest } else { 0.0 };
            }
        }
        let requested = requested.map_or(u64::MAX, |requested| requested[top + y] >> own.start);
        if frame.wants.ids && requested != 0 {
            let visible = sampled_row(frame, &state.buffer, &state.buffer.visible, [own.end, top + y]);
            store_ids(frame, state, band, pixels, VisibleRow { visible: &visible[own.clone()], requested });
        }
    }
}

/// The first `width` pixels of the tile in row `y`, each with the value of the sample that its depth and ids are taken from.
fn sampled_row<T: Copy + Default>(
    frame: &FrameView<'_>,
    buffer: &VisibilityBuffer,
    values: &[T],
    [width, y]: [usize; 2],
) -> [T; MAX_SIDE] {
    let axis = frame.supersampling as usize;
    let mut row = [T::default(); MAX_SIDE];
    if axis == 1 {
        // The pixels of a row lie side by side in each group.
        let halves = row.as_chunks_mut::<{ LANES / 2 }>().0.iter_mut().take(width.div_ceil(LANES / 2));
        for (number, half) in halves.enumerate() {
            let first = buffer.index(TileArea::index_of([number * (LANES / 2), y]), 0);
            *half = *values[first..].first_chunk().expect("groups are whole");
        }
    } else {
        let middle = |v: usize| v * axis + axis / 2;
        for (x, value) in row[..width].iter_mut().enumerate() {
            *value = values[buffer.index(TileArea::index_of([middle(x), middle(y)]), 0)];
        }
    }
    row
}

/// Neighbouring pixels of a row.
struct VisibleRow<'r> {
    /// The visible triangle of each.
    visible: &'r [u32],
    /// A bit for each whose ids are written.
    requested: u64,
}

/// Writes the ids of neighbouring pixels of a row, given by their indices in the band.
fn store_ids(
    frame: &FrameView<'_>,
    state: &TileState,
    band: &mut Band<'_>,
    pixels: Range<usize>,
    VisibleRow { visible, requested }: VisibleRow<'_>,
) {
    // Ids that are not requested go here, so that no pixel asks which are.
    let mut unused = [[0; MAX_SIDE]; 3];
    let mut planes = unused.each_mut().map(|row| &mut row[..visible.len()]);
    for (row, plane) in planes.iter_mut().zip([&mut *band.objects, &mut *band.faces, &mut *band.triangles]) {
        if !plane.is_empty() {
            *row = &mut plane[pixels.clone()];
        }
    }
    let [objects, faces, triangles] = planes;
    let ids = objects.iter_mut().zip(faces).zip(triangles);
    let mut last = (NO_TRIANGLE, [u32::MAX; 3]);
    for ((x, &visible), ((object, face), triangle)) in visible.iter().enumerate().zip(ids) {
        if requested >> x & 1 == 0 {
            continue;
        }
        // Neighbours often see the same triangle.
        if visible != last.0 {
            last = (visible, frame.ids(state, visible));
        }
        [*object, *face, *triangle] = last.1;
    }
}

/// Visits the target's pixels that a tile draws: their band, their index in it, and
/// their column and row from the tile's first.
#[inline(always)]
fn for_each_drawn(
    frame: &FrameView<'_>,
    area: &TileArea,
    bands: &Bands<'_>,
    mut visit: impl FnMut(&mut Band<'_>, usize, [usize; 2]),
) {
    let (mut band, first) = bands.lock(area.own_origin().map(|v| v as u32 / frame.supersampling));
    let [columns, rows] = frame.drawn_part(area);
    let [left, top] = area.margin.map(|side| side / frame.supersampling as usize);
    for y in rows {
        for x in columns.clone() {
            visit(&mut band, first + y * bands.width() + x, [left + x, top + y]);
        }
    }
}

impl FrameView<'_> {
    /// The object, face and primitive of a visible triangle.
    fn ids(&self, state: &TileState, visible: u32) -> [u32; 3] {
        match visible {
            NO_TRIANGLE => [u32::MAX; 3],
            visible => {
                let triangle = state.triangles[visible as usize];
                let plan = &self.plan.draws[self.draw_of(triangle)];
                let geometry = &self.pass[plan.draw()].geometry;
                let primitive = triangle.ordinal - plan.ordinals.start;
                [geometry.object, geometry.face(primitive), primitive]
            }
        }
    }
}

/// Gives the pixels their bytes.
fn average_codes(frame: &FrameView<'_>, area: &TileArea, shading: &mut Shading, encoding: Encoding) {
    at_level!(frame.token, simd => for_each_group(simd, frame, area, shading, #[inline(always)] |group, means, codes, _| {
        let codes: &mut [u32; LANES] = codes.first_chunk_mut().expect("groups are whole");
        let encoded = encoding.encode_lanes(simd, channels(simd, means.each_ref()));
        let mask = Mask::from_bitmask(simd, u64::from(group.lanes));
        *codes = mask.select(encoded, U32::simd_from(simd, *codes)).into();
    }));
}

/// Gives the pixels their colours in linear light.
fn average_colors(frame: &FrameView<'_>, area: &TileArea, shading: &mut Shading) {
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
