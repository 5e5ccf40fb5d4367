//! Masked triangles: first all samples that could be seen, then the mask, then
//! depth.

use super::buffer::NOBODY;
use super::visibility::single;
use super::{Covering, Scratch, TileArea};
use crate::frame::FrameView;
use crate::shade::{Job, Work, mask_jobs};
use std::ops::Range;

/// Masked fragments are asked for in portions of about this many, to bound
/// memory.
const PORTION: usize = 4096;

/// Calls `visit` for each sample that a triangle covers in a rectangle of
/// pixels (columns and rows, ends excluded): pixel, sample and depth, block by
/// block, and all samples of a pixel one after another.
pub(crate) fn for_each_sample(
    frame: &FrameView<'_>,
    area: &TileArea,
    covering: &Covering,
    region: [Range<usize>; 2],
    mut visit: impl FnMut(usize, usize, f32),
) {
    let bounds = |[first, last]: [i32; 2], range: &Range<usize>| {
        (first as usize).max(range.start)..(last as usize + 1).min(range.end)
    };
    let (columns, rows) = (bounds(covering.columns, &region[0]), bounds(covering.rows, &region[1]));
    let offsets = frame.grid.pattern.offsets();
    for block in blocks_of(columns, rows) {
        let corner = [block[0].start / 8 * 8, block[1].start / 8 * 8].map(|v| v as i32);
        let [outside, inside] = covering.block_sides(corner);
        if outside {
            continue;
        }
        let [columns, rows] = block;
        for (y, x) in rows.flat_map(|y| columns.clone().map(move |x| (y, x))) {
            let pixel = [area.origin[0] + x as i32, area.origin[1] + y as i32];
            for (sample, offset) in offsets.iter().enumerate() {
                let point = [pixel[0] * 256 + offset[0], pixel[1] * 256 + offset[1]];
                if inside || covering.covers([x as i32, y as i32], sample, point) {
                    visit(TileArea::index_of([x, y]), sample, covering.depth.at(point));
                }
            }
        }
    }
}

/// The parts of a rectangle of pixels that lie in one block each.
fn blocks_of(columns: Range<usize>, rows: Range<usize>) -> impl Iterator<Item = [Range<usize>; 2]> {
    let cut = |range: Range<usize>| {
        (range.start / 8..range.end.div_ceil(8))
            .map(move |block| range.start.max(block * 8)..range.end.min(block * 8 + 8))
    };
    cut(rows).flat_map(move |rows| cut(columns.clone()).map(move |columns| [columns, rows.clone()]))
}

/// As [`for_each_sample`], only where nothing in the visibility buffer hides
/// the triangle `place`.
pub(crate) fn for_each_seen(
    frame: &FrameView<'_>,
    area: &TileArea,
    scratch: &Scratch,
    (place, region): (usize, [Range<usize>; 2]),
    mut visit: impl FnMut(usize, usize, f32),
) {
    let Some(covering) = single(frame, area, scratch.places[place]) else {
        return;
    };
    for_each_sample(frame, area, &covering, region, |pixel, sample, depth| {
        if is_seen(frame, scratch, (pixel, sample), depth, place) {
            visit(pixel, sample, depth);
        }
    });
}

/// Whether a triangle at this depth is seen in front of what is there.
#[inline]
fn is_seen(
    frame: &FrameView<'_>,
    scratch: &Scratch,
    (pixel, sample): (usize, usize),
    depth: f32,
    place: usize,
) -> bool {
    let index = scratch.buffer.index(pixel, sample);
    let there = scratch.buffer.depth[index];
    if depth != there {
        return depth > there;
    }
    match scratch.buffer.winner[index] {
        NOBODY => true,
        winner => frame.precedes(scratch.places[place], scratch.places[winner as usize]),
    }
}

/// A masked fragment that waits for the answer of its mask.
#[derive(Clone, Copy)]
pub(super) struct Waiting {
    pixel: u32,
    sample: u32,
    depth: f32,
    place: u32,
    /// Which answer is its own.
    answer: u32,
}

/// Lets the masked triangles among the tile's `places` compete.
pub(super) fn cover_masked(
    frame: &FrameView<'_>,
    area: &TileArea,
    scratch: &mut Scratch,
    places: Range<usize>,
) {
    let mut waiting = std::mem::take(&mut scratch.waiting);
    waiting.clear();
    let whole = area.size.map(|side| 0..side);
    let draw = |scratch: &Scratch, place: usize| frame.draw_of(scratch.places[place]);
    scratch.jobs.clear();
    scratch.work.clear();
    for place in places.clone() {
        let turns = place > places.start && draw(scratch, place) != draw(scratch, place - 1);
        if turns || waiting.len() > PORTION {
            settle(frame, area, scratch, &mut waiting);
        }
        let start = scratch.work.len();
        let mut work = std::mem::take(&mut scratch.work);
        for_each_seen(frame, area, scratch, (place, whole.clone()), |pixel, sample, depth| {
            let answer = work.len();
            match work[start..].last() {
                // The samples of a pixel come one after another.
                Some(last) if last.pixel() == pixel => {}
                _ => work.push(Work::anywhere(pixel, frame.is_multisampled(), answer)),
            }
            let answer = work.len() as u32 - 1;
            waiting.push(Waiting {
                pixel: pixel as u32,
                sample: sample as u32,
                depth,
                place: place as u32,
                answer,
            });
        });
        scratch.work = work;
        if scratch.work.len() > start {
            scratch.jobs.push(Job { place: place as u32, work: start..scratch.work.len() });
        }
    }
    settle(frame, area, scratch, &mut waiting);
    scratch.waiting = waiting;
}

/// Asks the mask of one draw about its waiting fragments and lets those that
/// exist compete.
fn settle(frame: &FrameView<'_>, area: &TileArea, scratch: &mut Scratch, waiting: &mut Vec<Waiting>) {
    if waiting.is_empty() {
        return;
    }
    scratch.kept.clear();
    scratch.kept.resize(scratch.work.len(), 0);
    let Scratch { shading, places, jobs, work, kept, .. } = scratch;
    mask_jobs(frame, area, shading, (places, jobs, work), kept);
    scratch.stats.samples_masked += scratch.work.len() as u64;
    for fragment in waiting.drain(..) {
        let at = (fragment.pixel as usize, fragment.sample as usize);
        let kept = scratch.kept[fragment.answer as usize] != 0;
        if kept && is_seen(frame, scratch, at, fragment.depth, fragment.place as usize) {
            let index = scratch.buffer.index(at.0, at.1);
            scratch.buffer.depth[index] = fragment.depth;
            scratch.buffer.winner[index] = fragment.place;
        }
    }
    scratch.jobs.clear();
    scratch.work.clear();
}
