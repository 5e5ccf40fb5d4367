//! Sets of vertices, edges or faces of several nodes, and marks: elements shown in colours of their own, such as the
//! selection, seams and creases.

use std::collections::BTreeMap;
use std::sync::Arc;

use fixedbitset::FixedBitSet;
use rayon::prelude::*;
use trigon_math::{Vec3, Vec4};
use trigon_raster::MarkColors;

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

/// Vertices, edges and faces in their own colours.
///
/// Each list is in order of priority: an element in several sets has the colour of the first. An
/// editor would list the selected edges first, then sharp ones, seams and creases. Only the first
/// [`MOST`](Self::MOST) of each list are shown.
///
/// Marks cost no vertices and rebuild no geometry: the sets are looked up for visible triangles. To
/// change the marks, pass other sets.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Marks {
    /// Edges, by their numbers in the mesh: see [`Mesh::edges`](trigon_mesh::Mesh::edges). Marked edges have
    /// the same width as all edges unless they are [outlined](Mark::outlined), and are shown in styles with edges.
    pub edges: Vec<Mark>,
    /// Faces; their colours are mixed with the mark's.
    pub faces: Vec<Mark>,
    /// Vertices, if [`RenderSettings::vertices`](crate::RenderSettings::vertices) shows them.
    pub vertices: Vec<Mark>,
}

/// Elements of one kind with their colour.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// Shared with the creator of the selection: nothing is copied per frame.
    pub elements: Arc<ElementSet>,
    /// Linear RGB.
    pub color: Vec3,
    /// Opacity from 0 to 1; at 0 edges and vertices are not painted at all, not even in another
    /// colour. Lines of [`Style::Wireframe`](crate::Style::Wireframe) and other vertices are always
    /// opaque.
    pub opacity: f32,
    /// Whether marked edges of faces are twice as wide as others, with a black outline, so that they are seen on any
    /// surface. Faces, vertices, loose edges and wireframes have no outlines.
    pub outlined: bool,
}

/// How vertices are shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexPoints {
    /// Diameter in pixels.
    pub size: f32,
    /// The diameter of marked vertices.
    pub marked_size: f32,
    /// Linear RGB of unmarked vertices.
    pub color: Vec3,
}

impl Default for VertexPoints {
    /// Small and black, marked ones larger.
    fn default() -> Self {
        Self { size: 3.0, marked_size: 5.0, color: Vec3::ZERO }
    }
}

impl Marks {
    /// The maximum length of a list.
    pub const MOST: usize = MarkColors::COUNT - 1;

    /// Whether there are no marked edges or faces.
    pub(crate) fn is_plain(&self) -> bool {
        self.edges.is_empty() && self.faces.is_empty()
    }

    /// The colours of edges and faces.
    pub(crate) fn colors(&self) -> MarkColors {
        let mut outlined = [false; MarkColors::COUNT];
        for (mark, outlined) in self.edges.iter().zip(outlined[1..].iter_mut().rev()) {
            *outlined = mark.outlined;
        }
        MarkColors { edges: colors(&self.edges), faces: colors(&self.faces), outlined }
    }
}

/// The colours of marks by their numbers: the first of a list has the greatest number.
pub(crate) fn colors(marks: &[Mark]) -> [Vec4; MarkColors::COUNT] {
    let mut colors = [Vec4::ZERO; MarkColors::COUNT];
    for (mark, color) in marks.iter().zip(colors[1..].iter_mut().rev()) {
        *color = mark.color.extend(mark.opacity);
    }
    colors
}

/// Bits in a word of a set.
const WORD: usize = usize::BITS as usize;

/// Elements that a thread takes at a time: whole words.
const SHARE: usize = 256 * WORD;

/// The number of each element of a node, 0 without a mark, up to the last one that may have a mark.
pub(crate) fn numbers(marks: &[Mark], node: NodeId) -> Vec<u8> {
    let marks = &marks[..marks.len().min(Marks::MOST)];
    let sets = || marks.iter().enumerate().filter_map(|(index, mark)| Some((index, mark.elements.of(node)?)));
    let count = sets().map(|(_, bits)| bits.len()).max().unwrap_or(0);
    let mut numbers = vec![0; count];
    // The first has priority, so it comes last.
    let sets: Vec<_> = sets().collect();
    numbers.par_chunks_mut(SHARE).enumerate().for_each(|(share, numbers)| {
        for &(index, bits) in sets.iter().rev() {
            let words = bits.as_slice().iter().skip(share * (SHARE / WORD));
            for (own, &word) in numbers.chunks_mut(WORD).zip(words) {
                let mut rest = word;
                while rest != 0 {
                    own[rest.trailing_zeros() as usize] = (Marks::MOST - index) as u8;
                    rest &= rest - 1;
                }
            }
        }
    });
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FixedBitSet, Node, Scene};

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

    fn mark(node: NodeId, elements: &[usize], red: f32) -> Mark {
        let mut bits = FixedBitSet::with_capacity(8);
        bits.extend(elements.iter().copied());
        let mut set = ElementSet::default();
        set.add(node, bits);
        Mark { elements: Arc::new(set), color: Vec3::new(red, 0.0, 0.0), opacity: 1.0, outlined: false }
    }

    #[test]
    fn the_first_mark_of_an_element_gives_its_colour() {
        let mut scene = Scene::default();
        let [node, other] = [0, 1].map(|_| scene.add(Node::default()));
        let marks: Vec<_> =
            [mark(node, &[1, 2], 0.1), mark(node, &[2, 3], 0.2), mark(other, &[5], 0.3)].into();
        let (numbers, colors) = (numbers(&marks, node), colors(&marks));
        let reds: Vec<_> = numbers.iter().map(|&number| colors[usize::from(number)].x).collect();
        assert_eq!(reds, [0.0, 0.1, 0.1, 0.2, 0.0, 0.0, 0.0, 0.0], "the others have none");
    }

    #[test]
    fn each_of_many_elements_has_the_number_of_the_first_set_that_holds_it() {
        let mut scene = Scene::default();
        let node = scene.add(Node::default());
        let counts = [2 * SHARE + 100, SHARE + 1];
        let is_in = |set: usize, element: usize| element < counts[set] && element % (5 - set) == 1;
        let marks: Vec<_> = [0, 1]
            .map(|set| {
                let mut bits = FixedBitSet::with_capacity(counts[set]);
                bits.extend((0..counts[set]).filter(|&element| is_in(set, element)));
                let mut elements = ElementSet::default();
                elements.add(node, bits);
                Mark { elements: Arc::new(elements), color: Vec3::ONE, opacity: 1.0, outlined: false }
            })
            .into();
        let expected = (0..counts[0]).map(|element| match [0, 1].map(|set| is_in(set, element)) {
            [true, _] => 15,
            [false, true] => 14,
            [false, false] => 0,
        });
        assert!(numbers(&marks, node).into_iter().eq(expected));
    }

    #[test]
    fn marks_beyond_the_last_are_not_shown() {
        let mut scene = Scene::default();
        let node = scene.add(Node::default());
        let marks: Vec<_> = (0..40).map(|element| mark(node, &[element % 8], 1.0)).collect();
        assert_eq!(numbers(&marks, node), [15, 14, 13, 12, 11, 10, 9, 8], "the first of each");
        assert_eq!(colors(&marks)[0], Vec4::ZERO, "without a mark");
        assert!(numbers(&marks[..0], node).is_empty(), "nothing to be looked up");
    }
}
