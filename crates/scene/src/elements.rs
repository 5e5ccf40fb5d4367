//! Sets of vertices, edges or faces of several nodes.

use std::collections::BTreeMap;

use fixedbitset::FixedBitSet;

use crate::node::NodeId;

/// Elements of one kind (vertices, edges or faces) of nodes, with one bit for each element of a
/// node's mesh. Nodes without elements in the set are not stored.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ElementSet {
    nodes: BTreeMap<NodeId, FixedBitSet>,
}

impl ElementSet {
    /// The number of elements of all nodes.
    #[must_use]
    pub fn len(&self) -> usize {
        self.nodes.values().map(|bits| bits.count_ones(..)).sum()
    }

    /// Whether the set is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Whether an element of a node is in the set.
    #[must_use]
    pub fn contains(&self, node: NodeId, element: u32) -> bool {
        self.of(node).is_some_and(|bits| bits.contains(element as usize))
    }

    /// The elements of a node, one bit for each element of its mesh; `None` if there are none.
    #[must_use]
    pub fn of(&self, node: NodeId) -> Option<&FixedBitSet> {
        self.nodes.get(&node)
    }

    /// The nodes with their elements, in order.
    pub fn nodes(&self) -> impl Iterator<Item = (NodeId, &FixedBitSet)> {
        self.nodes.iter().map(|(&node, bits)| (node, bits))
    }

    /// All elements with their nodes, in the order of nodes and of elements.
    pub fn iter(&self) -> impl Iterator<Item = (NodeId, u32)> + '_ {
        self.nodes().flat_map(|(node, bits)| bits.ones().map(move |element| (node, element as u32)))
    }

    /// Adds elements of a node: one bit for each element of its mesh.
    pub fn add(&mut self, node: NodeId, bits: FixedBitSet) {
        if !bits.is_clear() {
            match self.nodes.get_mut(&node) {
                Some(known) => known.union_with(&bits),
                None => drop(self.nodes.insert(node, bits)),
            }
        }
    }
}
