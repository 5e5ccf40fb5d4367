//! A panel with widgets beside a scene: what they change is drawn, and nothing else.

use trigon_window::scene::math::Vec3;
use trigon_window::scene::{Material, mesh::primitives};
use trigon_window::{Application, WindowError, egui};

fn main() -> Result<(), WindowError> {
    let mut application = Application::new("Panel");
    let scene = &mut application.stage.scene;
    let material = scene.add_material(Material::from_color(Vec3::new(0.7, 0.3, 0.1)));
    let mesh = scene.add_mesh("teapot", primitives::teapot(8));
    scene.add(trigon_window::scene::Node::from_mesh(mesh, material));

    let mut color = [0.7, 0.3, 0.1];
    application.interface(move |stage, ui| {
        egui::Panel::left("settings").show(ui, |ui| {
            ui.heading("Light");
            ui.add(egui::Slider::new(&mut stage.settings.light_intensity, 0.1..=4.0).text("intensity"));
            ui.heading("Colour");
            if ui.color_edit_button_rgb(&mut color).changed()
                && let Some(material) = stage.scene.materials.get_mut(material)
            {
                *material = Material::from_color(color.into());
            }
        });
    });
    application.run()
}
