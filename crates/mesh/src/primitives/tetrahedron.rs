//! The tetrahedron: 4 vertices, 6 edges, 4 triangles.

use trigon_math::DVec3;

use super::circle::{on_ground, regular_polygon, turned};
use super::solid::{Solid, length};
use crate::Mesh;

/// The lowest face and the three that meet at the top, vertex 3.
const FACES: [[u32; 3]; 4] = [[0, 2, 1], [3, 0, 1], [3, 1, 2], [3, 2, 0]];

/// A regular tetrahedron with edges of `edge` metres, its lowest face level,
/// its centre in the origin. Each face shows a triangle of the image.
#[must_use]
pub fn tetrahedron(edge: f32) -> Mesh {
    let edge = f64::from(length(edge));
    let to_corner = edge * 6.0_f64.sqrt() / 4.0;
    let base_radius = edge / 3.0_f64.sqrt();
    let mut solid = Solid::with_capacity(4, 4, 12);
    for third in 0..3 {
        let position = on_ground(turned(third, 3).perp()) * base_radius;
        solid.vertex((position - DVec3::Y * (to_corner / 3.0)).as_vec3());
    }
    solid.vertex((DVec3::Y * to_corner).as_vec3());
    for face in FACES {
        solid.face(&face, &regular_polygon::<3>());
    }
    solid.build()
}
