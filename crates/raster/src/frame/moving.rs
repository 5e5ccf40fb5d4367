//! Frames in which the same vertices change again and again, as in a drag.
//!
//! From the second such frame on, moving primitives are set up and listed apart from still ones, and a cache holds what
//! still primitives show in each tile ([`TileCache`]). Faces move as a whole: if one triangle of a face moves, the face may
//! be cut into other triangles, and the edges of all its triangles are painted together.

use super::DrawChange;
use super::changed_vertices::{AffectedPrimitives, ChangedVertices, are_among, is_set, reset, set};
use super::tiles::TileCache;
use crate::BlendMode;
use crate::bin::{Chunk, Grid, MovingChunk};
use crate::geometry::Shape;
use crate::outer_ink::slots;
use crate::pass::RecordedDraw;
use crate::view::{DrawPlan, Plan};

/// If more than one in so many primitives moves, moving primitives are not listed apart: that would not pay.
const MANY: usize = 4;

/// What moves from frame to frame.
#[derive(Default)]
pub(super) struct MovingPrimitives {
    /// Whether primitives are listed apart. If not, of all below only `changed` is valid.
    is_apart: bool,
    /// The vertices that may have other values in frames such as this: [`ChangedVertices::changed`].
    changed: Vec<u64>,
    /// The vertices among `changed` that may move.
    moved: Vec<u64>,
    /// The primitives that may move: a bit for each of the frame.
    primitives: Vec<u64>,
    /// The primitives that may move, for each chunk of the frame.
    pub(super) chunks: Vec<MovingChunk>,
    /// The tiles in which still primitives may look different.
    pub(super) tiles: Vec<u32>,
    cache: TileCache,
}

impl MovingPrimitives {
    /// The cached tiles, if primitives are listed apart.
    pub(super) fn cache(&self) -> Option<&TileCache> {
        self.is_apart.then_some(&self.cache)
    }

    /// Leaves no primitives apart, and no vertices that have changed.
    pub(super) fn clear(&mut self) {
        self.unite();
        self.changed.clear();
    }

    /// Leaves no primitives apart.
    pub(super) fn unite(&mut self) {
        self.is_apart = false;
        self.chunks.clear();
        self.cache.reset(0);
    }

