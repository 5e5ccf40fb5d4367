//! Which triangles of a tile are seen, and at which pixels.

use super::Work;
use super::edges::push_edges;
use super::shading::{EmptyGroup, Run, Shading};
use super::task::{Fragment, Group};
use crate::bin::Place;
use crate::frame::FrameView;
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
    shading.empty_groups.clear();
    shading.edge_groups.clear();
    shading.sample_colors.clear();
    shading.part_colors = 0;
    let mut pixels = 0;
    for (group, rows) in winners.chunks_exact(LANES * buffer.samples).enumerate() {
        let (first, others) = rows.split_at(LANES);
        let lanes = U32::from_slice(simd, first);
        let agree = others.chunks_exact(LANES).fold(
            Mask::splat(simd, true),
            #[inline(always)]
            |agree, row| agree & lanes.simd_eq(U32::from_slice(simd, row)),
        );
        let edges = !agree.to_bitmask() & 0xff;
        let empty = lanes.simd_eq(U32::splat(simd, NOBODY)).to_bitmask();
        if empty != 0 {
            shading.empty_groups.push(EmptyGroup { number: group as u32, lanes: empty as u32 });
        }
        let seen = !empty & 0xff;
        pixels += seen.count_ones();
        if seen.count_ones() >= FULL {
            let slot = shading.slots[first[seen.trailing_zeros() as usize] as usize];
            let group =
                Group { slot, number: group as u32, lanes: seen as u32, edges: (seen & edges) as u32 };
            shading.groups.push(group);
        } else {
            push_lanes(shading, (group, first), [seen & !edges, seen & edges]);
        }
        if edges != 0 {
            push_edges(simd, shading, (group, rows), edges);
        }
    }
    let needed = PIXELS + shading.part_colors;
    if shading.colors.len() < needed {
        shading.colors.resize(needed, [0.0; 4]);
    }
    pixels as usize + shading.part_colors
}

/// Finds the triangles that are seen and numbers them in their order.
#[inline(always)]
fn number<S: Simd>(simd: S, winners: &[u32], places: usize, shading: &mut Shading) {
    let Shading { slots, seen, .. } = shading;
    slots.clear();
    // One more, for nobody.
    slots.resize(places + 1, 0);
    // As a slice: where it lies is looked up once.
    let marks = slots.as_mut_slice();
    let mut last = U32::splat(simd, NOBODY);
    for row in winners.as_chunks::<LANES>().0 {
        let lanes = U32::simd_from(simd, *row);
        // As before: often with several samples, and within large triangles.
        if lanes.simd_eq(last).all_true() {
            continue;
        }
        last = lanes;
        // All of them: which ones are new, nobody can foresee.
        for winner in <[u32; LANES]>::from(lanes.min(places as u32)) {
            marks[winner as usize] = 1;
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

/// Lists some pixels of a group by themselves: those that see one triangle, and
/// edge pixels with what their first samples see.
#[inline(always)]
fn push_lanes(shading: &mut Shading, (group, winners): (usize, &[u32]), lanes: [u64; 2]) {
    let Shading { slots, fragments, parts, .. } = shading;
    for ((list, mut lanes), partly) in [fragments, parts].into_iter().zip(lanes).zip([false, true]) {
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize % LANES;
            lanes &= lanes - 1;
            let pixel = group * LANES + lane;
            let slot = slots[winners[lane] as usize];
            list.push(Fragment { slot, work: Work::anywhere(pixel, partly, pixel) });
        }
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
        let belongs = |lane: usize| slots.contains(&(shading.slots[winners[lane] as usize] as usize));
        let stays = (0..LANES).filter(|lane| group.lanes >> lane & 1 != 0).all(belongs);
        if !stays {
            let lanes = [group.lanes & !group.edges, group.edges].map(u64::from);
            push_lanes(shading, (number, winners), lanes);
        }
        stays
    });
    shading.groups = groups;
}
