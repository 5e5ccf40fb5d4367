//! Sets and tables by index: lists as long as the mesh if an operation touches much of it, trees if
//! it touches little, so that the work is proportional to what is touched.

use std::collections::{BTreeMap, BTreeSet};

use fixedbitset::FixedBitSet;

use crate::edit_mesh::EditMesh;
use crate::ids::FaceId;

/// A list is used where at least one element of this many is touched. A list costs about a
/// nanosecond for 4 to 64 elements, a step in a tree some ten.
const DENSE: usize = 256;

fn is_dense(capacity: usize, expected: usize) -> bool {
    expected >= capacity / DENSE
}

/// Which elements belong to something.
pub(super) enum IndexSet {
    Dense(FixedBitSet),
    Sparse(BTreeSet<u32>),
}

impl IndexSet {
    /// An empty set of indices below `capacity`, which will have about `expected` elements.
    pub(super) fn new(capacity: usize, expected: usize) -> Self {
        if is_dense(capacity, expected) {
            Self::Dense(FixedBitSet::with_capacity(capacity))
        } else {
            Self::Sparse(BTreeSet::new())
        }
    }

    /// The set of some faces.
    pub(super) fn from_faces(mesh: &EditMesh, faces: &[FaceId]) -> Self {
        let mut set = Self::new(mesh.face_capacity(), faces.len());
        for face in faces {
            set.insert(face.0);
        }
        set
    }

    #[inline]
    pub(super) fn contains(&self, index: u32) -> bool {
        match self {
            Self::Dense(bits) => bits.contains(index as usize),
            Self::Sparse(tree) => tree.contains(&index),
        }
    }

    /// Whether the index is new.
    #[inline]
    pub(super) fn insert(&mut self, index: u32) -> bool {
        match self {
            Self::Dense(bits) => !bits.put(index as usize),
            Self::Sparse(tree) => tree.insert(index),
        }
    }
}

/// A number for some of the elements.
pub(super) enum IndexTable {
    /// One more than the number, 0 for none: zeroed memory costs nothing until it is touched.
    Dense(Vec<u32>),
    Sparse(BTreeMap<u32, u32>),
}

impl IndexTable {
    /// An empty table of indices below `capacity`, which will have about `expected` entries.
    pub(super) fn new(capacity: usize, expected: usize) -> Self {
        if is_dense(capacity, expected) {
            Self::Dense(vec![0; capacity])
        } else {
            Self::Sparse(BTreeMap::new())
        }
    }

    #[inline]
    pub(super) fn get(&self, index: u32) -> Option<u32> {
        match self {
            Self::Dense(list) => list[index as usize].checked_sub(1),
            Self::Sparse(tree) => tree.get(&index).copied(),
        }
    }

    #[inline]
    pub(super) fn insert(&mut self, index: u32, number: u32) {
        match self {
            Self::Dense(list) => list[index as usize] = number + 1,
            Self::Sparse(tree) => {
                tree.insert(index, number);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_tell_the_same() {
        for expected in [1, 1000] {
            let mut set = IndexSet::new(1000, expected);
            let mut table = IndexTable::new(1000, expected);
            assert!(set.insert(999) && !set.insert(999) && set.insert(0), "new ones are told");
            table.insert(999, 0);
            table.insert(3, 7);
            table.insert(3, 8);
            assert!(set.contains(0) && set.contains(999) && !set.contains(5), "{expected} expected");
            assert_eq!([table.get(999), table.get(3), table.get(4)], [Some(0), Some(8), None], "numbers");
        }
    }
}
