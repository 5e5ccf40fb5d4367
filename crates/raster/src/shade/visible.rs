//! Which triangles of a tile are seen, and at which pixels.

use super::Work;
use super::shading::{EdgePixel, Run, Shading};
use super::task::{Fragment, Group};
use crate::bin::Place;
use crate::frame::FrameView;
use crate::samples::MAX_SAMPLES;
use crate::simd::{LANES, Mask, Simd, U32, prelude::*};
use crate::tile::{NOBODY, PIXELS, VisibilityBuffer};

/// Groups with fewer pixels than this that see anything share vectors with others.
const FULL: u32 = 4;

/// Lists what is visible in a tile: the triangles, and the pixels that they are
/// seen at. Tells how many fragments are to be shaded.
#[inline(always)]
pub(super) fn list<S: Simd>(
    simd: S,
    buffer: &VisibilityBuffer,
    places: usize,
    shading: &mut Shading,
) -> usize {
    let winners = buffer.winners();
    number(simd, winners, places, shading);
    shading.groups.clear();
    shading.fragments.clear();
    shading.parts.clear();
    shading.edge_pixels.clear();
    shading.sample_colors.clear();
    let mut pixels = 0;
    for (group, rows) in winners.chunks_exact(LANES * buffer.samples).enumerate() {
        let (first, others) = rows.split_at(LANES);
        let lanes = U32::from_slice(simd, first);
        let agree = others.chunks_exact(LANES).fold(
            Mask::splat(simd, true),
            #[inline(always)]
            |agree, row| agree & lanes.simd_eq(U32::from_slice(simd, row)),
        );
        let agree = agree.to_bitmask();
        let seen = !lanes.simd_eq(U32::splat(simd, NOBODY)).to_bitmask() & agree;
        pixels += seen.count_ones();
        if agree == 0xff && seen.count_ones() >= FULL {
            let slot = shading.slots[first[seen.trailing_zeros() as usize] as usize];
            shading.groups.push(Group { slot, number: group as u32 });
            continue;
        }
        push_lanes(shading, (group, first), seen);
        push_edges(shading, (group, rows), !agree & 0xff);
    }
    let needed = PIXELS + shading.parts.len();
    if shading.colors.len() < needed {
        shading.colors.resize(needed, [0.0; 4]);
    }
    pixels as usize + shading.parts.len()
}

/// Finds the triangles that are seen and numbers them in their order.
#[inline(always)]
fn number<S: Simd>(simd: S, winners: &[u32], places: usize, shading: &mut Shading) {
    let Shading { slots, seen, .. } = shading;
    slots.clear();
    // One more, for nobody.
    slots.resize(places + 1, 0);
    let mut last = U32::splat(simd, NOBODY);
    for row in winners.as_chunks::<LANES>().0 {
        let lanes = U32::simd_from(simd, *row);
        // As before: often with several samples, and within large triangles.
        if lanes.simd_eq(last).all_true() {
            continue;
        }
        let mut others = !lanes.simd_eq(last).to_bitmask() & 0xff;
        last = lanes;
        if others.count_ones() > 3 {
            for &winner in row {
                slots[(winner as usize).min(places)] = 1;
            }
            continue;
        }
        while others != 0 {
            slots[(row[others.trailing_zeros() as usize % LANES] as usize).min(places)] = 1;
            others &= others - 1;
        }
    }
    slots.truncate(places);
    seen.resize(places, 0);
    let mut count = 0;
    // Without branches that nobody can foresee: what is not seen is written over.
    for (place, slot) in slots.iter_mut().enumerate() {
        seen[count] = place as u32;
        count += std::mem::replace(slot, count as u32) as usize;
    }
    seen.truncate(count);
}

/// Lists some pixels of a group by themselves.
#[inline(always)]
fn push_lanes(shading: &mut Shading, (group, winners): (usize, &[u32]), mut lanes: u64) {
    while lanes != 0 {
        let lane = lanes.trailing_zeros() as usize % LANES;
        lanes &= lanes - 1;
        let pixel = group * LANES + lane;
        let slot = shading.slots[winners[lane] as usize];
        shading.fragments.push(Fragment { slot, work: Work::anywhere(pixel, false, pixel) });
    }
}

