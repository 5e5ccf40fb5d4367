//! What the vertex stage runs and what it gives: the vertex half of a draw's pipeline, without its type; its input, up to
//! eight vertices; which of the pipeline's vertices a draw runs; and the draw's vertices after the stage.

use super::ScreenVertex;
use crate::clip::Outcode;
use crate::simd::{F32, LANES, Simd, Token, prelude::*};
use crate::viewport::Viewport;
use std::ops::Range;
use trigon_math::Vec4;

/// Where the vertex stage writes vertices, and their varyings side by side.
pub(crate) struct VertexDestination<'o> {
    pub(crate) vertices: &'o mut [ScreenVertex],
    pub(crate) varyings: &'o mut [f32],
    /// Where the position of the first vertex in clip space goes, if it is needed.
    pub(crate) position: Option<&'o mut Vec4>,
}

/// What the stages before shading need of a pipeline. The type is erased once per draw.
pub(crate) trait VertexProgram: Sync {
    fn vertex_count(&self) -> usize;

    /// The distance in f32 from one vertex's varyings to the next one's: a multiple of 2, so that
    /// two are copied at a time; one if there is one.
    fn stride(&self) -> usize;

    /// How many f32 are interpolated.
    fn varyings(&self) -> usize;

    /// Runs the vertex stage over some of the `used` vertices.
    fn run_vertices(
        &self,
        token: Token,
        used: Slots<'_>,
        slots: Range<usize>,
        viewport: Viewport,
        out: VertexDestination<'_>,
    );

    /// The clip-space position of a vertex.
    fn position(&self, token: Token, vertex: u32) -> Vec4;
}

/// Up to eight consecutive vertices: which they are, and where their varyings
/// go.
pub struct VertexLanes<'a> {
    first: usize,
    count: usize,
    /// Varyings of the vertices, vertex by vertex.
    varyings: &'a mut [f32],
    stride: usize,
}

impl<'a> VertexLanes<'a> {
    /// `varyings` has `stride` values for each of the `count` vertices.
    #[inline(always)]
    pub(crate) fn new(first: usize, count: usize, varyings: &'a mut [f32], stride: usize) -> Self {
        Self { first, count, varyings, stride }
    }

    /// Index of the vertex in the first lane.
    #[inline(always)]
    #[must_use]
    pub fn first(&self) -> usize {
        self.first
    }

    /// How many lanes there are, 1 to 8.
    #[inline(always)]
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// One number for each lane from an array over all vertices; 0 beyond its
    /// end.
    #[inline(always)]
    pub fn load<S: Simd>(&self, simd: S, values: &[f32]) -> F32<S> {
        let values = values.get(self.first..).unwrap_or(&[]);
        match values.first_chunk::<LANES>() {
            Some(chunk) => F32::simd_from(simd, *chunk),
            None => {
                let mut padded = [0.0; LANES];
                padded[..values.len()].copy_from_slice(values);
                F32::simd_from(simd, padded)
            }
        }
    }

    /// Stores the varying `index` of every lane.
    #[inline(always)]
    pub fn set<S: Simd>(&mut self, index: usize, value: F32<S>) {
        let value: [f32; LANES] = value.into();
        let rows = self.varyings.chunks_exact_mut(self.stride.max(1));
        for (row, value) in rows.zip(value) {
            row[index] = value;
        }
    }

    /// The varyings of one lane.
    #[inline(always)]
    pub(crate) fn of(&mut self, lane: usize) -> &mut [f32] {
        &mut self.varyings[lane * self.stride..(lane + 1) * self.stride]
    }
}

/// The vertices that a draw uses, each with a slot: its index among them.
#[derive(Debug, PartialEq)]
pub(crate) enum UsedVertices {
    /// All from the least to the greatest index.
    Range(Range<u32>),
    /// Few of many, ascending: this part of the frame's list.
    Listed(Range<u32>),
}

impl UsedVertices {
    /// The vertices that `indices` name, of those below `count`; a list of them is
    /// appended to that of the frame.
    ///
    /// A range costs nothing to look up, but may hold vertices that no index names;
    /// it is used if it is not much longer than the indices.
    pub(crate) fn new(indices: &[u32], count: usize, listed: &mut Vec<u32>) -> Self {
        // Running a vertex costs about as much as a few look-ups in a list.
        const WORTH_LISTING: usize = 4;
        if count <= indices.len() {
            return Self::all(count);
        }
        let exists = |index: &u32| (*index as usize) < count && *index < u32::MAX;
        let (mut least, mut beyond) = (u32::MAX, 0);
        for &index in indices.iter().filter(|index| exists(index)) {
            least = least.min(index);
            beyond = beyond.max(index + 1);
        }
        let range = least.min(beyond)..beyond;
        let is_full = listed.len() + indices.len() > u32::MAX as usize;
        if is_full || range.len() <= indices.len().saturating_mul(WORTH_LISTING) {
            return Self::Range(range);
        }
        let start = listed.len();
        listed.extend(indices.iter().copied().filter(exists));
        sort_and_dedup(listed, start);
        Self::Listed(start as u32..listed.len() as u32)
    }

