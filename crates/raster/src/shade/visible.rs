//! Which triangles of a tile are visible, and at which pixels. *Edge pixels* are pixels whose samples show different
//! triangles.

use super::shading::{DrawRun, EmptyGroup, Shading};
use crate::bin::TriangleRef;
use crate::fragments::{FragmentList, Group, ShadePoint};
use crate::simd::{LANES, Mask, Simd, U32, lane_numbers, prelude::*};
use crate::tile_buffer::{NO_TRIANGLE, PIXELS, VisibilityBuffer};
use crate::view::FrameView;

/// Groups with fewer pixels than this that see anything share vectors with others.
const FULL: u32 = 6;

/// Some lanes of each group of a tile.
#[derive(Clone, Copy)]
pub(super) struct SomeLanes<'l> {
    /// Those that are shaded.
    pub(super) shaded: &'l [u8],
    /// Those whose triangles count as visible.
    pub(super) visible: &'l [u8],
}

/// Lists the visible triangles of a tile and the pixels in which they are visible, for some lanes if not for all.
/// Returns the number of fragments to shade.
#[inline(always)]
pub(super) fn list<S: Simd>(
    simd: S,
    buffer: &VisibilityBuffer,
    triangle_count: usize,
    some: Option<SomeLanes<'_>>,
    shading: &mut Shading,
) -> usize {
    const NONE: SomeLanes<'_> = SomeLanes { shaded: &[], visible: &[] };
    match (buffer.samples, some) {
        (1, None) => list_samples::<S, 1, true>(simd, buffer, triangle_count, NONE, shading),
        (1, Some(some)) => list_samples::<S, 1, false>(simd, buffer, triangle_count, some, shading),
        (_, None) => list_samples::<S, 0, true>(simd, buffer, triangle_count, NONE, shading),
        (_, Some(some)) => list_samples::<S, 0, false>(simd, buffer, triangle_count, some, shading),
    }
}

/// The same with `SAMPLES` samples to a pixel, if that is not 0, and for all lanes if `WHOLE`.
#[inline(always)]
fn list_samples<S: Simd, const SAMPLES: usize, const WHOLE: bool>(
    simd: S,
    buffer: &VisibilityBuffer,
    triangle_count: usize,
    some: SomeLanes<'_>,
    shading: &mut Shading,
) -> usize {
    let samples = if SAMPLES > 0 { SAMPLES } else { buffer.samples };
    shading.clear(triangle_count, samples);
    let (mut pixels, mut last) = (0, U32::splat(simd, NO_TRIANGLE));
    let rows = buffer.visible().as_chunks::<LANES>().0;
    let Shading { slots, groups, fragments, parts, empty_groups, edges, .. } = &mut *shading;
    // As a slice: where it lies is looked up once.
    let marks = slots.as_mut_slice();
    for (group, rows) in rows.chunks_exact(samples).enumerate() {
        if !WHOLE && some.visible[group] == 0 {
            continue;
        }
        let (first, others) = rows.split_first().expect("a pixel has a sample");
        let lanes = U32::simd_from(simd, *first);
        // As before: often within large triangles.
        let mut counted = lanes;
        if !WHOLE {
            let visible = Mask::from_bitmask(simd, u64::from(some.visible[group]));
            counted = visible.select(lanes, U32::splat(simd, NO_TRIANGLE));
        }
        if !counted.simd_eq(last).all_true() {
            // All eight are marked: a branch on which are new would be mispredicted often.
            for visible in <[u32; LANES]>::from(counted.min(triangle_count as u32)) {
                marks[visible as usize] = 1;
            }
        }
        last = counted;
        let agree = others.iter().fold(
            Mask::splat(simd, true),
            #[inline(always)]
            |agree, row| agree & lanes.simd_eq(U32::simd_from(simd, *row)),
        );
        let shaded = if WHOLE { 0xff } else { u64::from(some.shaded[group]) };
        let partly = !agree.to_bitmask() & shaded;
        if !WHOLE && shaded != 0xff && samples > 1 {
            mark_all(marks, others, triangle_count);
        }
        let empty = lanes.simd_eq(U32::splat(simd, NO_TRIANGLE)).to_bitmask() & shaded;
        if empty != 0 {
            empty_groups.push(EmptyGroup { number: group as u32, lanes: empty as u32 });
        }
        let occupied = !empty & shaded;
        pixels += occupied.count_ones();
        if partly != 0 {
            edges.push(simd, group, rows, partly, parts);
        }
        if occupied.count_ones() >= FULL {
            let slot = first[occupied.trailing_zeros() as usize % LANES];
            let edges = (occupied & partly) as u32;
            groups.push(Group { slot, number: group as u32, lanes: occupied as u32, edges });
        } else {
            push_lanes([fragments, parts], group, first, [occupied & !partly, occupied & partly]);
        }
    }
    number(triangle_count, shading);
    let needed = shading.edges.color_count();
    if shading.colors.len() < needed {
        shading.colors.resize(needed, [0.0; 4]);
    }
    pixels as usize + shading.edges.part_count()
}

