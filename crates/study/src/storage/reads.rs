//! Lists that count the indices that are read from them.

use super::answer::byte_count;
use std::cell::Cell;

/// Counts where `COUNTED` is set. Elsewhere it does nothing, so that what is timed is the bare list.
#[derive(Default)]
pub(super) struct Reads<const COUNTED: bool>(Cell<u64>);

impl<const COUNTED: bool> Reads<COUNTED> {
    /// Hands on an index that has been read.
    #[inline]
    pub(super) fn note(&self, index: u32) -> u32 {
        if COUNTED {
            self.0.set(self.0.get() + 1);
        }
        index
    }

    pub(super) fn count(&self) -> u64 {
        self.0.get()
    }
}

/// A list whose elements consist of indices.
pub(super) struct List<T, const COUNTED: bool> {
    elements: Vec<T>,
    reads: Reads<COUNTED>,
}

impl<T, const COUNTED: bool> List<T, COUNTED> {
    pub(super) fn new(elements: Vec<T>) -> Self {
        Self { elements, reads: Reads::default() }
    }

    /// Reads those indices of an element that `part` picks.
    #[inline]
    pub(super) fn read<const N: usize>(&self, element: u32, part: impl Fn(&T) -> [u32; N]) -> [u32; N] {
        part(&self.elements[element as usize]).map(|index| self.reads.note(index))
    }

    pub(super) fn bytes(&self) -> usize {
        byte_count(&self.elements)
    }

    pub(super) fn reads(&self) -> u64 {
        self.reads.count()
    }
}

impl<const COUNTED: bool> List<u32, COUNTED> {
    /// Reads an index.
    #[inline]
    pub(super) fn at(&self, element: u32) -> u32 {
        self.read(element, |&index| [index])[0]
    }
}
