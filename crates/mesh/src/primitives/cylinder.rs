//! The cylinder: a band of quads and two polygons.

use trigon_math::{DVec2, DVec3, Vec2};

use super::circle::{in_image, on_ground, turned};
use super::ring::{Ring, band};
use super::solid::{MOST_PIECES, Solid, length};
use crate::Mesh;

/// An upright cylinder round the origin with `segments` sides, 3 to 2048. The
/// side is shaded smoothly, the two ends are flat polygons with sharp rims.
/// The image goes once round the side, and each end shows a circle of it.
pub fn cylinder(radius: f32, height: f32, segments: u32) -> Mesh {
    let segments = segments.clamp(3, MOST_PIECES);
    let radius = f64::from(length(radius));
    let half = f64::from(length(height)) / 2.0;
    let count = segments as usize;
    let mut solid = Solid::with_capacity(2 * count, count + 2, 6 * count);
    let directions: Vec<DVec2> = (0..segments).map(|i| turned(i, segments)).collect();
    let mut ring = |y: f64, v: f64| {
        let points = directions.iter().map(|&direction| {
            let outwards = on_ground(direction);
            (outwards * radius + DVec3::Y * y, outwards)
        });
        Ring::new(&mut solid, v, points)
    };
    let (lower, upper) = (ring(-half, 1.0), ring(half, 0.0));
    band(&mut solid, &lower, &upper);
    let uvs: Vec<Vec2> = directions.iter().copied().map(in_image).collect();
    solid.face(&upper.vertices, &uvs);
    end_below(&mut solid, &lower, &directions);
    solid.build()
}

/// Closes a ring with a polygon that faces down, its image upright when it is
/// tipped over towards +Z.
pub(super) fn end_below(solid: &mut Solid, ring: &Ring, directions: &[DVec2]) {
    let vertices: Vec<u32> = ring.vertices.iter().rev().copied().collect();
    let flipped = directions.iter().rev().map(|d| DVec2::new(d.x, -d.y));
    let uvs: Vec<Vec2> = flipped.map(in_image).collect();
    solid.face(&vertices, &uvs);
}
