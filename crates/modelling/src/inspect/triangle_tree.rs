//! Finds the pairs of triangles whose boxes overlap: a tree of boxes, compared with itself.

use trigon_math::Vec3;

use super::touching::FaceTriangle;

/// Most triangles in a leaf.
const LEAF: usize = 4;

/// Triangles in an order in which those near each other are together, and the boxes around them.
pub(crate) struct TriangleTree {
    triangles: Vec<FaceTriangle>,
    /// As a heap: the children of box i are 2 i + 1 and 2 i + 2.
    boxes: Vec<[Vec3; 2]>,
}

impl TriangleTree {
    pub(crate) fn new(mut triangles: Vec<FaceTriangle>) -> Self {
        let leaves = triangles.len().div_ceil(LEAF).next_power_of_two();
        let mut boxes = vec![[Vec3::INFINITY, Vec3::NEG_INFINITY]; 2 * leaves - 1];
        build(&mut triangles, &mut boxes, 0);
        Self { triangles, boxes }
    }
}

/// Orders triangles so that each half of a range is one half of its box, along its longest side.
fn build(triangles: &mut [FaceTriangle], boxes: &mut [[Vec3; 2]], node: usize) {
    for triangle in triangles.iter() {
        boxes[node] = union(boxes[node], box_of(triangle));
    }
    if 2 * node + 2 >= boxes.len() || triangles.is_empty() {
        return;
    }
    let axis = (boxes[node][1] - boxes[node][0]).max_position();
    let middle = triangles.len() / 2;
    // The first corner stands for a triangle well enough; ids decide where it is shared.
    let coordinate = |triangle: &FaceTriangle| triangle.positions[0][axis];
    triangles.select_nth_unstable_by(middle, |a, b| {
        coordinate(a).total_cmp(&coordinate(b)).then(a.face.cmp(&b.face)).then(a.vertices.cmp(&b.vertices))
    });
    let (first, second) = triangles.split_at_mut(middle);
    build(first, boxes, 2 * node + 1);
    build(second, boxes, 2 * node + 2);
}

fn box_of(triangle: &FaceTriangle) -> [Vec3; 2] {
    let [a, b, c] = triangle.positions;
    [a.min(b).min(c), a.max(b).max(c)]
}

fn union(a: [Vec3; 2], b: [Vec3; 2]) -> [Vec3; 2] {
    [a[0].min(b[0]), a[1].max(b[1])]
}

fn overlap(a: [Vec3; 2], b: [Vec3; 2]) -> bool {
    a[0].cmple(b[1]).all() && b[0].cmple(a[1]).all()
}

/// The search for pairs.
pub(crate) struct PairSearch<'a> {
    tree: &'a TriangleTree,
    stack: Vec<Range>,
    /// How many more pairs are looked at.
    left: usize,
}

/// A box, and the triangles within it.
#[derive(Clone, Copy)]
struct Range {
    node: usize,
    first: usize,
    end: usize,
}

impl<'a> PairSearch<'a> {
    pub(crate) fn new(tree: &'a TriangleTree) -> Self {
        /// Pairs for each triangle before the search is ended: a fair mesh has some tens; where
        /// most boxes overlap most others it would never end.
        const PAIRS: usize = 1000;
        /// So that a small mesh is always searched whole.
        const LEAST: usize = 100_000_000;
        Self { tree, stack: Vec::new(), left: LEAST.max(tree.triangles.len().saturating_mul(PAIRS)) }
    }

    /// Calls back with each pair of triangles whose boxes overlap, until that says false or there
    /// are too many; whether all were shown.
    pub(crate) fn for_each_pair(
        &mut self,
        mut call: impl FnMut(&FaceTriangle, &FaceTriangle) -> bool,
    ) -> bool {
        let tree = self.tree;
        for (index, triangle) in tree.triangles.iter().enumerate() {
            let bounds = box_of(triangle);
            self.stack.push(Range { node: 0, first: 0, end: tree.triangles.len() });
            while let Some(range) = self.stack.pop() {
                // Each pair is found from the first of its triangles.
                if range.end <= index + 1 || !overlap(bounds, tree.boxes[range.node]) {
                    continue;
                }
                if 2 * range.node + 2 >= tree.boxes.len() {
                    for other in &tree.triangles[range.first.max(index + 1)..range.end] {
                        self.left = self.left.saturating_sub(1);
                        if self.left == 0 || (overlap(bounds, box_of(other)) && !call(triangle, other)) {
                            return false;
                        }
                    }
                    continue;
                }
                let middle = range.first + (range.end - range.first) / 2;
                self.stack.push(Range { node: 2 * range.node + 2, first: middle, end: range.end });
                self.stack.push(Range { node: 2 * range.node + 1, first: range.first, end: middle });
            }
        }
        true
    }
}
