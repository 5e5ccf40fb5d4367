//! Which points are near one another: a k-d tree (Bentley, "Multidimensional binary search trees used for
//! associative searching", 1975), balanced and stored without pointers.
//!
//! The time of a tree does not depend on how the points are distributed. A grid would be slow if most points
//! lay in one cell, and sorting along an axis if most points had nearly the same coordinate on it.

use trigon_math::{DVec3, Vec3};

/// So few points are compared one by one.
const LEAF: usize = 8;

/// Points with numbers. The middle of a range is the point that splits the rest of it along an
/// axis: what comes before is not above it, what comes after not below.
pub(super) struct NearPoints {
    points: Vec<(Vec3, u32)>,
    /// For the point in the middle of a range, the axis.
    axes: Vec<u8>,
}

impl NearPoints {
    /// Those of some points that are finite. Numbers ascend.
    pub(super) fn new(points: impl Iterator<Item = (Vec3, u32)>) -> Self {
        let points: Vec<(Vec3, u32)> = points.filter(|(point, _)| point.is_finite()).collect();
        let mut tree = Self { axes: vec![0; points.len()], points };
        build(&mut tree.points, &mut tree.axes);
        tree
    }

    /// Lets each point, in the order of numbers, take all later ones within a distance that none took
    /// yet: calls back with both numbers.
    pub(super) fn for_each_cluster(&self, distance: f64, mut take: impl FnMut(u32, u32)) {
        let mut order: Vec<u32> = (0..self.points.len() as u32).collect();
        order.sort_unstable_by_key(|&index| self.points[index as usize].1);
        let mut is_taken = vec![false; self.points.len()];
        let (limit, mut found) = (distance * distance, Vec::new());
        for index in order {
            let (point, number) = self.points[index as usize];
            if is_taken[index as usize] {
                continue;
            }
            let center = point.as_dvec3();
            self.for_each_near(center, limit, |other| {
                if self.points[other].1 > number && !is_taken[other] {
                    is_taken[other] = true;
                    found.push(self.points[other].1);
                }
            });
            found.drain(..).for_each(|other| take(number, other));
        }
    }

    /// Calls back with the place of each point within the root of `limit`.
    fn for_each_near(&self, center: DVec3, limit: f64, mut found: impl FnMut(usize)) {
        /// Ranges halve, so there are never more than 32 of them to come back to.
        const DEEPEST: usize = 33;
        let mut ranges = [(0, 0); DEEPEST];
        ranges[0] = (0, self.points.len());
        let mut waiting = 1;
        let mut test = |index: usize| {
            if self.points[index].0.as_dvec3().distance_squared(center) <= limit {
                found(index);
            }
        };
        while waiting > 0 {
            waiting -= 1;
            let (start, end) = ranges[waiting];
            if end - start <= LEAF {
                (start..end).for_each(&mut test);
                continue;
            }
            let middle = start + (end - start) / 2;
            test(middle);
            let axis = usize::from(self.axes[middle]);
            let beyond = center[axis] - f64::from(self.points[middle].0[axis]);
            // The square of one coordinate's difference is never above that of the distance,
            // also when both are rounded.
            let is_near = beyond * beyond <= limit;
            if beyond >= 0.0 || is_near {
                ranges[waiting] = (middle + 1, end);
                waiting += 1;
            }
            if beyond <= 0.0 || is_near {
                ranges[waiting] = (start, middle);
                waiting += 1;
            }
        }
    }
}

/// Splits a range at its middle, along the axis in which it is longest, and then both halves.
fn build(points: &mut [(Vec3, u32)], axes: &mut [u8]) {
    if points.len() <= LEAF {
        return;
    }
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for &(point, _) in points.iter() {
        low = low.min(point);
        high = high.max(point);
    }
    let size = high.as_dvec3() - low.as_dvec3();
    let axis = (1..3).fold(0, |longest, axis| if size[axis] > size[longest] { axis } else { longest });
    let middle = points.len() / 2;
    points.select_nth_unstable_by(middle, |a, b| a.0[axis].total_cmp(&b.0[axis]).then(a.1.cmp(&b.1)));
    axes[middle] = axis as u8;
    let (before, after) = points.split_at_mut(middle);
    let (axes_before, axes_after) = axes.split_at_mut(middle);
    build(before, axes_before);
    build(&mut after[1..], &mut axes_after[1..]);
}
