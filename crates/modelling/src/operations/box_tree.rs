//! A tree of boxes, to find the things whose boxes touch a shape or are near a point.

use std::ops::Range;

use smallvec::{SmallVec, smallvec};
use trigon_math::{Bounds3, DVec3};

/// A thing that has a box.
#[derive(Debug, Clone, Copy)]
pub(super) struct BoxItem {
    pub(super) bounds: Bounds3,
    /// By which it is sorted.
    pub(super) middle: DVec3,
}

/// A box around some items.
#[derive(Debug, Clone)]
struct TreeNode {
    bounds: Bounds3,
    /// The items, in the order of the tree.
    items: Range<u32>,
    /// The second of both children; the first one follows the node. `None` for a leaf.
    second: Option<u32>,
}

/// Items, by their index, in boxes within boxes.
pub(super) struct BoxTree {
    /// Items in the order of the tree.
    order: Vec<u32>,
    nodes: Vec<TreeNode>,
}

/// A leaf has at most this many items.
const LEAF: usize = 4;

/// Deep enough for most trees: each level is half of the one above.
const DEPTH: usize = 32;

impl BoxTree {
    /// Of items with finite boxes.
    pub(super) fn new(items: &[BoxItem]) -> Self {
        let count = items.len();
        let mut tree = Self { order: (0..count as u32).collect(), nodes: Vec::new() };
        // Ranges that are still to be divided, and which node waits for them as its second child.
        let mut waiting = if count == 0 { Vec::new() } else { vec![(0..count, None::<usize>)] };
        while let Some((range, parent)) = waiting.pop() {
            let node = tree.nodes.len();
            if let Some(parent) = parent {
                tree.nodes[parent].second = Some(node as u32);
            }
            let inside = &tree.order[range.clone()];
            let boxes = inside.iter().map(|&item| items[item as usize].bounds);
            let bounds = boxes.fold(Bounds3::EMPTY, Bounds3::union);
            let numbers = range.start as u32..range.end as u32;
            tree.nodes.push(TreeNode { bounds, items: numbers, second: None });
            if range.len() > LEAF {
                let middle = range.start + divide(&mut tree.order[range.clone()], items);
                waiting.push((middle..range.end, Some(node)));
                // The first child is made next.
                waiting.push((range.start..middle, None));
            }
        }
        tree
    }

    /// Calls back with all items in leaves whose boxes, and all boxes around them, touch a shape; in any order.
    pub(super) fn for_each_touching(&self, touches: impl Fn(&Bounds3) -> bool, mut call: impl FnMut(u32)) {
        let mut waiting: SmallVec<[u32; DEPTH]> = (0..self.nodes.len().min(1) as u32).collect();
        while let Some(index) = waiting.pop() {
            let node = &self.nodes[index as usize];
            if !touches(&node.bounds) {
                continue;
            }
            match node.second {
                Some(second) => waiting.extend([second, index + 1]),
                None => self.items_of(node).iter().for_each(|&item| call(item)),
            }
        }
    }

    /// Calls back with items, those in near boxes first. The call returns the squared distance from the point beyond
    /// which nothing matters any more.
    pub(super) fn for_each_near(&self, point: DVec3, mut call: impl FnMut(u32) -> f64) {
        let Some(root) = self.nodes.first() else { return };
        let mut limit = f64::INFINITY;
        let mut waiting: SmallVec<[(f64, u32); DEPTH]> = smallvec![(root.squared_distance(point), 0)];
        while let Some((distance, index)) = waiting.pop() {
            if distance > limit {
                continue;
            }
            let node = &self.nodes[index as usize];
            let Some(second) = node.second else {
                self.items_of(node).iter().for_each(|&item| limit = call(item));
                continue;
            };
            let children =
                [index + 1, second].map(|child| (self.nodes[child as usize].squared_distance(point), child));
            let [near, far] = if children[1].0 < children[0].0 { [1, 0] } else { [0, 1] };
            waiting.extend([children[far], children[near]]);
        }
    }

    fn items_of(&self, node: &TreeNode) -> &[u32] {
        &self.order[node.items.start as usize..node.items.end as usize]
    }
}

/// Sorts a part of the order by halves along the longest side of the box around the items' middles; the length of the first
/// half.
fn divide(order: &mut [u32], items: &[BoxItem]) -> usize {
    let middle = |item: u32| items[item as usize].middle;
    let size = Bounds3::from_points(order.iter().map(|&item| middle(item))).size();
    let axis = if size.x >= size.y && size.x >= size.z { 0 } else { 1 + usize::from(size.z > size.y) };
    let half = order.len() / 2;
    order.select_nth_unstable_by(half, |&a, &b| middle(a)[axis].total_cmp(&middle(b)[axis]).then(a.cmp(&b)));
    half
}

impl TreeNode {
    /// The squared distance of a point from the box.
    fn squared_distance(&self, point: DVec3) -> f64 {
        let outside = (self.bounds.min - point).max(point - self.bounds.max).max(DVec3::ZERO);
        outside.length_squared()
    }
}
