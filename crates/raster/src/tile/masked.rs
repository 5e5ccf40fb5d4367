//! Masked triangles: first all samples where the triangle would be visible are collected, then the
//! mask is evaluated, then depth is tested again.

use super::TileState;
use super::blocks::Blocks;
use super::depth_query::{Candidate, TileView};
use super::single::single;
use crate::fragments::{Job, ShadePoint};
use crate::shade::{JobList, Shading, mask_jobs};
use crate::simd::{LANES, Simd, at_level, prelude::*};
use crate::tile_buffer::{NO_TRIANGLE, TileArea};
use crate::view::FrameView;
use crate::{BlendMode, Stats};
use std::ops::Range;

/// Masks are evaluated for portions of about this many fragments, to bound memory.
const PORTION: usize = 4096;

/// A masked fragment at a sample, whose mask is not evaluated yet.
#[derive(Clone, Copy)]
struct Waiting {
    /// Index of the sample in the buffer.
    index: u32,
    depth: f32,
    place: u32,
    /// The index of its mask evaluation.
    evaluation: u32,
}

/// Masked fragments of one draw that wait for their masks.
#[derive(Default)]
pub(crate) struct MaskQueue {
    waiting: Vec<Waiting>,
    jobs: Vec<Job>,
    points: Vec<ShadePoint>,
    kept: Vec<u8>,
}

/// Draws the masked triangles of a tile: a range of those that are listed.
pub(super) fn cover_masked(
    frame: &FrameView<'_>,
    area: &TileArea,
    state: &mut TileState,
    range: Range<usize>,
    shading: &mut Shading,
    stats: &mut Stats,
) {
    let mut queue = std::mem::take(&mut state.mask_queue);
    for place in range.clone() {
        let draw = |place: usize| frame.draw_of(state.triangles[place]);
        let turns = place > range.start && draw(place) != draw(place - 1);
        if turns || queue.waiting.len() > PORTION {
            stats.samples_masked += queue.evaluate(frame, area, state, shading);
        }
        let view = state.view(frame, area);
        at_level!(frame.token, simd => queue.collect(simd, view, place));
    }
    stats.samples_masked += queue.evaluate(frame, area, state, shading);
    state.mask_queue = queue;
}

impl MaskQueue {
    /// Adds the fragments of a triangle at all samples where nothing hides it.
    #[inline(always)]
    fn collect<S: Simd>(&mut self, simd: S, view: TileView<'_>, place: usize) {
        let Some(covering) = single(view.frame, view.area, view.triangles[place]) else {
            return;
        };
        let draw = &view.frame.plan.draws[view.frame.draw_of(view.triangles[place])];
        let per_sample = view.frame.pass[draw.draw].geometry.blend_mode == BlendMode::MaskedPerSample;
        let multisampled = view.frame.is_multisampled();
        let Self { waiting, jobs, points, .. } = self;
        let start = points.len();
        let candidate = Candidate { covering: &covering, place: place as u32 };
        let (mut group, mut kept) = (usize::MAX, [NO_TRIANGLE; LANES]);
        view.for_each_seen(
            simd,
            candidate,
            Blocks::ALL,
            #[inline(always)]
            |samples, seen, depth| {
                if samples.group != group {
                    (group, kept) = (samples.group, [NO_TRIANGLE; LANES]);
                }
                let (seen, depth): (_, [f32; LANES]) = (seen.to_bitmask(), depth.into());
                for lane in (0..LANES).filter(|lane| seen >> lane & 1 != 0) {
                    let pixel = samples.pixel(lane);
                    if per_sample || kept[lane] == NO_TRIANGLE {
                        kept[lane] = points.len() as u32;
                        points.push(match per_sample {
                            true => ShadePoint::at_sample(pixel, samples.sample, points.len()),
                            false => ShadePoint::anywhere(pixel, multisampled, points.len()),
                        });
                    }
                    let index = view.buffer.index(pixel, samples.sample) as u32;
                    let (place, evaluation) = (place as u32, kept[lane]);
                    waiting.push(Waiting { index, depth: depth[lane], place, evaluation });
                }
            },
        );
        if points.len() > start {
            jobs.push(Job { place: place as u32, points: start..points.len() });
        }
    }

    /// Evaluates the masks of the waiting fragments and tests the depth of those that the masks keep.
    /// Returns the number of evaluations.
    fn evaluate(
        &mut self,
        frame: &FrameView<'_>,
        area: &TileArea,
        state: &mut TileState,
        shading: &mut Shading,
    ) -> u64 {
        let Self { waiting, jobs, points, kept } = self;
        let evaluations = points.len();
        kept.clear();
        kept.resize(evaluations, 0);
        mask_jobs(frame, area, shading, JobList { triangles: &state.triangles, jobs, points }, kept);
        for fragment in waiting.drain(..).filter(|fragment| kept[fragment.evaluation as usize] != 0) {
            let (index, depth) = (fragment.index as usize, fragment.depth);
            if state.view(frame, area).is_seen(index, depth, fragment.place) {
                state.buffer.depth[index] = depth;
                state.buffer.visible[index] = fragment.place;
            }
        }
        jobs.clear();
        points.clear();
        evaluations as u64
    }
}
