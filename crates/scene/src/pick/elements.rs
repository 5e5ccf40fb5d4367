//! Sets of elements that are filled one by one.

use fixedbitset::FixedBitSet;

use trigon_mesh::Mesh;

use super::object::PickObject;
use crate::elements::ElementSet;

/// A set that grows element by element.
pub(super) struct Sets<'o, 's, C> {
    objects: &'o [Option<PickObject<'s>>],
    count: C,
    bits: Vec<FixedBitSet>,
}

impl<'o, 's, C: Fn(&Mesh) -> usize> Sets<'o, 's, C> {
    /// `count` tells how many elements a mesh has.
    pub(super) fn new(objects: &'o [Option<PickObject<'s>>], count: C) -> Self {
        Self { objects, count, bits: vec![FixedBitSet::new(); objects.len()] }
    }

    /// Adds an element of the node with this index, if there is such an element.
    #[inline]
    pub(super) fn insert(&mut self, object: u32, element: u32) {
        let Some(bits) = self.bits.get_mut(object as usize) else { return };
        if bits.is_empty() {
            // Its first.
            let Some(object) = &self.objects[object as usize] else { return };
            bits.grow((self.count)(object.mesh()));
        }
        if (element as usize) < bits.len() {
            bits.insert(element as usize);
        }
    }

    pub(super) fn finish(self) -> ElementSet {
        let mut set = ElementSet::default();
        for (object, bits) in self.objects.iter().zip(self.bits) {
            if let Some(object) = object {
                set.add(object.node, bits);
            }
        }
        set
    }
}
