//! Which pixels each triangle of a tile is seen at.

use super::{Encoding, Job, ShadeContext, ShadeOutput, Work};
use crate::frame::FrameView;
use crate::simd::LANES;
use crate::tile::{EdgePixel, NOBODY, PIXELS, Scratch, TileArea};

/// Shades every visible pixel of a tile once, straight to bytes.
pub(crate) fn shade_to_codes(
    frame: &FrameView<'_>,
    area: &TileArea,
    scratch: &mut Scratch,
    encoding: Encoding,
) {
    if frame.plan.is_flat {
        return shade_flat(frame, area, scratch, encoding);
    }
    scratch.stats.pixels_shaded += list_pixels(scratch) as u64;
    let Scratch { codes, places, jobs, work, .. } = scratch;
    let mut output = ShadeOutput::Codes(codes, encoding);
    shade_jobs(frame, area, (places, jobs, work), &mut output);
}

/// Shades every visible triangle of a tile once, and gives its colour to all of
/// its pixels.
fn shade_flat(frame: &FrameView<'_>, area: &TileArea, scratch: &mut Scratch, encoding: Encoding) {
    let Scratch { buffer, counts, jobs, work, places, place_codes, codes, .. } = scratch;
    let winners = &buffer.winner[..buffer.span()];
    // The first pixel of each triangle that is seen.
    counts.clear();
    counts.resize(places.len(), NOBODY);
    for (pixel, &winner) in winners.iter().enumerate() {
        if winner != NOBODY && counts[winner as usize] == NOBODY {
            counts[winner as usize] = pixel as u32;
        }
    }
    jobs.clear();
    work.clear();
    for (place, &pixel) in counts.iter().enumerate().filter(|&(_, &pixel)| pixel != NOBODY) {
        jobs.push(Job { place: place as u32, work: work.len()..work.len() + 1 });
        work.push(Work::anywhere(pixel as usize, false, place));
    }
    if place_codes.len() < places.len() {
        place_codes.resize(places.len(), 0);
    }
    shade_jobs(frame, area, (places, jobs, work), &mut ShadeOutput::Codes(place_codes, encoding));
    for (code, &winner) in codes.iter_mut().zip(winners) {
        if winner != NOBODY {
            *code = place_codes[winner as usize];
        }
    }
    scratch.stats.pixels_shaded += work.len() as u64;
}

/// Shades every visible triangle once at every pixel of a tile, in linear
/// light.
pub(crate) fn shade_to_colors(frame: &FrameView<'_>, area: &TileArea, scratch: &mut Scratch) {
    let fragments = if frame.is_multisampled() { list_samples(scratch) } else { list_pixels(scratch) };
    scratch.stats.pixels_shaded += fragments as u64;
    let Scratch { colors, places, jobs, work, .. } = scratch;
    shade_jobs(frame, area, (places, jobs, work), &mut ShadeOutput::Colors(colors));
}

/// Shades jobs in the order of their draws.
pub(crate) fn shade_jobs(
    frame: &FrameView<'_>,
    area: &TileArea,
    (places, jobs, work): (&[crate::bin::Place], &[Job], &[Work]),
    output: &mut ShadeOutput<'_>,
) {
    let draw = |job: &Job| frame.draw_of(places[job.place as usize]);
    let mut rest = jobs;
    while let Some(first) = rest.first() {
        let draw_number = draw(first);
        let end = frame.plan.draws[draw_number].ordinals.end;
        let count = rest.partition_point(|job| places[job.place as usize].ordinal < end);
        let (run, after) = rest.split_at(count);
        let context = ShadeContext { frame, area: *area, places, draw: draw_number };
        frame.pipeline(draw_number).shade(frame.token, &context, run, work, output);
        rest = after;
    }
}

