//! Which draws are hidden as a whole, found before any of their vertices run.
//!
//! Draws may say where they lie ([`DrawBounds`]). Those in front, up to [`LAYERS`] above each other, are drawn on their own
//! first, without colours, if they are a small part of all. That bounds the depths of all blocks. A draw that lies behind
//! these bounds wherever it may have samples is left out of the frame. It could not be visible, so no byte changes,
//! whichever draws are in front.

use super::layout::{FrameOptions, Layout};
use super::tiles::Scratch;
use crate::bin::Grid;
use crate::draw::DrawBounds;
use crate::pass::{BoundedDraw, Pass};
use crate::simd::at_level;
use crate::tile::{Listing, resolve_visibility};
use crate::tile_buffer::{BEHIND_ALL, BLOCKS};
use crate::view::FrameView;
use crate::{BlendMode, Stats, Target};
use fixedbitset::FixedBitSet;
use std::sync::{Mutex, PoisonError};

/// How often boxes in front may lie above each other, averaged over a box.
const LAYERS: f32 = 2.0;

/// How many times as many triangles as those in front all boxes have to hold.
const WORTH: f32 = 4.0;

/// After a frame in which less was left out than was drawn twice, so many frames are drawn without a search.
const REST: u32 = 15;

/// The farthest depth in each block of a tile.
type BlockDepths = [f32; BLOCKS * BLOCKS];

/// The draws that a frame needs, and what it takes to find them.
#[derive(Default)]
pub(super) struct Occlusion {
    bounded: Vec<Bounded>,
    /// How often boxes in front lie above each other in each tile.
    layers: Vec<f32>,
    depths: Vec<BlockDepths>,
    drawn: FixedBitSet,
    /// Triangles of the draws in front.
    in_front: usize,
    rest: u32,
}

/// Where a draw lies in the image.
#[derive(Clone, Copy)]
struct Bounded {
    draw: u32,
    /// The first and the last pixel that may hold samples.
    columns: [i32; 2],
    rows: [i32; 2],
    nearest: f64,
}

impl Bounded {
    /// `None` if it may have to be cut, or is out of view.
    fn new(BoundedDraw { draw, bounds }: BoundedDraw, grid: &Grid) -> Option<Self> {
        let DrawBounds { least, greatest, nearest } = bounds;
        let guard = grid.viewport.guard().map(|band| f64::from(band.factor()));
        let is_within = |axis: usize| least[axis] >= -guard[axis] && greatest[axis] <= guard[axis];
        if !(is_within(0) && is_within(1) && nearest <= 1.0) {
            return None;
        }
        let [[left, bottom], [right, top]] = [least, greatest].map(|end| grid.viewport.position(end, 1.0));
        // Samples lie within pixels, and vertices move by less than one to the grid.
        let pixels = |[low, high]: [f64; 2], side: u32| {
            let [first, last] = [low.floor() as i32 - 1, high.floor() as i32 + 1];
            (last >= 0 && first < side as i32).then(|| [first.max(0), last.min(side as i32 - 1)])
        };
        let columns = pixels([left, right], grid.viewport.width)?;
        Some(Self { draw, columns, rows: pixels([top, bottom], grid.viewport.height)?, nearest })
    }

    /// Whether everything of the draw lies behind what is in front of it.
    fn is_hidden(&self, front: &FrameView<'_>, depths: &[BlockDepths]) -> bool {
        let tiles = front.grid.tiles_that_see(self.columns, self.rows);
        let blocks = |[first, last]: [i32; 2], origin: i32, size: usize| {
            let end = ((last - origin) / 8 + 1).min(size.div_ceil(8) as i32);
            ((first - origin).max(0) / 8) as usize..end.max(0) as usize
        };
        (0..tiles.len() as u32).filter_map(|number| tiles.get(number)).all(|[column, row]| {
            let tile = row * front.grid.columns + column;
            let (area, depths) = (front.area(tile), &depths[tile as usize]);
            let columns = blocks(self.columns, area.origin[0], area.size[0]);
            blocks(self.rows, area.origin[1], area.size[1]).all(|row| {
                columns.clone().all(|column| f64::from(depths[row * BLOCKS + column]) > self.nearest)
            })
        })
    }
}

impl Occlusion {
    /// Chooses the draws in front; false if a search is not worth it.
    pub(super) fn choose(&mut self, pass: &Pass<'_>, target: &Target<'_>, options: FrameOptions<'_>) -> bool {
        // Ink reaches beyond the boxes of the triangles whose edges it draws.
        let has_ink = pass.edges.is_some() || pass.marks.is_some();
        if pass.bounds.is_empty() || pass.scissor.is_some() || has_ink || !options.hierarchical {
            return false;
        }
        self.rest = self.rest.saturating_sub(1);
        if self.rest > 0 {
            return false;
        }
        let grid = &Layout::new(pass, target, options).grid;
        self.bounded.clear();
        self.bounded.extend(pass.bounds.iter().filter_map(|&bounded| Bounded::new(bounded, grid)));
        self.bounded.sort_unstable_by(|a, b| b.nearest.total_cmp(&a.nearest).then(a.draw.cmp(&b.draw)));
        let triangles = |draw: u32| pass.draws[draw as usize].geometry.len();
        let all: usize = self.bounded.iter().map(|bounded| triangles(bounded.draw)).sum();
        self.list_front(pass, grid);
        self.in_front = self.drawn.ones().map(|draw| triangles(draw as u32)).sum();
        WORTH * self.in_front as f32 <= all as f32
    }

