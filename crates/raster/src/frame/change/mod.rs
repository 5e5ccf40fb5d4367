//! What changes in a frame if few vertices of a pass have other values than in the last frame: which vertices run
//! again, which chunks are set up again, and which tiles may look different.
//!
//! The image of a tile follows from the triangles that the tile lists, in their order. Where faces have edges, the image
//! also follows from the other triangles of these faces. A tile therefore keeps its image unless a vertex with new values
//! belongs to a triangle that the tile lists or listed before, or to a face of such a triangle.

use super::layout::Layout;
use crate::bin::{Chunk, Grid};
use crate::geometry::Shape;
use crate::paint2d::Rect;
use crate::pass::{Pass, RecordedDraw};
use crate::vertex::UsedVertices;
use crate::view::{Plan, RequestedOutputs};
use crate::{BlendMode, Stats};
use std::sync::atomic::{AtomicBool, Ordering};

/// How a draw differs from the one of the same index in the last pass.
#[derive(Clone, Copy, Debug, Default)]
pub struct DrawChange<'a> {
    /// Vertices for which the pipeline may return other values, in any order.
    pub vertices: &'a [u32],
    /// Triangles that may have other corners or [`edge_flags`](crate::Draw::edge_flags), and
    /// points that may have another [size](crate::Points::marked); increasing. None of lines:
    /// they, like points, can move but not have other vertices.
    pub reshaped: &'a [u32],
    /// Primitives that lie where they did and may have other colours, by their
    /// [`marks`](crate::Draw::marks) or as the pipeline answers for them; increasing.
    pub recolored: &'a [u32],
}

/// What [`Rasterizer::redraw`](crate::Rasterizer::redraw) has done.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Redraw {
    /// As of a whole frame up to the tiles; what happens in tiles counts in those that were
    /// drawn.
    pub stats: Stats,
    /// The parts of the target that were drawn; they do not overlap.
    pub parts: Vec<Rect>,
}

/// What has to be the same in two frames for one to follow from the other.
#[derive(PartialEq)]
pub(super) struct Signature {
    wants: RequestedOutputs,
    samples_per_axis: u32,
    samples: usize,
    /// Of the viewport, a tile, and its apron.
    sizes: [u32; 4],
    workers: usize,
    draws: Vec<DrawSignature>,
}

/// The same for a draw.
#[derive(PartialEq)]
struct DrawSignature {
    primitives: usize,
    vertices: usize,
    varyings: usize,
    object: u32,
    blend_mode: BlendMode,
}

impl Signature {
    pub(super) fn new(pass: &Pass<'_>, layout: &Layout, workers: usize) -> Self {
        let Layout { axis, wants, ref grid, .. } = *layout;
        let of_draw = |recorded: &RecordedDraw<'_>| DrawSignature {
            primitives: recorded.geometry.len(),
            vertices: recorded.pipeline.vertex_count(),
            varyings: recorded.pipeline.varyings(),
            object: recorded.geometry.object,
            blend_mode: recorded.geometry.blend_mode,
        };
        Self {
            wants,
            samples_per_axis: axis,
            samples: grid.pattern.count(),
            sizes: [grid.viewport.width, grid.viewport.height, grid.size, grid.apron],
            workers,
            draws: pass.draws.iter().map(of_draw).collect(),
        }
    }
}

/// Whether the changes of a pass that has the last one's signature are of a kind that the
/// plan outlasts.
pub(super) fn can_update(plan: &Plan, pass: &Pass<'_>, changes: &[DrawChange<'_>]) -> bool {
    pass.scissor.is_none()
        && changes.len() == pass.draws.len()
        && plan.draws.iter().all(|draw| {
            let RecordedDraw { geometry, pipeline } = &pass.draws[draw.draw()];
            let is_mesh = matches!(geometry.shape, Shape::Triangles { .. });
            // Other corners could use other vertices.
            let uses_all = draw.used == UsedVertices::all(pipeline.vertex_count());
            let is_points = matches!(geometry.shape, Shape::Points { .. });
            changes[draw.draw()].reshaped.is_empty() || is_points || is_mesh && uses_all
        })
}

/// Tiles that may look different.
pub(super) struct DirtyTiles(Vec<AtomicBool>);

impl DirtyTiles {
    /// None of a grid.
    pub(super) fn new(grid: &Grid) -> Self {
        let count = grid.columns * grid.viewport.height.div_ceil(grid.size);
        Self((0..count).map(|_| AtomicBool::new(false)).collect())
    }

    /// Adds the tiles that list primitives of a chunk for which a test of their indices in the chunk holds.
    pub(super) fn add(&self, grid: &Grid, chunk: &Chunk, is_one: impl Fn(u32) -> bool) {
        chunk.for_each_tile_of(grid, is_one, |tile| self.add_tile(tile));
    }

    /// Adds a tile.
    pub(super) fn add_tile(&self, tile: u32) {
        self.0[tile as usize].store(true, Ordering::Relaxed);
    }

    /// Their numbers, increasing.
    pub(super) fn listed(self) -> Vec<u32> {
        (0..).zip(self.0).filter_map(|(tile, is_dirty)| is_dirty.into_inner().then_some(tile)).collect()
    }
}

#[cfg(test)]
mod tests;
