//! The sphere by halving the edges of an icosahedron.

use std::f64::consts::{PI, TAU};

use trigon_math::{DVec3, Vec2, elementary};

use super::icosahedron::{FACES, GOLDEN_RATIO, golden_corners};
use super::solid::{Corner, Solid, length};
use crate::{Mesh, MeshBuilder};

/// The highest number of subdivisions: 327 680 triangles.
const MOST_SUBDIVISIONS: u32 = 7;

/// A sphere of nearly equal triangles: an icosahedron whose edges were halved
/// `subdivisions` times (0 to 7), 20·4ⁿ triangles. The image goes round it as
/// on a world map; where a triangle crosses the map's border its texture
/// coordinates run past 1, so let textures repeat.
#[must_use]
pub fn icosphere(radius: f32, subdivisions: u32) -> Mesh {
    let radius = f64::from(length(radius));
    let mut directions: Vec<DVec3> =
        golden_corners(1.0, GOLDEN_RATIO).map(|corner| corner.normalize()).collect();
    let mut faces = FACES.to_vec();
    for _ in 0..subdivisions.min(MOST_SUBDIVISIONS) {
        faces = subdivide(&mut directions, &faces);
    }
    let mut solid = Solid::with_capacity(directions.len(), faces.len(), 3 * faces.len());
    for direction in &directions {
        solid.vertex((*direction * radius).as_vec3());
    }
    for face in faces {
        let uvs = on_map(face.map(|vertex| directions[vertex as usize]));
        solid.curved_face([0, 1, 2].map(|i| {
            let normal = directions[face[i] as usize].as_vec3();
            Corner { vertex: face[i], uv: uvs[i], normal }
        }));
    }
    solid.build()
}

/// Adds the middle of every edge and makes four triangles of each.
fn subdivide(directions: &mut Vec<DVec3>, faces: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut builder = MeshBuilder::with_capacity(directions.len(), faces.len(), 3 * faces.len());
    for direction in directions.iter() {
        builder.push_vertex(direction.as_vec3());
    }
    for face in faces {
        builder.push_face(face).expect("the triangles of a sphere have three vertices");
    }
    let coarse = builder.build();
    let first = directions.len() as u32;
    for &[a, b] in coarse.edges() {
        directions.push((directions[a as usize] + directions[b as usize]).normalize());
    }
    let middle = |corner| first + coarse.corner_edge(corner).expect("its vertices are distinct");
    let quarters = |(corner, &[a, b, c]): (usize, &[u32; 3])| {
        let [ab, bc, ca] = [corner, corner + 1, corner + 2].map(middle);
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
    };
    (0..).step_by(3).zip(faces).flat_map(quarters).collect()
}

/// Longitude and latitude of a triangle's corners, without a jump inside it.
fn on_map(corners: [DVec3; 3]) -> [Vec2; 3] {
    let longitudes = corners.map(|p| {
        let is_pole = p.x * p.x + p.z * p.z < 1e-24;
        (!is_pole).then(|| (elementary::atan2(-p.z, p.x) / TAU).rem_euclid(1.0))
    });
    let known = || longitudes.into_iter().flatten();
    let highest = known().fold(0.0, f64::max);
    let unrolled = |u: f64| if highest - u > 0.5 { u + 1.0 } else { u };
    // A pole has every longitude; the middle of the others suits best.
    let middle = known().map(unrolled).sum::<f64>() / known().count() as f64;
    [0, 1, 2].map(|i| {
        let u = longitudes[i].map_or(middle, unrolled);
        let v = elementary::acos(corners[i].y.clamp(-1.0, 1.0)) / PI;
        Vec2::new(u as f32, v as f32)
    })
}
