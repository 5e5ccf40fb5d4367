//! Writes some of a tile's pixels to the target, which holds all others.

use crate::shade::TileRows;
use crate::simd::LANES;
use crate::target::Bands;
use crate::tile_buffer::TileArea;
use crate::view::FrameView;

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
