//! A tile in one visit: visibility, shading, blending, resolve.

mod cover;
mod edge;
mod scratch;
mod visibility;

pub(crate) use cover::{DepthPlane, Region, STRIDE, TileArea, TileTriangle};
pub(crate) use edge::Edge;
pub(crate) use scratch::{NOBODY, Scratch, Waiting};
pub(crate) use visibility::is_seen;

use crate::frame::Frame;
use crate::target::TileRows;
use crate::{blend, resolve, shade};

/// Draws the tile `index` of the frame into its part of the target.
pub(crate) fn draw_tile(frame: &Frame<'_>, scratch: &mut Scratch, (index, mut rows): (usize, TileRows<'_>)) {
    let bins = [&frame.opaque, &frame.masked, &frame.translucent].map(|bins| bins.tile(index));
    if bins.iter().all(|bin| bin.is_empty()) {
        resolve::fill_background(frame, &mut rows);
        return;
    }
    scratch.stats.tiles += 1;
    let samples = frame.samples_per_axis.get();
    let rect = rows.rect;
    let area = TileArea {
        origin: [(rect.x * samples) as i32, (rect.y * samples) as i32],
        size: [(rect.width * samples) as usize, (rect.height * samples) as usize],
    };
    let [opaque, masked, translucent] = bins;
    visibility::resolve_visibility(frame, area, scratch, [opaque, masked]);
    if frame.wants_color {
        resolve::lay_background(frame, rect, scratch);
        shade::shade_visible(frame, area, scratch);
        if !translucent.is_empty() {
            blend::blend_translucent(frame, area, scratch, translucent);
        }
    }
    resolve::resolve(frame, scratch, &mut rows);
}
