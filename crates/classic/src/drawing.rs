//! The result of every algorithm.

use super::Field;

/// What an image shows, and what it took to find out.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// The number of the face in each pixel, `u32::MAX` for none.
    pub faces: Field<u32>,
    /// The algorithm's own unit of work; see [`Method::test`](super::Method::test). 0 where it is not
    /// counted.
    pub tests: u64,
}

impl Drawing {
    pub(super) fn empty(size: [usize; 2]) -> Self {
        Self { faces: Field::new(size, u32::MAX), tests: 0 }
    }

    pub(super) fn clear(&mut self) {
        self.faces.clear(u32::MAX);
        self.tests = 0;
    }
}
