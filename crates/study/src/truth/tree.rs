//! The first triangle that a ray meets, in f64: a tree of boxes whose cuts cost least by area (J. Goldsmith and J. Salmon,
//! "Automatic Creation of Object Hierarchies for Ray Tracing", 1987), with 16 candidates for each axis (I. Wald, "On fast
//! Construction of SAH-based Bounding Volume Hierarchies", 2007). It shares nothing with the engine's.

use trigon_math::DVec3;

/// Triangles in a leaf, at most, unless no cut separates them.
const LEAF: usize = 4;

/// Candidates for a cut along each axis.
const BINS: usize = 16;

/// A ray, and the part of it that counts.
#[derive(Clone, Copy, Debug)]
pub(super) struct RaySegment {
    pub(super) origin: DVec3,
    /// Of any length; distances are in units of it.
    pub(super) direction: DVec3,
    pub(super) end: f64,
    /// A triangle that is passed: that on which the ray starts.
    pub(super) passed: u32,
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Crossing {
    pub(super) distance: f64,
    pub(super) triangle: u32,
    /// The weights of the second and the third corner.
    pub(super) weights: [f64; 2],
}

/// A corner and the two edges from it.
#[derive(Clone, Copy)]
struct TreeTriangle {
    corner: DVec3,
    sides: [DVec3; 2],
    triangle: u32,
}

#[derive(Clone, Copy)]
struct Node {
    low: DVec3,
    high: DVec3,
    /// The first of the triangles, or the first of two nodes.
    first: u32,
    /// Of triangles; 0 for two nodes.
    count: u32,
}

/// Triangles for rays.
pub(super) struct Tree {
    nodes: Vec<Node>,
    edges: Vec<TreeTriangle>,
}

impl Tree {
    pub(super) fn new(triangles: impl Iterator<Item = [DVec3; 3]>) -> Self {
        let edges = (0..).zip(triangles).map(|(triangle, [corner, b, c])| TreeTriangle {
            corner,
            sides: [b - corner, c - corner],
            triangle,
        });
        let mut tree = Self { nodes: Vec::new(), edges: edges.collect() };
        let mut left = vec![tree.push(0, tree.edges.len())];
        while let Some(node) = left.pop() {
            let Node { first, count, .. } = tree.nodes[node];
            let (start, count) = (first as usize, count as usize);
            if let Some(half) = cut(&mut tree.edges[start..start + count]) {
                let children = [tree.push(start, half), tree.push(start + half, count - half)];
                (tree.nodes[node].first, tree.nodes[node].count) = (children[0] as u32, 0);
                left.extend(children);
            }
        }
        tree
    }

    fn push(&mut self, first: usize, count: usize) -> usize {
        let [low, high] = bounds(&self.edges[first..first + count]);
        // Wider than any rounding, so that no ray lies in a side, where its distance from it would be no number.
        let margin = (low.abs() + high.abs()) * 1e-13 + DVec3::splat(1e-200);
        let (low, high) = (low - margin, high + margin);
        self.nodes.push(Node { low, high, first: first as u32, count: count as u32 });
        self.nodes.len() - 1
    }

    /// The nearest crossing after the start.
    pub(super) fn first(&self, ray: &RaySegment) -> Option<Crossing> {
        let mut nearest = None;
        self.walk(*ray, |found, ray| {
            ray.end = found.distance;
            nearest = Some(found);
            false
        });
        nearest
    }

    /// Whether any triangle lies on it.
    pub(super) fn is_blocked(&self, ray: &RaySegment) -> bool {
        let mut is_blocked = false;
        self.walk(*ray, |_, _| {
            is_blocked = true;
            true
        });
        is_blocked
    }

    /// Calls a function with crossings, which may shorten the ray, until it says that that is enough.
    fn walk(&self, mut ray: RaySegment, mut found: impl FnMut(Crossing, &mut RaySegment) -> bool) {
        let inverse = ray.direction.recip();
        let mut waiting = [0_u32; 128];
        let mut depth = 1;
        while depth > 0 {
            depth -= 1;
            let node = &self.nodes[waiting[depth] as usize];
            if entry(node, &ray, inverse).is_none() {
                continue;
            }
            if node.count > 0 {
                let first = node.first as usize;
                for edges in &self.edges[first..first + node.count as usize] {
                    if let Some(crossing) = edges.crossing(&ray)
                        && found(crossing, &mut ray)
                    {
                        return;
                    }
                }
                continue;
            }
            // The nearer one last, so that it is next.
            let children = [node.first, node.first + 1];
            let near = children.map(|child| entry(&self.nodes[child as usize], &ray, inverse));
            let order = if near[0] <= near[1] { [1, 0] } else { [0, 1] };
            for child in order.into_iter().filter(|&child| near[child].is_some()) {
                waiting[depth] = children[child];
                depth += 1;
            }
        }
    }
}

/// Where a ray enters a box, if it does.
fn entry(node: &Node, ray: &RaySegment, inverse: DVec3) -> Option<f64> {
    let (one, other) = ((node.low - ray.origin) * inverse, (node.high - ray.origin) * inverse);
    let enters = one.min(other).max_element().max(0.0);
    let leaves = one.max(other).min_element().min(ray.end);
    (enters <= leaves).then_some(enters)
}

impl TreeTriangle {
    /// T. Möller and B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997.
    fn crossing(&self, ray: &RaySegment) -> Option<Crossing> {
        let [right, up] = self.sides;
        let across = ray.direction.cross(up);
        let inverse = right.dot(across).recip();
        let from = ray.origin - self.corner;
        let second = from.dot(across) * inverse;
        let normal = from.cross(right);
        let third = ray.direction.dot(normal) * inverse;
        let distance = up.dot(normal) * inverse;
        let is_met = second >= 0.0
            && third >= 0.0
            && second + third <= 1.0
            && distance > 0.0
            && distance < ray.end
            && self.triangle != ray.passed;
        is_met.then_some(Crossing { distance, triangle: self.triangle, weights: [second, third] })
    }

