//! Building: triangles are split where this is expected to save the most tests.

use glam::Vec3;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use super::Bvh;
use super::extent::Extent;
use super::wide::{Child, Leaf, Node, WIDTH};
use crate::simd::Token;

/// More bins split better and build slower; beyond sixteen there is hardly any gain.
const BINS: usize = 16;

/// The box and the centre of one triangle.
#[derive(Clone, Copy)]
struct Item {
    min: Vec3,
    max: Vec3,
    number: u32,
}

impl Item {
    /// Twice the centre of the box.
    fn middle(&self) -> Vec3 {
        self.min + self.max
    }
}

impl Bvh {
    /// A hierarchy over triangles, numbered in their order, built by the threads of the current rayon pool. No ray hits a
    /// triangle with a coordinate that is not finite.
    #[must_use]
    pub fn new(triangles: &[[Vec3; 3]]) -> Self {
        let usable = |corners: &[Vec3; 3]| corners.iter().all(|corner| corner.is_finite());
        let numbered = (0_u32..).zip(triangles).filter(|(_, corners)| usable(corners));
        let mut items: Vec<Item> = numbered.map(|(number, corners)| item(number, corners)).collect();
        let extent = extent_of(&items);
        let extent = if items.is_empty() { [Vec3::ZERO; 2] } else { [extent.min, extent.max] };
        let mut tree = Subtree::default();
        let root = tree.grow(&mut items, triangles);
        let Subtree { nodes, leaves } = tree;
        let mut tree =
            Self { root, nodes, leaves, len: items.len(), extent, cost: 0.0, level: Token::best() };
        tree.cost = tree.expected_cost();
        tree
    }
}

/// Nodes and leaves of some items.
#[derive(Default)]
struct Subtree {
    nodes: Vec<Node>,
    leaves: Vec<Leaf>,
}

impl Subtree {
    /// Adds the nodes of some items, which it reorders, children first. The
    /// depth of the recursion is bounded by splitting in the middle if the bins do not split well.
    fn grow(&mut self, items: &mut [Item], triangles: &[[Vec3; 3]]) -> Child {
        /// Fewer items are faster on one thread.
        const FOR_THREADS: usize = 16_384;
        if items.len() <= WIDTH {
            let numbered = items.iter().map(|item| (item.number, triangles[item.number as usize]));
            self.leaves.push(Leaf::new(numbered));
            return Child::leaf(self.leaves.len() - 1);
        }
        let mut node = Node::EMPTY;
        if items.len() < FOR_THREADS {
            for (slot, (extent, group)) in groups(items).into_iter().enumerate() {
                node.set(slot, extent.min, extent.max, self.grow(group, triangles));
            }
        } else {
            let grown = |(extent, group): (Extent, &mut [Item])| {
                let mut subtree = Self::default();
                let root = subtree.grow(group, triangles);
                (extent, subtree, root)
            };
            let grown: Vec<(Extent, Self, Child)> = groups(items).into_par_iter().map(grown).collect();
            for (slot, (extent, subtree, root)) in grown.into_iter().enumerate() {
                let (nodes, leaves) = (self.nodes.len(), self.leaves.len());
                self.append(subtree);
                node.set(slot, extent.min, extent.max, root.moved(nodes, leaves));
            }
        }
        self.nodes.push(node);
        Child::node(self.nodes.len() - 1)
    }

    fn append(&mut self, subtree: Self) {
        let (nodes, leaves) = (self.nodes.len(), self.leaves.len());
        let moved =
            |node: Node| Node { children: node.children.map(|child| child.moved(nodes, leaves)), ..node };
        self.nodes.extend(subtree.nodes.into_iter().map(moved));
        self.leaves.extend(subtree.leaves);
    }
}

