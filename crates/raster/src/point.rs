//! Points are squares. For a disc, tiles also compare the distance from the centre; for an anti-aliased point, they
//! compute its coverage (see [`Stroke`]). Most points are drawn from their vertices
//! ([`PlainPoints`]); each of the others gets a record.
//!
//! Plain points are drawn from their vertices without a record. A dense mesh has as many points as vertices, and writing
//! and reading a record would take longer than drawing the point.

use crate::bin::Entry;
use crate::geometry::{Geometry, PointSizes, Shape};
use crate::line::{half_size, smooth_size};
use crate::primitive::{Column, DetailIndex, Ends, Form, Kind, Quad, QuadDetail, Stroke};
use crate::setup::{EightPrimitives, Setup};
use crate::simd::{I32, InlineMap, LANES, Mask, Simd, inlined, prelude::*};
use crate::vertex::{ScreenVertex, nearer};
use crate::{BlendMode, PointShape, Smoothing};

/// How a draw's points look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PointStyle {
    /// Half the size, in units of the grid.
    half: i32,
    kind: Kind,
    /// The size in pixels of the grid, if it is anti-aliased.
    smooth: Option<f64>,
    depth_bias: f32,
}

impl PointStyle {
    pub(crate) fn new(
        size: f32,
        smoothing: Smoothing,
        shape: PointShape,
        depth_bias: f32,
        supersampling: u32,
    ) -> Self {
        let smooth = f64::from(smooth_size(size)) * f64::from(supersampling);
        let smooth = (smoothing == Smoothing::AntiAliased).then_some(smooth);
        let half = half_size(size, smoothing, supersampling);
        let kind = match shape {
            PointShape::Round => Kind::RoundPoint,
            PointShape::Square => Kind::SquarePoint,
        };
        Self { half: half.round() as i32, kind, smooth, depth_bias }
    }

    /// The square around a point.
    fn square(&self, ordinal: u32, center: ScreenVertex, detail: Option<DetailIndex>) -> Quad {
        let ([column, row], half) = (center.raw(), self.half);
        // Within the guard band and the largest size, nothing leaves the grid.
        let corner = |x: i32, y: i32| [column + x * half, row + y * half];
        Quad {
            corners: [[corner(-1, -1), corner(1, -1)], [corner(-1, 1), corner(1, 1)]],
            depths: [nearer(center.depth(), self.depth_bias); 2],
            inverse_w: [center.inverse_w(); 2],
            ordinal,
            detail,
            kind: if self.smooth.is_some() { Kind::Stroke } else { self.kind },
            ends: Ends::Point,
        }
    }
}

impl Setup<'_> {
    /// One point of a draw of points.
    pub(crate) fn point(&mut self, primitive: u32, index: u32, style: PointStyle) {
        let outcode = self.vertices.outcode(index);
        if outcode.is_invalid() {
            self.chunk.stats.invalid += 1;
        } else if outcode.cuts() || outcode.hides_wide() {
            self.chunk.stats.outside += 1;
        } else {
            self.square(primitive, *self.vertices.get(index), style);
        }
    }

    fn square(&mut self, primitive: u32, center: ScreenVertex, style: PointStyle) {
        let detail = style.smooth.and_then(|size| {
            let form = if style.kind == Kind::RoundPoint { Form::Round } else { Form::Square };
            let stroke = Some(Stroke::point(center.raw(), size, form));
            self.chunk.keep(QuadDetail { weights: QuadDetail::WHOLE, stroke })
        });
        self.push_quad(style.square(self.first + primitive, center, detail));
    }
}

/// How the points of a draw look if they are drawn from their vertices: sharp, opaque, and of one
/// colour each, so that it does not matter in which half of its square a sample lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PlainPoints {
    /// Of usual ones, and of those of the other size.
    styles: [PointStyle; 2],
}

/// From this size on, in 1/256 pixel, points are drawn by the kernel for squares of any size.
const WIDE: i32 = 32 * 256;

impl PlainPoints {
    /// `None` if a draw, with a pipeline that may be flat, has no such points.
    pub(crate) fn of(geometry: &Geometry<'_>, is_flat: bool, supersampling: u32) -> Option<Self> {
        let Shape::Points { sizes, shape, smoothing, depth_bias, .. } = geometry.shape else {
            return None;
        };
        let is_opaque = matches!(geometry.blend_mode, BlendMode::Opaque | BlendMode::Overlay);
        let marked = sizes.marked.map_or(sizes.size, |marked| marked.size);
        let styles = [sizes.size, marked]
            .map(|size| PointStyle::new(size, smoothing, shape, depth_bias, supersampling));
        let are_small = styles.iter().all(|style| 2 * style.half < WIDE);
        let are_plain = smoothing == Smoothing::Sharp && is_opaque && is_flat;
        (are_plain && are_small).then_some(Self { styles })
    }

    /// Whether points are discs.
    #[inline(always)]
    pub(crate) fn are_round(&self) -> bool {
        self.styles[0].kind == Kind::RoundPoint
    }

    /// By what fraction of their distance points are moved towards the eye.
    #[inline(always)]
    pub(crate) fn depth_bias(&self) -> f32 {
        self.styles[0].depth_bias
    }

