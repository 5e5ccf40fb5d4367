//! Writes neighbouring tiles to the target together, finished and empty ones, because long rows of memory are written
//! faster than short ones: the processor prefetches them.
//!
//! Of a tile that is redrawn in part, [`write_some`] writes the pixels that were shaded. The target holds all others.

use super::fill_background;
use crate::simd::{InlineMap, LANES};
use crate::target::Bands;
use crate::tile_buffer::TileRows;
use crate::tile_buffer::{PIXELS, TileArea};
use crate::view::FrameView;
use std::mem::swap;

/// Neighbours of one row of tiles, from left to right, that wait to be written.
#[derive(Default)]
pub(crate) struct Strip {
    /// Those that are finished.
    areas: Vec<TileArea>,
    /// Their pixels as bytes. At least as many; the others are kept for later tiles.
    codes: Vec<Vec<u32>>,
    /// The first and the last of those that nothing is in.
    empty: Option<[TileArea; 2]>,
}

impl Strip {
    /// The most finished tiles that wait: more would not fit into a processor's cache.
    pub(crate) const MOST: usize = 8;

    /// Takes a tile that nothing is in. What waits of such tiles is written first if this one
    /// does not continue it.
    pub(crate) fn push_empty(&mut self, frame: &FrameView<'_>, area: &TileArea, bands: &Bands<'_>) {
        match &mut self.empty {
            Some([_, last]) if continues(frame, last, area) => *last = *area,
            _ => {
                self.write_empty(frame, bands);
                self.empty = Some([*area; 2]);
            }
        }
    }

    /// Takes a tile's pixels, and leaves others instead. What waits is written
    /// first if the tile does not continue it.
    pub(super) fn push(
        &mut self,
        frame: &FrameView<'_>,
        area: &TileArea,
        codes: &mut Vec<u32>,
        bands: &Bands<'_>,
    ) {
        let continued = self.areas.last().is_none_or(|last| continues(frame, last, area));
        if !continued || self.areas.len() == Self::MOST {
            self.write_finished(frame, bands);
        }
        if self.codes.len() == self.areas.len() {
            self.codes.push(vec![0; PIXELS]);
        }
        swap(&mut self.codes[self.areas.len()], codes);
        self.areas.push(*area);
    }

    /// Writes all that waits.
    pub(crate) fn write(&mut self, frame: &FrameView<'_>, bands: &Bands<'_>) {
        self.write_empty(frame, bands);
        self.write_finished(frame, bands);
    }

    fn write_empty(&mut self, frame: &FrameView<'_>, bands: &Bands<'_>) {
        if let Some(ends) = self.empty.take() {
            fill_background(frame, ends, bands);
        }
    }

    fn write_finished(&mut self, frame: &FrameView<'_>, bands: &Bands<'_>) {
        let Some(first) = self.areas.first() else { return };
        let (mut band, corner) = bands.lock(first.own_origin().map(|v| v as u32));
        let band = &mut *band;
        let image = if band.unorm8.is_empty() { &mut *band.srgb8 } else { &mut *band.unorm8 };
        let [_, rows] = frame.drawn_part(first);
        // For each of them once: its columns that are drawn, its width, and where its own begin.
        let parts: [_; Self::MOST] = std::array::from_fn(|number| {
            let area = self.areas.get(number).unwrap_or(first);
            (frame.drawn_part(area)[0].clone(), frame.own_part(area)[0].len(), area.margin)
        });
        for y in rows {
            let mut start = corner + y * bands.width();
            for ((columns, width, [left, top]), codes) in parts[..self.areas.len()].iter().zip(&self.codes) {
                let row = &mut image[start + columns.start..start + columns.end];
                copy_row(row, codes, [left + columns.start, top + y]);
                start += width;
            }
        }
        self.areas.clear();
    }
}

/// Whether a tile is the next one of its row.
fn continues(frame: &FrameView<'_>, last: &TileArea, next: &TileArea) -> bool {
    let [x, y] = last.own_origin();
    next.own_origin() == [x + frame.own_part(last)[0].len() as i32, y]
}