/// Marks what further samples see, of a group that is not shaded as a whole.
fn mark_all(marks: &mut [u32], rows: &[[u32; LANES]], triangle_count: usize) {
    for visible in rows.as_flattened() {
        marks[(*visible as usize).min(triangle_count)] = 1;
    }
}

/// Numbers the triangles that are marked, in their order. In what was listed, these numbers replace
/// the indices of the visible triangles.
#[inline(always)]
fn number(triangle_count: usize, shading: &mut Shading) {
    let Shading { slots, visible_triangles, groups, fragments, parts, .. } = shading;
    for &visible in parts.slots() {
        slots[visible as usize] = 1;
    }
    slots.truncate(triangle_count);
    visible_triangles.resize(triangle_count, 0);
    let mut count = 0;
    // Without a branch on what is visible, which would be mispredicted often: the index of a
    // triangle that is not visible is overwritten by the next one.
    for (index, slot) in slots.iter_mut().enumerate() {
        visible_triangles[count] = index as u32;
        count += std::mem::replace(slot, count as u32) as usize;
    }
    visible_triangles.truncate(count);
    for group in groups {
        group.slot = slots[group.slot as usize];
    }
    for slot in fragments.slots_mut().iter_mut().chain(parts.slots_mut()) {
        *slot = slots[*slot as usize];
    }
}

/// Lists some pixels of a group by themselves, with the slots or names of what they
/// see: those that see one triangle, and edge pixels with what their first samples see,
/// each kind in its list.
#[inline(always)]
fn push_lanes(lists: [&mut FragmentList; 2], group: usize, slots: &[u32; LANES], lanes: [u64; 2]) {
    for ((list, mut lanes), partly) in lists.into_iter().zip(lanes).zip([false, true]) {
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize % LANES;
            lanes &= lanes - 1;
            let pixel = group * LANES + lane;
            let point = if partly {
                ShadePoint::covering(pixel, 0, pixel)
            } else {
                ShadePoint::anywhere(pixel, false, pixel)
            };
            list.push(slots[lane], point);
        }
    }
}

/// Divides what was listed by draws.
pub(super) fn divide(
    frame: &FrameView<'_>,
    buffer: &VisibilityBuffer,
    triangles: &[TriangleRef],
    shading: &mut Shading,
) {
    let Shading { visible_triangles, runs, .. } = shading;
    runs.clear();
    let mut start = 0;
    while let Some(&first) = visible_triangles.get(start) {
        let draw = frame.draw_of(triangles[first as usize]);
        let ordinals = frame.plan.draws[draw].ordinals.end;
        let end = start
            + visible_triangles[start..]
                .partition_point(|&index| triangles[index as usize].ordinal < ordinals);
        runs.push(DrawRun {
            draw,
            slots: start..end,
            groups: 0..0,
            fragments: 0..0,
            parts: 0..0,
            records: None,
        });
        start = end;
    }
    if runs.len() > 1 {
        part_groups(buffer, shading);
        shading.groups.sort_unstable_by_key(|group| group.slot);
        shading.fragments.sort();
        shading.parts.sort();
    }
    let Shading { runs, groups, fragments, parts, .. } = shading;
    let (fragments, parts) = (fragments.slots(), parts.slots());
    let (mut group, mut fragment, mut part) = (0, 0, 0);
    for run in runs {
        let end = run.slots.end as u32;
        run.groups = group..group + groups[group..].partition_point(|group| group.slot < end);
        run.fragments = fragment..fragment + fragments[fragment..].partition_point(|&slot| slot < end);
        run.parts = part..part + parts[part..].partition_point(|&slot| slot < end);
        (group, fragment, part) = (run.groups.end, run.fragments.end, run.parts.end);
    }
}

/// Takes groups apart that see several draws.
fn part_groups(buffer: &VisibilityBuffer, shading: &mut Shading) {
    let mut groups = std::mem::take(&mut shading.groups);
    groups.retain(|group| {
        let number = group.number as usize;
        let visible =
            buffer.visible()[number * LANES * buffer.samples..].first_chunk().expect("groups are whole");
        let run = shading.runs.partition_point(|run| run.slots.end <= group.slot as usize);
        let slots = shading.runs[run].slots.clone();
        let slot_of_lane: [u32; LANES] =
            visible.map(|visible| shading.slots.get(visible as usize).copied().unwrap_or(NO_TRIANGLE));
        let belongs = |lane: usize| slots.contains(&(slot_of_lane[lane] as usize));
        let stays = (0..LANES).filter(|lane| group.lanes >> lane & 1 != 0).all(belongs);
        if !stays {
            let lanes = [group.lanes & !group.edges, group.edges].map(u64::from);
            push_lanes([&mut shading.fragments, &mut shading.parts], number, &slot_of_lane, lanes);
        }
        stays
    });
    shading.groups = groups;
}

