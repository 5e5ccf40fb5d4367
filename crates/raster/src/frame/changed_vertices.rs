//! The vertices of a pass that have other values than in the last frame. These vertices run again. For each chunk,
//! [`AffectedSearch`] finds the primitives that look different, and the primitives that lie elsewhere.

use super::DrawChange;
use super::layout::{FrameOptions, VERTICES};
use crate::bin::Chunk;
use crate::geometry::{Geometry, Shape};
use crate::outer_ink::parts;
use crate::pass::RecordedDraw;
use crate::simd::Token;
use crate::vertex::{ScreenVertex, Slots, VertexDestination};
use crate::view::Plan;
use crate::viewport::Viewport;
use std::hint::black_box;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// What the vertices of a frame become.
pub(super) struct VertexValues<'a> {
    pub(super) screen_vertices: &'a mut [ScreenVertex],
    pub(super) varyings: &'a mut [f32],
}

/// Vertices with other values, a bit for each slot of each draw.
#[derive(Default)]
pub(super) struct ChangedVertices {
    draws: Vec<ChangedOfDraw>,
    /// The vertices that may have other values.
    changed: Vec<u64>,
    /// The vertices among `changed` that lie elsewhere, or nowhere.
    moved: Vec<u64>,
}

/// Which vertices of a draw have changed.
struct ChangedOfDraw {
    /// The words of the lists that hold its bits.
    words: Range<usize>,
    /// The least and the greatest of its vertices that may have other values.
    least: u32,
    greatest: u32,
}

/// The same, with the bits.
#[derive(Clone, Copy)]
struct VertexBits<'a> {
    least: u32,
    greatest: u32,
    changed: &'a [u64],
    moved: &'a [u64],
}

impl ChangedVertices {
    /// The vertices that may have other values: a bit for each slot of each draw.
    pub(super) fn changed(&self) -> &[u64] {
        &self.changed
    }

    /// The vertices among `changed` that lie elsewhere, or nowhere.
    pub(super) fn moved(&self) -> &[u64] {
        &self.moved
    }

    /// Takes the vertices of a pass that have changed.
    pub(super) fn mark(&mut self, plan: &Plan, changes: &[DrawChange<'_>]) {
        self.draws.clear();
        let mut end = 0;
        for draw in &plan.draws {
            let vertices = changes[draw.draw()].vertices.iter().copied();
            let least = vertices.clone().min().unwrap_or(u32::MAX);
            let greatest = vertices.max().unwrap_or(0);
            let words = end..end + draw.used.len().div_ceil(64);
            end = words.end;
            self.draws.push(ChangedOfDraw { words, least, greatest });
        }
        for bits in [&mut self.changed, &mut self.moved] {
            bits.clear();
            bits.resize(end, 0);
        }
        for (draw, of_draw) in plan.draws.iter().zip(&self.draws) {
            let slots = plan.slots(draw);
            let bits = &mut self.changed[of_draw.words.clone()];
            for slot in changes[draw.draw()].vertices.iter().map(|&vertex| slots.of(vertex)) {
                if slot < draw.used.len() {
                    bits[slot / 64] |= 1 << (slot % 64);
                }
            }
        }
    }

    /// What was found out of a draw, given by its number in the plan.
    fn of_draw(&self, number: usize) -> VertexBits<'_> {
        let ChangedOfDraw { ref words, least, greatest } = self.draws[number];
        let [changed, moved] = [&self.changed, &self.moved].map(|bits| &bits[words.clone()]);
        VertexBits { least, greatest, changed, moved }
    }

    /// Runs the changed vertices and their neighbours again, and finds which have moved.
    pub(super) fn run(
        &mut self,
        pass: &[RecordedDraw<'_>],
        plan: &Plan,
        viewport: Viewport,
        options: FrameOptions<'_>,
        values: VertexValues<'_>,
    ) {
        let VertexValues { mut screen_vertices, mut varyings } = values;
        let mut tasks = Vec::new();
        let (mut changed, mut moved) = (self.changed.as_slice(), self.moved.as_mut_slice());
        for draw in &plan.draws {
            let stride = pass[draw.draw()].pipeline.stride();
            for start in (0..draw.used.len()).step_by(VERTICES) {
                let slots = start..draw.used.len().min(start + VERTICES);
                let task = RunTask {
                    recorded: &pass[draw.draw()],
                    used: plan.slots(draw),
                    changed: split(&mut changed, slots.len().div_ceil(64)),
                    moved: split_mut(&mut moved, slots.len().div_ceil(64)),
                    screen_vertices: split_mut(&mut screen_vertices, slots.len()),
                    varyings: split_mut(&mut varyings, slots.len() * stride),
                    slots,
                };
                if task.changed.iter().any(|&word| word != 0) {
                    tasks.push(task);
                }
            }
        }
        let shared = tasks.len() > 1;
        let queue = Mutex::new(tasks.into_iter());
        let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).next();
        options.workers.run(shared, |_| {
            while let Some(task) = next()
                && !options.is_cancelled()
            {
                task.run(options.token, viewport);
            }
        });
    }
}

