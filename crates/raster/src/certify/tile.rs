//! What is certain in one tile: first the nearest primitive that certainly covers each sample, then everything
//! that may be visible in front of it.

use super::outline::{Cover, Outline};
use crate::BlendMode;
use crate::tile_buffer::{BEHIND_ALL, TileArea};
use crate::view::FrameView;

/// Which pixels of a tile are doubtful, and which show anything at all.
pub(super) struct TileCertainty {
    width: usize,
    doubtful: Vec<bool>,
    drawn: Vec<bool>,
}

/// What certainly covers a sample.
#[derive(Clone, Copy)]
struct Nearest {
    outline: Option<usize>,
    depths: [f32; 2],
}

/// A translucent layer that certainly lies over a sample.
struct CertainLayer {
    sample: usize,
    depths: [f32; 2],
}

impl TileCertainty {
    pub(super) fn of(frame: &FrameView<'_>, area: &TileArea, outlines: Vec<Outline>) -> Self {
        let pixels = area.size[0] * area.size[1];
        let nobody = Nearest { outline: None, depths: [BEHIND_ALL; 2] };
        let mut builder = Builder {
            frame,
            area,
            nearest: vec![nobody; pixels * frame.grid.pattern.count()],
            layers: Vec::new(),
            certainty: Self {
                width: area.size[0],
                doubtful: vec![false; pixels],
                drawn: vec![false; pixels],
            },
        };
        for (number, outline) in outlines.iter().enumerate() {
            if outline.blend_mode == BlendMode::Opaque {
                builder.occlude(number, outline);
            }
        }
        for (number, outline) in outlines.iter().enumerate() {
            builder.challenge(number, outline);
        }
        builder.compare_layers();
        builder.certainty
    }

    /// Whether a pixel of the tile may come to see something else.
    fn is_doubtful(&self, [x, y]: [usize; 2]) -> bool {
        self.doubtful[y * self.width + x]
    }

    /// Whether a pixel of the tile, or one of those within so many of it, may come to see
    /// something else.
    pub(super) fn is_doubtful_around(&self, [x, y]: [usize; 2], reach: usize) -> bool {
        let height = self.doubtful.len() / self.width;
        let around = |at: usize, end: usize| at.saturating_sub(reach)..end.min(at + reach + 1);
        around(y, height).any(|y| around(x, self.width).any(|x| self.is_doubtful([x, y])))
    }

    /// Whether a pixel of the tile certainly shows a primitive.
    pub(super) fn is_drawn(&self, [x, y]: [usize; 2]) -> bool {
        self.drawn[y * self.width + x]
    }
}

struct Builder<'f> {
    frame: &'f FrameView<'f>,
    area: &'f TileArea,
    /// For each sample of each pixel.
    nearest: Vec<Nearest>,
    layers: Vec<CertainLayer>,
    certainty: TileCertainty,
}

impl Builder<'_> {
    /// Calls `visit` with the builder, and the number and the corner of each pixel
    /// in the rectangle of an outline.
    fn for_each_pixel(&mut self, outline: &Outline, mut visit: impl FnMut(&mut Self, usize, [i32; 2])) {
        let part = [0, 1].map(|axis| {
            let [first, last] =
                self.frame.grid.pattern.pixels_between(outline.extent[axis]).unwrap_or([0, -1]);
            let origin = self.area.origin[axis];
            let side = self.area.size[axis] as i32;
            (first - origin).clamp(0, side)..(last - origin + 1).clamp(0, side)
        });
        let [columns, rows] = part;
        for (y, x) in rows.flat_map(|y| columns.clone().map(move |x| (y, x))) {
            let corner = [self.area.origin[0] + x, self.area.origin[1] + y].map(|v| v * 256);
            visit(self, y as usize * self.area.size[0] + x as usize, corner);
        }
    }

    /// The samples of a pixel: index and position.
    fn samples(&self, pixel: usize, corner: [i32; 2]) -> impl Iterator<Item = (usize, [i32; 2])> + use<> {
        let offsets = self.frame.grid.pattern.offsets();
        let first = pixel * offsets.len();
        let positions = offsets.iter().map(move |offset| [corner[0] + offset[0], corner[1] + offset[1]]);
        positions.enumerate().map(move |(number, position)| (first + number, position))
    }

    /// Keeps an opaque primitive where it certainly covers a sample and is the
    /// nearest that does.
    fn occlude(&mut self, number: usize, outline: &Outline) {
        self.for_each_pixel(outline, |builder, pixel, corner| {
            for (sample, position) in builder.samples(pixel, corner) {
                if outline.covers(position) != Cover::Covers {
                    continue;
                }
                let depths = outline.depths(position);
                let nearest = &mut builder.nearest[sample];
                if depths[0] > nearest.depths[0] {
                    *nearest = Nearest { outline: Some(number), depths };
                    builder.certainty.drawn[pixel] = true;
                }
            }
        });
    }

    /// Marks as uncertain the pixels in which a primitive may be visible without being certain.
    fn challenge(&mut self, number: usize, outline: &Outline) {
        self.for_each_pixel(outline, |builder, pixel, corner| {
            let mut is_visible = false;
            for (sample, position) in builder.samples(pixel, corner) {
                if builder.nearest[sample].outline == Some(number) {
                    is_visible = true;
                    continue;
                }
                let cover = outline.covers(position);
                if cover == Cover::Misses {
                    continue;
                }
                let (depths, ground) = (outline.depths(position), builder.nearest[sample].depths);
                let is_hidden = depths[1] < ground[0] || depths[1] <= BEHIND_ALL;
                let is_layer = outline.blend_mode == BlendMode::Translucent && cover == Cover::Covers;
                if is_layer && depths[0] > ground[1] {
                    builder.layers.push(CertainLayer { sample, depths });
                    builder.certainty.drawn[pixel] = true;
                    is_visible = true;
                } else if !is_hidden {
                    builder.certainty.doubtful[pixel] = true;
                }
            }
            // Where it is shaded depends on whether it covers the centre, and how
            // often on the triangles that it is cut into.
            let center = corner.map(|v| v + 128);
            let is_unsettled = || outline.covers(center) == Cover::May || outline.may_part(center);
            if is_visible && builder.frame.is_multisampled() && is_unsettled() {
                builder.certainty.doubtful[pixel] = true;
            }
        });
    }

    /// Doubts pixels in which the order of layers is not certain.
    fn compare_layers(&mut self) {
        self.layers.sort_unstable_by(|a, b| {
            a.sample.cmp(&b.sample).then_with(|| a.depths[0].total_cmp(&b.depths[0]))
        });
        let count = self.frame.grid.pattern.count();
        for pair in self.layers.windows(2) {
            if pair[0].sample == pair[1].sample && pair[1].depths[0] <= pair[0].depths[1] {
                self.certainty.doubtful[pair[0].sample / count] = true;
            }
        }
    }
}
