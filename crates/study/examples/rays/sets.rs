//! The rays of a scene: camera rays, and what starts where they hit.

use crate::scenes::{Setting, direction};
use trigon_math::{Bvh, Ray, SplitMix64, Vec3};

/// Pixels of the camera; multiples of 8.
const SIZE: [u32; 2] = [640, 480];

/// A ray that looks for hits before an end.
#[derive(Clone, Copy)]
pub(crate) struct Query {
    pub(crate) ray: Ray,
    pub(crate) end: f32,
}

/// Rays that are asked one after the other.
pub(crate) struct Set<'a> {
    pub(crate) name: &'a str,
    /// Whether any hit will do.
    pub(crate) is_any: bool,
    pub(crate) queries: Vec<Query>,
}

/// Where a camera ray hits, moved off the surface towards the camera.
struct Surface {
    point: Vec3,
    normal: Vec3,
}

pub(crate) fn of(setting: &Setting, bvh: &Bvh) -> [Set<'static>; 4] {
    let primary: Vec<Query> = (0..SIZE[0] * SIZE[1]).map(|number| camera_ray(setting, number)).collect();
    let surfaces: Vec<Surface> = primary.iter().filter_map(|query| surface(setting, bvh, query)).collect();
    let mut random = SplitMix64::new(2);
    let mut cosine = |surface: &Surface, end| {
        let direction = (surface.normal + direction(&mut random) * 0.999).normalize();
        Query { ray: Ray { origin: surface.point, direction }, end }
    };
    let sparse = surfaces.iter().step_by(16).flat_map(|surface| std::iter::repeat_n(surface, 16));
    let ambient = sparse.map(|surface| cosine(surface, setting.reach)).collect();
    let bounce = surfaces.iter().map(|surface| cosine(surface, f32::INFINITY)).collect();
    let sun = setting.sun.normalize();
    let shadow =
        |surface: &Surface| Query { ray: Ray { origin: surface.point, direction: sun }, end: f32::INFINITY };
    let shadow = surfaces.iter().map(shadow).collect();
    [
        Set { name: "primary", is_any: false, queries: primary },
        Set { name: "shadow", is_any: true, queries: shadow },
        Set { name: "ambient", is_any: true, queries: ambient },
        Set { name: "bounce", is_any: false, queries: bounce },
    ]
}

/// Pixels go in tiles of 8 × 8, and those in blocks of 4 × 2, so that eight rays in a row are near each other.
fn camera_ray(setting: &Setting, number: u32) -> Query {
    let [tile, block, lane] = [number / 64, number / 8 % 8, number % 8];
    let x = tile % (SIZE[0] / 8) * 8 + block % 2 * 4 + lane % 4;
    let y = tile / (SIZE[0] / 8) * 8 + block / 2 * 2 + lane / 4;
    let forward = (setting.target - setting.eye).normalize();
    let right = forward.cross(Vec3::Y).normalize();
    let [width, height] = SIZE.map(|pixels| pixels as f32);
    let across = right * (x as f32 + 0.5 - width / 2.0) / height;
    let up = right.cross(forward) * (height / 2.0 - y as f32 - 0.5) / height;
    let direction = (forward + across + up).normalize();
    Query { ray: Ray { origin: setting.eye, direction }, end: f32::INFINITY }
}

fn surface(setting: &Setting, bvh: &Bvh, query: &Query) -> Option<Surface> {
    let hit = bvh.nearest(&query.ray, 0.0..query.end)?;
    let [a, b, c] = setting.triangles[hit.triangle as usize];
    let across = (b - a).cross(c - a).normalize_or(Vec3::Y);
    let normal = if across.dot(query.ray.direction) > 0.0 { -across } else { across };
    Some(Surface { point: query.ray.at(hit.distance) + normal * (setting.reach * 1e-3), normal })
}
