//! The background, where nothing is drawn.

use crate::fragments::Encoding;
use crate::outer_ink::OuterInk;
use crate::pass::Background;
use crate::shade::{EmptyGroup, Shading};
use crate::simd::LANES;
use crate::target::{Band, Bands};
use crate::tile_buffer::TileArea;
use crate::view::{FrameView, finite_color};
use std::ops::Range;
use trigon_math::{UVec2, Vec4};

impl FrameView<'_> {
    /// The background at a pixel of the tile.
    #[inline]
    pub(crate) fn background_at(&self, area: &TileArea, [x, y]: [usize; 2]) -> Vec4 {
        let pixel = UVec2::new(area.origin[0] as u32 + x as u32, area.origin[1] as u32 + y as u32);
        self.background_of(pixel / self.supersampling)
    }

    /// The background at a pixel of the tile, with the lines on it.
    #[inline]
    pub(crate) fn lined_background_at(&self, area: &TileArea, at: [usize; 2], outer: &OuterInk) -> Vec4 {
        let color = self.background_at(area, at);
        match (&self.ink, outer.at(TileArea::index_of(at))) {
            (Some(ink), overlap) if overlap.share > 0.0 => ink.over(color, overlap),
            _ => color,
        }
    }

    /// The background at a pixel of the target.
    fn background_of(&self, pixel: UVec2) -> Vec4 {
        match self.background {
            Background::Color(color) => finite_color(color),
            Background::PerRow(_) => {
                self.background_rows.get(pixel.y as usize).map_or(Vec4::ZERO, |row| row.color)
            }
            Background::PerPixel(function) => finite_color(function(pixel)),
        }
    }
}

/// Draws neighbouring tiles of one row that nothing is in, from the first to the last.
pub(super) fn fill_background(frame: &FrameView<'_>, [first, last]: [TileArea; 2], bands: &Bands<'_>) {
    let corner = first.own_origin().map(|v| v as u32 / frame.supersampling);
    let [columns, rows] = frame.drawn_part(&first);
    let way = (last.own_origin()[0] - first.own_origin()[0]) as usize / frame.supersampling as usize;
    let columns = columns.start..way + frame.drawn_part(&last)[0].end;
    let (mut band, first) = bands.lock(corner);
    let band = &mut *band;
    let part = RowPart { first, width: bands.width(), drawn: [columns, rows] };
    part.fill(band.depth, 0.0);
    for ids in [&mut band.objects, &mut band.faces, &mut band.triangles] {
        part.fill(ids, u32::MAX);
    }
    match frame.background {
        Background::Color(_) => {
            let color = frame.background_of(UVec2::ZERO);
            part.fill(band.srgb8, Encoding::Srgb8.encode(color));
            part.fill(band.unorm8, Encoding::Unorm8.encode(color));
            part.fill(band.linear, color);
        }
        Background::PerRow(_) => part.paint_rows(band, |y| frame.background_of(UVec2::new(0, corner[1] + y))),
        Background::PerPixel(_) => part.paint(band, |at| frame.background_of(UVec2::from(corner) + at)),
    }
}

/// The part of a band that tiles draw.
struct RowPart {
    /// The index of the first tile's first pixel.
    first: usize,
    /// Pixels in a row of the band.
    width: usize,
    /// Columns and rows, from that pixel.
    drawn: [Range<usize>; 2],
}

impl RowPart {
    /// Fills a plane, if there is one.
    fn fill<T: Copy>(&self, plane: &mut [T], value: T) {
        for y in self.drawn[1].clone() {
            self.fill_row(plane, y, value);
        }
    }

    /// Fills a row of a plane, if there is one.
    fn fill_row<T: Copy>(&self, plane: &mut [T], y: usize, value: T) {
        if !plane.is_empty() {
            let (start, columns) = (self.first + y * self.width, &self.drawn[0]);
            plane[start + columns.start..start + columns.end].fill(value);
        }
    }

    /// Gives each row its own colour.
    fn paint_rows(&self, band: &mut Band<'_>, color_at: impl Fn(u32) -> Vec4) {
        for y in self.drawn[1].clone() {
            let color = color_at(y as u32);
            self.fill_row(band.srgb8, y, Encoding::Srgb8.encode(color));
            self.fill_row(band.unorm8, y, Encoding::Unorm8.encode(color));
            self.fill_row(band.linear, y, color);
        }
    }

