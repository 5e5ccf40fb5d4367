//! The scenes in which the algorithms are compared.

use trigon_classic::{Body, Pose, STEPS_PER_PIXEL, Scene};
use trigon_math::{DVec3, SplitMix64};
use trigon_mesh::{Mesh, primitives};

/// A scene that asks one question.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VisibilityCase {
    /// 40 balls of 80 faces all over the image: what is usual.
    Balls,
    /// Three long bodies that overlap in a ring: no order from back to front is right.
    Ring,
    /// Balls that stick in each other.
    Crossing,
    /// A torus of 2,304 triangles, a body that is not convex.
    Torus,
    /// The Utah teapot, likewise.
    Teapot,
}

impl VisibilityCase {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Balls, Self::Ring, Self::Crossing, Self::Torus, Self::Teapot];

    /// The name in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Balls => "40 balls",
            Self::Ring => "three in a ring",
            Self::Crossing => "balls in each other",
            Self::Torus => "torus",
            Self::Teapot => "teapot",
        }
    }

    /// The bodies in a square image of `side` pixels.
    #[must_use]
    pub fn scene(self, side: usize) -> Scene {
        let size = side as f64;
        match self {
            Self::Balls => balls(side, 40, size / 14.0, 1),
            Self::Ring => Scene::new([side; 2], ring(size)),
            Self::Crossing => crossing(side),
            Self::Torus => of_mesh(side, &primitives::torus(1.0, 0.4, 48, 24), size / 3.2),
            Self::Teapot => of_mesh(side, &primitives::teapot(6), size / 7.0),
        }
    }
}

/// Balls of 80 faces at chance places, wholly in the image.
#[must_use]
pub fn balls(side: usize, count: usize, radius: f64, seed: u64) -> Scene {
    let mut random = SplitMix64::new(seed);
    let mut pixel = || {
        let mut across = || random.between(radius, side as f64 - radius);
        DVec3::new(across(), across(), across())
    };
    let bodies = (0..count).map(|_| ball(radius, pixel())).collect();
    Scene::new([side; 2], bodies)
}

/// Sixteen sheets over the whole image, one behind the other; `tilt` pixels nearer and
/// farther at their corners, each at others, so that tilted ones cross. What they cover is
/// the same for any tilt.
#[must_use]
pub fn sheets(side: usize, tilt: i32) -> Scene {
    let side_px = side as i32;
    let sheet = |i: i32| {
        let corner = |j: i32, x: i32, y: i32| {
            let depth = side_px * 3 / 2 + i * side_px / 64 + ((i + j) % 3 - 1) * tilt;
            [x * side_px, y * side_px, depth].map(|part| part * STEPS_PER_PIXEL)
        };
        // Its far side is a point behind its middle.
        let behind = [side_px, side_px, 0].map(|part| part * STEPS_PER_PIXEL);
        Body::tetrahedron([corner(0, -1, -1), corner(1, 3, -1), corner(2, -1, 3), behind])
    };
    Scene::new([side; 2], (0..16).map(sheet).collect())
}

fn ball(radius: f64, middle: DVec3) -> Body {
    Body::of_mesh(&primitives::icosphere(1.0, 1), Pose::new(0.3, 0.4, radius, middle))
}

/// Two rows of balls, each of which sticks in its neighbours. None is farther from the eye than the first.
fn crossing(side: usize) -> Scene {
    let size = side as f64;
    let pixel = |i: usize| {
        let (row, column) = ((i / 6) as f64, (i % 6) as f64);
        DVec3::new(0.15 + 0.14 * column, 0.35 + 0.3 * row, 0.3 + 0.02 * ((i * 5) % 7) as f64) * size
    };
    Scene::new([side; 2], (0..12).map(|i| ball(size / 9.0, pixel(i))).collect())
}

/// Three tetrahedra, each with its far end under the one before it.
fn ring(size: f64) -> Vec<Body> {
    let grid = |point: [f64; 3]| point.map(|part| (part * size * f64::from(STEPS_PER_PIXEL)).round() as i32);
    let ends = [[0.1, 0.2], [0.9, 0.3], [0.4, 0.9]];
    let bar = |i: usize| {
        let ([x, y], [u, v]) = (ends[i], ends[(i + 1) % 3]);
        // Beyond the next corner, and away from the eye from near to far.
        let (end_x, end_y) = (x + 1.12 * (u - x), y + 1.12 * (v - y));
        let (start_x, start_y) = (x - 0.12 * (u - x), y - 0.12 * (v - y));
        let (across_x, across_y) = (0.08 * (v - y), -0.08 * (u - x));
        Body::tetrahedron([
            grid([start_x + across_x, start_y + across_y, 0.5]),
            grid([start_x - across_x, start_y - across_y, 0.5]),
            grid([end_x + across_x, end_y + across_y, 0.2]),
            grid([end_x - across_x, end_y - across_y, 0.21]),
        ])
    };
    (0..3).map(bar).collect()
}

fn of_mesh(side: usize, mesh: &Mesh, scale: f64) -> Scene {
    let bounds = mesh.bounds();
    let middle = DVec3::splat(side as f64 / 2.0);
    let pose = Pose::new(0.7, 0.5, scale, middle);
    let center = pose.turn * ((bounds.min + bounds.max) / 2.0) * scale;
    let middle = middle - DVec3::new(center.x, -center.y, center.z);
    Scene::new([side; 2], vec![Body::of_mesh(mesh, Pose { middle, ..pose })])
}

#[cfg(test)]
mod tests;