    /// Half the sizes of some of the draw's points, in 1/256 pixel.
    #[inline(always)]
    pub(crate) fn half_sizes<S: Simd>(
        &self,
        simd: S,
        sizes: &PointSizes<'_>,
        primitives: [u32; LANES],
    ) -> I32<S> {
        let [usual, marked] = self.styles.each(
            #[inline(always)]
            |style| style.half,
        );
        let Some(set) = sizes.marked.map(|marked| marked.set) else { return I32::splat(simd, usual) };
        let halves = primitives.each(
            #[inline(always)]
            |primitive| if set.contains(primitive as usize) { marked } else { usual },
        );
        I32::simd_from(simd, halves)
    }

    /// The square around a point of the draw, from its vertex.
    pub(crate) fn square(
        &self,
        sizes: &PointSizes<'_>,
        primitive: u32,
        ordinal: u32,
        center: ScreenVertex,
    ) -> Quad {
        let [usual, marked] = self.styles;
        let is_marked = sizes.marked.is_some_and(|marked| marked.set.contains(primitive as usize));
        let style = if is_marked { marked } else { usual };
        style.square(ordinal, center, None)
    }
}

/// The first and last columns, or rows, in which squares may contain a sample; none if the first is after
/// the last. `reach` is from where to where samples lie in a pixel. A sample on the left or upper side of
/// a square belongs to it.
#[inline(always)]
pub(crate) fn sampled_pixels<S: Simd>(
    centers: I32<S>,
    half: I32<S>,
    [least, greatest]: [i32; 2],
) -> [I32<S>; 2] {
    [(centers - half + (255 - greatest)) >> 8, (centers + half - (least + 1)) >> 8]
}

impl Setup<'_> {
    /// Up to eight points of the draw.
    #[inline(always)]
    pub(crate) fn eight_points<S: Simd>(
        &mut self,
        simd: S,
        points: &EightPrimitives<'_, u32>,
        plain: &PlainPoints,
        sizes: &PointSizes<'_>,
    ) {
        let vertices = points.indices.each(
            #[inline(always)]
            |&index| self.vertices.get(index),
        );
        let centers = Column::new(simd, vertices, 0);
        let lanes = points.lanes();
        let placed = !centers.x.simd_eq(I32::splat(simd, ScreenVertex::NOWHERE)).to_bitmask() & lanes;
        for lane in (0..LANES).filter(|lane| (lanes & !placed) >> lane & 1 != 0) {
            let stats = &mut self.chunk.stats;
            let is_invalid = vertices[lane].outcode().is_invalid();
            *(if is_invalid { &mut stats.invalid } else { &mut stats.outside }) += 1;
        }
        let half = plain.half_sizes(simd, sizes, points.numbers);
        let (visible, pixels) = self.pixels_of_squares(simd, [centers.x, centers.y], half, placed);
        self.chunk.stats.culled += u64::from((placed & !visible).count_ones());
        self.chunk.stats.set_up += u64::from(visible.count_ones());
        self.push_points(simd, points.numbers, visible, pixels);
    }

    /// Those of the `placed` lanes whose squares hold a sample of the view, and the first and last
    /// columns and rows of those samples.
    #[inline(always)]
    fn pixels_of_squares<S: Simd>(
        &self,
        simd: S,
        centers: [I32<S>; 2],
        half: I32<S>,
        placed: u64,
    ) -> (u64, [[I32<S>; 2]; 2]) {
        let grid = self.grid;
        let reach = grid.pattern.reach();
        let mut visible = Mask::from_bitmask(simd, placed);
        let pixels = [(0, grid.viewport.width), (1, grid.viewport.height)].each(
            #[inline(always)]
            |(axis, side)| {
                let [begin, end] = sampled_pixels(centers[axis], half, reach);
                visible = visible & begin.simd_le(end) & end.simd_ge(I32::splat(simd, 0));
                visible &= begin.simd_lt(I32::splat(simd, side as i32));
                [begin, end]
            },
        );
        (visible.to_bitmask(), pixels)
    }

    /// Bins the points of lanes, from the first and last columns and rows of their pixels.
    #[inline(always)]
    fn push_points<S: Simd>(
        &mut self,
        simd: S,
        primitives: [u32; LANES],
        visible: u64,
        pixels: [[I32<S>; 2]; 2],
    ) {
        let grid = self.grid;
        let apron = grid.apron as i32;
        let tiles = inlined(
            #[inline(always)]
            |(axis, side): (usize, u32)| {
                let [begin, end] = pixels[axis];
                [(begin - apron).max(0), (end + apron).min(side as i32 - 1)].each(
                    #[inline(always)]
                    |pixel| grid.tiles_at(pixel),
                )
            },
        );
        let (columns, rows) = (tiles((0, grid.viewport.width)), tiles((1, grid.viewport.height)));
        let lanes = Mask::from_bitmask(simd, visible);
        let alone = columns[0].simd_eq(columns[1]) & rows[0].simd_eq(rows[1]);
        if !(lanes & !alone).any_true() {
            let tiles = (rows[0] * grid.columns as i32 + columns[0]).bitcast();
            let indices = self.indices_in_chunk(simd, primitives);
            return self.chunk.push_some(lanes, tiles, indices, Entry::point);
        }
        let [columns, rows] = [columns, rows].each(
            #[inline(always)]
            |range| range.each(<[i32; LANES]>::from),
        );
        // One after the other, because tiles list their points in the order of primitives.
        for lane in (0..LANES).filter(|lane| visible >> lane & 1 != 0) {
            let entry = Entry::point(self.index_in_chunk(primitives[lane]));
            for row in rows[0][lane]..=rows[1][lane] {
                for column in columns[0][lane]..=columns[1][lane] {
                    let tile = row as u32 * grid.columns + column as u32;
                    self.chunk.push(tile, entry);
                }
            }
        }
    }
}
