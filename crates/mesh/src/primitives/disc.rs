//! The disc: one polygon.

use trigon_math::Vec2;

use super::circle::{in_image, on_ground, turned};
use super::solid::{MOST_PIECES, Solid, length};
use crate::Mesh;

/// A level disc that faces up, as one polygon with `segments` corners, 3 to
/// 2048. It shows the circle that fits in the image, whose top is at −Z.
pub fn disc(radius: f32, segments: u32) -> Mesh {
    let segments = segments.clamp(3, MOST_PIECES);
    let radius = f64::from(length(radius));
    let mut solid = Solid::with_capacity(segments as usize, 1, segments as usize);
    let points = (0..segments).map(|i| turned(i, segments));
    let vertices: Vec<u32> =
        points.clone().map(|p| solid.vertex((on_ground(p) * radius).as_vec3())).collect();
    let uvs: Vec<Vec2> = points.map(in_image).collect();
    solid.face(&vertices, &uvs);
    solid.build()
}
