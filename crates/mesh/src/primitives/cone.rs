//! The cone: triangles round a tip, and one polygon.

use trigon_math::{DVec2, DVec3};

use super::circle::{on_ground, turned};
use super::cylinder::end_below;
use super::ring::{Ring, band};
use super::solid::{MOST_PIECES, Solid, length};
use crate::Mesh;

/// An upright cone with `segments` sides, 3 to 2048: its tip at half its
/// height above the origin, its base at half its height below. The side is
/// shaded smoothly (at the tip, which has no normal, each triangle has the one
/// of its middle), the base is a flat polygon with a sharp rim.
#[must_use]
pub fn cone(radius: f32, height: f32, segments: u32) -> Mesh {
    let segments = segments.clamp(3, MOST_PIECES);
    let radius = f64::from(length(radius));
    let height = f64::from(length(height));
    let count = segments as usize;
    let mut solid = Solid::with_capacity(count + 1, count + 1, 4 * count);
    let normal = |direction: DVec2| (on_ground(direction) * height + DVec3::Y * radius).normalize();
    let directions: Vec<DVec2> = (0..segments).map(|i| turned(i, segments)).collect();
    let foot = DVec3::Y * (-height / 2.0);
    let points = directions.iter().map(|&d| (on_ground(d) * radius + foot, normal(d)));
    let base = Ring::new(&mut solid, 1.0, points);
    let between = (0..segments).map(|i| turned(2 * i + 1, 2 * segments));
    let tip = Ring {
        vertices: vec![solid.vertex((-foot).as_vec3())],
        normals: between.map(|d| normal(d).as_vec3()).collect(),
        v: 0.0,
    };
    band(&mut solid, &base, &tip);
    end_below(&mut solid, &base, &directions);
    solid.build()
}