    /// Whether primitives are listed apart, and all that moves or looks different in a frame was expected to.
    pub(super) fn covers(&self, vertices: &ChangedVertices, plan: &Plan, changes: &[DrawChange<'_>]) -> bool {
        let are_prepared = |draw: &DrawPlan| {
            let change = changes[draw.draw()];
            let moves = |&index: &u32| is_set(&self.primitives, (draw.ordinals.start + index) as usize);
            change.recolored.is_empty() && change.reshaped.iter().all(moves)
        };
        self.is_apart
            && are_among(vertices.changed(), &self.changed)
            && are_among(vertices.moved(), &self.moved)
            && plan.draws.iter().all(are_prepared)
    }

    /// Takes the vertices that have changed in a frame; returns whether the same have changed in the last one of
    /// which any have.
    pub(super) fn repeats(&mut self, vertices: &ChangedVertices) -> bool {
        let is_same = self.changed == vertices.changed();
        if vertices.changed().iter().all(|&word| word == 0) {
            return false;
        }
        self.changed.clear();
        self.changed.extend_from_slice(vertices.changed());
        is_same
    }

    /// Finds which primitives move and which look different, from what was found in each chunk. Returns the indices
    /// of the moving primitives in each chunk; `None` if too many primitives move.
    pub(super) fn find(
        &mut self,
        pass: &[RecordedDraw<'_>],
        plan: &Plan,
        vertices: &ChangedVertices,
        chunks: &[Chunk],
        affected: &[AffectedPrimitives],
    ) -> Option<Vec<Vec<u32>>> {
        let count = chunks.last()?.ordinals.end as usize;
        // Vertices that moved in an earlier frame of the drag count as well: a vertex may rest for a moment.
        let is_continued = self.is_apart && self.moved.len() == vertices.moved().len();
        if !is_continued {
            reset(&mut self.moved, 64 * vertices.moved().len());
            reset(&mut self.primitives, count);
        }
        self.moved.iter_mut().zip(vertices.moved()).for_each(|(all, &moved)| *all |= moved);
        let differ = &mut self.cache.differ;
        reset(differ, count);
        for (chunk, affected) in chunks.iter().zip(affected) {
            let start = chunk.ordinals.start as usize;
            let flagged = |flags: &[bool], bits: &mut [u64]| {
                let ordinals = (start..).zip(flags).filter(|(_, is_flagged)| **is_flagged);
                ordinals.for_each(|(ordinal, _)| set(bits, ordinal));
            };
            flagged(&affected.differs, differ);
            flagged(&affected.is_moved, &mut self.primitives);
        }
        self.add_slots(pass, plan);
        self.cache.differ.iter_mut().zip(&self.primitives).for_each(|(differ, &moved)| *differ |= moved);
        let moving: u32 = self.primitives.iter().map(|word| word.count_ones()).sum();
        let indices = |chunk: &Chunk| -> Vec<u32> {
            let ordinals = chunk.ordinals.clone();
            let moving = ordinals.filter(|&ordinal| is_set(&self.primitives, ordinal as usize));
            moving.map(|ordinal| ordinal - chunk.ordinals.start).collect()
        };
        let are_few = (moving as usize) < count / MANY;
        are_few.then(|| chunks.iter().map(indices).collect())
    }

    /// Adds all slots of the faces whose triangles move.
    fn add_slots(&mut self, pass: &[RecordedDraw<'_>], plan: &Plan) {
        for draw in &plan.draws {
            let geometry = &pass[draw.draw()].geometry;
            if !matches!(geometry.shape, Shape::Triangles { .. }) {
                continue;
            }
            let start = draw.ordinals.start;
            let moving: Vec<u32> =
                draw.ordinals.clone().filter(|&ordinal| is_set(&self.primitives, ordinal as usize)).collect();
            for slot in moving.into_iter().flat_map(|ordinal| slots(geometry, ordinal - start)) {
                set(&mut self.primitives, (start + slot) as usize);
            }
        }
    }

    /// Whether primitives can be listed apart, given their indices in each chunk.
    pub(super) fn can_part(
        &self,
        pass: &[RecordedDraw<'_>],
        plan: &Plan,
        chunks: &[Chunk],
        indices: &[Vec<u32>],
    ) -> bool {
        let is_plain = |draw: &DrawPlan| match pass[draw.draw()].geometry.shape {
            Shape::Triangles { .. } => true,
            Shape::Points { .. } => plan.points(draw).is_some(),
            Shape::Lines { .. } => false,
        };
        let none = MovingChunk::default();
        let mut parted = (0..).zip(chunks).zip(indices).filter(|(_, indices)| !indices.is_empty());
        parted.all(|((number, chunk), indices)| {
            let apart = self.chunks.get::<usize>(number).unwrap_or(&none);
            let draw = |&index: &u32| &plan.draws[plan.draw_of(chunk.ordinals.start + index)];
            matches!(chunk.blend_mode, BlendMode::Opaque | BlendMode::Overlay)
                && apart.can_take(chunk)
                && indices.iter().map(draw).all(is_plain)
        })
    }

    /// Moves primitives from chunks to lists of their own.
    pub(super) fn part(&mut self, grid: &Grid, chunks: &mut [Chunk], indices: Vec<Vec<u32>>) {
        self.is_apart = true;
        self.chunks.resize_with(chunks.len(), MovingChunk::default);
        for ((moving, chunk), indices) in self.chunks.iter_mut().zip(chunks).zip(indices) {
            moving.take(chunk, indices);
        }
        self.cache.reset((grid.columns * grid.viewport.height.div_ceil(grid.size)) as usize);
    }
}
