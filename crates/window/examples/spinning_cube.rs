//! A spinning cube with a small companion that comes and goes. Arrows and mouse
//! move the camera, Tab selects an object, Alt+arrows move it; H lists the rest.

use trigon_window::scene::math::{DVec3, Vec3};
use trigon_window::scene::{Material, Node, mesh::primitives};
use trigon_window::{AnimationState, Application, WindowError};

fn main() -> Result<(), WindowError> {
    let mut application = Application::new("Spinning cube");
    let scene = &mut application.stage.scene;
    let red = Material::from_color(Vec3::new(0.7, 0.1, 0.08));
    let cube = scene.add_object("cube", primitives::cube(1.0), red);
    let small = scene.add_mesh("small", primitives::cube(0.3));
    let blue = scene.add_material(Material::from_color(Vec3::new(0.08, 0.2, 0.7)));

    let mut companion = None;
    application.animate(move |stage, tick| {
        if let Some(node) = stage.scene.node_mut(cube) {
            node.transform.rotate(DVec3::new(0.3, 1.0, 0.0), tick.delta.as_secs_f64());
        }
        // There for two seconds, away for two.
        match (companion, tick.time.as_secs() % 4 < 2) {
            (None, true) => {
                let node = Node::from_mesh(small, blue).with_name("companion").at(DVec3::X);
                companion = Some(stage.scene.add(node));
            }
            (Some(id), false) => {
                stage.scene.remove(id);
                companion = None;
            }
            _ => {}
        }
        AnimationState::Running
    });
    application.run()
}
