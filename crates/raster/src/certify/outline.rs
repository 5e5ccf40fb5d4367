//! What is certain about a primitive at a sample if its corners are off. The proofs are in the module above.

use super::gather::{Contender, Corner, extent};
use crate::BlendMode;
use crate::primitive::{DepthPlane, SetupTriangle};

/// Whether a primitive covers a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cover {
    Misses,
    May,
    Covers,
}

/// A primitive at any sample.
pub(super) struct Outline {
    pub(super) blend_mode: BlendMode,
    /// The rectangle outside of which it certainly misses, by axis.
    pub(super) extent: [[i32; 2]; 2],
    drift: i64,
    /// Of the way round; 0 if nothing is certainly covered.
    sign: i64,
    hull: Hull,
    /// Along which it may be cut into triangles.
    diagonals: Vec<Side>,
    is_disc: bool,
    /// The range of the corners' depths.
    range: [f64; 2],
    plane: Option<DepthPlane>,
    /// By how much depths may be off from the plane.
    radius: f64,
    /// Triangles between corners that are too thin for the plane to mean anything.
    needles: Vec<Hull>,
}

impl Outline {
    pub(super) fn new(contender: Contender, corners: &[Corner]) -> Self {
        let drift = i64::from(contender.drift);
        let sign = if contender.is_sure { doubled_area(corners).signum() } else { 0 };
        let least = corners.iter().map(|corner| corner.low).fold(f32::INFINITY, f32::min);
        let greatest = corners.iter().map(|corner| corner.high).fold(f32::NEG_INFINITY, f32::max);
        let extent = extent(corners, contender.drift);
        let mut outline = Self {
            blend_mode: contender.blend_mode,
            extent,
            drift,
            sign,
            hull: Hull::new(corners, drift),
            diagonals: diagonals(corners),
            is_disc: contender.is_disc,
            range: [least, greatest].map(f64::from),
            plane: None,
            radius: 0.0,
            needles: Vec::new(),
        };
        outline.find_plane(corners);
        outline
    }

    /// The plane of the depths, through those corners that span the most, and how
    /// far depths may be off from it.
    fn find_plane(&mut self, corners: &[Corner]) {
        let triangles = || triples(corners.len()).map(|triple| triple.map(|i| corners[i]));
        let area = |triangle: &[Corner; 3]| doubled_area(triangle).abs();
        let Some(widest) = triangles().max_by_key(area).filter(|widest| area(widest) > 0) else {
            return;
        };
        let mut thinnest = area(&widest);
        for triangle in triangles() {
            let least = area(&triangle) - area_slack(&triangle, self.drift);
            if least > 0 {
                thinnest = thinnest.min(least);
            } else {
                self.needles.push(Hull::new(&triangle, self.drift));
            }
        }
        let plane = DepthPlane::of(&SetupTriangle::whole(widest.map(|corner| corner.vertex), 0));
        self.radius = (plane.right.abs() + plane.down.abs()) * self.drift as f64
            + corners.iter().map(|corner| apart(corner, &plane)).fold(0.0, f64::max)
            + self.rounding(thinnest as f64);
        self.plane = Some(plane);
    }

    /// What the engine's planes and the one here may be rounded by, if no triangle
    /// is thinner than this.
    fn rounding(&self, doubled_area: f64) -> f64 {
        let [least, greatest] = self.range;
        let [width, height] = self.extent.map(|[low, high]| f64::from(high) - f64::from(low));
        // The bound that `DepthPlane` states, twice.
        let needle = 2.0 * width * height / doubled_area;
        let planes = 2.0 * (greatest - least) * needle / (1_u64 << 50) as f64;
        // Corners that a plane makes are rounded to f32, too.
        let largest = least.abs().max(greatest.abs());
        let cutting = if self.sign == 0 { largest / f64::from(1 << 20) } else { 0.0 };
        planes + cutting
    }

    /// Whether it covers a point of the grid.
    pub(super) fn covers(&self, point: [i32; 2]) -> Cover {
        match self.hull.winding(point) {
            Some(0) => Cover::Misses,
            Some(winding) if winding == self.sign && self.is_in_disc(point) => Cover::Covers,
            _ => Cover::May,
        }
    }

    /// Whether two of the triangles that it is cut into may meet in the pixel
    /// around this point.
    pub(super) fn may_part(&self, center: [i32; 2]) -> bool {
        let center = center.map(i64::from);
        self.diagonals.iter().any(|diagonal| diagonal.is_within(self.drift + 128, center))
    }

    /// Whether a point of the square certainly lies in the disc, if only that is
    /// drawn.
    fn is_in_disc(&self, point: [i32; 2]) -> bool {
        if !self.is_disc {
            return true;
        }
        let [[left, right], [top, bottom]] = self.extent.map(|range| range.map(i64::from));
        let [dx, dy] = [2 * i64::from(point[0]) - left - right, 2 * i64::from(point[1]) - top - bottom];
        // The centre moves as the corners do, by less than one and a half of the
        // drift; all lengths are doubled.
        let diameter = right - left - 2 * self.drift - 3 * self.drift;
        diameter > 0 && dx * dx + dy * dy < diameter * diameter
    }

