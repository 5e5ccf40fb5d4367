//! A ball of a material, drawn by the renderer.

use trigon_document::Document;
use trigon_document::mesh::primitives;
use trigon_document::scene::camera::Camera;
use trigon_document::scene::math::DVec3;
use trigon_document::scene::{Lighting, Material, MaterialId, Node, RenderSettings, Scene, render};
use trigon_window::egui::{self, ColorImage, TextureHandle, TextureOptions, Ui};

/// In pixels and points.
const SIDE: u32 = 96;

/// The picture of a material, drawn again when that has changed.
#[derive(Default)]
pub(super) struct Preview {
    shown: Option<(MaterialId, Material, TextureHandle)>,
}

impl std::fmt::Debug for Preview {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Preview").finish_non_exhaustive()
    }
}

impl Preview {
    /// Shows the ball.
    pub(super) fn show(&mut self, ui: &mut Ui, document: &Document, id: MaterialId, material: &Material) {
        if self.shown.as_ref().is_none_or(|(of, known, _)| (*of, known) != (id, material)) {
            let Some(image) = image(document.nodes(), id) else { return };
            let texture = ui.ctx().load_texture("material", image, TextureOptions::LINEAR);
            self.shown = Some((id, material.clone(), texture));
        }
        if let Some((.., texture)) = &self.shown {
            ui.vertical_centered(|ui| {
                ui.add(egui::Image::new((texture.id(), egui::Vec2::splat(SIDE as f32))));
            });
        }
    }
}

/// A ball of this material in studio lights.
fn image(scene: &Scene, material: MaterialId) -> Option<ColorImage> {
    let mut studio = scene.clone();
    for (_, node) in studio.nodes_mut() {
        node.visible = false;
    }
    let ball = primitives::uv_sphere(1.0, 48, 24);
    let mesh = studio.add_mesh("ball", ball);
    studio.add(Node::from_mesh(mesh, material));
    let camera = Camera::look_at(DVec3::new(0.9, 1.1, 4.2), DVec3::ZERO, DVec3::Y);
    let settings =
        RenderSettings { samples_per_axis: 2, lighting: Lighting::Studio, ..RenderSettings::new(SIDE, SIDE) };
    let frame = render(&studio, &camera, &settings).ok()?;
    Some(ColorImage::from_rgba_unmultiplied([SIDE as usize; 2], &frame.color))
}
