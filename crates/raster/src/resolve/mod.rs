//! Pixels of a tile go to the target: mean in linear light, transfer function,
//! ids.

mod background;
mod edges;
mod mean;

pub(crate) use background::fill_background;
pub(crate) use mean::{mean, saturated};

use crate::frame::FrameView;
use crate::shade::{Encoding, Shading};
use crate::simd::{Each, LANES, at_level};
use crate::target::{Band, Bands};
use crate::tile::{NOBODY, Scratch, TileArea};
use trigon_math::Vec4;

/// Writes all outputs of a tile; `early` if its pixels are bytes already.
pub(crate) fn resolve(
    frame: &FrameView<'_>,
    area: &TileArea,
    scratch: &mut Scratch,
    (bands, early): (&Bands<'_>, Option<Encoding>),
) {
    if let Some(encoding) = early {
        background::lay_codes(frame, area, &mut scratch.shading, encoding);
        edges::average_codes(frame, area, &mut scratch.shading, encoding);
        copy_codes(frame, area, scratch, bands);
    } else if frame.wants.color {
        finish_colors(frame, area, scratch);
        if let Some(encoding) = frame.wants.bytes {
            let span = scratch.buffer.span();
            let Shading { colors, codes, .. } = &mut scratch.shading;
            at_level!(frame.token, simd => encoding.encode_all(simd, &colors[..span], codes));
            copy_codes(frame, area, scratch, bands);
        } else {
            store_colors(frame, area, scratch, bands);
        }
    }
    if frame.wants.depth || frame.wants.ids {
        store_visibility(frame, area, scratch, bands);
    }
}

/// Copies bytes, a row of a block at a time.
fn copy_codes(frame: &FrameView<'_>, area: &TileArea, scratch: &Scratch, bands: &Bands<'_>) {
    let [left, top] = area.origin.map(|v| v as u32);
    let (mut band, first) = bands.lock([left, top]);
    let band = &mut *band;
    let picture = if band.unorm8.is_empty() { &mut *band.srgb8 } else { &mut *band.unorm8 };
    let [columns, rows] = frame.drawn_part(area);
    let codes = &scratch.shading.codes;
    for y in rows {
        let start = first + y * bands.width();
        let row = &mut picture[start + columns.start..start + columns.end];
        // Up to a whole block first.
        let head = row.len().min(columns.start.next_multiple_of(8) - columns.start);
        let (head, row) = row.split_at_mut(head);
        copy_some(head, codes, [columns.start, y]);
        let whole = columns.start + head.len();
        let (eights, tail) = row.as_chunks_mut::<8>();
        let copied = whole + 8 * eights.len();
        let blocks = &codes.as_chunks::<BLOCK>().0[TileArea::index_of([whole, y]) / BLOCK..];
        // The same in each block: what is known of it is not asked for each.
        let left = TileArea::index_of([0, y % 8]);
        for (pixels, block) in eights.iter_mut().zip(blocks) {
            for (pixels, at) in pixels.as_chunks_mut().0.iter_mut().zip([left, left + LANES]) {
                let codes = block[at..].first_chunk::<4>().expect("groups are whole");
                *pixels = codes.each(u32::to_le_bytes);
            }
        }
        copy_some(tail, codes, [copied, y]);
    }
}

/// Pixels of a block.
const BLOCK: usize = 64;

/// Copies fewer pixels than are in a row of a block.
fn copy_some(pixels: &mut [[u8; 4]], codes: &[u32], [x, y]: [usize; 2]) {
    for (pixel, x) in pixels.iter_mut().zip(x..) {
        *pixel = codes[TileArea::index_of([x, y])].to_le_bytes();
    }
}

/// Gives every pixel of the finer grid its colour: the mean of its samples, or
/// the background.
fn finish_colors(frame: &FrameView<'_>, area: &TileArea, scratch: &mut Scratch) {
    if std::mem::take(&mut scratch.blended) {
        return;
    }
    background::lay_colors(frame, area, &mut scratch.shading);
    edges::average_colors(frame, area, &mut scratch.shading);
}

/// Writes the outputs of colour, pixel by pixel.
fn store_colors(frame: &FrameView<'_>, area: &TileArea, scratch: &Scratch, bands: &Bands<'_>) {
    let axis = frame.supersampling as usize;
    let color_of = |cell| Vec4::from_array(scratch.shading.colors[TileArea::index_of(cell)]);
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

/// Writes depth and ids, each from one sample of the pixel.
fn store_visibility(frame: &FrameView<'_>, area: &TileArea, scratch: &Scratch, bands: &Bands<'_>) {
    let axis = frame.supersampling as usize;
    for_each_drawn(frame, area, bands, |band, index, [x, y]| {
        let pixel = TileArea::index_of([x * axis + axis / 2, y * axis + axis / 2]);
        let sample = scratch.buffer.index(pixel, 0);
        if let Some(depth) = band.depth.get_mut(index) {
            let seen = scratch.buffer.depth[sample];
            // The background is behind 0; and -0 becomes 0.
            *depth = if seen > 0.0 { seen } else { 0.0 };
        }
        if frame.wants.ids {
            let ids = frame.ids(scratch, sample);
            for (plane, id) in [&mut band.objects, &mut band.faces, &mut band.triangles].into_iter().zip(ids)
            {
                if let Some(place) = plane.get_mut(index) {
                    *place = id;
                }
            }
        }
    });
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
    let (mut band, first) = bands.lock(area.origin.map(|v| v as u32 / frame.supersampling));
    let [columns, rows] = frame.drawn_part(area);
    for y in rows {
        for x in columns.clone() {
            visit(&mut band, first + y * bands.width() + x, [x, y]);
        }
    }
}

impl FrameView<'_> {
    /// The object, face and primitive that a sample of the buffer sees.
    fn ids(&self, scratch: &Scratch, sample: usize) -> [u32; 3] {
        match scratch.buffer.winner[sample] {
            NOBODY => [u32::MAX; 3],
            winner => {
                let place = scratch.places[winner as usize];
                let plan = &self.plan.draws[self.draw_of(place)];
                let geometry = &self.pass[plan.draw].geometry;
                let primitive = place.ordinal - plan.ordinals.start;
                [geometry.object, geometry.face(primitive), primitive]
            }
        }
    }
}
