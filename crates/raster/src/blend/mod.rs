//! Translucent fragments: gathered, ordered by (depth, object, face) at each
//! sample, and laid over what is there from back to front.
//!
//! The order is total, so it depends neither on the order of draws nor on
//! threads. A band of eight rows is done at a time, to bound the memory that
//! many layers take.

use crate::frame::Frame;
use crate::shade::Span;
use crate::tile::{STRIDE, Scratch, TileArea, TileTriangle, Waiting, is_seen};
use std::cmp::Ordering;
use trigon_math::Vec4;

const BAND: usize = 8;

/// Lays the translucent triangles of a tile over its colours.
pub(crate) fn blend_translucent(frame: &Frame<'_>, area: TileArea, scratch: &mut Scratch, bin: &[u32]) {
    let last = area.size[1] - 1;
    for first in (0..=last).step_by(BAND) {
        let rows = [first, last.min(first + BAND - 1)];
        let mut waiting = std::mem::take(&mut scratch.waiting);
        waiting.clear();
        gather(frame, area, scratch, (bin, rows), &mut waiting);
        if !waiting.is_empty() {
            shade(frame, area, scratch, &waiting);
            sort(frame, scratch, &waiting);
            lay_over(frame, scratch, &waiting);
        }
        scratch.waiting = waiting;
    }
}

/// The fragments that nothing opaque hides.
fn gather(
    frame: &Frame<'_>,
    area: TileArea,
    scratch: &mut Scratch,
    (bin, rows): (&[u32], [usize; 2]),
    waiting: &mut Vec<Waiting>,
) {
    scratch.spans.clear();
    let mut spans = std::mem::take(&mut scratch.spans);
    for &ordinal in bin {
        let Some(tile_triangle) = TileTriangle::new(&frame.triangles[ordinal as usize], area, rows) else {
            continue;
        };
        tile_triangle.for_each_sample(|sample, depth| {
            if is_seen(frame, scratch, sample, depth, ordinal) {
                Span::extend(&mut spans, ordinal, [sample % STRIDE, sample / STRIDE], waiting.len());
                waiting.push(Waiting { sample: sample as u32, depth, triangle: ordinal });
            }
        });
    }
    scratch.spans = spans;
}

fn shade(frame: &Frame<'_>, area: TileArea, scratch: &mut Scratch, waiting: &[Waiting]) {
    scratch.waiting_color.clear();
    scratch.waiting_color.resize(waiting.len(), Vec4::ZERO);
    frame.shade(area, &scratch.spans, &mut scratch.waiting_color);
    scratch.stats.samples_shaded += waiting.len() as u64;
}

/// By sample, then from back to front.
fn sort(frame: &Frame<'_>, scratch: &mut Scratch, waiting: &[Waiting]) {
    scratch.order.clear();
    scratch.order.extend(0..waiting.len() as u32);
    scratch.order.sort_unstable_by(|&a, &b| {
        let (a, b) = (&waiting[a as usize], &waiting[b as usize]);
        let depth = || a.depth.partial_cmp(&b.depth).unwrap_or(Ordering::Equal);
        // Of equal depths the smaller key is in front, so later.
        let key = || frame.compare(b.triangle, a.triangle);
        a.sample.cmp(&b.sample).then_with(depth).then_with(key)
    });
}

fn lay_over(frame: &Frame<'_>, scratch: &mut Scratch, waiting: &[Waiting]) {
    let Scratch { order, color, waiting_color, .. } = scratch;
    for layers in order.chunk_by(|&a, &b| waiting[a as usize].sample == waiting[b as usize].sample) {
        let color = &mut color[waiting[layers[0] as usize].sample as usize];
        for &layer in layers {
            if is_joint(frame, waiting, layers, layer) {
                continue;
            }
            let source = waiting_color[layer as usize];
            *color = source + *color * (1.0 - source.w);
        }
    }
}

/// Whether the layer is a segment that leaves this sample to a later one of the
/// same draw that it is joined to.
fn is_joint(frame: &Frame<'_>, waiting: &[Waiting], layers: &[u32], layer: u32) -> bool {
    let triangle = |layer: u32| &frame.triangles[waiting[layer as usize].triangle as usize];
    let own = triangle(layer);
    if own.kind != crate::setup::Kind::Line {
        return false;
    }
    layers.iter().map(|&other| triangle(other)).any(|other| {
        other.draw == own.draw
            && other.primitive > own.primitive
            && frame.geometry(own).segments_meet(own.primitive, other.primitive)
    })
}