    /// The range of its depth at a point that it may cover.
    pub(super) fn depths(&self, point: [i32; 2]) -> [f32; 2] {
        let [mut least, mut greatest] = self.range;
        let known = self.plane.filter(|_| self.needles.iter().all(|needle| needle.winding(point) == Some(0)));
        if let Some(plane) = known {
            let depth = unclamped(&plane, point);
            least = least.max(depth - self.radius);
            greatest = greatest.min(depth + self.radius);
        }
        // Rounding to f32 keeps the order; sums in f64 are off by less than a step.
        [(least as f32).next_down(), (greatest as f32).next_up()]
    }
}

/// How far the depths of a corner may lie from a plane there.
fn apart(corner: &Corner, plane: &DepthPlane) -> f64 {
    let [low, depth, high] = [corner.low, corner.vertex.depth(), corner.high].map(f64::from);
    let residue = (depth - unclamped(plane, corner.vertex.raw())).abs();
    residue + (high - depth).max(depth - low)
}

/// The plane's depth, also outside of the triangle.
fn unclamped(plane: &DepthPlane, [x, y]: [i32; 2]) -> f64 {
    let [dx, dy] = [x - plane.anchor[0], y - plane.anchor[1]].map(f64::from);
    plane.value + plane.down * dy + plane.right * dx
}

/// A closed outline whose corners may be off.
struct Hull {
    sides: Vec<Side>,
    drift: i64,
}

impl Hull {
    fn new(corners: &[Corner], drift: i64) -> Self {
        let sides = (0..corners.len()).map(|i| Side::between(&corners[i], &corners[(i + 1) % corners.len()]));
        Self { sides: sides.collect(), drift }
    }

    /// How often the outline runs around a point clockwise on the screen, wherever
    /// its corners are; `None` if a side may run over the point.
    fn winding(&self, point: [i32; 2]) -> Option<i64> {
        let point = point.map(i64::from);
        let mut winding = 0;
        for side in &self.sides {
            if side.is_within(self.drift, point) {
                return None;
            }
            winding += side.crossing(point);
        }
        Some(winding)
    }
}

/// A line between two corners.
struct Side([[i64; 2]; 2]);

impl Side {
    fn between(from: &Corner, to: &Corner) -> Self {
        Self([from, to].map(|corner| corner.vertex.raw().map(i64::from)))
    }

    /// Whether a point lies within so much of it, on both axes.
    fn is_within(&self, reach: i64, point: [i64; 2]) -> bool {
        let [from, to] = self.0;
        let near = |axis: usize| {
            let [low, high] = [from[axis].min(to[axis]), from[axis].max(to[axis])];
            low - reach <= point[axis] && point[axis] <= high + reach
        };
        let lengths = (to[0] - from[0]).abs() + (to[1] - from[1]).abs();
        near(0) && near(1) && self.turn(point).abs() <= reach * lengths
    }

    /// Twice the area between it and a point: positive if they run clockwise.
    fn turn(&self, point: [i64; 2]) -> i64 {
        let [from, to] = self.0;
        (to[0] - from[0]) * (point[1] - from[1]) - (to[1] - from[1]) * (point[0] - from[0])
    }

    /// 1 if it crosses the row of a point on the right of it downwards, -1 upwards.
    fn crossing(&self, point: [i64; 2]) -> i64 {
        match self.0.map(|end| end[1] <= point[1]) {
            [true, false] if self.turn(point) > 0 => 1,
            [false, true] if self.turn(point) < 0 => -1,
            _ => 0,
        }
    }
}

/// Twice the signed area of an outline, exactly.
pub(super) fn doubled_area(corners: &[Corner]) -> i64 {
    let points: Vec<_> = corners.iter().map(|corner| corner.vertex).collect();
    crate::setup::doubled_area(&points)
}

/// By how much the doubled area of an outline may be off: each corner moves
/// across the line between its neighbours, and pairs of neighbours together.
pub(super) fn area_slack(corners: &[Corner], drift: i64) -> i64 {
    let count = corners.len();
    let position = |i: usize| corners[i % count].vertex.raw().map(i64::from);
    let apart = |i: usize| {
        let [a, b] = [position(i), position(i + 2)];
        (a[0] - b[0]).abs() + (a[1] - b[1]).abs()
    };
    drift * (0..count).map(apart).sum::<i64>() + 2 * count as i64 * drift * drift
}

/// The lines between corners that no side joins.
fn diagonals(corners: &[Corner]) -> Vec<Side> {
    let count = corners.len();
    let apart = |&[a, b]: &[usize; 2]| b - a > 1 && b - a < count - 1;
    let pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| [a, b]));
    pairs.filter(apart).map(|[a, b]| Side::between(&corners[a], &corners[b])).collect()
}

/// All choices of three among so many.
fn triples(count: usize) -> impl Iterator<Item = [usize; 3]> {
    (0..count).flat_map(move |a| (a + 1..count).flat_map(move |b| (b + 1..count).map(move |c| [a, b, c])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triples_are_all_choices_of_three() {
        let of = |count| triples(count).collect::<Vec<_>>();
        assert_eq!((of(2), of(3)), (vec![], vec![[0, 1, 2]]));
        assert_eq!(of(4), [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]]);
        assert_eq!(of(6).len(), 20);
    }
}
