//! Up to eight primitives of one draw, to be set up together.

use crate::simd::{InlineMap, LANES, lanes_of};

/// One primitive in each lane; unused lanes repeat the last one.
pub(crate) struct EightPrimitives<'p, T> {
    /// Their numbers in the draw, increasing.
    pub(crate) numbers: [u32; LANES],
    /// The indices of their vertices.
    pub(crate) indices: [&'p T; LANES],
    count: usize,
}

impl<'p, T> EightPrimitives<'p, T> {
    /// Consecutive ones from `first` on; at least one.
    #[inline(always)]
    pub(crate) fn consecutive(first: u32, indices: &'p [T]) -> Self {
        // Nearly always eight.
        if let Some(eight) = indices.first_chunk::<LANES>() {
            let numbers = lanes_of(
                #[inline(always)]
                |lane| first + lane as u32,
            );
            return Self { numbers, indices: eight.each_ref(), count: LANES };
        }
        let last = indices.len() - 1;
        let numbers = lanes_of(
            #[inline(always)]
            |lane| first + lane.min(last) as u32,
        );
        let indices = lanes_of(
            #[inline(always)]
            |lane| &indices[lane.min(last)],
        );
        Self { numbers, indices, count: last + 1 }
    }

    /// Those with the given numbers, at least one, of all of the draw.
    #[inline(always)]
    pub(crate) fn listed(numbers: &[u32], all: &'p [T]) -> Self {
        let last = numbers.len() - 1;
        let numbers = lanes_of(
            #[inline(always)]
            |lane| numbers[lane.min(last)],
        );
        let indices = numbers.each(
            #[inline(always)]
            |number| &all[number as usize],
        );
        Self { numbers, indices, count: last + 1 }
    }

    /// A bit for each lane that is used.
    #[inline(always)]
    pub(crate) fn lanes(&self) -> u64 {
        (1 << self.count) - 1
    }
}
