//! Triangles as the renderer draws them: their corners are moved to the grid of 1/256 pixel,
//! and which pixels' centres they cover is decided there, in whole numbers. Written anew from
//! the conventions, so that nothing is taken from the rasterizer.
//!
//! The renderer multiplies a vertex by its map in f32. Where it comes to lie is therefore known
//! within a small error, and nearly always that is one point of the grid. Where the error
//! reaches across the border between two points, both are tried, and an answer that differs
//! between them is open.

use std::cmp::Ordering;

use trigon_math::{DVec2, DVec3};

use super::oracle::Answer::{self, No, Open, Yes};
use super::oracle::{Lens, ROUNDING};

/// Half a step of f32, as a share of the number that is rounded.
const HALF_STEP: f64 = 1.0 / (1_u64 << 24) as f64;

/// Each term of a coordinate in clip space is rounded five times at most: as an entry of the
/// map, as a product, and in three sums. A little more, for roundings of roundings.
const ROUNDINGS: f64 = 5.01;

/// By how much the renderer may err in a distance, as a share of it. A corner's depth is
/// rounded six times, the mean of three by exact weights about as often; each time half a step of
/// f32 of the largest number that takes part, which is that of the far plane, at most five times as
/// far as what is seen. That is 4e-6.
const DEPTHS: f64 = 1e-5;

/// Steps of the grid to a pixel.
const STEPS: f64 = 256.0;

/// A vertex before the camera, and how far off the renderer may be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vertex {
    /// Across, upwards, and along the line of sight.
    pub(super) local: DVec3,
    /// For each of these the sum of the magnitudes of the numbers that it is added up from.
    pub(super) terms: DVec3,
}

/// The points of the grid that a vertex may be moved to, from the least to the greatest of
/// each coordinate.
#[derive(Clone, Copy, Debug)]
struct Snapped {
    least: [i64; 2],
    greatest: [i64; 2],
}

impl Snapped {
    /// `None` where the vertex is not certain to lie beyond the near plane, or may be moved to more
    /// than two neighbouring points along an axis.
    fn new(lens: &Lens, vertex: &Vertex) -> Option<Self> {
        let error = vertex.terms * (ROUNDINGS * HALF_STEP);
        if vertex.local.z - lens.near <= error.z + DEPTHS * vertex.local.z {
            return None;
        }
        let seen = lens.seen(vertex.local);
        let off = |across: f64, error_across: f64| {
            let pixels = if lens.parallel {
                error_across
            } else {
                (error_across + (across / vertex.local.z).abs() * error.z) / (vertex.local.z - error.z)
            };
            pixels * lens.scale + ROUNDING
        };
        let off = DVec2::new(off(vertex.local.x, error.x), off(vertex.local.y, error.y));
        let step = |at: DVec2| at.to_array().map(|at| (at * STEPS).round_ties_even() as i64);
        let (least, greatest) = (step(seen.at - off), step(seen.at + off));
        let is_usable = (0..2).all(|axis| greatest[axis] - least[axis] <= 1 && least[axis].abs() < 1 << 23);
        is_usable.then_some(Self { least, greatest })
    }

    fn candidates(self) -> impl Iterator<Item = [i64; 2]> {
        let [x, y] = [0, 1].map(|axis| self.least[axis]..=self.greatest[axis]);
        x.flat_map(move |x| y.clone().map(move |y| [x, y]))
    }
}

/// A triangle on the grid.
pub(super) struct GridTriangle {
    /// Each way that its corners may be moved.
    ways: Vec<[[i64; 2]; 3]>,
    distances: [f64; 3],
    double_sided: bool,
}

/// What the renderer finds of a triangle at a pixel's centre.
pub(super) struct Met {
    /// Whether it is covered, and drawn.
    pub(super) covered: Answer,
    /// The side, by its corners counter-clockwise on the screen, that alone leaves open
    /// whether it is covered.
    pub(super) side: Option<[usize; 2]>,
    /// The least and the greatest distance there.
    pub(super) distances: [f64; 2],
}

