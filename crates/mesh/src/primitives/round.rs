//! Round objects: spheres, cylinder, cone, disc and torus, of bands between rings of points on the unit circle.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use trigon_math::{DVec2, DVec3, Vec2, Vec3, elementary};

use super::polyhedra::{GOLDEN_RATIO, ICOSAHEDRON_FACES, golden_corners};
use super::solid::{Corner, MOST_PIECES, Solid, length};
use crate::{Mesh, MeshBuilder};

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
    let mut faces = ICOSAHEDRON_FACES.to_vec();
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

/// Vertices once round, counter-clockwise seen from the side where the next
/// ring upwards is. Or one vertex only, a pole.
#[derive(Clone)]
pub(super) struct Ring {
    pub(super) vertices: Vec<u32>,
    /// One normal per vertex. At a pole either one, or one for each triangle
    /// that meets there.
    pub(super) normals: Vec<Vec3>,
    /// The texture coordinate along the surface, 0 at the top.
    pub(super) v: f32,
}

impl Ring {
    /// Adds vertices with their normals.
    pub(super) fn new(solid: &mut Solid, v: f64, points: impl Iterator<Item = (DVec3, DVec3)>) -> Self {
        let (vertices, normals) =
            points.map(|(position, normal)| (solid.vertex(position.as_vec3()), normal.as_vec3())).unzip();
        Self { vertices, normals, v: v as f32 }
    }

    /// The same ring met a second time, at the end of the image.
    pub(super) fn again(&self, v: f32) -> Self {
        Self { v, ..self.clone() }
    }

    fn corner(&self, i: usize, u: f32) -> Corner {
        Corner {
            vertex: self.vertices[i % self.vertices.len()],
            uv: Vec2::new(u, self.v),
            normal: self.normals[i % self.normals.len()],
        }
    }

    fn is_pole(&self) -> bool {
        self.vertices.len() == 1
    }
}

/// Closes the surface between two rings with as many vertices, or a ring and a
/// pole: quads, or triangles. Seen from outside, u runs to the right, from 0
/// to 1 once round.
pub(super) fn band(solid: &mut Solid, lower: &Ring, upper: &Ring) {
    let segments = lower.vertices.len().max(upper.vertices.len());
    let u = |numerator: f64| (numerator / segments as f64) as f32;
    for i in 0..segments {
        let (left, right, middle) = (u(i as f64), u(i as f64 + 1.0), u(i as f64 + 0.5));
        let bottom = [lower.corner(i, left), lower.corner(i + 1, right)];
        let top = [upper.corner(i + 1, right), upper.corner(i, left)];
        match (lower.is_pole(), upper.is_pole()) {
            (true, _) => solid.curved_face([lower.corner(i, middle), top[0], top[1]]),
            (_, true) => solid.curved_face([bottom[0], bottom[1], upper.corner(i, middle)]),
            _ => solid.curved_face([bottom[0], bottom[1], top[0], top[1]]),
        }
    }
}

/// The point after `part` of `parts` of a full turn, counter-clockwise from
/// (1, 0). Quarter turns are exact, so that round objects touch their bounds.
pub(super) fn turned(part: u32, parts: u32) -> DVec2 {
    let quarters = 4 * u64::from(part);
    let parts = u64::from(parts);
    let angle = (quarters % parts) as f64 / parts as f64 * FRAC_PI_2;
    let (sin, cos) = elementary::sin_cos(angle);
    match (quarters / parts) % 4 {
        0 => DVec2::new(cos, sin),
        1 => DVec2::new(-sin, cos),
        2 => DVec2::new(-cos, -sin),
        _ => DVec2::new(sin, -cos),
    }
}

/// A point of the plane that is seen from above (x right, y away) as a point
/// in space, where +Y is up and away is −Z.
pub(super) fn on_ground(point: DVec2) -> DVec3 {
    DVec3::new(point.x, 0.0, -point.y)
}

/// Where a point of the unit circle (y up) is in an image (v down) that the
/// circle just fits in.
pub(super) fn in_image(point: DVec2) -> Vec2 {
    DVec2::new(0.5 + 0.5 * point.x, 0.5 - 0.5 * point.y).as_vec2()
}

/// The corners of a regular polygon in an image, counter-clockwise, its first
/// one at the top.
pub(super) fn regular_polygon<const N: usize>() -> [Vec2; N] {
    std::array::from_fn(|i| in_image(turned(i as u32, N as u32).perp()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_on_the_circle_and_quarters_are_exact() {
        for parts in 3..100 {
            for part in 0..parts {
                let length = turned(part, parts).length();
                assert!((length - 1.0).abs() < 1e-15, "{part} of {parts}: {length}");
            }
        }
        let quarters = [0, 1, 2, 3].map(|part| turned(part, 4));
        assert_eq!(quarters, [DVec2::X, DVec2::Y, -DVec2::X, -DVec2::Y], "quarter turns");
    }
}
