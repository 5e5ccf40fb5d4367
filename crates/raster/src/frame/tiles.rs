//! Draws one tile: visibility, shading, blending, resolve.

use crate::Stats;
use crate::blend::{Layers, blend_translucent};
use crate::clock::Clock;
use crate::outer_ink::OuterInk;
use crate::resolve::{Strip, TileColors, resolve, store_visibility};
use crate::shade::{PixelsToShade, Shading, list_visible, shade_tile};
use crate::target::Bands;
use crate::tile::{Listing, Surfaces, TileState, cover_overlay, resolve_visibility};
use crate::view::FrameView;

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
pub(super) fn count_visible(frame: &FrameView<'_>, state: &TileState, stats: &mut Stats) {
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
