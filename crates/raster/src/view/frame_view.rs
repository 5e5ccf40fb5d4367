//! A frame before its tiles are drawn: everything that the earlier stages have produced for the tiles, which outputs the
//! frame is to have, and what a tile shows.

use super::Plan;
use crate::StageTimes;
use crate::bin::{Chunk, Grid, MovingChunk, TileRange, TriangleRef};
use crate::draw_view::DrawView;
use crate::fragments::Encoding;
use crate::ink::Ink;
use crate::paint2d::Rect;
use crate::pass::{Background, RecordedDraw};
use crate::pipeline::AnyPipeline;
use crate::primitive::SetupTriangle;
use crate::simd::Token;
use crate::tile_buffer::{TileArea, VisibilityBuffer};
use crate::vertex::{DrawVertices, ScreenVertex};
use std::cmp::Ordering;
use std::ops::Range;
use trigon_math::Vec4;

/// Everything that tiles read.
pub(crate) struct FrameView<'f> {
    pub(crate) pass: &'f [RecordedDraw<'f>],
    pub(crate) background: Background<'f>,
    /// The background's rows, if each has its own colour.
    pub(crate) background_rows: &'f [BackgroundRow],
    pub(crate) plan: &'f Plan,
    pub(crate) screen_vertices: &'f [ScreenVertex],
    pub(crate) varyings: &'f [f32],
    /// In the order of their ordinals.
    pub(crate) chunks: &'f [Chunk],
    /// What those chunks' primitives that move list, in the same order, if they are listed apart.
    pub(crate) moving: &'f [MovingChunk],
    pub(crate) grid: Grid,
    /// The pixels of the target that are drawn.
    pub(crate) drawn: Rect,
    /// Internal pixels for each pixel of the target and axis.
    pub(crate) supersampling: u32,
    pub(crate) wants: RequestedOutputs,
    /// What paints the edges of faces, if anything does.
    pub(crate) ink: Option<Ink>,
    pub(crate) token: Token,
    pub(crate) hierarchical: bool,
    pub(crate) timed: bool,
    /// How long the stages before the tiles took.
    pub(crate) times: StageTimes,
}

impl<'f> FrameView<'f> {
    /// Whether edges of faces are painted.
    pub(crate) fn paints_lines(&self) -> bool {
        self.ink.as_ref().is_some_and(Ink::has_lines)
    }

    /// The rectangle that a tile reads.
    pub(crate) fn area(&self, tile: u32) -> TileArea {
        let Grid { viewport, size, apron, columns, .. } = self.grid;
        let own = [(tile % columns) * size, (tile / columns) * size];
        let first = own.map(|v| v.saturating_sub(apron));
        let side = |axis: usize, whole: u32| (whole.min(own[axis] + size + apron) - first[axis]) as usize;
        TileArea {
            origin: first.map(|v| v as i32),
            size: [side(0, viewport.width), side(1, viewport.height)],
            margin: [0, 1].map(|axis| (own[axis] - first[axis]) as usize),
        }
    }

    /// The columns and rows of a tile that belong to it and to none of its neighbours.
    pub(crate) fn own_part(&self, area: &TileArea) -> [Range<usize>; 2] {
        [0, 1].map(|axis| {
            let first = area.margin[axis];
            first..area.size[axis].min(first + self.grid.size as usize)
        })
    }

    /// The tiles that have pixels to be drawn.
    pub(crate) fn tiles(&self) -> TileRange {
        if self.drawn.is_empty() {
            return TileRange { columns: 0..0, rows: 0..0 };
        }
        let axis = self.supersampling as i32;
        let Rect { min, max } = self.drawn;
        let pixels = |i: usize| [min[i] * axis, max[i] * axis - 1];
        self.grid.tiles_of(pixels(0), pixels(1))
    }

    /// The columns and rows of a tile that are drawn, in pixels of the target
    /// from the first one that is the tile's own.
    pub(crate) fn drawn_part(&self, area: &TileArea) -> [Range<usize>; 2] {
        let axis = self.supersampling;
        let (origin, own) = (area.own_origin(), self.own_part(area));
        [0, 1].map(|i| {
            let first = origin[i] / axis as i32;
            let side = own[i].len() / axis as usize;
            let within = |end: i32| ((end - first).max(0) as usize).min(side);
            within(self.drawn.min[i])..within(self.drawn.max[i])
        })
    }

    /// The pixels of the target that a tile draws.
    pub(crate) fn drawn_rect(&self, tile: u32) -> Rect {
        let area = self.area(tile);
        let (first, drawn) = (area.own_origin(), self.drawn_part(&area));
        let end = |axis: usize, at: usize| first[axis] / self.supersampling as i32 + at as i32;
        Rect::new(
            [0, 1].map(|axis| end(axis, drawn[axis].start)),
            [0, 1].map(|axis| end(axis, drawn[axis].end)),
        )
    }

    pub(crate) fn is_multisampled(&self) -> bool {
        self.grid.pattern.count() > 1
    }

