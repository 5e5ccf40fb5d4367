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
mod tests {
    use crate::simd::SimdLevel;
    use crate::{
        Background, BlendMode, Draw, EdgeFlags, ExecuteSettings, FaceEdges, Fragment, Output, Pass, Pipeline,
        Rasterizer, Rect, Target, VertexOutput,
    };
    use proptest::prelude::*;
    use std::num::NonZeroUsize;
    use trigon_math::{UVec2, Vec3, Vec4};

    /// A triangle in one colour.
    struct Triangle {
        corners: [[f32; 2]; 3],
        alpha: f32,
    }

    impl Pipeline for Triangle {
        type Varyings = ();

        fn vertex_count(&self) -> usize {
            3
        }

        fn vertex(&self, index: usize) -> VertexOutput<()> {
            let [x, y] = self.corners[index];
            VertexOutput { position: Vec4::new(x, y, 0.5, 1.0), varyings: () }
        }

        fn fragment(&self, _: &Fragment<()>) -> Vec4 {
            Vec3::new(0.8, 0.1, 0.3).extend(1.0) * self.alpha
        }
    }

    /// Every seventh row has no colour.
    fn row(y: u32) -> Vec4 {
        let level = if y % 7 == 6 { f32::NAN } else { (y % 50) as f32 / 40.0 };
        Vec4::new(level, 0.4, 1.0 - level, 0.9)
    }

    #[derive(Clone, Debug)]
    struct Case {
        size: [u32; 2],
        samples: [u32; 2],
        outputs: Vec<Output>,
        corners: [[f32; 2]; 3],
        blend_mode: BlendMode,
        edges: Option<f32>,
        scissor: Option<[i32; 4]>,
        settings: ExecuteSettings,
    }

    fn case() -> impl Strategy<Value = Case> {
        use Output::{Depth, Linear, Srgb8, Unorm8};
        let samples = prop::sample::select(vec![[1, 1], [1, 1], [1, 4], [2, 1], [3, 2]]);
        let outputs = prop_oneof![
            Just(vec![Srgb8]),
            Just(vec![Unorm8]),
            prop::sample::subsequence(vec![Srgb8, Unorm8, Linear, Depth], 1..5),
        ];
        let corners = prop::array::uniform3(prop::array::uniform2(-1.5_f32..1.5));
        let blend_mode = prop::sample::select(vec![BlendMode::Opaque, BlendMode::Translucent]);
        let levels: Vec<_> = SimdLevel::ALL.into_iter().filter(|level| level.is_supported()).collect();
        let settings =
            (1..4_usize, prop::sample::select(levels)).prop_map(|(threads, level)| ExecuteSettings {
                threads: NonZeroUsize::new(threads),
                simd: Some(level),
                ..ExecuteSettings::default()
            });
        let edges = prop::option::of(0.5_f32..5.0);
        let scissor = prop::option::of(prop::array::uniform4(-9..120));
        ([1_u32..200, 1_u32..150], samples, outputs, corners, blend_mode, edges, scissor, settings).prop_map(
            |(size, samples, outputs, corners, blend_mode, edges, scissor, settings)| Case {
                size,
                samples,
                outputs,
                corners,
                blend_mode,
                edges,
                scissor,
                settings,
            },
        )
    }

    impl Case {
        fn draw(&self, background: Background<'_>) -> Target<'static> {
            let alpha = if self.blend_mode == BlendMode::Translucent { 0.5 } else { 1.0 };
            let triangle = Triangle { corners: self.corners, alpha };
            let mut pass = Pass::new();
            pass.background(background);
            pass.triangles(Draw {
                edge_flags: Some(&[EdgeFlags::ALL]),
                blend_mode: self.blend_mode,
                culling: crate::Culling::None,
                ..Draw::new(&triangle, &[[0, 1, 2]])
            });
            if let Some(width) = self.edges {
                pass.edges(FaceEdges { width, color: Vec3::Y, opacity: 0.6 });
            }
            if let Some([left, top, right, bottom]) = self.scissor {
                pass.scissor(Rect::new([left, top], [right, bottom]));
            }
            let target = Target::new(self.size[0], self.size[1], &self.outputs).expect("a size");
            let target = target.with_samples_per_axis(self.samples[0]).expect("a number of samples");
            let mut target = target.with_samples(self.samples[1]).expect("a number of samples");
            Rasterizer::new(self.settings).expect("a level that there is").draw(&pass, &mut target);
            target
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]

        #[test]
        fn colours_of_rows_are_those_of_their_pixels(case in case()) {
            let [rows, pixels] =
                [Background::PerRow(&row), Background::PerPixel(&|UVec2 { y, .. }| row(y))].map(|way| case.draw(way));
            prop_assert!(rows.srgb8() == pixels.srgb8(), "bytes");
            prop_assert!(rows.unorm8() == pixels.unorm8(), "linear bytes");
            prop_assert!(rows.linear() == pixels.linear(), "light");
            prop_assert!(rows.depth() == pixels.depth(), "depth");
        }
    }
}
