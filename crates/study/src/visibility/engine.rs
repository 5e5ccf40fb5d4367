//! The engine, drawing ids alone.

use crate::engine::{Corners, Engine, clip_position, target};
use trigon_classic::{DEPTH_LIMIT, Drawing, STEPS_PER_PIXEL, Scene};
use trigon_math::{DVec2, Vec4};
use trigon_raster::Output;

pub(super) fn draw(scene: &Scene) -> Drawing {
    let shape = Corners::new(clip_corners(scene));
    Drawing { faces: Engine::default().seen(&shape, scene.size()), tests: 0 }
}

/// Draws again and again, into the same target.
pub(super) fn repeated(scene: &Scene) -> impl FnMut() + use<> {
    let (mut engine, mut target) = (Engine::default(), target(scene.size(), &[Output::Triangle]));
    let shape = Corners::new(clip_corners(scene));
    move || engine.draw(&shape, &mut target)
}

/// The corners of all faces, three for each, as the engine takes them.
pub(crate) fn clip_corners(scene: &Scene) -> Vec<Vec4> {
    let position = |[x, y, z]: [i32; 3]| {
        let point = DVec2::new(x.into(), y.into()) / f64::from(STEPS_PER_PIXEL);
        clip_position(point, f64::from(z) / f64::from(DEPTH_LIMIT), scene.size())
    };
    scene.faces().flat_map(|(_, face)| face.corners.map(position)).collect()
}
