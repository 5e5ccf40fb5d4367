//! Elements that were met already.

/// A bit for each element.
pub(super) struct Marks(Vec<u64>);

impl Marks {
    pub(super) fn new(elements: usize) -> Self {
        Self(vec![0; elements.div_ceil(64)])
    }

    /// Marks an element; whether it was not marked before.
    pub(super) fn insert(&mut self, element: u32) -> bool {
        let (word, bit) = (&mut self.0[element as usize / 64], 1 << (element % 64));
        let is_new = *word & bit == 0;
        *word |= bit;
        is_new
    }
}
