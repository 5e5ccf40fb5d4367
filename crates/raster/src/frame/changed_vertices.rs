//! The vertices of a pass that have other values than in the last frame: they run again.

use super::DrawChange;
use super::options::{FrameOptions, VERTICES};
use super::stages::VertexValues;
use crate::pass::RecordedDraw;
use crate::simd::Token;
use crate::vertex::{ScreenVertex, Slots, VertexDestination};
use crate::view::Plan;
use crate::viewport::Viewport;
use std::hint::black_box;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Vertices with other values, a bit for each slot of each draw.
#[derive(Default)]
pub(super) struct ChangedVertices {
    draws: Vec<ChangedOfDraw>,
    /// The vertices that may have other values.
    changed: Vec<u64>,
    /// The vertices among them that lie elsewhere, or nowhere.
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
pub(super) struct VertexBits<'a> {
    pub(super) least: u32,
    pub(super) greatest: u32,
    pub(super) changed: &'a [u64],
    pub(super) moved: &'a [u64],
}

impl ChangedVertices {
    /// The vertices that may have other values: a bit for each slot of each draw.
    pub(super) fn changed(&self) -> &[u64] {
        &self.changed
    }

    /// The vertices among them that lie elsewhere, or nowhere.
    pub(super) fn moved(&self) -> &[u64] {
        &self.moved
    }

    /// Takes the vertices of a pass that have changed.
    pub(super) fn mark(&mut self, plan: &Plan, changes: &[DrawChange<'_>]) {
        self.draws.clear();
        let mut end = 0;
        for draw in &plan.draws {
            let vertices = changes[draw.draw].vertices.iter().copied();
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
            for slot in changes[draw.draw].vertices.iter().map(|&vertex| slots.of(vertex)) {
                if slot < draw.used.len() {
                    bits[slot / 64] |= 1 << (slot % 64);
                }
            }
        }
    }

    /// What was found out of a draw, given by its number in the plan.
    pub(super) fn of_draw(&self, number: usize) -> VertexBits<'_> {
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
            let stride = pass[draw.draw].pipeline.stride();
            for start in (0..draw.used.len()).step_by(VERTICES) {
                let slots = start..draw.used.len().min(start + VERTICES);
                let task = RunTask {
                    recorded: &pass[draw.draw],
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
            // That of vertices that do not exist.
            split_mut(&mut screen_vertices, 1);
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
                    VertexDestination { vertices, varyings },
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
