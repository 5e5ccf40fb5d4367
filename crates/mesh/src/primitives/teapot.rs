//! The Utah teapot: 32 bicubic patches, cut into quads, and its numbers as Martin Newell published them.
//!
//! M. Newell, "The Utilization of Procedure Models in Digital Image Synthesis", PhD thesis, University of
//! Utah, 1975: 28 bicubic Bézier patches. The four patches of the bottom are those that F. C. Crow added in
//! "Displays on Display: The Origins of the Teapot", IEEE Computer Graphics and Applications 7(1), 1987. The
//! table goes round the world as 32 patches over 306 control points, 4 of which no patch uses and 12 of which
//! repeat others. All of them follow from the numbers below: body and lid are four quarter turns each, handle
//! and spout are two mirrored halves each.
//!
//! Published axes: z up, the spout towards +x.

use trigon_math::DVec3;

use super::round::{Ring, band};
use super::solid::Solid;
use crate::Mesh;

/// Handle and spout are two patches round: with one piece each they would be
/// flat.
const FEWEST_SUBDIVISIONS: u32 = 2;

/// The highest number of pieces along a patch: 131 072 faces.
const MOST_SUBDIVISIONS: u32 = 64;

/// The Utah teapot with `subdivisions` by `subdivisions` quads per patch (2 to
/// 64; triangles round the tip of the lid and the middle of the bottom). Its
/// spout points to +X, it stands on y = 0 with the middle of its bottom in the
/// origin, and is as large as its published numbers: 3.15 high, the rim 2.8
/// wide inside.
///
/// Normals are those of the exact surface. The image goes round each of the
/// four parts once.
///
/// It is faithful, so it is not one closed surface. The edge of the lid (radius 1.3) does not reach the inner
/// edge of the rim (1.4); both are at height 2.4. The lower ends of spout and handle are open and stick
/// through the body, which has no hole there. The mouth of the spout ends inside it. (The real pot was a
/// third higher: the numbers are those that were handed on.)
#[must_use]
pub fn teapot(subdivisions: u32) -> Mesh {
    let pieces = subdivisions.clamp(FEWEST_SUBDIVISIONS, MOST_SUBDIVISIONS);
    let faces = 32 * (pieces * pieces) as usize;
    let mut solid = Solid::with_capacity(faces + 16 * pieces as usize, faces, 4 * faces);
    for part in parts() {
        part.add_to(&mut solid, pieces);
    }
    solid.build()
}

/// The four parts as rows of control points.
fn parts() -> [Part; 4] {
    [
        Part { rows: BODY.iter().map(row_round).collect() },
        Part { rows: LID.iter().map(row_round).collect() },
        Part { rows: HANDLE.iter().map(row_across).collect() },
        Part { rows: SPOUT.iter().map(row_across).collect() },
    ]
}

/// Patches joined to a net that closes once round. Rows go down the surface;
/// each has three control points per patch, counter-clockwise seen against the
/// way that the rows go.
struct Part {
    rows: Vec<Vec<DVec3>>,
}

/// From published axes (z up) to ours (+Y up): the spout stays at +X.
fn upright(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, z, -y)
}

fn row_round(row: &Round) -> Vec<DVec3> {
    let Round { radius, pull, height } = *row;
    let quarter = [(radius, 0.0), (radius, pull), (pull, radius)];
    let turned = |turns: i32, (x, y): (f64, f64)| match turns {
        0 => (x, y),
        1 => (-y, x),
        2 => (-x, -y),
        _ => (y, -x),
    };
    let points = (0..4).flat_map(|turns| quarter.map(|point| turned(turns, point)));
    points.map(|(x, y)| upright(x, y, height)).collect()
}

fn row_across(row: &Across) -> Vec<DVec3> {
    let Across { from, to, width } = *row;
    let there = [(from, 0.0), (from, width), (to, width)];
    let back = [(to, 0.0), (to, -width), (from, -width)];
    there.into_iter().chain(back).map(|([x, z], y)| upright(x, y, z)).collect()
}

impl Part {
    fn add_to(&self, solid: &mut Solid, pieces: u32) {
        let patches_down = (self.rows.len() as u32 - 1) / 3;
        let steps = patches_down * pieces;
        let mut ring = |step: u32| {
            // The last row belongs to the end of the last patch.
            let patch_row = (step / pieces).min(patches_down - 1);
            let down = Weights::new(step - patch_row * pieces, pieces);
            let points = self.points_round(patch_row, &down, pieces);
            Ring::new(solid, f64::from(step) / f64::from(steps), points.into_iter())
        };
        let rings: Vec<Ring> = (0..=steps).map(&mut ring).collect();
        for neighbours in rings.windows(2) {
            band(solid, &neighbours[1], &neighbours[0]);
        }
    }

    /// Positions and normals once round, or of the single point at a pole.
    fn points_round(&self, patch_row: u32, down: &Weights, pieces: u32) -> Vec<(DVec3, DVec3)> {
        let patches = self.rows[0].len() as u32 / 3;
        let at = |step: u32| {
            let patch = self.patch(patch_row, step / pieces);
            point_and_normal(&patch, &Weights::new(step % pieces, pieces), down)
        };
        let is_pole = at(0).0 == at(pieces).0;
        let count = if is_pole { 1 } else { patches * pieces };
        (0..count).map(at).collect()
    }

