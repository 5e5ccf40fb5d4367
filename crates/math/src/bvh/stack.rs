//! The boxes that a ray has yet to visit.

use super::wide::WIDTH;

/// Entries that need no allocation. A balanced tree over 2³² triangles has 11 levels, each of which leaves 7 boxes at most.
const FEW: usize = 64;

/// Boxes to visit, the next one last.
pub(super) struct Stack<T> {
    few: [T; FEW],
    count: usize,
    /// The entries below these, for lopsided trees.
    more: Vec<T>,
}

/// A box, and where a ray enters it.
#[derive(Clone, Copy)]
pub(super) struct Entered<T> {
    pub(super) near: f32,
    pub(super) child: T,
}

impl<T: Copy> Stack<T> {
    /// An empty one; the entry is of no importance.
    #[inline(always)]
    pub(super) fn new(entry: T) -> Self {
        Self { few: [entry; FEW], count: 0, more: Vec::new() }
    }

    #[inline(always)]
    pub(super) fn pop(&mut self) -> Option<T> {
        if self.count == 0 {
            return self.more.pop();
        }
        self.count -= 1;
        Some(self.few[self.count % FEW])
    }

    /// Makes room for the boxes of a node. To be called before they are tested: vectors do not survive a call.
    #[inline(always)]
    pub(super) fn reserve(&mut self) {
        if self.count + WIDTH > FEW {
            spill(&mut self.more, &self.few[..self.count]);
            self.count = 0;
        }
    }

    /// Adds an entry; there must be room.
    #[inline(always)]
    pub(super) fn push(&mut self, entry: T) {
        self.few[self.count % FEW] = entry;
        self.count += 1;
    }

    /// Entries above those that were moved away.
    #[inline(always)]
    pub(super) fn count(&self) -> usize {
        self.count
    }
}

impl<T: Copy> Stack<Entered<T>> {
    /// Adds an entry to those from `first` on, of which the nearest comes last; there must be room.
    #[inline(always)]
    pub(super) fn push_sorted(&mut self, entry: Entered<T>, first: usize) {
        self.push(entry);
        let mut slot = (self.count - 1) % FEW;
        while slot > first && self.few[slot - 1].near < self.few[slot].near {
            self.few.swap(slot - 1, slot);
            slot -= 1;
        }
    }
}

#[cold]
#[inline(never)]
fn spill<T: Copy>(more: &mut Vec<T>, few: &[T]) {
    more.extend_from_slice(few);
}
