//! Masked triangles: first all samples where the triangle would be visible are collected, then the
//! mask is evaluated, then depth is tested again.

use super::TileState;
use super::depth_query::{Blocks, Candidate, TileView};
use super::triangle::single;
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
struct WaitingFragment {
    /// Index of the sample in the buffer.
    sample: u32,
    depth: f32,
    triangle: u32,
    /// The index of its mask evaluation.
    evaluation: u32,
}

/// Masked fragments of one draw that wait for their masks.
#[derive(Default)]
pub(crate) struct MaskQueue {
    waiting: Vec<WaitingFragment>,
    jobs: Vec<Job>,
    points: Vec<ShadePoint>,
    passed: Vec<u8>,
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
    for triangle in range.clone() {
        let draw = |triangle: usize| frame.draw_of(state.triangles[triangle]);
        let turns = triangle > range.start && draw(triangle) != draw(triangle - 1);
        if turns || queue.waiting.len() > PORTION {
            stats.samples_masked += queue.evaluate(frame, area, state, shading);
        }
        let view = state.view(frame, area);
        at_level!(frame.token, simd => queue.collect(simd, view, triangle));
    }
    stats.samples_masked += queue.evaluate(frame, area, state, shading);
    state.mask_queue = queue;
}

impl MaskQueue {
    /// Adds the fragments of a triangle at all samples where nothing hides it.
    #[inline(always)]
    fn collect<S: Simd>(&mut self, simd: S, view: TileView<'_>, triangle: usize) {
        let Some(covering) = single(view.frame, view.area, view.triangles[triangle]) else {
            return;
        };
        let draw = &view.frame.plan.draws[view.frame.draw_of(view.triangles[triangle])];
        let per_sample = view.frame.pass[draw.draw()].geometry.blend_mode == BlendMode::MaskedPerSample;
        let multisampled = view.frame.is_multisampled();
        let Self { waiting, jobs, points, .. } = self;
        let start = points.len();
        let candidate = Candidate { covering: &covering, triangle: triangle as u32 };
        let (mut group, mut evaluations) = (usize::MAX, [NO_TRIANGLE; LANES]);
        view.for_each_visible(
            simd,
            candidate,
            Blocks::ALL,
            #[inline(always)]
            |samples, visible, depth| {
                if samples.group != group {
                    (group, evaluations) = (samples.group, [NO_TRIANGLE; LANES]);
                }
                let (visible, depth): (_, [f32; LANES]) = (visible.to_bitmask(), depth.into());
                for lane in (0..LANES).filter(|lane| visible >> lane & 1 != 0) {
                    let pixel = samples.pixel(lane);
                    if per_sample || evaluations[lane] == NO_TRIANGLE {
                        evaluations[lane] = points.len() as u32;
                        points.push(match per_sample {
                            true => ShadePoint::at_sample(pixel, samples.sample, points.len()),
                            false => ShadePoint::anywhere(pixel, multisampled, points.len()),
                        });
                    }
                    let sample = view.buffer.index(pixel, samples.sample) as u32;
                    let (triangle, evaluation) = (triangle as u32, evaluations[lane]);
                    waiting.push(WaitingFragment { sample, depth: depth[lane], triangle, evaluation });
                }
            },
        );
        if points.len() > start {
            jobs.push(Job { triangle: triangle as u32, points: start..points.len() });
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
        let Self { waiting, jobs, points, passed } = self;
        let evaluations = points.len();
        passed.clear();
        passed.resize(evaluations, 0);
        mask_jobs(frame, area, shading, JobList { triangles: &state.triangles, jobs, points }, passed);
        for fragment in waiting.drain(..).filter(|fragment| passed[fragment.evaluation as usize] != 0) {
            let (index, depth) = (fragment.sample as usize, fragment.depth);
            if state.view(frame, area).is_visible(index, depth, fragment.triangle) {
                state.buffer.depth[index] = depth;
                state.buffer.visible[index] = fragment.triangle;
            }
        }
        jobs.clear();
        points.clear();
        evaluations as u64
    }
}
