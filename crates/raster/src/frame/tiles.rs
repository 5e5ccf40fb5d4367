//! Draws one tile: visibility, shading, blending, resolve.
//!
//! While primitives move from frame to frame, [`TileCache`] holds what the still triangles of each tile show. Only the
//! moving triangles are drawn over the cached tile, and only pixels that may look different are shaded.
//!
//! Without the cache a drag takes 2.6 times the processor time if a patch moves, and 1.6 to 1.9 times if vertices all over
//! the mesh move (`cargo bench -p trigon-scene --bench changes -- sheet edges`, and `derived edges`).

use super::changed_vertices::is_set;
use crate::Stats;
use crate::blend::{Layers, blend_translucent};
use crate::ink::{Ink, VisibleFaces};
use crate::outer_ink::OuterInk;
use crate::resolve::{Strip, TileColors, resolve, store_visibility};
use crate::shade::{PartialTile, PixelsToShade, Shading, list_visible, note_faces, shade_tile};
use crate::stats::Clock;
use crate::target::Bands;
use crate::tile::{
    CachedTile, Listing, MovingRanges, Surfaces, TileState, cover_overlay, resolve_visibility,
};
use crate::tile_buffer::{GROUP_COUNT, TileArea, TileLanes, TileRows, rows_of, rows_of_either};
use crate::view::FrameView;
use std::sync::{Mutex, PoisonError};

/// What a worker keeps from tile to tile and from frame to frame, so that nothing allocates
/// once it is warm: a part for each stage.
pub(super) struct Scratch {
    pub(super) state: TileState,
    pub(super) shading: Shading,
    /// Of a tile of which only some pixels are shaded.
    pub(super) pixels_to_shade: Box<PixelsToShade>,
    layers: Layers,
    /// Tiles that are not written yet.
    pub(super) strip: Strip,
    pub(super) stats: Stats,
}

impl Scratch {
    pub(super) fn new() -> Self {
        Self {
            state: TileState::new(),
            shading: Shading::new(),
            pixels_to_shade: Box::new(PixelsToShade::new()),
            layers: Layers::default(),
            strip: Strip::default(),
            stats: Stats::default(),
        }
    }
}

/// Draws the tile `index` of the frame. Its pixels may wait in `scratch` for those beside them.
pub(super) fn draw_tile(frame: &FrameView<'_>, scratch: &mut Scratch, bands: &Bands<'_>, index: u32) {
    let area = frame.area(index);
    let Scratch { state, shading, strip, stats, .. } = scratch;
    let surfaces = state.list(frame, index, Listing::All);
    if state.triangles.is_empty() {
        return strip.push_empty(frame, &area, bands);
    }
    stats.tiles += 1;
    let mut clock = Clock::new(frame.timed);
    state.begin(frame, index);
    resolve_visibility(frame, &area, state, &surfaces, shading, stats);
    count_visible(frame, state, stats);
    stats.times.visibility += clock.lap();
    // Depth and ids know nothing of what is shown over the surfaces.
    store_visibility(frame, &area, None, state, bands);
    stats.times.resolve += clock.lap();
    if frame.wants.color {
        cover_overlay(frame, &area, state, &surfaces, stats);
        stats.times.visibility += clock.lap();
        draw_colors(frame, scratch, surfaces, bands, index, &mut clock);
    }
}

/// Counts the samples that show opaque and masked triangles.
fn count_visible(frame: &FrameView<'_>, state: &TileState, stats: &mut Stats) {
    if frame.timed {
        stats.samples_visible += state.buffer.visible_count() as u64;
    }
}

/// Gives a tile its colours, after all opaque triangles have competed.
fn draw_colors(
    frame: &FrameView<'_>,
    scratch: &mut Scratch,
    surfaces: Surfaces,
    bands: &Bands<'_>,
    index: u32,
    clock: &mut Clock,
) {
    let area = frame.area(index);
    let Scratch { state, shading, layers, strip, stats, .. } = scratch;
    let is_blended = !surfaces.translucent.is_empty();
    let encoding = if is_blended { None } else { frame.wants.bytes };
    stats.pixels_shaded += shade_tile(frame, state.visible(&area), None, shading, encoding);
    stats.triangles_edged += shading.edged;
    stats.times.shading += clock.lap();
    let colors = match encoding {
        Some(encoding) => TileColors::Encoded(encoding),
        None if is_blended => TileColors::Blended,
        None => TileColors::Shaded,
    };
    if is_blended {
        let triangles = surfaces.translucent;
        let blended = blend_translucent(frame, &area, state, layers, shading, triangles);
        stats.pixels_shaded += blended;
        stats.pixels_blended += blended;
        stats.times.blending += clock.lap();
    }
    resolve(frame, &area, colors, shading, strip, bands);
    stats.times.resolve += clock.lap();
}

/// What edges cover beyond their faces in a single tile.
pub(crate) fn outer_ink(frame: &FrameView<'_>, index: u32) -> OuterInk {
    let Scratch { mut state, mut shading, mut stats, .. } = Scratch::new();
    if frame.paints_lines() {
        let area = frame.area(index);
        let surfaces = state.list(frame, index, Listing::All);
        state.begin(frame, index);
        resolve_visibility(frame, &area, &mut state, &surfaces, &mut shading, &mut stats);
        cover_overlay(frame, &area, &mut state, &surfaces, &mut stats);
        list_visible(frame, state.visible(&area), None, &mut shading);
    }
    shading.outer
}

