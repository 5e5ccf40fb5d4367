//! Who is seen at each sample of a tile: opaque triangles, then masked ones.

use super::cover::{LANES, Lanes, STRIDE, TileArea, TileTriangle};
use super::scratch::{NOBODY, Scratch, Waiting};
use crate::frame::Frame;
use crate::shade::Span;

/// Masked fragments are asked for in portions of about this many, to bound
/// memory.
const MASK_PORTION: usize = 4096;

/// Finds the nearest opaque or masked triangle at every sample.
pub(crate) fn resolve_visibility(
    frame: &Frame<'_>,
    area: TileArea,
    scratch: &mut Scratch,
    bins: [&[u32]; 2],
) {
    scratch.depth.fill(0.0);
    scratch.winner.fill(NOBODY);
    scratch.triangles.clear();
    let [opaque, masked] = bins;
    scratch.triangles.extend_from_slice(opaque);
    scratch.triangles.extend_from_slice(masked);
    for place in 0..opaque.len() {
        cover_opaque(frame, area, scratch, place);
    }
    if !masked.is_empty() {
        cover_masked(frame, area, scratch, opaque.len());
    }
}

fn cover_opaque(frame: &Frame<'_>, area: TileArea, scratch: &mut Scratch, place: usize) {
    let triangle = &frame.triangles[scratch.triangles[place] as usize];
    let Some(tile_triangle) = TileTriangle::new(triangle, area, area.whole()) else {
        return;
    };
    let Scratch { depth, winner, triangles, .. } = scratch;
    tile_triangle.for_each_run(|lanes| {
        let first = lanes.y * STRIDE + lanes.x;
        let depth = &mut depth[first..first + LANES];
        let winner = &mut winner[first..first + LANES];
        if any_tie(&lanes, depth) {
            settle_ties(frame, triangles, &lanes, depth, winner, place as u32);
        }
        for lane in 0..LANES {
            let nearer = (lanes.sign[lane] >= 0) & (lanes.depth[lane] > depth[lane]);
            depth[lane] = if nearer { lanes.depth[lane] } else { depth[lane] };
            winner[lane] = if nearer { place as u32 } else { winner[lane] };
        }
    });
}

#[inline(always)]
fn any_tie(lanes: &Lanes, depth: &[f32]) -> bool {
    // Without short cuts, so that the lanes go in step.
    let ties = lanes.sign.iter().zip(&lanes.depth).zip(depth);
    ties.fold(0, |any, ((&sign, &ours), &theirs)| any | (u32::from(sign >= 0) & u32::from(ours == theirs)))
        != 0
}

/// Gives samples of equal depth to the smaller key.
#[cold]
fn settle_ties(
    frame: &Frame<'_>,
    triangles: &[u32],
    lanes: &Lanes,
    depth: &[f32],
    winner: &mut [u32],
    place: u32,
) {
    for lane in 0..LANES {
        if lanes.sign[lane] >= 0 && lanes.depth[lane] == depth[lane] {
            let ours = triangles[place as usize];
            if winner[lane] == NOBODY || frame.precedes(ours, triangles[winner[lane] as usize]) {
                winner[lane] = place;
            }
        }
    }
}

/// Whether a triangle at this depth is seen in front of what is there.
#[inline]
pub(crate) fn is_seen(frame: &Frame<'_>, scratch: &Scratch, sample: usize, depth: f32, ordinal: u32) -> bool {
    let there = scratch.depth[sample];
    if depth != there {
        return depth > there;
    }
    match scratch.winner[sample] {
        NOBODY => true,
        winner => frame.precedes(ordinal, scratch.triangles[winner as usize]),
    }
}

/// Masked triangles from place `first` on: first all samples that could be
/// seen, then the mask, then depth.
fn cover_masked(frame: &Frame<'_>, area: TileArea, scratch: &mut Scratch, first: usize) {
    let mut waiting = std::mem::take(&mut scratch.waiting);
    waiting.clear();
    let draw = |scratch: &Scratch, place: usize| frame.triangles[scratch.triangles[place] as usize].draw;
    for place in first..scratch.triangles.len() {
        if waiting.len() > MASK_PORTION || (place > first && draw(scratch, place) != draw(scratch, place - 1))
        {
            settle_masks(frame, area, scratch, &mut waiting);
        }
        let ordinal = scratch.triangles[place];
        let triangle = &frame.triangles[ordinal as usize];
        let Some(tile_triangle) = TileTriangle::new(triangle, area, area.whole()) else {
            continue;
        };
        tile_triangle.for_each_sample(|sample, depth| {
            if is_seen(frame, scratch, sample, depth, ordinal) {
                waiting.push(Waiting { sample: sample as u32, depth, triangle: place as u32 });
            }
        });
    }
    settle_masks(frame, area, scratch, &mut waiting);
    scratch.waiting = waiting;
}

/// Asks the mask of one draw about its waiting fragments and lets those that
/// exist compete.
fn settle_masks(frame: &Frame<'_>, area: TileArea, scratch: &mut Scratch, waiting: &mut Vec<Waiting>) {
    if waiting.is_empty() {
        return;
    }
    scratch.spans.clear();
    for (output, fragment) in waiting.iter().enumerate() {
        let ordinal = scratch.triangles[fragment.triangle as usize];
        let sample = fragment.sample as usize;
        Span::extend(&mut scratch.spans, ordinal, [sample % STRIDE, sample / STRIDE], output);
    }
    scratch.kept.clear();
    scratch.kept.resize(waiting.len(), false);
    frame.mask(area, &scratch.spans, &mut scratch.kept);
    scratch.stats.samples_masked += waiting.len() as u64;
    for (index, fragment) in waiting.drain(..).enumerate() {
        let sample = fragment.sample as usize;
        let ordinal = scratch.triangles[fragment.triangle as usize];
        if scratch.kept[index] && is_seen(frame, scratch, sample, fragment.depth, ordinal) {
            scratch.depth[sample] = fragment.depth;
            scratch.winner[sample] = fragment.triangle;
        }
    }
}
