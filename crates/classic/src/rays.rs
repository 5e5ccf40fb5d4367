//! Ray casting (A. Appel, "Some techniques for shading machine renderings of solids", AFIPS 1968): a ray
//! through the centre of each pixel, and the nearest face that it hits.

use super::Field;
use super::scene::{Face, STEPS_PER_PIXEL};
use super::{Drawing, Scene, Surface};
use trigon_math::{Bvh, Ray, Vec3};

/// All faces, set up.
pub(super) struct AllFaces {
    surfaces: Vec<(u32, Surface)>,
    drawing: Drawing,
}

impl AllFaces {
    pub(super) fn new(scene: &Scene) -> Self {
        let surfaces =
            scene.faces().filter_map(|(number, face)| Some((number, Surface::new(face)?))).collect();
        Self { surfaces, drawing: Drawing::empty(scene.size()) }
    }

    /// A ray through each pixel against every face.
    pub(super) fn draw(&mut self) -> &Drawing {
        let Self { surfaces, drawing } = self;
        each_pixel(&mut drawing.faces, |[x, y]| {
            let pixel = [x as i32, y as i32];
            let met = surfaces.iter().filter(|(_, surface)| surface.covers(pixel));
            let nearest = met.max_by(|(_, a), (_, b)| a.depth(pixel).total_cmp(&b.depth(pixel)));
            nearest.map_or(u32::MAX, |&(number, _)| number)
        });
        drawing.tests = (drawing.faces.values().len() * surfaces.len()) as u64;
        drawing
    }
}

/// A bounding volume hierarchy of all faces.
pub(super) struct Tree {
    tree: Bvh,
    /// Where rays start: before all faces.
    front: f32,
    drawing: Drawing,
}

impl Tree {
    pub(super) fn new(scene: &Scene) -> Self {
        // In pixels. Depths are turned round, so that rays start at the eye.
        let corner = |[x, y, z]: [i32; 3]| Vec3::new(x as f32, y as f32, -z as f32) / STEPS_PER_PIXEL as f32;
        let triangles: Vec<[Vec3; 3]> =
            scene.faces().map(|(_, Face { corners, .. })| corners.map(corner)).collect();
        let front = triangles.as_flattened().iter().map(|corner| corner.z).fold(0.0, f32::min) - 1.0;
        Self { tree: Bvh::new(&triangles), front, drawing: Drawing::empty(scene.size()) }
    }

    /// A ray through each pixel against the tree.
    pub(super) fn draw(&mut self) -> &Drawing {
        let Self { tree, front, drawing } = self;
        each_pixel(&mut drawing.faces, |[x, y]| {
            let origin = Vec3::new(x as f32 + 0.5, y as f32 + 0.5, *front);
            let hit = tree.nearest(&Ray { origin, direction: Vec3::Z }, 0.0..f32::INFINITY);
            hit.map_or(u32::MAX, |hit| hit.triangle)
        });
        drawing
    }
}

/// Sets each pixel to what a function says of its place.
fn each_pixel(faces: &mut Field<u32>, face: impl Fn([usize; 2]) -> u32) {
    for (y, row) in faces.rows_mut().enumerate() {
        for (x, pixel) in row.iter_mut().enumerate() {
            *pixel = face([x, y]);
        }
    }
}
