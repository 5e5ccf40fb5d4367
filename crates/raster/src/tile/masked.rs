//! Masked triangles: first all samples that could be seen, then the mask, then
//! depth.

use super::blocks::Blocks;
use super::buffer::{NOBODY, VisibilityBuffer};
use super::seen::{Candidate, TileView};
use super::single::single;
use super::ties::Ties;
use super::{TileArea, TileState};
use crate::bin::Place;
use crate::frame::FrameView;
use crate::shade::{Job, Shading, Work, mask_jobs};
use crate::simd::{LANES, Simd, at_level, prelude::*};
use crate::{Stats, Surface};
use std::ops::Range;

/// Masked fragments are asked for in portions of about this many, to bound
/// memory.
const PORTION: usize = 4096;

/// A masked fragment at a sample, which waits for the answer of its mask.
#[derive(Clone, Copy)]
struct Waiting {
    /// Index of the sample in the buffer.
    index: u32,
    depth: f32,
    place: u32,
    /// Which answer is its own.
    answer: u32,
}

/// Masked fragments of one draw, and what their mask is asked.
#[derive(Default)]
pub(crate) struct Questions {
    waiting: Vec<Waiting>,
    jobs: Vec<Job>,
    work: Vec<Work>,
    answers: Vec<u8>,
}

/// Lets the masked triangles among the tile's `places` compete.
pub(super) fn cover_masked(
    frame: &FrameView<'_>,
    area: &TileArea,
    state: &mut TileState,
    range: Range<usize>,
    (shading, stats): (&mut Shading, &mut Stats),
) {
    let TileState { buffer, places, ties, questions, .. } = state;
    let draw = |place: usize| frame.draw_of(places[place]);
    for place in range.clone() {
        let turns = place > range.start && draw(place) != draw(place - 1);
        if turns || questions.waiting.len() > PORTION {
            stats.samples_masked += questions.settle(frame, area, (places, ties, buffer), shading);
        }
        let view = TileView { frame, area, buffer, places, ties };
        at_level!(frame.token, simd => questions.collect(simd, view, place));
    }
    stats.samples_masked += questions.settle(frame, area, (places, ties, buffer), shading);
}

impl Questions {
    /// Asks about a triangle wherever nothing hides it.
    #[inline(always)]
    fn collect<S: Simd>(&mut self, simd: S, view: TileView<'_>, place: usize) {
        let Some(covering) = single(view.frame, view.area, view.places[place]) else {
            return;
        };
        let draw = &view.frame.plan.draws[view.frame.draw_of(view.places[place])];
        let per_sample = view.frame.pass[draw.draw].geometry.surface == Surface::MaskedPerSample;
        let multisampled = view.frame.is_multisampled();
        let Self { waiting, jobs, work, .. } = self;
        let start = work.len();
        let candidate = Candidate { covering: &covering, place: place as u32 };
        let (mut group, mut answers) = (usize::MAX, [NOBODY; LANES]);
        view.for_each_seen(
            simd,
            candidate,
            Blocks::ALL,
            #[inline(always)]
            |samples, seen, depth| {
                if samples.group != group {
                    (group, answers) = (samples.group, [NOBODY; LANES]);
                }
                let (seen, depth): (_, [f32; LANES]) = (seen.to_bitmask(), depth.into());
                for lane in (0..LANES).filter(|lane| seen >> lane & 1 != 0) {
                    let pixel = samples.pixel(lane);
                    if per_sample || answers[lane] == NOBODY {
                        answers[lane] = work.len() as u32;
                        work.push(match per_sample {
                            true => Work::at_sample(pixel, samples.sample, work.len()),
                            false => Work::anywhere(pixel, multisampled, work.len()),
                        });
                    }
                    let index = view.buffer.index(pixel, samples.sample) as u32;
                    let (place, answer) = (place as u32, answers[lane]);
                    waiting.push(Waiting { index, depth: depth[lane], place, answer });
                }
            },
        );
        if work.len() > start {
            jobs.push(Job { place: place as u32, work: start..work.len() });
        }
    }

    /// Asks the mask about the waiting fragments and lets those that exist
    /// compete; how often it was asked.
    fn settle(
        &mut self,
        frame: &FrameView<'_>,
        area: &TileArea,
        (places, ties, buffer): (&[Place], &Ties, &mut VisibilityBuffer),
        shading: &mut Shading,
    ) -> u64 {
        let Self { waiting, jobs, work, answers } = self;
        let asked = work.len();
        answers.clear();
        answers.resize(asked, 0);
        mask_jobs(frame, area, shading, (places, jobs, work), answers);
        for fragment in waiting.drain(..).filter(|fragment| answers[fragment.answer as usize] != 0) {
            let (index, depth) = (fragment.index as usize, fragment.depth);
            let view = TileView { frame, area, buffer, places, ties };
            if view.is_seen(index, depth, fragment.place) {
                buffer.depth[index] = depth;
                buffer.winner[index] = fragment.place;
            }
        }
        jobs.clear();
        work.clear();
        asked as u64
    }
}
