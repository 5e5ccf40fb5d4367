//! What is seen where nothing is drawn.

use crate::frame::FrameView;
use crate::pass::Background;
use crate::shade::{EmptyGroup, Encoding, Shading};
use crate::simd::LANES;
use crate::target::Bands;
use crate::tile::TileArea;
use trigon_math::{UVec2, Vec4};

impl FrameView<'_> {
    /// The background at a pixel of the tile.
    #[inline]
    pub(crate) fn background_at(&self, area: &TileArea, [x, y]: [usize; 2]) -> Vec4 {
        let pixel = UVec2::new(area.origin[0] as u32 + x as u32, area.origin[1] as u32 + y as u32);
        self.background_of(pixel / self.supersampling)
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

/// Draws a tile that nothing is in.
pub(crate) fn fill_background(frame: &FrameView<'_>, area: &TileArea, bands: &Bands<'_>) {
    let [left, top] = area.origin.map(|v| v as u32 / frame.supersampling);
    let [columns, rows] = frame.drawn_part(area);
    let constant = matches!(frame.background, Background::Color(_));
    let color = frame.background_of(UVec2::ZERO);
    let codes = [Encoding::Srgb8, Encoding::Unorm8].map(|encoding| encoding.encode(color));
    let (mut band, first) = bands.lock([left, top]);
    for y in rows {
        let start = first + y * bands.width();
        let row = start + columns.start..start + columns.end;
        if let Some(depths) = band.depth.get_mut(row.clone()) {
            depths.fill(0.0);
        }
        let band = &mut *band;
        for ids in [&mut band.objects, &mut band.faces, &mut band.triangles] {
            if let Some(ids) = ids.get_mut(row.clone()) {
                ids.fill(u32::MAX);
            }
        }
        if constant {
            for (picture, code) in [&mut band.srgb8, &mut band.unorm8].into_iter().zip(codes) {
                if let Some(pixels) = picture.get_mut(row.clone()) {
                    pixels.fill(code);
                }
            }
            if let Some(pixels) = band.linear.get_mut(row) {
                pixels.fill(color);
            }
            continue;
        }
        for (x, index) in columns.clone().zip(row) {
            let color = frame.background_of(UVec2::new(left + x as u32, top + y as u32));
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
        Background::Color(_) => Some(encode(frame.background_of(UVec2::ZERO))),
        Background::PerPixel(_) => None,
    };
    let Shading { empty_groups, codes, .. } = shading;
    for &EmptyGroup { number, lanes } in empty_groups.iter() {
        let codes = &mut codes[number as usize * LANES..][..LANES];
        match constant {
            Some(code) if lanes == 0xff => codes.fill(code),
            Some(code) => bits(lanes).for_each(|lane| codes[lane] = code),
            None => {
                for (lane, at) in within(area, number, lanes) {
                    codes[lane] = encode(frame.background_at(area, at));
                }
            }
        }
    }
}

/// Puts the background's colour into all pixels of which the first sample sees it.
/// (Edge pixels get their colour afterwards.)
pub(super) fn lay_colors(frame: &FrameView<'_>, area: &TileArea, shading: &mut Shading) {
    let Shading { empty_groups, colors, .. } = shading;
    for &EmptyGroup { number, lanes } in empty_groups.iter() {
        for (lane, at) in within(area, number, lanes) {
            colors[number as usize * LANES + lane] = frame.background_at(area, at).to_array();
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
