//! The distance to the nearest of many points.
//!
//! The points are in a tree of boxes; each box is divided into two with equally many points along its
//! longest side. A search starts from the result of the previous one. Neighbours in a mesh are mostly near
//! each other, so most of the tree is skipped at once.

use trigon_math::{DVec3, Vec3};

/// Most points in a leaf: as many as are compared in the time of a few boxes.
const LEAF: usize = 8;

/// Points in space, in an order that makes the nearest one quick to find. Points that are not
/// finite are left out.
pub(super) struct NearestPoints {
    points: Vec<Vec3>,
    /// As a heap: the children of box i are 2 i + 1 and 2 i + 2.
    boxes: Vec<[Vec3; 2]>,
    /// Levels of boxes below the first.
    depth: u32,
}

impl NearestPoints {
    pub(super) fn new(mut points: Vec<Vec3>) -> Self {
        points.retain(|point| point.is_finite());
        let leaves = points.len().div_ceil(LEAF).next_power_of_two();
        let mut boxes = vec![[Vec3::ZERO; 2]; 2 * leaves - 1];
        if !points.is_empty() {
            build(&mut points, &mut boxes, 0);
        }
        Self { points, boxes, depth: leaves.trailing_zeros() }
    }

    pub(super) fn search(&self) -> Search<'_> {
        Search { tree: self, last: 0, stack: Vec::with_capacity(2 * self.depth as usize + 2) }
    }

    fn box_distance_squared(&self, node: usize, point: DVec3) -> f64 {
        let [low, high] = self.boxes[node];
        let outside = (low.as_dvec3() - point).max(point - high.as_dvec3()).max(DVec3::ZERO);
        outside.length_squared()
    }
}

/// Orders points so that each half of a range is one half of its box.
fn build(points: &mut [Vec3], boxes: &mut [[Vec3; 2]], node: usize) {
    let (mut low, mut high) = (points[0], points[0]);
    for &point in points.iter() {
        low = low.min(point);
        high = high.max(point);
    }
    boxes[node] = [low, high];
    if 2 * node + 2 >= boxes.len() {
        return;
    }
    let axis = (high - low).max_position();
    let middle = points.len() / 2;
    if middle > 0 && middle < points.len() {
        points.select_nth_unstable_by(middle, |a, b| a[axis].total_cmp(&b[axis]));
    }
    let (first, second) = points.split_at_mut(middle);
    for (half, child) in [(first, 2 * node + 1), (second, 2 * node + 2)] {
        if !half.is_empty() {
            build(half, boxes, child);
        }
    }
}

/// Searches one after the other, each starting from what the last one found.
pub(super) struct Search<'a> {
    tree: &'a NearestPoints,
    last: usize,
    /// Boxes to be looked into: number, first point, end, squared distance.
    stack: Vec<Pending>,
}

#[derive(Clone, Copy)]
struct Pending {
    node: usize,
    first: usize,
    end: usize,
    squared: f64,
}

impl Search<'_> {
    /// The distance from a point to the nearest of the tree's points; infinite if that is `radius`
    /// or more, or the point is not finite. The same whatever was searched before.
    pub(super) fn distance(&mut self, point: Vec3, radius: f64) -> f64 {
        let tree = self.tree;
        if !point.is_finite() || tree.points.is_empty() {
            return f64::INFINITY;
        }
        let from = point.as_dvec3();
        let squared = |index: usize| tree.points[index].as_dvec3().distance_squared(from);
        let mut best = squared(self.last);
        let limit = radius * radius;
        let root = Pending {
            node: 0,
            first: 0,
            end: tree.points.len(),
            squared: tree.box_distance_squared(0, from),
        };
        self.stack.push(root);
        while let Some(here) = self.stack.pop() {
            if here.squared >= best.min(limit) {
                continue;
            }
            if 2 * here.node + 2 >= tree.boxes.len() {
                for index in here.first..here.end {
                    let found = squared(index);
                    if found < best {
                        (best, self.last) = (found, index);
                    }
                }
                continue;
            }
            self.push_halves(here, from);
        }
        if best < limit { best.sqrt() } else { f64::INFINITY }
    }

    /// The nearer half is looked into first.
    fn push_halves(&mut self, here: Pending, from: DVec3) {
        let middle = here.first + (here.end - here.first) / 2;
        let half = |node, first: usize, end: usize| {
            // An empty half has no box.
            let squared =
                if first < end { self.tree.box_distance_squared(node, from) } else { f64::INFINITY };
            Pending { node, first, end, squared }
        };
        let one = half(2 * here.node + 1, here.first, middle);
        let two = half(2 * here.node + 2, middle, here.end);
        let (near, far) = if one.squared <= two.squared { (one, two) } else { (two, one) };
        self.stack.push(far);
        self.stack.push(near);
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn point() -> impl Strategy<Value = Vec3> {
        let coordinate =
            prop_oneof![10 => -8.0f32..8.0, 5 => (-3i8..3).prop_map(f32::from), 1 => Just(f32::NAN)];
        prop::array::uniform3(coordinate).prop_map(Vec3::from_array)
    }

    proptest! {
        #[test]
        fn the_nearest_of_all_points_is_found(
            points in prop::collection::vec(point(), 0..60),
            from in prop::collection::vec(point(), 1..20),
            radius in 0.5f64..12.0,
        ) {
            let tree = NearestPoints::new(points.clone());
            let mut search = tree.search();
            for from in from {
                let distance = |to: &Vec3| to.as_dvec3().distance(from.as_dvec3());
                let all = points.iter().map(distance).filter(|&distance| distance < radius);
                let nearest = all.fold(f64::INFINITY, f64::min);
                prop_assert_eq!(search.distance(from, radius), nearest);
            }
        }
    }
}
