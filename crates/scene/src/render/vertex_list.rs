//! The vertices of a mesh that are drawn as points.

use std::collections::HashMap;
use std::mem::take;
use std::sync::{Arc, Mutex, PoisonError};

use fixedbitset::FixedBitSet;
use rayon::prelude::*;

use crate::marks::{self, Mark};
use crate::node::NodeId;

/// Vertices that a thread takes at a time.
const SHARE: usize = 1 << 14;

/// The vertices of a mesh at a node that are shown as points, with their marks. The lists are shared
/// with the last image, which compares them with those of the next.
#[derive(Clone)]
pub(super) struct VertexList {
    /// Increasing.
    pub(super) points: Arc<Vec<u32>>,
    /// The number of the mark of each point, 0 without one.
    pub(super) numbers: Arc<Vec<u8>>,
    /// The points that have a mark.
    pub(super) marked: Arc<FixedBitSet>,
}

impl VertexList {
    /// The used vertices, without those that a mark hides.
    fn new(node: NodeId, used: &[bool], marks: &[Mark]) -> Self {
        let (of_vertices, colors) = (marks::numbers(marks, node), marks::colors(marks));
        let starts: Vec<usize> = (0..used.len()).step_by(SHARE).collect();
        let shares = starts.into_par_iter().map(|start| {
            let share = start..used.len().min(start + SHARE);
            let (mut points, mut numbers) = (Vec::with_capacity(SHARE), Vec::with_capacity(SHARE));
            for vertex in share.filter(|&vertex| used[vertex]) {
                let number = of_vertices.get(vertex).copied().unwrap_or(0);
                if number == 0 || colors[usize::from(number)].w > 0.0 {
                    points.push(vertex as u32);
                    numbers.push(number);
                }
            }
            (points, numbers)
        });
        let (points, numbers): (Vec<Vec<u32>>, Vec<Vec<u8>>) = shares.unzip();
        let (points, numbers) = (points.concat(), numbers.concat());
        let word = |numbers: &[u8]| {
            numbers.iter().rev().fold(0, |word, &number| word << 1 | usize::from(number != 0))
        };
        let words = numbers.chunks(usize::BITS as usize).map(word);
        let marked = FixedBitSet::with_capacity_and_blocks(numbers.len(), words);
        Self { points: Arc::new(points), numbers: Arc::new(numbers), marked: Arc::new(marked) }
    }
}

/// The lists of the last frame, most of which the next one shows again.
#[derive(Default)]
pub(super) struct VertexLists(Mutex<TwoFrames>);

#[derive(Default)]
struct TwoFrames {
    last: HashMap<NodeId, KnownList>,
    now: HashMap<NodeId, KnownList>,
}

/// A list, and what it was made from.
struct KnownList {
    used: Arc<Vec<bool>>,
    marks: Vec<Mark>,
    list: VertexList,
}

impl VertexLists {
    /// Begins a frame: forgets lists that the last one did not use.
    pub(super) fn begin(&mut self) {
        let TwoFrames { last, now } = self.0.get_mut().unwrap_or_else(PoisonError::into_inner);
        *last = take(now);
    }

    /// The used vertices of a node's mesh, without those that a mark hides.
    pub(super) fn of(&self, node: NodeId, used: &Arc<Vec<bool>>, marks: &[Mark]) -> VertexList {
        let mut frames = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let TwoFrames { last, now } = &mut *frames;
        let known = now.remove(&node).or_else(|| last.remove(&node));
        let known = known.filter(|known| known.is_of(used, marks)).unwrap_or_else(|| KnownList {
            used: Arc::clone(used),
            marks: marks.to_vec(),
            list: VertexList::new(node, used, marks),
        });
        now.entry(node).insert_entry(known).get().list.clone()
    }
}

impl KnownList {
    /// Whether it was made from the same. Sets that were made anew may be equal, but comparing them takes long.
    fn is_of(&self, used: &Arc<Vec<bool>>, marks: &[Mark]) -> bool {
        let are_same = |(one, other): (&Mark, &Mark)| {
            Arc::ptr_eq(&one.elements, &other.elements)
                && (one.color, one.opacity) == (other.color, other.opacity)
        };
        Arc::ptr_eq(&self.used, used)
            && self.marks.len() == marks.len()
            && self.marks.iter().zip(marks).all(are_same)
    }
}

#[cfg(test)]
mod tests {
    use fixedbitset::FixedBitSet;
    use trigon_math::Vec3;

    use super::*;
    use crate::{ElementSet, Node, Scene};

    #[test]
    fn a_list_is_kept_as_long_as_nothing_of_it_changes() {
        let mut scene = Scene::new();
        let [node, other] = [(); 2].map(|()| scene.add(Node::default()));
        let used = Arc::new(vec![true, false, true, true]);
        let mark = |hidden: usize, opacity: f32| {
            let mut bits = FixedBitSet::with_capacity(4);
            bits.insert(hidden);
            let mut elements = ElementSet::default();
            elements.add(node, bits);
            Mark { elements: Arc::new(elements), color: Vec3::ONE, opacity }
        };
        let (marked, transparent) = (vec![mark(2, 1.0)], vec![mark(2, 0.0)]);
        let mut lists = VertexLists::default();
        let mut points = |node: NodeId, used: &Arc<Vec<bool>>, marks: &[Mark]| {
            lists.begin();
            lists.of(node, used, marks).points
        };
        let first = points(node, &used, &marked);
        assert_eq!(*first, [0, 2, 3], "the used ones");
        assert!(Arc::ptr_eq(&first, &points(node, &used, &marked)), "the same list");
        assert_eq!(*points(node, &used, &transparent), [0, 3], "a mark hides one");
        assert_eq!(*points(node, &Arc::new(vec![true; 2]), &transparent), [0, 1], "of another mesh");
        assert_eq!(*points(other, &used, &marked), [0, 2, 3], "of another node");
        let again = points(node, &used, &marked);
        assert!(*again == *first && !Arc::ptr_eq(&again, &first), "it was not shown meanwhile");
    }
}
