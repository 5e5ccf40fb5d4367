//! Knots that lie on a torus.

use trigon_math::DVec3;

use super::round::{Ring, band};
use super::round::{on_ground, turned};
use super::solid::{MOST_PIECES, Solid, length};
use crate::Mesh;

/// The shape of a [`torus_knot`]. The default is the trefoil.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TorusKnot {
    /// How often the knot goes round the torus's axis, 1 to 32.
    pub turns: u32,
    /// How often it goes through the torus's hole, 1 to 32. Factors that both
    /// numbers have are divided out: they would repeat the same way.
    pub loops: u32,
    /// The radius of the circle in the middle of the torus's tube, in metres.
    pub major_radius: f32,
    /// The radius of the torus's tube, on which the knot runs, in metres.
    pub minor_radius: f32,
    /// The radius of the knot's own tube, in metres.
    pub tube_radius: f32,
    /// Pieces along the knot, 3 to 2048.
    pub segments: u32,
    /// Sides of its tube, 3 to 2048.
    pub sides: u32,
}

impl Default for TorusKnot {
    fn default() -> Self {
        Self {
            turns: 2,
            loops: 3,
            major_radius: 1.0,
            minor_radius: 0.5,
            tube_radius: 0.2,
            segments: 192,
            sides: 16,
        }
    }
}

/// The highest number of turns or loops.
const MOST_TURNS: u32 = 32;

/// A tube along a knot that winds on a level torus: `segments` by `sides`
/// quads. The tube's sides are kept square to the torus, so they close
/// without a twist.
#[must_use]
pub fn torus_knot(shape: &TorusKnot) -> Mesh {
    let curve = Curve::new(shape);
    let [segments, sides] = [shape.segments, shape.sides].map(|n| n.clamp(3, MOST_PIECES));
    let tube = f64::from(length(shape.tube_radius));
    let faces = (segments * sides) as usize;
    let mut solid = Solid::with_capacity(faces, faces, 4 * faces);
    let mut ring = |i: u32| {
        let [center, right, up] = curve.frame(i, segments);
        let points = (0..sides).map(|j| {
            let across = turned(j, sides);
            let normal = right * across.x + up * across.y;
            (center + normal * tube, normal)
        });
        Ring::new(&mut solid, 1.0 - f64::from(i) / f64::from(segments), points)
    };
    let rings: Vec<Ring> = (0..segments).map(&mut ring).collect();
    for neighbours in rings.windows(2) {
        band(&mut solid, &neighbours[0], &neighbours[1]);
    }
    band(&mut solid, &rings[rings.len() - 1], &rings[0].again(0.0));
    solid.build()
}

/// The line in the middle of the tube.
struct Curve {
    turns: u32,
    loops: u32,
    major: f64,
    minor: f64,
}

impl Curve {
    fn new(shape: &TorusKnot) -> Self {
        let [turns, loops] = [shape.turns, shape.loops].map(|n| n.clamp(1, MOST_TURNS));
        let common = greatest_common_divisor(turns, loops);
        Self {
            turns: turns / common,
            loops: loops / common,
            major: f64::from(length(shape.major_radius)),
            minor: f64::from(length(shape.minor_radius)),
        }
    }

    /// The point after `part` of `parts` of the way, and two unit vectors
    /// square to the curve and to each other: the first one out of the torus,
    /// the second to its left seen along the curve.
    fn frame(&self, part: u32, parts: u32) -> [DVec3; 3] {
        // Exact at quarter turns, and within range: 2048 * 32 parts.
        let round = turned(part * self.turns % parts, parts);
        let across = turned(part * self.loops % parts, parts);
        let outwards = on_ground(round);
        let onwards = on_ground(round.perp());
        let out = outwards * across.x + DVec3::Y * across.y;
        let over = DVec3::Y * across.x - outwards * across.y;
        let center = outwards * self.major + out * self.minor;
        let [turns, loops] = [self.turns, self.loops].map(f64::from);
        let distance = self.major + self.minor * across.x;
        let along = onwards * (distance * turns) + over * (self.minor * loops);
        let left = along.cross(out).normalize();
        [center, out, left]
    }
}

fn greatest_common_divisor(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { greatest_common_divisor(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_square_to_the_curve() {
        let curve = Curve::new(&TorusKnot::default());
        for i in 0..360 {
            let [center, out, left] = curve.frame(i, 360);
            let ahead = curve.frame((i + 1) % 360, 360)[0] - curve.frame((i + 359) % 360, 360)[0];
            assert!(out.dot(left).abs() < 1e-12, "the frame at {i} is not square");
            let slant = ahead.normalize().dot(out).abs().max(ahead.normalize().dot(left).abs());
            assert!(slant < 0.02, "the frame at {i} ({center}) leans by {slant}");
            assert!(out.cross(left).dot(ahead) > 0.0, "the frame at {i} looks back");
        }
    }
}