    fn corners(&self) -> [DVec3; 3] {
        [self.corner, self.corner + self.sides[0], self.corner + self.sides[1]]
    }

    /// Three times the middle.
    fn middle(&self) -> DVec3 {
        self.corner * 3.0 + self.sides[0] + self.sides[1]
    }
}

fn bounds(edges: &[TreeTriangle]) -> [DVec3; 2] {
    let corners = edges.iter().flat_map(TreeTriangle::corners);
    corners.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)])
}

/// The bounds of triangles, and their number.
type Bin = ([DVec3; 2], usize);

/// Half of the surface of a box, times the number of triangles in it.
fn price([low, high]: [DVec3; 2], count: usize) -> f64 {
    let size = (high - low).max(DVec3::ZERO);
    (size.x * size.y + size.y * size.z + size.z * size.x) * count as f64
}

/// Sorts triangles into two parts, and tells the size of the first. Nothing for few, or where their middles are one point.
fn cut(edges: &mut [TreeTriangle]) -> Option<usize> {
    if edges.len() <= LEAF {
        return None;
    }
    let middles = edges.iter().map(TreeTriangle::middle);
    let [low, high] =
        middles.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)]);
    let bin = |edges: &TreeTriangle, axis: usize| {
        let part = (edges.middle()[axis] - low[axis]) / (high[axis] - low[axis]);
        ((part * BINS as f64) as usize).min(BINS - 1)
    };
    let axes = (0..3).filter(|&axis| high[axis] > low[axis]);
    let cuts = axes.flat_map(|axis| (1..BINS).map(move |first| (axis, first)));
    let mut counted: [Option<Vec<Bin>>; 3] = [const { None }; 3];
    let mut cost = |(axis, first): (usize, usize)| {
        let bins = counted[axis].get_or_insert_with(|| binned(edges, |edges| bin(edges, axis)));
        let side = |part: &[Bin]| {
            let empty = ([DVec3::INFINITY, DVec3::NEG_INFINITY], 0);
            let (bounds, count) = part.iter().fold(empty, |([low, high], sum), ([l, h], count)| {
                ([low.min(*l), high.max(*h)], sum + count)
            });
            if count == 0 { f64::INFINITY } else { price(bounds, count) }
        };
        side(&bins[..first]) + side(&bins[first..])
    };
    let (_, (axis, first)) =
        cuts.map(|cut| (cost(cut), cut)).min_by(|one, other| one.0.total_cmp(&other.0))?;
    edges.sort_unstable_by_key(|edges| bin(edges, axis) >= first);
    let half = edges.partition_point(|edges| bin(edges, axis) < first);
    (half > 0 && half < edges.len()).then_some(half)
}

/// The bounds and the number of the triangles in each bin.
fn binned(edges: &[TreeTriangle], bin: impl Fn(&TreeTriangle) -> usize) -> Vec<Bin> {
    let mut bins = vec![([DVec3::INFINITY, DVec3::NEG_INFINITY], 0); BINS];
    for one in edges {
        let ([low, high], count) = &mut bins[bin(one)];
        for corner in one.corners() {
            (*low, *high) = (low.min(corner), high.max(corner));
        }
        *count += 1;
    }
    bins
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Xorshift (G. Marsaglia, 2003), from −1 to 1.
    fn random(state: &mut u64) -> f64 {
        *state ^= *state << 13;
        *state ^= *state >> 7;
        *state ^= *state << 17;
        (*state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn point(state: &mut u64) -> DVec3 {
        DVec3::from_array([(); 3].map(|()| random(state)))
    }

    /// The tree finds what a test of every triangle finds.
    #[test]
    fn the_first_crossing_is_that_of_all_triangles() {
        let state = &mut 99;
        let triangles: Vec<[DVec3; 3]> = (0..500)
            .map(|_| {
                let corner = point(state);
                [corner, corner + 0.2 * point(state), corner + 0.2 * point(state)]
            })
            .collect();
        let tree = Tree::new(triangles.iter().copied());
        let mut met = 0;
        for _ in 0..500 {
            let ray = RaySegment {
                origin: point(state) * 2.0,
                direction: point(state),
                end: 9.0,
                passed: u32::MAX,
            };
            let all = tree.edges.iter().filter_map(|edges| edges.crossing(&ray));
            let nearest = all.min_by(|one, other| one.distance.total_cmp(&other.distance));
            assert_eq!(tree.first(&ray), nearest);
            assert_eq!(tree.is_blocked(&ray), nearest.is_some());
            met += usize::from(nearest.is_some());
            if let Some(nearest) = nearest {
                let next = tree.first(&RaySegment { passed: nearest.triangle, ..ray });
                assert!(next.is_none_or(|next| next.triangle != nearest.triangle), "it is passed");
            }
        }
        assert!((20..450).contains(&met), "{met} rays meet something");
    }
}