    /// Gives each pixel its own colour.
    fn paint(&self, band: &mut Band<'_>, color_at: impl Fn(UVec2) -> Vec4) {
        let [columns, rows] = &self.drawn;
        for (y, x) in rows.clone().flat_map(|y| columns.clone().map(move |x| (y, x))) {
            let color = color_at(UVec2::new(x as u32, y as u32));
            let index = self.first + y * self.width + x;
            if let Some(pixel) = band.linear.get_mut(index) {
                *pixel = color;
            }
            if let Some(pixel) = band.srgb8.get_mut(index) {
                *pixel = Encoding::Srgb8.encode(color);
            }
            if let Some(pixel) = band.unorm8.get_mut(index) {
                *pixel = Encoding::Unorm8.encode(color);
            }
        }
    }
}

/// Puts the background's bytes into all pixels that see it.
pub(super) fn lay_codes(frame: &FrameView<'_>, area: &TileArea, shading: &mut Shading, encoding: Encoding) {
    let encode = |color| u32::from_le_bytes(encoding.encode(color));
    let Shading { empty_groups, codes, outer, .. } = shading;
    let one_code = match frame.background {
        Background::Color(color) => encode(finite_color(color)),
        Background::PerRow(_) | Background::PerPixel(_) => 0,
    };
    for &EmptyGroup { number, lanes } in empty_groups.iter() {
        let codes = &mut codes[number as usize * LANES..][..LANES];
        match frame.background {
            Background::Color(_) => lay_rows(codes, lanes, [one_code; 2]),
            Background::PerRow(_) => lay_rows(codes, lanes, row_codes(frame, area, number)),
            Background::PerPixel(_) => {
                for (lane, at) in within(area, number, lanes) {
                    codes[lane] = encode(frame.lined_background_at(area, at, outer));
                }
                continue;
            }
        }
        if !outer.is_empty() {
            for (lane, at) in within(area, number, lanes) {
                if outer.at(TileArea::index_of(at)).share > 0.0 {
                    codes[lane] = encode(frame.lined_background_at(area, at, outer));
                }
            }
        }
    }
}

/// The bytes of the background in the two rows of a group; anything for rows below the image.
fn row_codes(frame: &FrameView<'_>, area: &TileArea, group: u32) -> [u32; 2] {
    let [_, top] = TileArea::pixel_at(group as usize * LANES);
    let first = area.origin[1] as usize + top;
    [first, first + 1].map(|row| frame.background_rows.get(row).map_or(0, |row| row.code))
}

/// Gives lanes of a group the bytes of their rows.
fn lay_rows(codes: &mut [u32], lanes: u32, rows: [u32; 2]) {
    if lanes == 0xff {
        let (upper, lower) = codes.split_at_mut(LANES / 2);
        upper.fill(rows[0]);
        lower.fill(rows[1]);
    } else {
        bits(lanes).for_each(|lane| codes[lane] = rows[lane / (LANES / 2)]);
    }
}

/// Writes the background's colour to all pixels whose first sample shows it.
/// (Edge pixels get their colour afterwards.)
pub(super) fn lay_colors(frame: &FrameView<'_>, area: &TileArea, shading: &mut Shading) {
    let Shading { empty_groups, colors, outer, .. } = shading;
    for &EmptyGroup { number, lanes } in empty_groups.iter() {
        for (lane, at) in within(area, number, lanes) {
            let color = frame.lined_background_at(area, at, outer);
            colors[number as usize * LANES + lane] = color.to_array();
        }
    }
}

/// The lanes of a group that lie in the image, with their positions in the tile.
fn within(area: &TileArea, group: u32, lanes: u32) -> impl Iterator<Item = (usize, [usize; 2])> {
    bits(lanes)
        .map(move |lane| (lane, TileArea::pixel_at(group as usize * LANES + lane)))
        .filter(|&(_, at)| area.contains(at))
}

/// The numbers of the bits that are set.
fn bits(mut lanes: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = (lanes != 0).then_some(lanes.trailing_zeros() as usize)?;
        lanes &= lanes - 1;
        Some(lane)
    })
}

#[cfg(test)]
mod tests;