impl GridTriangle {
    /// Fronts wind counter-clockwise as seen. `None` where the near plane may cut it.
    pub(super) fn new(lens: &Lens, corners: &[Vertex; 3], double_sided: bool) -> Option<Self> {
        let [a, b, c] = corners.each_ref().map(|corner| Snapped::new(lens, corner));
        let (a, b, c) = (a?, b?, c?);
        let pairs = a.candidates().flat_map(|a| b.candidates().map(move |b| [a, b]));
        let ways = pairs.flat_map(|[a, b]| c.candidates().map(move |c| [a, b, c])).collect();
        Some(Self { ways, distances: corners.map(|corner| corner.local.z), double_sided })
    }

    /// `None` where it is certain that the pixel's centre is not covered.
    pub(super) fn met(&self, lens: &Lens, [x, y]: [u32; 2]) -> Option<Met> {
        let center = [x, y].map(|at| i64::from(at) * 256 + 128);
        let mut inside = [[false; 2]; 3];
        let (mut covered, mut winds, mut drawn) = ([false; 2], [false; 3], [false; 2]);
        let (mut near, mut far) = (f64::INFINITY, f64::NEG_INFINITY);
        for way in &self.ways {
            let area = turn(way[0], way[1], way[2]);
            // y points down: what winds counter-clockwise has a negative area.
            let is_drawn = area < 0 || (self.double_sided && area != 0);
            drawn[usize::from(is_drawn)] = true;
            winds[(area.signum() + 1) as usize] = true;
            let [a, b, c] = *way;
            let sides = [[b, c], [c, a], [a, b]].map(|side| is_inside(side, center, area.signum()));
            for (known, is_inside) in inside.iter_mut().zip(sides) {
                known[usize::from(is_inside)] = true;
            }
            let is_covered = is_drawn && sides == [true; 3];
            covered[usize::from(is_covered)] = true;
            if is_covered {
                let weights = [[b, c], [c, a], [a, b]].map(|[from, to]| turn(from, to, center) as f64);
                let distance = self.distance(lens, weights);
                (near, far) = (near.min(distance), far.max(distance));
            }
        }
        if !covered[1] {
            return None;
        }
        let is_open = |known: &[bool; 2]| *known == [true; 2];
        let alone = inside.iter().filter(|known| is_open(known)).count() == 1 && drawn == [false, true];
        let side = inside.iter().position(is_open).filter(|_| alone);
        let side = side.and_then(|corner| match winds {
            [true, false, false] => Some([(corner + 1) % 3, (corner + 2) % 3]),
            [false, false, true] => Some([(corner + 2) % 3, (corner + 1) % 3]),
            _ => None,
        });
        let covered = if covered[0] { Open } else { Yes };
        Some(Met { covered, side, distances: [near, far] })
    }

    /// The mean of the corners' depths by the areas opposite to them.
    fn distance(&self, lens: &Lens, weights: [f64; 3]) -> f64 {
        let sum: f64 = weights.iter().sum();
        let mean =
            |values: [f64; 3]| values.iter().zip(weights).map(|(value, by)| value * by).sum::<f64>() / sum;
        if lens.parallel {
            mean(self.distances)
        } else {
            1.0 / mean(self.distances.map(|distance| 1.0 / distance))
        }
    }
}

/// Distances that depths in f32 may take for these.
pub(super) fn depths([near, far]: [f64; 2]) -> [f64; 2] {
    [near - DEPTHS * near.abs(), far + DEPTHS * far.abs()]
}

/// Whether distances lie before the far plane, by depths in f32.
pub(super) fn is_before_far(lens: &Lens, distances: [f64; 2]) -> Answer {
    let [near, far] = depths(distances).map(|distance| distance.total_cmp(&lens.far));
    match (near, far) {
        (_, Ordering::Less) => Yes,
        (Ordering::Greater, _) => No,
        _ => Open,
    }
}

/// Twice the area of a triangle.
fn turn(a: [i64; 2], b: [i64; 2], c: [i64; 2]) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Whether a point is on the inner side of a side. A point on it counts if it is a left side,
/// or a top side that is level.
fn is_inside([from, to]: [[i64; 2]; 2], point: [i64; 2], sign: i64) -> bool {
    // Of a triangle that winds the other way the same side in reverse.
    let [right, down] = [(from[1] - to[1]) * sign, (to[0] - from[0]) * sign];
    match (turn(from, to, point) * sign).cmp(&0) {
        Ordering::Greater => true,
        Ordering::Equal => right > 0 || (right == 0 && down > 0),
        Ordering::Less => false,
    }
}
