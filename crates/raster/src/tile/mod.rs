//! A tile in one visit: visibility, shading, blending, resolve.

mod area;
mod blocks;
mod buffer;
mod counts;
mod cover;
mod covering;
mod depth;
mod edge;
mod eight;
mod key_order;
mod masked;
mod micro;
mod quad;
mod scratch;
mod seen;
mod several;
mod single;
mod starts;
mod store;
#[cfg(test)]
mod tests;
mod ties;
mod tiny;
mod visibility;

pub(crate) use area::{MAX_SIDE, PIXELS, TileArea, lane_point};
pub(crate) use blocks::Blocks;
pub(crate) use buffer::{BEHIND_ALL, NOBODY, VisibilityBuffer};
pub(crate) use counts::Counts;
pub(crate) use covering::Covering;
pub(crate) use depth::DepthPlane;
pub(crate) use edge::Edge;
pub(crate) use scratch::Scratch;
pub(crate) use seen::{Candidate, SampleGroup, TileView};
pub(crate) use single::single;
pub(crate) use ties::Ties;

use crate::Surface;
use crate::clock::Clock;
use crate::frame::FrameView;
use crate::ink::OuterInk;
use crate::target::Bands;
use crate::{blend, resolve, shade};
use std::ops::Range;

/// The tile's triangles by kind of surface: ranges of its places.
pub(crate) struct Surfaces {
    pub(crate) opaque: Range<usize>,
    pub(crate) masked: Range<usize>,
    pub(crate) overlay: Range<usize>,
    pub(crate) translucent: Range<usize>,
}

/// Draws the tile `index` of the frame. Its pixels may wait in `scratch` for those beside them.
pub(crate) fn draw_tile(frame: &FrameView<'_>, scratch: &mut Scratch, bands: &Bands<'_>, index: u32) {
    let area = frame.area(index);
    let surfaces = collect(frame, scratch, index);
    if scratch.places.is_empty() {
        return scratch.strip.push_empty(frame, &area, bands);
    }
    scratch.stats.tiles += 1;
    let mut clock = Clock::new(frame.timed);
    scratch.buffer.clear(&area, frame.grid.pattern.count());
    scratch.ties.reset(scratch.places.len());
    visibility::resolve_visibility(frame, &area, scratch, &surfaces);
    scratch.stats.times.visibility += clock.lap();
    // Depth and ids know nothing of what is shown over the surfaces.
    resolve::store_visibility(frame, &area, scratch, bands);
    scratch.stats.times.resolve += clock.lap();
    if frame.wants.color {
        visibility::cover_overlay(frame, &area, scratch, &surfaces);
        scratch.stats.times.visibility += clock.lap();
    }
    let mut early = None;
    if frame.wants.color {
        early = surfaces.translucent.is_empty().then_some(frame.wants.bytes).flatten();
        shade::shade_tile(frame, &area, scratch, early);
        scratch.stats.times.shading += clock.lap();
        if !surfaces.translucent.is_empty() {
            blend::blend_translucent(frame, &area, scratch, surfaces.translucent);
            scratch.stats.times.blending += clock.lap();
        }
    }
    resolve::resolve(frame, &area, scratch, (bands, early));
    scratch.stats.times.resolve += clock.lap();
}

/// What edges cover beyond their faces in a tile that is looked at by itself.
pub(crate) fn outer_ink(frame: &FrameView<'_>, index: u32) -> OuterInk {
    let mut scratch = Scratch::new();
    if frame.paints_lines() {
        let area = frame.area(index);
        let surfaces = collect(frame, &mut scratch, index);
        scratch.buffer.clear(&area, frame.grid.pattern.count());
        scratch.ties.reset(scratch.places.len());
        visibility::resolve_visibility(frame, &area, &mut scratch, &surfaces);
        visibility::cover_overlay(frame, &area, &mut scratch, &surfaces);
        let Scratch { buffer, places, shading, .. } = &mut scratch;
        shade::list_visible(frame, &area, (buffer, places), shading);
    }
    scratch.shading.outer
}

/// Lists the triangles of a tile.
fn collect(frame: &FrameView<'_>, scratch: &mut Scratch, tile: u32) -> Surfaces {
    scratch.places.clear();
    let mut ends = [0; 4];
    for chunk in frame.chunks.iter().filter(|chunk| !chunk.is_empty()) {
        chunk.collect(&frame.grid, tile, &mut scratch.places);
        let first = match chunk.surface {
            Surface::Opaque => 0,
            Surface::Masked | Surface::MaskedPerSample => 1,
            Surface::Overlay => 2,
            Surface::Translucent => 3,
        };
        ends[first..].fill(scratch.places.len());
    }
    let [opaque, masked, overlay, translucent] = ends;
    Surfaces {
        opaque: 0..opaque,
        masked: opaque..masked,
        overlay: masked..overlay,
        translucent: overlay..translucent,
    }
}
