//! Translucent fragments: gathered, ordered by (depth, object, face) at each
//! sample, and laid over what is there from back to front.
//!
//! The order is total, so it depends neither on the order of draws nor on
//! threads. A band of eight rows is done at a time, and where layers are very
//! many a part of one, to bound the memory that they take: a sample's layers
//! are never parted, so the result does not depend on it.

use crate::frame::Frame;
use crate::resolve::saturated;
use crate::setup::Kind;
use crate::shade::Span;
use crate::tile::{Region, STRIDE, Scratch, TileArea, TileTriangle, Waiting, is_seen};
use std::cmp::Ordering;
use trigon_math::Vec4;

const BAND: usize = 8;

/// Beyond this many fragments at a time a region is done in parts: a few
/// megabytes, and 512 layers over a whole band.
const MOST_WAITING: usize = 1 << 18;

/// An end of a translucent segment at the sample that is blended: its draw, its
/// vertex, and the segment.
pub(crate) type Joint = [u32; 3];

/// Lays the translucent triangles of a tile over its colours.
pub(crate) fn blend_translucent(frame: &Frame<'_>, area: TileArea, scratch: &mut Scratch, bin: &[u32]) {
    let whole = area.whole();
    let last = whole.rows[1];
    for first in (0..=last).step_by(BAND) {
        let rows = [first, last.min(first + BAND - 1)];
        blend_region(frame, area, scratch, (bin, Region { rows, ..whole }));
    }
}

fn blend_region(frame: &Frame<'_>, area: TileArea, scratch: &mut Scratch, (bin, region): (&[u32], Region)) {
    let mut waiting = std::mem::take(&mut scratch.waiting);
    let complete = gather(frame, area, scratch, (bin, region), &mut waiting);
    if complete && !waiting.is_empty() {
        shade(frame, area, scratch, &waiting);
        sort(frame, scratch, &waiting);
        lay_over(frame, scratch, &waiting);
    }
    scratch.waiting = waiting;
    if !complete {
        for half in region.halves().into_iter().flatten() {
            blend_region(frame, area, scratch, (bin, half));
        }
    }
}

/// The fragments that nothing opaque hides. False if they are too many to be
/// done at once, and the region can be halved.
fn gather(
    frame: &Frame<'_>,
    area: TileArea,
    scratch: &mut Scratch,
    (bin, region): (&[u32], Region),
    waiting: &mut Vec<Waiting>,
) -> bool {
    let most = if region.halves().is_some() { MOST_WAITING } else { usize::MAX };
    waiting.clear();
    scratch.spans.clear();
    let mut spans = std::mem::take(&mut scratch.spans);
    for &ordinal in bin {
        if waiting.len() > most {
            break;
        }
        let Some(tile_triangle) = TileTriangle::new(&frame.triangles[ordinal as usize], area, region) else {
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
    waiting.len() <= most
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
    let Scratch { order, color, waiting_color, joints, .. } = scratch;
    for layers in order.chunk_by(|&a, &b| waiting[a as usize].sample == waiting[b as usize].sample) {
        let color = &mut color[waiting[layers[0] as usize].sample as usize];
        collect_joints(frame, waiting, layers, joints);
        for &layer in layers {
            if leaves_joint(frame, joints, waiting[layer as usize].triangle) {
                continue;
            }
            let source = waiting_color[layer as usize];
            *color = saturated(source + *color * (1.0 - source.w));
        }
    }
}

/// The ends of all segments at a sample, in order.
fn collect_joints(frame: &Frame<'_>, waiting: &[Waiting], layers: &[u32], joints: &mut Vec<Joint>) {
    joints.clear();
    for &layer in layers {
        joints.extend(joints_of(frame, waiting[layer as usize].triangle).into_iter().flatten());
    }
    joints.sort_unstable();
}

/// The two ends of a line's triangle.
fn joints_of(frame: &Frame<'_>, ordinal: u32) -> Option<[Joint; 2]> {
    let triangle = &frame.triangles[ordinal as usize];
    let ends = || {
        let [from, to, _] = frame.geometry(triangle).corners(triangle.primitive);
        [from, to].map(|vertex| [triangle.draw, vertex, triangle.primitive])
    };
    (triangle.kind == Kind::Line).then(ends)
}

/// Whether a triangle is of a segment that leaves this sample to a later one of
/// the same draw that it is joined to.
fn leaves_joint(frame: &Frame<'_>, joints: &[Joint], ordinal: u32) -> bool {
    joints_of(frame, ordinal).into_iter().flatten().any(|[draw, vertex, primitive]| {
        // The last that meets in this vertex; the segment itself is among them.
        let after = joints.partition_point(|joint| *joint <= [draw, vertex, u32::MAX]);
        joints[after - 1][2] > primitive
    })
}
