//! What is seen where nothing is drawn.

use crate::frame::FrameView;
use crate::ink::OuterInk;
use crate::pass::Background;
use crate::shade::{EmptyGroup, Encoding, Shading};
use crate::simd::LANES;
use crate::target::{Band, Bands};
use crate::tile::TileArea;
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
        let value = match self.background {
            Background::Color(color) => color,
            Background::PerPixel(function) => function(pixel),
        };
        if value.is_finite() { value } else { Vec4::ZERO }
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
    let part = Part { first, width: bands.width(), drawn: [columns, rows] };
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
        Background::PerPixel(_) => part.paint(band, |at| frame.background_of(UVec2::from(corner) + at)),
    }
}

/// The part of a band that tiles draw.
struct Part {
    /// The index of the first tile's first pixel.
    first: usize,
    /// Pixels in a row of the band.
    width: usize,
    /// Columns and rows, from that pixel.
    drawn: [Range<usize>; 2],
}

impl Part {
    /// Fills a plane, if there is one.
    fn fill<T: Copy>(&self, plane: &mut [T], value: T) {
        if plane.is_empty() {
            return;
        }
        let [columns, rows] = &self.drawn;
        for y in rows.clone() {
            let start = self.first + y * self.width;
            plane[start + columns.start..start + columns.end].fill(value);
        }
    }

    /// Gives each pixel a colour of its own.
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
    let constant = match frame.background {
        Background::Color(_) if shading.outer.is_empty() => Some(encode(frame.background_of(UVec2::ZERO))),
        Background::Color(_) | Background::PerPixel(_) => None,
    };
    let Shading { empty_groups, codes, outer, .. } = shading;
    for &EmptyGroup { number, lanes } in empty_groups.iter() {
        let codes = &mut codes[number as usize * LANES..][..LANES];
        match constant {
            Some(code) if lanes == 0xff => codes.fill(code),
            Some(code) => bits(lanes).for_each(|lane| codes[lane] = code),
            None => {
                for (lane, at) in within(area, number, lanes) {
                    codes[lane] = encode(frame.lined_background_at(area, at, outer));
                }
            }
        }
    }
}

/// Puts the background's colour into all pixels of which the first sample sees it.
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

/// The lanes of a group that lie in the picture, with their places in the tile.
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