    /// Lists opaque draws from front to back, as long as few of them lie above each other.
    fn list_front(&mut self, pass: &Pass<'_>, grid: &Grid) {
        let Self { bounded, layers, drawn, .. } = self;
        drawn.clear();
        drawn.grow(pass.draws.len());
        layers.clear();
        layers.resize((grid.columns * grid.tile_of(grid.viewport.height - 1) + grid.columns) as usize, 0.0);
        let [width, height] = [grid.viewport.width, grid.viewport.height].map(|side| side as i32);
        let overlap = |[first, last]: [i32; 2], tile: u32, side: i32| {
            let (start, end) = ((tile * grid.size) as i32, side.min(((tile + 1) * grid.size) as i32));
            pixel_count([first.max(start), last.min(end - 1)]) / (end - start) as f32
        };
        for Bounded { draw, columns, rows, .. } in bounded.iter() {
            if pass.draws[*draw as usize].geometry.blend_mode != BlendMode::Opaque {
                continue;
            }
            let tiles = grid.tiles_of(*columns, *rows);
            let shares = || {
                let tiles = (0..tiles.len() as u32).filter_map(|number| tiles.get(number));
                tiles.map(|[column, row]| {
                    let share = overlap(*columns, column, width) * overlap(*rows, row, height);
                    ((row * grid.columns + column) as usize, share)
                })
            };
            let (above, area) = shares().fold((0.0, 0.0), |(above, area), (tile, share)| {
                (above + share * layers[tile], area + share)
            });
            if above < LAYERS * area {
                drawn.insert(*draw as usize);
                shares().for_each(|(tile, share)| layers[tile] += share);
            }
        }
    }

    /// The draws of the pass that are to be drawn: those in front, or after [`leave_out`](Self::leave_out) all that may be
    /// visible.
    pub(super) fn drawn(&self) -> &FixedBitSet {
        &self.drawn
    }

    /// Draws the frame of the draws in front, and leaves out what they hide.
    pub(super) fn leave_out(
        &mut self,
        front: &FrameView<'_>,
        options: FrameOptions<'_>,
        scratches: &mut [Scratch],
    ) {
        self.find_depths(front, options, scratches);
        let Self { bounded, depths, drawn, .. } = self;
        drawn.insert_range(..);
        let mut hidden = 0;
        for Bounded { draw, .. } in bounded.iter().filter(|bounded| bounded.is_hidden(front, depths)) {
            drawn.set(*draw as usize, false);
            hidden += front.pass[*draw as usize].geometry.len();
        }
        if hidden < self.in_front {
            self.rest = REST + 1;
        }
    }

    /// Finds the depths of all tiles.
    fn find_depths(&mut self, front: &FrameView<'_>, options: FrameOptions<'_>, scratches: &mut [Scratch]) {
        self.depths.clear();
        self.depths.resize(front.tiles().len(), [BEHIND_ALL; _]);
        let tiles = Mutex::new(self.depths.iter_mut().zip(0..));
        let next = || tiles.lock().unwrap_or_else(PoisonError::into_inner).next();
        let free = Mutex::new(scratches.iter_mut());
        options.workers.run(true, |_| {
            let Some(scratch) = free.lock().unwrap_or_else(PoisonError::into_inner).next() else {
                return;
            };
            while let Some((depths, tile)) = next()
                && !options.is_cancelled()
            {
                find_depths(front, scratch, tile, depths);
            }
        });
    }
}

/// How many pixels lie from the first to the last.
fn pixel_count([first, last]: [i32; 2]) -> f32 {
    (last - first + 1).max(0) as f32
}

/// Finds the farthest depth in each block of a tile.
fn find_depths(front: &FrameView<'_>, scratch: &mut Scratch, tile: u32, depths: &mut BlockDepths) {
    let Scratch { state, shading, .. } = scratch;
    let (area, surfaces) = (front.area(tile), state.list(front, tile, Listing::All));
    if state.triangles.is_empty() {
        return;
    }
    state.begin(front, tile);
    resolve_visibility(front, &area, state, &surfaces, shading, &mut Stats::default());
    state.buffer.bring_outside_near(&area);
    at_level!(front.token, simd => state.buffer.refresh_all(simd, &area));
    *depths = state.buffer.blocks.farthest;
}
