//! Translucent fragments: gathered, ordered by (depth, object, face) at each
//! sample, and laid over what is there from back to front.
//!
//! The order is total, so it depends neither on the order of draws nor on
//! threads. A band of eight rows is done at a time, and where layers are very
//! many a part of one, to bound the memory that they take: a sample's layers
//! are never parted, so the result does not depend on it.
//!
//! With several samples a fragment is shaded once for its triangle and pixel,
//! like an opaque one, and laid over each sample that it covers and that nothing
//! hides; it stores no depth and no ids.

mod joints;
mod samples;

pub(crate) use joints::Joints;

use crate::bin::Place;
use crate::frame::FrameView;
use crate::resolve::saturated;
use crate::shade::{Job, ShadeOutput, Work, shade_jobs};
use crate::tile::{Scratch, TileArea, for_each_seen};
use std::cmp::Ordering;
use std::ops::Range;
use trigon_math::Vec4;

const BAND: usize = 8;

/// Beyond this many fragments at a time a region is done in parts: a few
/// megabytes, and 512 layers over a whole band.
const MOST_WAITING: usize = 1 << 18;

/// A fragment that waits for its turn at one sample.
#[derive(Clone, Copy)]
struct Waiting {
    /// Index of the sample in the tile's buffer.
    sample: u32,
    depth: f32,
    place: u32,
    /// Which colour it has.
    color: u32,
}

/// What blending keeps from tile to tile.
#[derive(Default)]
pub(crate) struct Layers {
    waiting: Vec<Waiting>,
    order: Vec<u32>,
    jobs: Vec<Job>,
    work: Vec<Work>,
    colors: Vec<[f32; 4]>,
    joints: Joints,
}

/// A rectangle of pixels of a tile: columns and rows, ends excluded.
type Region = [Range<usize>; 2];

/// Lays the translucent triangles of a tile over its colours.
pub(crate) fn blend_translucent(
    frame: &FrameView<'_>,
    area: &TileArea,
    scratch: &mut Scratch,
    places: Range<usize>,
) {
    samples::expand(frame, area, scratch);
    let mut layers = std::mem::take(&mut scratch.layers);
    for first in (0..area.size[1]).step_by(BAND) {
        let rows = first..area.size[1].min(first + BAND);
        blend_region(frame, area, scratch, &mut layers, (places.clone(), [0..area.size[0], rows]));
    }
    scratch.layers = layers;
    samples::collapse(frame, scratch);
}

fn blend_region(
    frame: &FrameView<'_>,
    area: &TileArea,
    scratch: &mut Scratch,
    layers: &mut Layers,
    (places, region): (Range<usize>, Region),
) {
    if gather(frame, area, scratch, layers, (places.clone(), region.clone())) {
        if !layers.waiting.is_empty() {
            shade(frame, area, scratch, layers);
            scratch.stats.pixels_shaded += layers.work.len() as u64;
            sort(frame, &scratch.places, layers);
            lay_over(frame, &scratch.places, layers, &mut scratch.samples);
        }
        return;
    }
    for half in halves(region).into_iter().flatten() {
        blend_region(frame, area, scratch, layers, (places.clone(), half));
    }
}

/// Both halves, one above or beside the other; `None` if there is only one
/// pixel.
fn halves([columns, rows]: Region) -> Option<[Region; 2]> {
    let cut = |range: &Range<usize>| {
        let middle = range.start + range.len() / 2;
        [range.start..middle, middle..range.end]
    };
    if rows.len() > 1 {
        Some(cut(&rows).map(|rows| [columns.clone(), rows]))
    } else if columns.len() > 1 {
        Some(cut(&columns).map(|columns| [columns, rows.clone()]))
    } else {
        None
    }
}

/// The fragments that nothing opaque hides. False if they are too many to be
/// done at once, and the region can be halved.
fn gather(
    frame: &FrameView<'_>,
    area: &TileArea,
    scratch: &Scratch,
    layers: &mut Layers,
    (places, region): (Range<usize>, Region),
) -> bool {
    let most = if halves(region.clone()).is_some() { MOST_WAITING } else { usize::MAX };
    let Layers { waiting, jobs, work, .. } = layers;
    waiting.clear();
    jobs.clear();
    work.clear();
    for place in places {
        if waiting.len() > most {
            return false;
        }
        let start = work.len();
        for_each_seen(frame, area, scratch, (place, region.clone()), |pixel, sample, depth| {
            // The samples of a pixel come one after another.
            if work[start..].last().is_none_or(|last: &Work| last.pixel() != pixel) {
                work.push(Work::anywhere(pixel, frame.is_multisampled(), work.len()));
            }
            let sample = scratch.buffer.index(pixel, sample) as u32;
            waiting.push(Waiting { sample, depth, place: place as u32, color: work.len() as u32 - 1 });
        });
        if work.len() > start {
            jobs.push(Job { place: place as u32, work: start..work.len() });
        }
    }
    waiting.len() <= most
}

fn shade(frame: &FrameView<'_>, area: &TileArea, scratch: &mut Scratch, layers: &mut Layers) {
    let Scratch { shading, places, .. } = scratch;
    layers.colors.clear();
    layers.colors.resize(layers.work.len(), [0.0; 4]);
    let mut output = ShadeOutput::Colors(&mut layers.colors);
    shade_jobs(frame, area, shading, (places, &layers.jobs, &layers.work), &mut output);
}

/// By sample, then from back to front.
fn sort(frame: &FrameView<'_>, places: &[Place], layers: &mut Layers) {
    let Layers { waiting, order, .. } = layers;
    order.clear();
    order.extend(0..waiting.len() as u32);
    order.sort_unstable_by(|&a, &b| {
        let (a, b) = (&waiting[a as usize], &waiting[b as usize]);
        let depth = || a.depth.partial_cmp(&b.depth).unwrap_or(Ordering::Equal);
        // Of equal depths the smaller key is in front, so later.
        let key = || frame.compare(places[b.place as usize], places[a.place as usize]);
        a.sample.cmp(&b.sample).then_with(depth).then_with(key)
    });
}

fn lay_over(frame: &FrameView<'_>, places: &[Place], layers: &mut Layers, samples: &mut [Vec4]) {
    let Layers { waiting, order, colors, joints, .. } = layers;
    let place = |layer: u32| places[waiting[layer as usize].place as usize];
    for at_sample in order.chunk_by(|&a, &b| waiting[a as usize].sample == waiting[b as usize].sample) {
        let color = &mut samples[waiting[at_sample[0] as usize].sample as usize];
        joints.collect(frame, at_sample.iter().map(|&layer| place(layer)));
        for &layer in at_sample {
            if joints.leaves(frame, place(layer)) {
                continue;
            }
            let source = Vec4::from_array(colors[waiting[layer as usize].color as usize]);
            *color = saturated(source + *color * (1.0 - source.w));
        }
    }
}
