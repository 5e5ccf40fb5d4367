//! Sets of vertices, edges or faces of several nodes.

use std::collections::BTreeMap;

use fixedbitset::FixedBitSet;

use trigon_mesh::Mesh;

use super::object::Object;
use crate::scene::NodeId;

/// Elements of one kind (vertices, edges or faces) of nodes, as one bit for each element
/// of a node's mesh. Nodes of which there is none are left out.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ElementSet {
    nodes: BTreeMap<NodeId, FixedBitSet>,
}

impl ElementSet {
    /// How many elements there are, of all nodes.
    #[must_use]
    pub fn len(&self) -> usize {
        self.nodes.values().map(|bits| bits.count_ones(..)).sum()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Whether an element of a node is in the set.
    #[must_use]
    pub fn contains(&self, node: NodeId, element: u32) -> bool {
        self.of(node).is_some_and(|bits| bits.contains(element as usize))
    }

    /// The elements of a node, one bit for each that its mesh has; `None` without any.
    #[must_use]
    pub fn of(&self, node: NodeId) -> Option<&FixedBitSet> {
        self.nodes.get(&node)
    }

    /// The nodes with their elements, in their order.
    pub fn nodes(&self) -> impl Iterator<Item = (NodeId, &FixedBitSet)> {
        self.nodes.iter().map(|(&node, bits)| (node, bits))
    }

    /// All elements with their nodes, in the order of nodes and of elements.
    pub fn iter(&self) -> impl Iterator<Item = (NodeId, u32)> + '_ {
        self.nodes().flat_map(|(node, bits)| bits.ones().map(move |element| (node, element as u32)))
    }

    /// Adds the elements of a node.
    pub(super) fn add(&mut self, node: NodeId, bits: FixedBitSet) {
        if !bits.is_clear() {
            match self.nodes.get_mut(&node) {
                Some(known) => known.union_with(&bits),
                None => drop(self.nodes.insert(node, bits)),
            }
        }
    }
}

/// A set that grows element by element.
pub(super) struct Sets<'o, 's, C> {
    objects: &'o [Option<Object<'s>>],
    count: C,
    bits: Vec<FixedBitSet>,
}

impl<'o, 's, C: Fn(&Mesh) -> usize> Sets<'o, 's, C> {
    /// `count` tells how many elements a mesh has.
    pub(super) fn new(objects: &'o [Option<Object<'s>>], count: C) -> Self {
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
