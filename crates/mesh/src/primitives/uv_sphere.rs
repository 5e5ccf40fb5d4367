//! The sphere by longitude and latitude.

use trigon_math::DVec3;

use super::circle::{on_ground, turned};
use super::ring::{Ring, band};
use super::solid::{MOST_PIECES, Solid, length};
use crate::Mesh;

/// A sphere with `segments` sides round its axis (3 to 2048) and `rings` bands
/// from pole to pole (2 to 2048): quads, and triangles at the poles. The
/// image goes round it as on a world map.
#[must_use]
pub fn uv_sphere(radius: f32, segments: u32, rings: u32) -> Mesh {
    let segments = segments.clamp(3, MOST_PIECES);
    let rings = rings.clamp(2, MOST_PIECES);
    let radius = f64::from(length(radius));
    let faces = (segments * rings) as usize;
    let mut solid = Solid::with_capacity(faces, faces, 4 * faces);
    let mut latitude = |ring: u32| {
        // Half a turn from the north pole to the south pole.
        let from_north = turned(ring, 2 * rings);
        let sides = if ring == 0 || ring == rings { 1 } else { segments };
        let points = (0..sides).map(|i| {
            let normal = on_ground(turned(i, segments)) * from_north.y + DVec3::Y * from_north.x;
            (normal * radius, normal)
        });
        Ring::new(&mut solid, f64::from(ring) / f64::from(rings), points)
    };
    let latitudes: Vec<Ring> = (0..=rings).map(&mut latitude).collect();
    for neighbours in latitudes.windows(2) {
        band(&mut solid, &neighbours[1], &neighbours[0]);
    }
    solid.build()
}