/// What still primitives show in each tile, for the tiles that were drawn since primitives were listed apart.
#[derive(Default)]
pub(super) struct TileCache {
    tiles: Vec<Mutex<Option<Box<TileCacheEntry>>>>,
    /// The primitives that may look different: a bit for each of the frame.
    pub(super) differ: Vec<u64>,
}

/// All lanes.
const ALL: [TileLanes; 2] = [[u8::MAX; GROUP_COUNT]; 2];

/// What is cached of a tile.
struct TileCacheEntry {
    /// What still triangles show; `None` if the tile cannot be cached.
    still: Option<CachedTile>,
    /// The still triangles as the search for outer halves of lines needs them, if there are lines.
    faces: VisibleFaces,
    /// The pixels that show still triangles whose values change in every frame.
    look: TileRows,
    /// The lanes that showed moving triangles in the last frame: without overlays, if depths or ids are written, and with
    /// overlays.
    shown: [TileLanes; 2],
}

impl TileCache {
    /// Forgets all tiles, and begins with `count`.
    pub(super) fn reset(&mut self, count: usize) {
        self.tiles.clear();
        self.tiles.resize_with(count, Mutex::default);
    }

    /// Draws a tile.
    pub(super) fn draw(&self, frame: &FrameView<'_>, scratch: &mut Scratch, bands: &Bands<'_>, index: u32) {
        let mut cached = self.tiles[index as usize].lock().unwrap_or_else(PoisonError::into_inner);
        let area = &frame.area(index);
        let find = || Box::new(TileCacheEntry::find(frame, &self.differ, area, index, scratch));
        let own = cached.get_or_insert_with(find);
        if own.draw(frame, scratch, bands, area, index).is_none() {
            own.shown = ALL;
            draw_tile(frame, scratch, bands, index);
        }
    }
}

impl TileCacheEntry {
    /// Finds what its still triangles show.
    fn find(
        frame: &FrameView<'_>,
        differ: &[u64],
        area: &TileArea,
        index: u32,
        scratch: &mut Scratch,
    ) -> Self {
        let Scratch { state, shading, stats, .. } = scratch;
        let still = CachedTile::find(frame, area, index, state, shading, stats);
        let (mut look, mut faces) = ([0; GROUP_COUNT], VisibleFaces::default());
        if let Some(still) = &still {
            still.lanes_of(|triangle| is_set(differ, triangle.ordinal as usize), &mut look);
            if frame.paints_lines() {
                faces = note_faces(frame, area, still.triangles(), &mut shading.records);
            }
        }
        Self { still, faces, look: rows_of(&look), shown: ALL }
    }

    /// Draws what has changed; `None`, with nothing drawn for good, if it has to be drawn as a whole.
    fn draw(
        &mut self,
        frame: &FrameView<'_>,
        scratch: &mut Scratch,
        bands: &Bands<'_>,
        area: &TileArea,
        index: u32,
    ) -> Option<()> {
        let Scratch { state, shading, pixels_to_shade, strip, stats, .. } = scratch;
        let (still, encoding) = (self.still.as_ref()?, frame.wants.bytes?);
        let mut clock = Clock::new(frame.timed);
        let moving = still.restore(frame, area, index, state);
        MovingRanges::cover(frame, area, state, &moving.surfaces.opaque, stats)?;
        count_visible(frame, state, stats);
        stats.times.visibility += clock.lap();
        let mut now = [[0; GROUP_COUNT]; 2];
        if frame.wants.depth || frame.wants.ids {
            moving.lanes(frame, state, &mut now[0]);
            let moved = rows_of_either(&now[0], &self.shown[0]);
            store_visibility(frame, area, Some(&moved), state, bands);
            stats.times.resolve += clock.lap();
        }
        still.lay_overlays(frame, state);
        MovingRanges::cover(frame, area, state, &moving.surfaces.overlay, stats)?;
        moving.lanes(frame, state, &mut now[1]);
        moving.sort(frame, state);
        stats.tiles += 1;
        let reach = frame.ink.as_ref().map_or(0, Ink::reach) as usize;
        pixels_to_shade.set(&self.look, &now[1], &self.shown[1], frame.own_part(area), reach);
        self.shown = now;
        stats.times.visibility += clock.lap();
        if pixels_to_shade.any() {
            let visible = state.visible(area);
            let partly = PartialTile {
                pixels: pixels_to_shade,
                still: &self.faces,
                indices: moving.still_indices(state),
            };
            stats.pixels_shaded += shade_tile(frame, visible, Some(partly), shading, Some(encoding));
            stats.triangles_edged += shading.edged;
            stats.times.shading += clock.lap();
            let colors = TileColors::PartlyEncoded(encoding, &pixels_to_shade.rows);
            resolve(frame, area, colors, shading, strip, bands);
            stats.times.resolve += clock.lap();
        }
        Some(())
    }
}
