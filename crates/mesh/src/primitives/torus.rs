//! The torus.

use trigon_math::DVec3;

use super::circle::{on_ground, turned};
use super::ring::{Ring, band};
use super::solid::{MOST_PIECES, Solid, length};
use crate::Mesh;

/// A level torus: a tube of `minor_radius` round a circle of `major_radius`
/// about +Y, with `major_segments` by `minor_segments` quads (3 to 2048 each).
/// A tube as thick as the circle is wide or thicker meets itself in the
/// middle. The image's top is on the inside, where the tube is closed.
#[must_use]
pub fn torus(major_radius: f32, minor_radius: f32, major_segments: u32, minor_segments: u32) -> Mesh {
    let [major, minor] = [major_segments, minor_segments].map(|n| n.clamp(3, MOST_PIECES));
    let [wide, thick] = [major_radius, minor_radius].map(|radius| f64::from(length(radius)));
    let faces = (major * minor) as usize;
    let mut solid = Solid::with_capacity(faces, faces, 4 * faces);
    let mut ring = |i: u32| {
        // Starts on the inside and rises over the outside.
        let across = -turned(i, minor);
        let points = (0..major).map(|j| {
            let outwards = on_ground(turned(j, major));
            let normal = outwards * across.x + DVec3::Y * across.y;
            (outwards * wide + normal * thick, normal)
        });
        Ring::new(&mut solid, 1.0 - f64::from(i) / f64::from(minor), points)
    };
    let rings: Vec<Ring> = (0..minor).map(&mut ring).collect();
    for neighbours in rings.windows(2) {
        band(&mut solid, &neighbours[0], &neighbours[1]);
    }
    band(&mut solid, &rings[rings.len() - 1], &rings[0].again(0.0));
    solid.build()
}
