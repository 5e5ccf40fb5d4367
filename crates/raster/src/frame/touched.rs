//! Runs the vertices of a pass that have new values since the last frame, and finds the triangles that look different
//! as a result.

use super::bits::is_set;
use super::change::DrawChange;
use super::options::{FrameOptions, VERTICES};
use crate::bin::Chunk;
use crate::geometry::{Geometry, Shape};
use crate::outer_ink::parts;
use crate::pass::Recorded;
use crate::simd::Token;
use crate::vertex::{ScreenVertex, Slots};
use crate::view::Plan;
use crate::viewport::Viewport;
use std::hint::black_box;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Vertices with other values, a bit for each slot of each draw.
#[derive(Default)]
pub(super) struct Touched {
    /// Where the words of each planned draw begin, and the end.
    starts: Vec<usize>,
    /// The least and the greatest of each draw's vertices that may have other values.
    reaches: Vec<[u32; 2]>,
    /// Those that may have other values.
    changed: Vec<u64>,
    /// Those of them that have another place, or none.
    moved: Vec<u64>,
}

/// What was found out about each primitive of a chunk.
#[derive(Default)]
pub(super) struct Found {
    /// Those that look different.
    pub(super) differ: Vec<bool>,
    /// Those that lie elsewhere.
    pub(super) moved: Vec<bool>,
    /// Whether there are any of these.
    pub(super) any: bool,
    pub(super) any_moved: bool,
}

impl Found {
    /// Starts with `count` primitives, none of them found.
    fn reset(&mut self, count: usize) {
        (self.any, self.any_moved) = (false, false);
        for flags in [&mut self.differ, &mut self.moved] {
            flags.clear();
            flags.resize(count, false);
        }
    }
}

impl Touched {
    /// The vertices that may have other values: a bit for each slot of each draw.
    pub(super) fn changed(&self) -> &[u64] {
        &self.changed
    }

    /// Those of them that have another place, or none.
    pub(super) fn moved(&self) -> &[u64] {
        &self.moved
    }