/// Some consecutive slots of a draw.
struct RunTask<'a> {
    recorded: &'a RecordedDraw<'a>,
    used: Slots<'a>,
    slots: Range<usize>,
    changed: &'a [u64],
    moved: &'a mut [u64],
    screen_vertices: &'a mut [ScreenVertex],
    varyings: &'a mut [f32],
}

impl RunTask<'_> {
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
                let vertices = &mut self.screen_vertices[first..end];
                before[..vertices.len()].copy_from_slice(vertices);
                let slots = self.slots.start + first..self.slots.start + end;
                let varyings = &mut self.varyings[first * stride..end * stride];
                pipeline.run_vertices(
                    token,
                    self.used,
                    slots,
                    viewport,
                    VertexDestination { vertices, varyings, position: None },
                );
                for ((bit, after), before) in (first % 64..).zip(&*vertices).zip(&before) {
                    // The position of a vertex without a snapped one is computed by the pipeline once more.
                    let differs = after.0 != before.0 || !after.is_snapped();
                    *moved |= changed & (u64::from(differs) << bit);
                }
            }
        }
    }

    /// Reads what the groups hold, which may lie all over the memory: a processor waits for many reads at once if
    /// nothing else is done meanwhile, and finds them nearby afterwards.
    fn read_ahead(&self) {
        let stride = self.recorded.pipeline.stride();
        let groups = self.changed.iter().zip((0..).step_by(64)).flat_map(|(&changed, first)| {
            (0..8).filter(move |byte| changed >> (8 * byte) & 0xff != 0).map(move |byte| first + 8 * byte)
        });
        let read = |all: u32, slot: usize| {
            let vertex = self.screen_vertices.get(slot).map_or(0, |vertex| vertex.0[0] as u32);
            all ^ vertex ^ self.varyings.get(slot * stride).map_or(0, |varying| varying.to_bits())
        };
        // A group fills two lines of the cache.
        black_box(groups.fold(0, |all, first| read(read(all, first), first + 4)));
    }
}

fn split<'a, T>(list: &mut &'a [T], count: usize) -> &'a [T] {
    list.split_off(..count).expect("draws have so many")
}

fn split_mut<'a, T>(list: &mut &'a mut [T], count: usize) -> &'a mut [T] {
    list.split_off_mut(..count).expect("draws have so many")
}

/// Primitives that are left out together.
const BLOCK: usize = 64;

/// What was found out about each primitive of a chunk.
#[derive(Default)]
pub(super) struct AffectedPrimitives {
    /// Whether the primitive looks different.
    pub(super) differs: Vec<bool>,
    /// Whether the primitive lies elsewhere.
    pub(super) is_moved: Vec<bool>,
    /// Whether any does.
    pub(super) any_differs: bool,
    pub(super) any_moved: bool,
}

impl AffectedPrimitives {
    /// Starts with `count` primitives, none of them affected.
    fn reset(&mut self, count: usize) {
        (self.any_differs, self.any_moved) = (false, false);
        for flags in [&mut self.differs, &mut self.is_moved] {
            flags.clear();
            flags.resize(count, false);
        }
    }

    fn note_different(&mut self, index: usize) {
        (self.differs[index], self.any_differs) = (true, true);
    }

    /// It also looks different.
    fn note_moved(&mut self, index: usize) {
        self.note_different(index);
        (self.is_moved[index], self.any_moved) = (true, true);
    }
}

/// What the search for affected primitives reads.
#[derive(Clone, Copy)]
pub(super) struct AffectedSearch<'a> {
    pub(super) pass: &'a [RecordedDraw<'a>],
    pub(super) plan: &'a Plan,
    pub(super) vertices: &'a ChangedVertices,
    pub(super) changes: &'a [DrawChange<'a>],
    /// Whether edges of faces are painted: then a face looks different as a whole.
    pub(super) has_edges: bool,
}

impl AffectedSearch<'_> {
    /// Finds the affected primitives of a chunk.
    pub(super) fn find(&self, chunk: &Chunk, affected: &mut AffectedPrimitives) {
        affected.reset(chunk.ordinals.len());
        for (draw, range) in self.plan.parts(chunk.ordinals.clone()) {
            if range.is_empty() {
                continue;
            }
            // Draws without triangles end where they begin.
            let number = self.plan.draws.partition_point(|other| other.ordinals.end <= draw.ordinals.start);
            let search = DrawSearch {
                slots: self.plan.slots(draw),
                geometry: &self.pass[draw.draw()].geometry,
                change: self.changes[draw.draw()],
                vertices: self.vertices.of_draw(number),
                first: (draw.ordinals.start + range.start - chunk.ordinals.start) as usize,
                range,
            };
            match search.geometry.shape {
                Shape::Triangles { triangles, .. } => {
                    search.find_triangles(triangles, self.has_edges, affected);
                }
                Shape::Lines { segments, .. } => search.find_others(segments, affected),
                Shape::Points { points, .. } => search.find_others(points.as_chunks::<1>().0, affected),
            }
        }
    }
}

