//! A scene at rest: it is drawn when something changes, and only then. With an
//! own key (G, for another cube), an own text, and dropped files' names.

use std::path::PathBuf;

use trigon_math::DVec3;
use trigon_mesh::primitives;
use trigon_scene::Material;
use trigon_window::{Action, Application, Corner, Handler, Modifiers, Stage, WindowError};

#[derive(Default)]
struct Still {
    cubes: u32,
}

impl Handler for Still {
    fn start(&mut self, stage: &mut Stage) {
        stage.keymap.bind('g', "add_cube", Action::Command, "add a cube");
        stage.overlay.set(Corner::Top, ["Cubes at rest"]);
        self.command(stage, "add_cube");
    }

    fn command(&mut self, stage: &mut Stage, name: &str) {
        if name == "add_cube" {
            let cube = primitives::cube(1.0);
            let id = stage.scene.add_object(format!("cube {}", self.cubes), cube, Material::default());
            if let Some(node) = stage.scene.node_mut(id) {
                node.transform.translate(DVec3::X * 1.5 * f64::from(self.cubes));
            }
            self.cubes += 1;
            stage.set_title(format!("{} cubes", self.cubes));
        }
    }

    fn dropped(&mut self, stage: &mut Stage, paths: Vec<PathBuf>, _: Modifiers) {
        paths.iter().for_each(|path| stage.overlay.notify(format!("Dropped: {}", path.display())));
    }
}

fn main() -> Result<(), WindowError> {
    Application::new("Still").run_with(&mut Still::default())
}