    /// Takes the vertices of a pass that have changed.
    pub(super) fn mark(&mut self, plan: &Plan, changes: &[DrawChange<'_>]) {
        self.starts.clear();
        self.reaches.clear();
        let mut words = 0;
        for draw in &plan.draws {
            let vertices = changes[draw.draw].vertices.iter().copied();
            let least = vertices.clone().min().unwrap_or(u32::MAX);
            self.reaches.push([least, vertices.max().unwrap_or(0)]);
            self.starts.push(words);
            words += draw.used.len().div_ceil(64);
        }
        self.starts.push(words);
        for bits in [&mut self.changed, &mut self.moved] {
            bits.clear();
            bits.resize(words, 0);
        }
        for (draw, &start) in plan.draws.iter().zip(&self.starts) {
            let slots = plan.slots(draw);
            for &vertex in changes[draw.draw].vertices {
                let slot = slots.of(vertex);
                if slot < draw.used.len() {
                    self.changed[start + slot / 64] |= 1 << (slot % 64);
                }
            }
        }
    }

    /// Runs them and their neighbours again, and finds which have moved.
    pub(super) fn run_vertices(
        &mut self,
        pass: &[Recorded<'_>],
        plan: &Plan,
        viewport: Viewport,
        options: FrameOptions<'_>,
        (mut places, mut varyings): (&mut [ScreenVertex], &mut [f32]),
    ) {
        let mut pieces = Vec::new();
        let (mut changed, mut moved) = (self.changed.as_slice(), self.moved.as_mut_slice());
        for draw in &plan.draws {
            let stride = pass[draw.draw].pipeline.stride();
            let mut slot = 0;
            while slot < draw.used.len() {
                let slots = slot..draw.used.len().min(slot + VERTICES);
                slot = slots.end;
                let piece = Piece {
                    recorded: &pass[draw.draw],
                    used: plan.slots(draw),
                    changed: split(&mut changed, slots.len().div_ceil(64)),
                    moved: split_mut(&mut moved, slots.len().div_ceil(64)),
                    places: split_mut(&mut places, slots.len()),
                    varyings: split_mut(&mut varyings, slots.len() * stride),
                    slots,
                };
                if piece.changed.iter().any(|&word| word != 0) {
                    pieces.push(piece);
                }
            }
            // The place of vertices that do not exist.
            split_mut(&mut places, 1);
        }
        let shared = pieces.len() > 1;
        let rest = Mutex::new(pieces.into_iter());
        let next = || rest.lock().unwrap_or_else(PoisonError::into_inner).next();
        options.workers.run(shared, |_| {
            while let Some(piece) = next()
                && !options.is_cancelled()
            {
                piece.run(options.token, viewport);
            }
        });
    }

    /// Finds the primitives of a chunk that may look different.
    pub(super) fn triangles(
        &self,
        pass: &[Recorded<'_>],
        plan: &Plan,
        (changes, has_edges): (&[DrawChange<'_>], bool),
        chunk: &Chunk,
        found: &mut Found,
    ) {
        found.reset(chunk.ordinals.len());
        for (draw, range) in plan.parts(chunk.ordinals.clone()) {
            if range.is_empty() {
                continue;
            }
            // Draws without triangles end where they begin.
            let number = plan.draws.partition_point(|other| other.ordinals.end <= draw.ordinals.start);
            let words = self.starts[number]..self.starts[number + 1];
            let search = Search {
                slots: plan.slots(draw),
                geometry: &pass[draw.draw].geometry,
                change: changes[draw.draw],
                reach: self.reaches[number],
                changed: &self.changed[words.clone()],
                moved: &self.moved[words],
            };
            let first = (draw.ordinals.start + range.start - chunk.ordinals.start) as usize;
            match search.geometry.shape {
                Shape::Triangles { triangles, .. } => {
                    search.flag(triangles, range, has_edges, (found, first));
                }
                Shape::Lines { .. } | Shape::Points { .. } => search.flag_quads(range, (found, first)),
            }
        }
    }
}

/// Primitives that are left out together.
const BLOCK: usize = 64;

/// Looks for the primitives of a draw that look different.
struct Search<'a> {
    slots: Slots<'a>,
    geometry: &'a Geometry<'a>,
    /// With the primitives that are known to.
    change: DrawChange<'a>,
    /// Between which vertices those lie that may have other values.
    reach: [u32; 2],
    changed: &'a [u64],
    moved: &'a [u64],
}

impl Search<'_> {
    /// Flags some of the triangles, and the others of their faces if it has edges. The flags
    /// of the first one are given by their place.
    fn flag(
        &self,
        triangles: &[[u32; 3]],
        range: Range<u32>,
        has_edges: bool,
        (found, first): (&mut Found, usize),
    ) {
        let mut seeds = Vec::new();
        let Found { differ, moved, any, any_moved } = found;
        let mut note_moved = |triangle: u32| {
            moved[first + (triangle - range.start) as usize] = true;
            *any_moved = true;
        };
        let triangles = &triangles[range.start as usize..range.end as usize];
        let blocks = if self.has_vertices() { triangles } else { &[] }.chunks(BLOCK);
        for (block, start) in blocks.zip((range.start..).step_by(BLOCK)) {
            if self.reaches(block.as_flattened()) {
                for (&corners, triangle) in block.iter().zip(start..) {
                    if self.has(self.changed, corners) {
                        seeds.push(triangle);
                        if self.has(self.moved, corners) {
                            note_moved(triangle);
                        }
                    }
                }
            }
        }
        let reshaped = within(self.change.reshaped, &range);
        reshaped.iter().for_each(|&triangle| note_moved(triangle));
        seeds.extend(reshaped);
        seeds.extend(within(self.change.recolored, &range));
        if has_edges {
            self.add_beside(&range, &mut seeds);
        }
        *any |= !seeds.is_empty();
        let place =
            |triangle: u32| range.contains(&triangle).then(|| first + (triangle - range.start) as usize);
        for seed in seeds {
            place(seed).into_iter().for_each(|place| differ[place] = true);
            if has_edges {
                parts(self.geometry, seed).filter_map(place).for_each(|place| differ[place] = true);
            }
        }
    }

    /// Flags some of the lines or points. The flags of the first one are given by their place.
    fn flag_quads(&self, range: Range<u32>, (found, first): (&mut Found, usize)) {
        let place = |quad: u32| first + (quad - range.start) as usize;
        for &quad in within(self.change.recolored, &range) {
            (found.differ[place(quad)], found.any) = (true, true);
        }
        for &quad in within(self.change.reshaped, &range) {
            (found.differ[place(quad)], found.any) = (true, true);
            (found.moved[place(quad)], found.any_moved) = (true, true);
        }
        let indices = range.start as usize..range.end as usize;
        let (corners, count) = match self.geometry.shape {
            Shape::Triangles { .. } => return,
            _ if !self.has_vertices() => return,
            Shape::Lines { segments, .. } => (segments[indices].as_flattened(), 2),
            Shape::Points { points, .. } => (&points[indices], 1),
        };
        let blocks = corners.chunks(BLOCK * count).zip((first..).step_by(BLOCK));
        for (block, first) in blocks.filter(|(block, _)| self.reaches(block)) {
            for (corners, place) in block.chunks(count).zip(first..) {
                let has = |bits| corners.iter().any(|&corner| is_set(bits, self.slots.of(corner)));
                if has(self.changed) {
                    (found.differ[place], found.any) = (true, true);
                    if has(self.moved) {
                        (found.moved[place], found.any_moved) = (true, true);
                    }
                }
            }
        }
    }

    /// Adds triangles beside the range that belong to faces in it, and look different.
    fn add_beside(&self, range: &Range<u32>, seeds: &mut Vec<u32>) {
        let ends = [range.start, range.end - 1].map(|end| parts(self.geometry, end));
        let is_beside = |triangle: &u32| {
            let corners = self.geometry.corners(*triangle);
            let is_listed = |list: &[u32]| list.binary_search(triangle).is_ok();
            !range.contains(triangle)
                && (self.has(self.changed, corners)
                    || is_listed(self.change.reshaped)
                    || is_listed(self.change.recolored))
        };
        seeds.extend(ends.into_iter().flatten().filter(is_beside));
    }

    /// Whether any vertex may have changed. Mostly only colours do.
    fn has_vertices(&self) -> bool {
        let [least, greatest] = self.reach;
        least <= greatest
    }

    /// Whether any of some vertices may have changed, tested several at once.
    fn reaches(&self, vertices: &[u32]) -> bool {
        let [least, greatest] = self.reach;
        let within = |any: bool, &vertex: &u32| any | (vertex >= least) & (vertex <= greatest);
        vertices.iter().fold(false, within)
    }

    /// Whether the bit of a corner is set.
    #[inline(always)]
    fn has(&self, bits: &[u64], [a, b, c]: [u32; 3]) -> bool {
        let is_set = |vertex| is_set(bits, self.slots.of(vertex));
        is_set(a) | is_set(b) | is_set(c)
    }
}

/// Some consecutive slots of a draw.
struct Piece<'a> {
    recorded: &'a Recorded<'a>,
    used: Slots<'a>,
    slots: Range<usize>,
    changed: &'a [u64],
    moved: &'a mut [u64],
    places: &'a mut [ScreenVertex],
    varyings: &'a mut [f32],
}

impl Piece<'_> {
    /// Runs all groups of eight vertices of which at least one has changed, from the first to the last that has.
    fn run(self, token: Token, viewport: Viewport) {
        self.read_ahead();
        let pipeline = self.recorded.pipeline;
        let stride = pipeline.stride();
        let mut before = [ScreenVertex::default(); 64];
        for (word, (&changed, moved)) in self.changed.iter().zip(self.moved).enumerate() {
            let mut byte = 0;
            while byte < 8 {
                let group = |byte: usize| (changed >> (8 * byte)) as u8;
                if group(byte) == 0 {
                    byte += 1;
                    continue;
                }
                let first = word * 64 + byte * 8 + group(byte).trailing_zeros() as usize;
                while byte < 8 && group(byte) != 0 {
                    byte += 1;
                }
                let end = word * 64 + byte * 8 - group(byte - 1).leading_zeros() as usize;
                let places = &mut self.places[first..end];
                before[..places.len()].copy_from_slice(places);
                let slots = self.slots.start + first..self.slots.start + end;
                let varyings = &mut self.varyings[first * stride..end * stride];
                pipeline.run_vertices(token, self.used, slots, viewport, (places, varyings));
                for ((bit, after), before) in (first % 64..).zip(&*places).zip(&before) {
                    // The position of a vertex without a snapped one is computed by the pipeline once more.
                    let differs = after.0 != before.0 || !after.has_place();
                    *moved |= changed & (u64::from(differs) << bit);
                }
            }
        }
    }

    /// Reads what the groups hold, which may lie all over the memory: a processor waits for many places at once if
    /// nothing else is done meanwhile, and finds them nearby afterwards.
    fn read_ahead(&self) {
        let stride = self.recorded.pipeline.stride();
        let groups = self.changed.iter().zip((0..).step_by(64)).flat_map(|(&changed, first)| {
            (0..8).filter(move |byte| changed >> (8 * byte) & 0xff != 0).map(move |byte| first + 8 * byte)
        });
        let read = |all: u32, slot: usize| {
            let place = self.places.get(slot).map_or(0, |place| place.0[0] as u32);
            all ^ place ^ self.varyings.get(slot * stride).map_or(0, |varying| varying.to_bits())
        };
        // A group fills two lines of the cache.
        black_box(groups.fold(0, |all, first| read(read(all, first), first + 4)));
    }
}

/// Those of some increasing numbers that lie in a range.
fn within<'a>(list: &'a [u32], range: &Range<u32>) -> &'a [u32] {
    let at = |at: u32| list.partition_point(|&number| number < at);
    &list[at(range.start)..at(range.end)]
}

fn split<'a, T>(list: &mut &'a [T], count: usize) -> &'a [T] {
    let (first, rest) = list.split_at(count);
    *list = rest;
    first
}

fn split_mut<'a, T>(list: &mut &'a mut [T], count: usize) -> &'a mut [T] {
    let (first, rest) = std::mem::take(list).split_at_mut(count);
    *list = rest;
    first
}