/// Looks for affected primitives among some of a draw.
struct DrawSearch<'a> {
    slots: Slots<'a>,
    geometry: &'a Geometry<'a>,
    /// With the primitives that are known to look different.
    change: DrawChange<'a>,
    vertices: VertexBits<'a>,
    /// The primitives of the draw that are examined.
    range: Range<u32>,
    /// The index of the first of these primitives in the chunk.
    first: usize,
}

impl DrawSearch<'_> {
    /// Flags triangles, and if faces have edges the other triangles of their faces.
    fn find_triangles(&self, triangles: &[[u32; 3]], has_edges: bool, affected: &mut AffectedPrimitives) {
        if !has_edges {
            return self.find_others(triangles, affected);
        }
        let mut seeds = Vec::new();
        self.for_each_changed(triangles, |triangle, is_moved| {
            seeds.push(triangle);
            if is_moved {
                affected.note_moved(self.index(triangle));
            }
        });
        let reshaped = within(self.change.reshaped, &self.range);
        reshaped.iter().for_each(|&triangle| affected.note_moved(self.index(triangle)));
        seeds.extend(reshaped);
        seeds.extend(within(self.change.recolored, &self.range));
        self.add_beside(&mut seeds);
        for seed in seeds {
            let own = parts(self.geometry, seed).chain([seed]).filter(|part| self.range.contains(part));
            own.for_each(|part| affected.note_different(self.index(part)));
        }
    }

    /// Flags primitives, each by itself.
    fn find_others<const N: usize>(&self, primitives: &[[u32; N]], affected: &mut AffectedPrimitives) {
        self.for_each_changed(primitives, |primitive, is_moved| match is_moved {
            true => affected.note_moved(self.index(primitive)),
            false => affected.note_different(self.index(primitive)),
        });
        let recolored = within(self.change.recolored, &self.range);
        recolored.iter().for_each(|&primitive| affected.note_different(self.index(primitive)));
        let reshaped = within(self.change.reshaped, &self.range);
        reshaped.iter().for_each(|&primitive| affected.note_moved(self.index(primitive)));
    }

    /// Visits the primitives of which a vertex has changed, and whether one was moved.
    fn for_each_changed<const N: usize>(&self, primitives: &[[u32; N]], mut visit: impl FnMut(u32, bool)) {
        let VertexBits { least, greatest, changed, moved } = self.vertices;
        // Mostly only colours change.
        let range = if least <= greatest { self.range.clone() } else { 0..0 };
        let primitives = &primitives[range.start as usize..range.end as usize];
        for (block, first) in primitives.chunks(BLOCK).zip((range.start..).step_by(BLOCK)) {
            // Without a way out after each, several are tested at once.
            let is_near = |any: bool, &vertex: &u32| any | (vertex >= least) & (vertex <= greatest);
            if !block.as_flattened().iter().fold(false, is_near) {
                continue;
            }
            for (&corners, primitive) in block.iter().zip(first..) {
                if self.has(changed, corners) {
                    visit(primitive, self.has(moved, corners));
                }
            }
        }
    }

    /// Adds triangles beside the range that belong to faces in it, and look different.
    fn add_beside(&self, seeds: &mut Vec<u32>) {
        let ends = [self.range.start, self.range.end - 1].map(|end| parts(self.geometry, end));
        let is_beside = |triangle: &u32| {
            let is_listed = |list: &[u32]| list.binary_search(triangle).is_ok();
            !self.range.contains(triangle)
                && (self.has(self.vertices.changed, self.geometry.corners(*triangle))
                    || is_listed(self.change.reshaped)
                    || is_listed(self.change.recolored))
        };
        seeds.extend(ends.into_iter().flatten().filter(is_beside));
    }

    /// The index in the chunk of a primitive of the draw.
    #[inline(always)]
    fn index(&self, primitive: u32) -> usize {
        self.first + (primitive - self.range.start) as usize
    }

    /// Whether the bit of a corner is set.
    #[inline(always)]
    fn has<const N: usize>(&self, bits: &[u64], corners: [u32; N]) -> bool {
        corners.iter().fold(false, |any, &corner| any | is_set(bits, self.slots.of(corner)))
    }
}

/// The part of an increasing list of numbers that lies in a range.
fn within<'a>(list: &'a [u32], range: &Range<u32>) -> &'a [u32] {
    let at = |at: u32| list.partition_point(|&number| number < at);
    &list[at(range.start)..at(range.end)]
}

/// Whether the bit of a number is set.
#[inline(always)]
pub(super) fn is_set(bits: &[u64], number: usize) -> bool {
    bits.get(number / 64).is_some_and(|word| word >> (number % 64) & 1 != 0)
}

/// Sets the bit of a number.
#[inline(always)]
pub(super) fn set(bits: &mut [u64], number: usize) {
    bits[number / 64] |= 1 << (number % 64);
}

/// Empties a set, and makes room for numbers below `count`.
pub(super) fn reset(bits: &mut Vec<u64>, count: usize) {
    bits.clear();
    bits.resize(count.div_ceil(64), 0);
}

/// Whether all of one set are in another.
pub(super) fn are_among(some: &[u64], all: &[u64]) -> bool {
    some.len() == all.len() && some.iter().zip(all).all(|(some, all)| some & !all == 0)
}
