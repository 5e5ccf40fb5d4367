//! The engine's shadows of the same ball on the same floor.

use super::ball_on_floor::{self, BALL, FLOOR, LIGHT};
use std::num::NonZeroUsize;
use trigon_classic::Field;
use trigon_math::{DVec3, Vec3};
use trigon_mesh::primitives;
use trigon_scene::camera::{Camera, Projection};
use trigon_scene::{
    Frame, Light, Lighting, Material, Node, Outputs, RenderSettings, Renderer, Scene, Shading, Shadows,
    Transform,
};

/// The scene and what it takes to draw it again and again, on one thread.
pub struct Drawer {
    scene: Scene,
    camera: Camera,
    renderer: Renderer,
    frame: Frame,
}

impl Drawer {
    /// An image of `side` by `side` pixels that shows the floor and nothing else.
    #[must_use]
    pub fn new(shadows: Shadows, side: usize) -> Self {
        let mut settings = RenderSettings::new(side as u32, side as u32);
        settings.samples_per_axis = 1;
        settings.threads = Some(NonZeroUsize::MIN);
        settings.lighting = Lighting::Scene;
        settings.outputs = Outputs { color: false, radiance: true, ..Outputs::default() };
        settings.effects.shadows = shadows;
        Self { scene: scene(), camera: camera(), renderer: Renderer::new(settings), frame: Frame::default() }
    }

    /// Draws the image. What can be kept of it, maps and trees, is kept for the next one.
    pub fn draw(&mut self) {
        let drawn = self.renderer.render_into(&self.scene, &self.camera, &mut self.frame);
        drawn.expect("images of the study have a size in range");
    }

    /// The share of light in each pixel.
    pub fn light(&self) -> Field<f64> {
        let radiance = self.frame.radiance.as_ref().expect("it was asked for");
        let most = radiance.iter().map(|color| color.x).fold(0.0, f32::max);
        let side = self.frame.width as usize;
        Field::from_fn([side; 2], |[x, y]| f64::from(radiance[y * side + x].x / most))
    }
}

fn scene() -> Scene {
    let mut scene = Scene::new();
    let white = Material { shading: Shading::Lambert, ..Material::from_color(Vec3::ONE) };
    scene.add_object("floor", primitives::plane(FLOOR as f32, FLOOR as f32), white);
    let mesh = scene.add_mesh("ball", ball_on_floor::ball());
    let material = scene.add_material(Material::from_color(Vec3::ONE));
    scene.add(Node::from_mesh(mesh, material).at(BALL));
    let orientation = Camera::look_at(LIGHT, DVec3::ZERO, DVec3::Y).orientation;
    let sun = Transform::from_scale_rotation_translation(DVec3::ONE, orientation, DVec3::ZERO);
    scene.add(Node::from_light(Light::directional(1.0)).with_transform(sun));
    scene
}

/// Looks straight down from below the ball, whose lowest point is 0.2 metres above the floor.
fn camera() -> Camera {
    let eye = DVec3::new(0.0, 0.1, 0.0);
    let projection = Projection::orthographic(FLOOR, 0.01, 1.0).expect("the planes are in order");
    Camera { projection, ..Camera::look_at(eye, DVec3::ZERO, DVec3::NEG_Z) }
}