    /// The control points of a patch: four rows of four.
    fn patch(&self, patch_row: u32, patch: u32) -> [[DVec3; 4]; 4] {
        let rows = &self.rows[3 * patch_row as usize..];
        std::array::from_fn(|i| {
            let around = rows[i].len();
            std::array::from_fn(|j| rows[i][(3 * patch as usize + j) % around])
        })
    }
}

/// Cubic Bernstein polynomials and their derivatives at one parameter.
struct Weights {
    value: [f64; 4],
    slope: [f64; 4],
    is_end: bool,
}

impl Weights {
    /// At the parameter `step / steps`.
    fn new(step: u32, steps: u32) -> Self {
        let t = f64::from(step) / f64::from(steps);
        let s = f64::from(steps - step) / f64::from(steps);
        Self {
            value: [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t],
            slope: [-3.0 * s * s, 3.0 * s * (s - 2.0 * t), 3.0 * t * (2.0 * s - t), 3.0 * t * t],
            is_end: step == steps,
        }
    }
}

/// The point of a patch for weights along and across its rows, and the unit
/// normal there, out of the side from which rows run counter-clockwise.
fn point_and_normal(patch: &[[DVec3; 4]; 4], along: &Weights, down: &Weights) -> (DVec3, DVec3) {
    let blend = |down: &[f64; 4], along: &[f64; 4]| weighted(patch.map(|row| weighted(row, along)), down);
    let point = blend(&down.value, &along.value);
    let downwards = blend(&down.slope, &along.value);
    let mut onwards = blend(&down.value, &along.slope);
    if onwards == DVec3::ZERO {
        // The row has shrunk to a point: a pole. Next to it the direction is
        // that of the derivative of this one, which grows into the patch.
        let growing = blend(&down.slope, &along.slope);
        onwards = if down.is_end { -growing } else { growing };
    }
    (point, downwards.cross(onwards).normalize())
}

fn weighted(points: [DVec3; 4], weights: &[f64; 4]) -> DVec3 {
    let [a, b, c, d] = points;
    (a * weights[0] + d * weights[3]) + (b * weights[1] + c * weights[2])
}

/// A row of control points round the axis: the first one of a quarter turn is
/// (radius, 0), the next (radius, pull), then (pull, radius) and (0, radius),
/// at this height. A radius of 0 is a single point.
pub(super) struct Round {
    pub(super) radius: f64,
    pub(super) pull: f64,
    pub(super) height: f64,
}

/// A row of control points across the handle or the spout: a loop from `from`
/// (x, z) over both sides, `width` from the middle, to `to` and back.
pub(super) struct Across {
    pub(super) from: [f64; 2],
    pub(super) to: [f64; 2],
    pub(super) width: f64,
}

const fn round(radius: f64, pull: f64, height: f64) -> Round {
    Round { radius, pull, height }
}

const fn across(from: [f64; 2], to: [f64; 2], width: f64) -> Across {
    Across { from, to, width }
}

/// From the inner edge of the rim over the belly to the middle of the bottom:
/// each patch has four rows and shares the last with the next one.
pub(super) const BODY: [Round; 13] = [
    round(1.4, 0.784, 2.4),
    round(1.3375, 0.749, 2.53125),
    round(1.4375, 0.805, 2.53125),
    round(1.5, 0.84, 2.4),
    round(1.75, 0.98, 1.875),
    round(2.0, 1.12, 1.35),
    round(2.0, 1.12, 0.9),
    round(2.0, 1.12, 0.45),
    round(1.5, 0.84, 0.225),
    round(1.5, 0.84, 0.15),
    round(1.5, 0.84, 0.075),
    round(1.425, 0.798, 0.0),
    round(0.0, 0.0, 0.0),
];

/// From the tip of the knob to the edge of the lid.
pub(super) const LID: [Round; 7] = [
    round(0.0, 0.0, 3.15),
    round(0.8, 0.45, 3.15),
    round(0.0, 0.0, 2.85),
    round(0.2, 0.112, 2.7),
    round(0.4, 0.224, 2.55),
    round(1.3, 0.728, 2.55),
    round(1.3, 0.728, 2.4),
];

/// From its upper end on the belly backwards and down to the lower one.
pub(super) const HANDLE: [Across; 7] = [
    across([-1.6, 2.025], [-1.5, 2.25], 0.3),
    across([-2.3, 2.025], [-2.5, 2.25], 0.3),
    across([-2.7, 2.025], [-3.0, 2.25], 0.3),
    across([-2.7, 1.8], [-3.0, 1.8], 0.3),
    across([-2.7, 1.575], [-3.0, 1.35], 0.3),
    across([-2.5, 1.125], [-2.65, 0.9375], 0.3),
    across([-2.0, 0.9], [-1.9, 0.6], 0.3),
];

/// From the belly outwards, over the lip and into the mouth.
pub(super) const SPOUT: [Across; 7] = [
    across([1.7, 1.425], [1.7, 0.6], 0.66),
    across([2.6, 1.425], [3.1, 0.825], 0.66),
    across([2.3, 2.1], [2.4, 2.025], 0.25),
    across([2.7, 2.4], [3.3, 2.4], 0.25),
    across([2.8, 2.475], [3.525, 2.49375], 0.25),
    across([2.9, 2.475], [3.45, 2.5125], 0.15),
    across([2.8, 2.4], [3.2, 2.4], 0.15),
];