/// Lists pixels whose samples see different triangles: each triangle's colour gets
/// a place of its own, and the samples name theirs.
#[inline(always)]
fn push_edges(shading: &mut Shading, (group, rows): (usize, &[u32]), mut lanes: u64) {
    let Shading { slots, parts, edge_pixels, sample_colors, .. } = shading;
    let rows = rows.as_chunks::<LANES>().0;
    let mut names = [NOBODY; MAX_SAMPLES];
    let names = &mut names[..rows.len()];
    while lanes != 0 {
        let lane = lanes.trailing_zeros() as usize % LANES;
        lanes &= lanes - 1;
        let pixel = group * LANES + lane;
        edge_pixels.push(EdgePixel { pixel: pixel as u32, first: sample_colors.len() as u32 });
        for (sample, row) in rows.iter().enumerate() {
            let winner = row[lane];
            if sample > 0 && winner == rows[sample - 1][lane] {
                names[sample] = names[sample - 1];
                continue;
            }
            names[sample] = match rows[..sample].iter().position(|row| row[lane] == winner) {
                _ if winner == NOBODY => NOBODY,
                Some(before) => names[before],
                None => {
                    let place = PIXELS + parts.len();
                    let slot = slots[winner as usize];
                    parts.push(Fragment { slot, work: Work::anywhere(pixel, true, place) });
                    place as u32
                }
            };
        }
        sample_colors.extend_from_slice(names);
    }
}

/// Divides what was listed by draws.
pub(super) fn divide(
    frame: &FrameView<'_>,
    buffer: &VisibilityBuffer,
    places: &[Place],
    shading: &mut Shading,
) {
    let Shading { seen, runs, .. } = shading;
    runs.clear();
    let mut start = 0;
    while let Some(&first) = seen.get(start) {
        let draw = frame.draw_of(places[first as usize]);
        let ordinals = frame.plan.draws[draw].ordinals.end;
        let end = start + seen[start..].partition_point(|&place| places[place as usize].ordinal < ordinals);
        runs.push(Run { draw, slots: start..end, groups: 0..0, fragments: 0..0, parts: 0..0 });
        start = end;
    }
    if runs.len() > 1 {
        part_groups(buffer, shading);
        shading.groups.sort_unstable_by_key(|group| group.slot);
        shading.fragments.sort_unstable_by_key(|fragment| fragment.slot);
        shading.parts.sort_unstable_by_key(|fragment| fragment.slot);
    }
    let Shading { runs, groups, fragments, parts, .. } = shading;
    let (mut group, mut fragment, mut part) = (0, 0, 0);
    for run in runs {
        let end = run.slots.end as u32;
        run.groups = group..group + groups[group..].partition_point(|group| group.slot < end);
        run.fragments =
            fragment..fragment + fragments[fragment..].partition_point(|fragment| fragment.slot < end);
        run.parts = part..part + parts[part..].partition_point(|part| part.slot < end);
        (group, fragment, part) = (run.groups.end, run.fragments.end, run.parts.end);
    }
}

/// Takes groups apart that see several draws.
fn part_groups(buffer: &VisibilityBuffer, shading: &mut Shading) {
    let mut groups = std::mem::take(&mut shading.groups);
    groups.retain(|group| {
        let number = group.number as usize;
        let winners = &buffer.winners()[number * LANES * buffer.samples..][..LANES];
        let run = shading.runs.partition_point(|run| run.slots.end <= group.slot as usize);
        let slots = shading.runs[run].slots.clone();
        let belongs =
            |winner: u32| winner == NOBODY || slots.contains(&(shading.slots[winner as usize] as usize));
        let stays = winners.iter().all(|&winner| belongs(winner));
        if !stays {
            let seen =
                (0..LANES).filter(|&lane| winners[lane] != NOBODY).fold(0, |seen, lane| seen | 1 << lane);
            push_lanes(shading, (number, winners), seen);
        }
        stays
    });
    shading.groups = groups;
}
