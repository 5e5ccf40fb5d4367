//! Ray casting (A. Appel, "Some techniques for shading machine renderings of solids",
//! AFIPS 1968): a ray through the middle of each pixel, and the nearest face that it
//! meets.

use super::scene::{Face, STEPS};
use super::{Drawing, Scene, Surface};
use crate::field::Field;
use trigon_math::{Bvh, Ray, Vec3};

/// Against every face.
pub(super) fn draw_with_all(scene: &Scene) -> Drawing {
    let surfaces: Vec<(u32, Surface)> =
        scene.faces().filter_map(|(number, face)| Some((number, Surface::new(face)?))).collect();
    let nearest = |place: [usize; 2]| {
        let pixel = place.map(|part| part as i32);
        let met = surfaces.iter().filter(|(_, surface)| surface.covers(pixel));
        let nearest = met.max_by(|(_, a), (_, b)| a.depth(pixel).total_cmp(&b.depth(pixel)));
        nearest.map_or(u32::MAX, |&(number, _)| number)
    };
    let faces = Field::from_fn(scene.size(), nearest);
    let tests = (faces.values().len() * surfaces.len()) as u64;
    Drawing { faces, tests }
}

/// Through a bounding volume hierarchy, which is built for the picture.
pub(super) fn draw_with_tree(scene: &Scene) -> Drawing {
    // In pixels. Depths are turned round, so that rays start at the eye.
    let corner = |[x, y, z]: [i32; 3]| Vec3::new(x as f32, y as f32, -z as f32) / STEPS as f32;
    let triangles: Vec<[Vec3; 3]> =
        scene.faces().map(|(_, Face { corners, .. })| corners.map(corner)).collect();
    let tree = Bvh::new(&triangles);
    let front = triangles.as_flattened().iter().map(|corner| corner.z).fold(0.0, f32::min) - 1.0;
    let nearest = |[x, y]: [usize; 2]| {
        let origin = Vec3::new(x as f32 + 0.5, y as f32 + 0.5, front);
        let hit = tree.nearest(&Ray { origin, direction: Vec3::Z }, 0.0..f32::INFINITY);
        hit.map_or(u32::MAX, |hit| hit.triangle)
    };
    Drawing { faces: Field::from_fn(scene.size(), nearest), tests: 0 }
}