/// Splits items in two, then the part with the largest box that is not a leaf, and so on until the
/// node is full.
fn groups(items: &mut [Item]) -> Vec<(Extent, &mut [Item])> {
    let mut groups = vec![boxed(items)];
    while groups.len() < WIDTH {
        let worth = |(extent, items): &(Extent, &mut [Item])| {
            if items.len() > WIDTH { extent.half_area() } else { f32::NEG_INFINITY }
        };
        let largest = (1..groups.len())
            .fold(0, |best, index| if worth(&groups[index]) > worth(&groups[best]) { index } else { best });
        if groups[largest].1.len() <= WIDTH {
            break;
        }
        let (_, items) = groups.swap_remove(largest);
        let middle = split(items);
        let (first, second) = items.split_at_mut(middle);
        groups.extend([boxed(first), boxed(second)]);
    }
    // The largest first: rays that look for any hit visit them in this order.
    groups.sort_by(|(a, _), (b, _)| b.half_area().total_cmp(&a.half_area()));
    groups
}

fn boxed(items: &mut [Item]) -> (Extent, &mut [Item]) {
    (extent_of(items), items)
}

fn extent_of(items: &[Item]) -> Extent {
    let mut extent = Extent::EMPTY;
    items.iter().for_each(|item| extent.add(item.min, item.max));
    extent
}

fn item(number: u32, corners: &[Vec3; 3]) -> Item {
    let mut extent = Extent::EMPTY;
    corners.iter().for_each(|&corner| extent.add(corner, corner));
    Item { min: extent.min, max: extent.max, number }
}

/// Moves the items of one side before those of the other, and returns the number of the first.
fn split(items: &mut [Item]) -> usize {
    let mut middles = Extent::EMPTY;
    items.iter().for_each(|item| middles.add(item.middle(), item.middle()));
    let size = middles.max - middles.min;
    let axis = size
        .to_array()
        .into_iter()
        .enumerate()
        .fold((0, 0.0), |best, (axis, size)| if size > best.1 { (axis, size) } else { best });
    let half = items.len() / 2;
    let (axis, size) = axis;
    let scale = BINS as f32 / size;
    if size <= 0.0 || !scale.is_finite() {
        return half;
    }
    let bin = |item: &Item| {
        let bin = (item.middle()[axis] - middles.min[axis]) * scale;
        if bin < BINS as f32 { bin as usize } else { BINS - 1 }
    };
    let border = border(items, bin);
    let first = partition(items, |item| bin(item) < border);
    // A lopsided tree is deep: no side gets less than a sixteenth.
    let least = items.len() / 16 + 1;
    if (least..=items.len() - least).contains(&first) {
        return first;
    }
    items.sort_by(|a, b| a.middle()[axis].total_cmp(&b.middle()[axis]));
    half
}

/// Moves the items that belong to the first side before the others, and returns the number of the first of these.
fn partition(items: &mut [Item], is_first: impl Fn(&Item) -> bool) -> usize {
    let mut first = 0;
    for index in 0..items.len() {
        if is_first(&items[index]) {
            items.swap(first, index);
            first += 1;
        }
    }
    first
}

/// The first bin of the second side, where areas times counts are least.
fn border(items: &[Item], bin: impl Fn(&Item) -> usize) -> usize {
    let mut bins = [(Extent::EMPTY, 0_usize); BINS];
    for item in items {
        let (extent, count) = &mut bins[bin(item)];
        extent.add(item.min, item.max);
        *count += 1;
    }
    let mut costs = [0.0_f32; BINS];
    for backwards in [false, true] {
        let (mut extent, mut count) = (Extent::EMPTY, 0);
        for step in 1..BINS {
            let (border, added) = if backwards { (BINS - step, BINS - step) } else { (step, step - 1) };
            extent.add(bins[added].0.min, bins[added].0.max);
            count += bins[added].1;
            costs[border] += extent.half_area() * count.div_ceil(WIDTH) as f32;
        }
    }
    (1..BINS).fold(1, |best, border| if costs[border] < costs[best] { border } else { best })
}