/// With one sample: a pixel's colour goes to the pixel's place. Sorted by
/// triangle, by counting.
fn list_pixels(scratch: &mut Scratch) -> usize {
    let Scratch { buffer, counts, jobs, work, places, .. } = scratch;
    let winners = &buffer.winner[..buffer.span()];
    counts.clear();
    counts.resize(places.len(), 0);
    for group in winners.chunks_exact(LANES) {
        let first = group[0];
        if group.iter().all(|&winner| winner == first) {
            if first != NOBODY {
                counts[first as usize] += LANES as u32;
            }
            continue;
        }
        for &winner in group.iter().filter(|&&winner| winner != NOBODY) {
            counts[winner as usize] += 1;
        }
    }
    let total = make_jobs(counts, jobs);
    if work.len() < total {
        work.resize(total, Work::default());
    }
    for (pixel, &winner) in winners.iter().enumerate() {
        if winner != NOBODY {
            let next = &mut counts[winner as usize];
            work[*next as usize] = Work::anywhere(pixel, false, pixel);
            *next += 1;
        }
    }
    total
}

/// Turns the counts of the triangles' pixels into the places where each
/// triangle's begin.
fn make_jobs(counts: &mut [u32], jobs: &mut Vec<Job>) -> usize {
    jobs.clear();
    let mut start = 0;
    for (place, count) in counts.iter_mut().enumerate() {
        if *count > 0 {
            let end = start + *count as usize;
            jobs.push(Job { place: place as u32, work: start..end });
            *count = start as u32;
            start = end;
        }
    }
    start
}

/// With several samples: where all see one triangle, its colour goes to the
/// pixel's place; else each triangle's has a place of its own, and an edge pixel
/// names those of its samples.
fn list_samples(scratch: &mut Scratch) -> usize {
    let Scratch { buffer, counts, jobs, work, places, edge_pixels, sample_colors, colors, .. } = scratch;
    edge_pixels.clear();
    sample_colors.clear();
    counts.clear();
    counts.resize(places.len(), 0);
    let samples = buffer.samples;
    let mut fragments = 0;
    // First each fragment in the order of the pixels, then sorted.
    let mut unsorted = std::mem::take(&mut scratch.fragments);
    unsorted.clear();
    let groups = buffer.winner[..buffer.span() * samples].chunks_exact(samples * LANES);
    for (group, winners) in groups.enumerate() {
        if winners.iter().all(|&winner| winner == NOBODY) {
            continue;
        }
        let agree = winners.chunks_exact(LANES).all(|row| row == &winners[..LANES]);
        for lane in 0..LANES {
            let pixel = group * LANES + lane;
            let winner = |sample: usize| winners[sample * LANES + lane];
            let seen = winner(0);
            if agree || (1..samples).all(|sample| winner(sample) == seen) {
                if seen != NOBODY {
                    counts[seen as usize] += 1;
                    unsorted.push((seen, Work::anywhere(pixel, false, pixel)));
                }
                continue;
            }
            let start = sample_colors.len();
            edge_pixels.push(EdgePixel { pixel: pixel as u32, first: start as u32 });
            for sample in 0..samples {
                let seen = winner(sample);
                let before = (0..sample).find(|&before| winner(before) == seen);
                let color = match before {
                    _ if seen == NOBODY => NOBODY,
                    Some(before) => sample_colors[start + before],
                    None => {
                        let place = PIXELS + fragments;
                        fragments += 1;
                        counts[seen as usize] += 1;
                        unsorted.push((seen, Work::anywhere(pixel, true, place)));
                        place as u32
                    }
                };
                sample_colors.push(color);
            }
        }
    }
    if colors.len() < PIXELS + fragments {
        colors.resize(PIXELS + fragments, [0.0; 4]);
    }
    let total = make_jobs(counts, jobs);
    if work.len() < total {
        work.resize(total, Work::default());
    }
    for &(winner, item) in &unsorted {
        let next = &mut counts[winner as usize];
        work[*next as usize] = item;
        *next += 1;
    }
    scratch.fragments = unsorted;
    total
}
