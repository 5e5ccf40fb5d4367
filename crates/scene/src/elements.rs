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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Node, Scene};

    fn bits(elements: &[usize]) -> FixedBitSet {
        let mut bits = FixedBitSet::with_capacity(10);
        elements.iter().for_each(|&element| bits.insert(element));
        bits
    }

    #[test]
    fn sets_hold_what_was_added() {
        let mut scene = Scene::new();
        let nodes = [(); 3].map(|()| scene.add(Node::default()));
        let mut set = ElementSet::default();
        set.add(nodes[1], bits(&[]));
        assert!(set.is_empty() && set == ElementSet::default(), "nothing is no element");
        assert_eq!(set.len(), 0);
        set.add(nodes[2], bits(&[7]));
        set.add(nodes[0], bits(&[1, 4]));
        set.add(nodes[0], bits(&[4, 9]));
        assert!(!set.is_empty());
        assert_eq!(set.len(), 4, "each once");
        let elements: Vec<_> = set.iter().collect();
        assert_eq!(elements, [(nodes[0], 1), (nodes[0], 4), (nodes[0], 9), (nodes[2], 7)], "in order");
        for (place, node) in nodes.into_iter().enumerate() {
            for element in 0..12 {
                let expected = elements.contains(&(node, element));
                assert_eq!(set.contains(node, element), expected, "{element} of node {place}");
            }
            assert_eq!(set.of(node).is_some(), place != 1, "node {place}");
        }
        let listed: Vec<_> = set.nodes().map(|(node, bits)| (node, bits.count_ones(..))).collect();
        assert_eq!(listed, [(nodes[0], 3), (nodes[2], 1)]);
    }
}