    /// The index among the plans of the draw that a triangle belongs to.
    #[inline(always)]
    pub(crate) fn draw_of(&self, triangle: TriangleRef) -> usize {
        self.plan.draw_of(triangle.ordinal)
    }

    pub(crate) fn pipeline(&self, draw: usize) -> &'f dyn AnyPipeline {
        self.pass[self.plan.draws[draw].draw()].pipeline
    }

    /// The vertices of a draw.
    #[inline(always)]
    pub(crate) fn vertices(&self, draw: usize) -> DrawVertices<'f> {
        let plan = &self.plan.draws[draw];
        let screen_vertices = &self.screen_vertices[plan.screen_vertices()];
        let pipeline = self.pass[plan.draw()].pipeline;
        DrawVertices { slots: self.plan.slots(plan), screen_vertices, pipeline, token: self.token }
    }

    /// The triangles of a draw.
    #[inline(always)]
    pub(crate) fn draw_view(&self, draw: usize) -> DrawView<'f> {
        let plan = &self.plan.draws[draw];
        DrawView {
            geometry: &self.pass[plan.draw()].geometry,
            vertices: self.vertices(draw),
            first: plan.ordinals.start,
            points: self.plan.points(plan),
            chunks: self.chunks,
        }
    }

    /// A triangle of a tile, ready.
    #[inline]
    pub(crate) fn triangle(&self, triangle: TriangleRef) -> SetupTriangle {
        self.draw_view(self.draw_of(triangle)).triangle(triangle)
    }

    /// The vertices of a primitive.
    #[inline(always)]
    pub(crate) fn corners(&self, triangle: TriangleRef) -> [&'f ScreenVertex; 3] {
        self.draw_view(self.draw_of(triangle)).corners(triangle)
    }

    /// The chunk that a triangle belongs to.
    pub(crate) fn chunk_of(&self, triangle: TriangleRef) -> &'f Chunk {
        Chunk::of(self.chunks, triangle)
    }

    /// The (object, face) of a triangle as one number, given the index of its draw among the plans: the
    /// first part of the key by which [`Self::compare`] orders triangles.
    #[inline]
    pub(crate) fn object_and_face(&self, draw: usize, triangle: TriangleRef) -> u64 {
        let plan = &self.plan.draws[draw];
        let geometry = &self.pass[plan.draw()].geometry;
        let face = geometry.face(triangle.ordinal - plan.ordinals.start);
        u64::from(geometry.object) << 32 | u64::from(face)
    }

    /// The rule for ties: the order of two triangles at equal depth, of which the first is visible. The
    /// smaller (object, face) comes first; within a face, and only there, the smaller index, then the
    /// earlier draw.
    pub(crate) fn compare(&self, a: TriangleRef, b: TriangleRef) -> Ordering {
        let key = |triangle: TriangleRef| {
            let draw = self.draw_of(triangle);
            let plan = &self.plan.draws[draw];
            (self.object_and_face(draw, triangle), triangle.ordinal - plan.ordinals.start, plan.draw())
        };
        key(a).cmp(&key(b))
    }

    /// Whether `a` is visible and not `b` at equal depth.
    pub(crate) fn precedes(&self, a: TriangleRef, b: TriangleRef) -> bool {
        self.compare(a, b).is_lt()
    }
}

/// A row of a background that has one colour in each row.
#[derive(Clone, Copy)]
pub(crate) struct BackgroundRow {
    pub(crate) color: Vec4,
    /// The colour as bytes, in frames that keep bytes of one kind and nothing else of colour.
    pub(crate) code: u32,
}

impl BackgroundRow {
    /// Lists the rows of a target of this height; none if the background has none.
    pub(crate) fn list(
        background: Background<'_>,
        height: u32,
        bytes: Option<Encoding>,
        rows: &mut Vec<Self>,
    ) {
        rows.clear();
        if let Background::PerRow(function) = background {
            rows.extend((0..height).map(|y| {
                let color = finite_color(function(y));
                let code = bytes.map_or(0, |encoding| u32::from_le_bytes(encoding.encode(color)));
                Self { color, code }
            }));
        }
    }
}

pub(crate) fn finite_color(color: Vec4) -> Vec4 {
    if color.is_finite() { color } else { Vec4::ZERO }
}

/// What a frame is to leave behind.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) struct RequestedOutputs {
    pub(crate) color: bool,
    pub(crate) depth: bool,
    pub(crate) ids: bool,
    /// The encoding, if bytes of one kind are the only output of colour and there is no
    /// supersampling.
    pub(crate) bytes: Option<Encoding>,
}

/// What a tile shows: the visible triangle at each sample, by its index among the tile's.
#[derive(Clone, Copy)]
pub(crate) struct VisibleTile<'t> {
    pub(crate) area: &'t TileArea,
    pub(crate) buffer: &'t VisibilityBuffer,
    pub(crate) triangles: &'t [TriangleRef],
}