    /// All vertices of a pipeline that an index may name, the greatest index left out.
    pub(crate) fn all(count: usize) -> Self {
        Self::Range(0..u32::try_from(count).unwrap_or(u32::MAX))
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Range(range) | Self::Listed(range) => range.len(),
        }
    }

    /// How slots are looked up, with the frame's list.
    pub(crate) fn slots<'a>(&self, listed: &'a [u32]) -> Slots<'a> {
        match self {
            Self::Range(range) => Slots { start: range.start, listed: None },
            Self::Listed(part) => {
                Slots { start: 0, listed: Some(&listed[part.start as usize..part.end as usize]) }
            }
        }
    }
}

/// Sorts a list from `start` on, and keeps one of equal entries.
fn sort_and_dedup(list: &mut Vec<u32>, start: usize) {
    list[start..].sort_unstable();
    let mut end = start;
    for at in start..list.len() {
        if end == start || list[end - 1] != list[at] {
            list[end] = list[at];
            end += 1;
        }
    }
    list.truncate(end);
}

/// Looks up the slots of vertices, and the vertices of slots.
#[derive(Clone, Copy)]
pub(crate) struct Slots<'a> {
    start: u32,
    listed: Option<&'a [u32]>,
}

impl Slots<'_> {
    /// One vertex.
    pub(crate) fn of_vertex(vertex: u32) -> Self {
        Self { start: vertex, listed: None }
    }

    /// The slot of a vertex; beyond the last slot if the draw has no such vertex.
    #[inline(always)]
    pub(crate) fn of(self, index: u32) -> usize {
        match self.listed {
            None => index.wrapping_sub(self.start) as usize,
            Some(listed) => search(listed, index),
        }
    }

    /// The vertex of a slot.
    #[inline]
    pub(crate) fn index(self, slot: usize) -> usize {
        match self.listed {
            None => self.start as usize + slot,
            Some(listed) => listed[slot] as usize,
        }
    }

    /// Whether vertices of neighbouring slots are neighbours.
    #[inline]
    pub(crate) fn are_consecutive(self) -> bool {
        self.listed.is_none()
    }
}

#[cold]
fn search(listed: &[u32], index: u32) -> usize {
    listed.binary_search(&index).unwrap_or(usize::MAX)
}

/// Looks up a draw's vertices by the indices that the draw uses.
#[derive(Clone, Copy)]
pub(crate) struct DrawVertices<'a> {
    pub(crate) slots: Slots<'a>,
    pub(crate) screen_vertices: &'a [ScreenVertex],
    pub(crate) pipeline: &'a dyn VertexProgram,
    pub(crate) token: Token,
}

impl<'a> DrawVertices<'a> {
    /// The vertex of an index; one that is not snapped and invalid if there is none.
    #[inline(always)]
    pub(crate) fn get(&self, index: u32) -> &'a ScreenVertex {
        self.screen_vertices.get(self.slots.of(index)).unwrap_or(&ScreenVertex::MISSING)
    }

    /// The planes beyond which a vertex lies; none for one that needs no cutting.
    pub(crate) fn outcode(&self, index: u32) -> Outcode {
        self.get(index).outcode()
    }

    /// The position of a vertex in clip space. It is not kept, because few triangles are cut: the
    /// pipeline computes it again. Pipelines must then return the same bits as in the vertex stage, or
    /// cracks would open to neighbours that are not cut.
    pub(crate) fn position(&self, index: u32) -> Vec4 {
        self.pipeline.position(self.token, index)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slots_and_vertices_belong_together() {
        for (indices, count) in [
            (vec![5, 7, 6, 5], 100),
            (vec![5, 7, 6, 5], 3),
            (vec![90, 3, 50, 3], 100),
            (vec![0, u32::MAX, u32::MAX - 1], usize::MAX),
            (vec![99, 100, 101], 100),
        ] {
            // Of another draw.
            let mut listed = vec![7, 90];
            let used = UsedVertices::new(&indices, count, &mut listed);
            let slots = used.slots(&listed);
            for &index in &indices {
                let slot = slots.of(index);
                // The greatest index names no vertex.
                let exists = (index as usize) < count && index < u32::MAX;
                assert_eq!(slot < used.len(), exists, "vertex {index} of {count} in {used:?}");
                assert!(!exists || slots.index(slot) == index as usize, "slot of {index}");
            }
        }
    }

    #[test]
    fn few_of_many_are_listed() {
        let mut listed = vec![9];
        let mut used = |indices: &[u32], count| UsedVertices::new(indices, count, &mut listed);
        assert_eq!(used(&[2, 9, 4], 10), UsedVertices::Range(2..10), "near each other");
        assert_eq!(used(&[900, 9, 9], 1000), UsedVertices::Listed(1..3), "far apart");
        assert_eq!(used(&[4, 5], 2), UsedVertices::Range(0..2), "not worth a look");
        assert_eq!(used(&[4, 5], 3).len(), 0, "none exists");
        assert_eq!(used(&[], 3).len(), 0, "none is asked for");
        assert_eq!(listed, [9, 9, 900], "each once, ascending, after what was there");
    }
}
