//! The input of a pipeline's vertex stage: up to eight vertices.

use crate::simd::{F32, LANES, Simd, prelude::*};

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