/// Copies bytes to a row from a column on, a row of a block at a time.
#[inline]
fn copy_row(row: &mut [[u8; 4]], codes: &[u32], [column, y]: [usize; 2]) {
    // Up to a whole block first.
    let head = row.len().min(column.next_multiple_of(8) - column);
    let (head, row) = row.split_at_mut(head);
    copy_some(head, codes, [column, y]);
    let whole = column + head.len();
    let (eights, tail) = row.as_chunks_mut::<8>();
    let copied = whole + 8 * eights.len();
    let blocks = &codes.as_chunks::<BLOCK>().0[TileArea::index_of([whole, y]) / BLOCK..];
    // The same in each block, from values that are known for the whole strip.
    let left = TileArea::index_of([0, y % 8]);
    for (pixels, block) in eights.iter_mut().zip(blocks) {
        for (pixels, at) in pixels.as_chunks_mut().0.iter_mut().zip([left, left + LANES]) {
            let codes = block[at..].first_chunk::<4>().expect("groups are whole");
            *pixels = codes.each(u32::to_le_bytes);
        }
    }
    copy_some(tail, codes, [copied, y]);
}

/// Pixels of a block.
const BLOCK: usize = 64;

/// Copies fewer pixels than are in a row of a block.
fn copy_some(pixels: &mut [[u8; 4]], codes: &[u32], [x, y]: [usize; 2]) {
    for (pixel, x) in pixels.iter_mut().zip(x..) {
        *pixel = codes[TileArea::index_of([x, y])].to_le_bytes();
    }
}

/// Pixels of a row that lie side by side in a group.
const SIDE: usize = LANES / 2;

/// All bits of the pixels of a group for which a number has a bit.
const MASKS: [[u32; SIDE]; 1 << SIDE] = {
    let mut masks = [[0; SIDE]; 1 << SIDE];
    let mut index = 0;
    while index < SIDE << SIDE {
        let (number, lane) = (index / SIDE, index % SIDE);
        masks[number][lane] = if number >> lane & 1 != 0 { u32::MAX } else { 0 };
        index += 1;
    }
    masks
};

/// Writes those of a tile's own pixels for which `requested` has a bit in their row.
pub(super) fn write_some(
    frame: &FrameView<'_>,
    area: &TileArea,
    requested: &TileRows,
    codes: &[u32],
    bands: &Bands<'_>,
) {
    let (mut band, corner) = bands.lock(area.own_origin().map(|v| v as u32));
    let band = &mut *band;
    let image = if band.unorm8.is_empty() { &mut *band.srgb8 } else { &mut *band.unorm8 };
    let ([columns, rows], [left, top]) = (frame.drawn_part(area), area.margin);
    for (y, requested) in rows.map(|y| (y, requested[top + y])).filter(|(_, requested)| *requested != 0) {
        let start = corner + y * bands.width();
        let row = &mut image[start + columns.start..start + columns.end];
        write_row(row, codes, requested, [left + columns.start, top + y]);
    }
}

/// Writes to a row of pixels, which begins at a column of the tile.
fn write_row(row: &mut [[u8; 4]], codes: &[u32], requested: u64, [column, y]: [usize; 2]) {
    // Up to a whole group first.
    let head = row.len().min(column.next_multiple_of(SIDE) - column);
    let (head, row) = row.split_at_mut(head);
    write_each(head, codes, requested, [column, y]);
    let whole = column + head.len();
    let (groups, tail) = row.as_chunks_mut::<SIDE>();
    let mut rest = requested.checked_shr(whole as u32).unwrap_or(0);
    while let Some(pixels) = groups.get_mut(rest.trailing_zeros() as usize / SIDE) {
        let first = rest.trailing_zeros() as usize / SIDE * SIDE;
        let mask = &MASKS[(rest >> first) as usize % MASKS.len()];
        rest &= !(0xf << first);
        let codes = codes[TileArea::index_of([whole + first, y])..].first_chunk::<SIDE>();
        let codes = codes.expect("groups are whole");
        // Without a branch for each, which would be mispredicted often.
        *pixels = std::array::from_fn(|lane| {
            let before = u32::from_le_bytes(pixels[lane]);
            (before ^ (before ^ codes[lane]) & mask[lane]).to_le_bytes()
        });
    }
    let written = whole + SIDE * groups.len();
    write_each(tail, codes, requested, [written, y]);
}

/// The same, pixel by pixel.
fn write_each(pixels: &mut [[u8; 4]], codes: &[u32], requested: u64, [x, y]: [usize; 2]) {
    for (pixel, x) in pixels.iter_mut().zip(x..).filter(|(_, x)| requested >> x & 1 != 0) {
        *pixel = codes[TileArea::index_of([x, y])].to_le_bytes();
    }
}