/// The index of the colour behind all triangles.
pub(crate) const BEHIND: usize = PIXELS;

/// The first index of a colour that only some samples of a pixel have.
const PARTS: usize = PIXELS + 1;

/// No colour's name.
const UNNAMED: u32 = u32::MAX;

/// The pixels of a tile whose samples see different triangles, and the names of their
/// samples' colours: the indices where they lie.
pub(crate) struct Edges {
    groups: Vec<EdgeGroup>,
    /// Group by group, sample by sample; and room for more.
    names: Vec<[u32; LANES]>,
    samples: usize,
    /// How many colours have an index of their own, beside those of pixels.
    parts: usize,
}

/// A group with such pixels.
#[derive(Clone, Copy)]
pub(crate) struct EdgeGroup {
    pub(crate) number: u32,
    /// Those pixels.
    pub(crate) lanes: u32,
}

impl EdgeGroup {
    /// The pixels, by their lanes.
    #[inline(always)]
    pub(crate) fn lanes(self) -> impl Iterator<Item = usize> {
        let mut rest = self.lanes;
        std::iter::from_fn(move || {
            let lane = (rest != 0).then_some(rest.trailing_zeros() as usize % LANES)?;
            rest &= rest - 1;
            Some(lane)
        })
    }
}

impl Edges {
    pub(super) fn new() -> Self {
        Self { groups: Vec::new(), names: Vec::new(), samples: 1, parts: 0 }
    }

    pub(super) fn clear(&mut self, samples: usize) {
        (self.samples, self.parts) = (samples, 0);
        self.forget();
        let most = PIXELS / LANES * samples;
        if samples > 1 && self.names.len() < most {
            self.names.resize(most, [0; LANES]);
        }
    }

    /// Leaves no pixel in it.
    pub(crate) fn forget(&mut self) {
        self.groups.clear();
    }

    /// How many colours have an index of their own.
    fn part_count(&self) -> usize {
        self.parts
    }

    /// How many colours there is memory for.
    fn color_count(&self) -> usize {
        PARTS + self.parts
    }

    /// The groups, each with the names of its samples' colours, sample by sample.
    #[inline(always)]
    pub(crate) fn iter(&self) -> impl Iterator<Item = (EdgeGroup, &[[u32; LANES]])> {
        self.groups.iter().copied().zip(self.names.chunks_exact(self.samples))
    }

    /// Lists pixels of a group whose samples show different triangles. The pixels' own slots get the colours
    /// of their first samples, the colour of each other triangle gets a slot of its own, and the samples
    /// refer to these slots.
    #[inline(always)]
    pub(super) fn push<S: Simd>(
        &mut self,
        simd: S,
        group: usize,
        rows: &[[u32; LANES]],
        lanes: u64,
        parts: &mut FragmentList,
    ) {
        let pixel = group * LANES;
        let names = &mut self.names[self.groups.len() * rows.len()..][..rows.len()];
        self.groups.push(EdgeGroup { number: group as u32, lanes: lanes as u32 });
        let (no_triangle, behind) = (U32::splat(simd, NO_TRIANGLE), U32::splat(simd, BEHIND as u32));
        let pixels = (lane_numbers(simd) + pixel as i32).bitcast::<U32<S>>();
        let listed = Mask::from_bitmask(simd, lanes);
        names[0] = U32::simd_from(simd, rows[0]).simd_eq(no_triangle).select(behind, pixels).into();
        for sample in 1..rows.len() {
            let visible = U32::simd_from(simd, rows[sample]);
            let unnamed = U32::splat(simd, UNNAMED);
            let mut name = visible.simd_eq(no_triangle).select(behind, unnamed);
            for (row, names) in rows[..sample].iter().zip(&names[..sample]) {
                name = visible.simd_eq(U32::simd_from(simd, *row)).select(U32::simd_from(simd, *names), name);
            }
            // All lanes without a name at once: how many there are is hard to predict.
            let others = name.simd_eq(unnamed) & listed;
            let indices = (lane_numbers(simd) + (PARTS + self.parts) as i32).bitcast::<U32<S>>();
            parts.push_some(others, [visible, ShadePoint::covering_lanes(pixels, sample)], indices);
            self.parts += others.to_bitmask().count_ones() as usize;
            names[sample] = indices.expand_merge(others, name).into();
        }
    }
}
