//! The materials of an object: its slots, their values, their textures.

use trigon_document::mesh::math::Vec3;
use trigon_document::scene::{AlphaMode, Material, MaterialId, MetallicRoughness, Shading};
use trigon_document::{
    AssignTexture, Document, MaterialName, SetMaterial, SurfaceAlpha, SurfaceShading, TextureSlot,
};
use trigon_window::egui::{self, Ui};

use super::super::form::NumberForm;
use super::super::parameters::check_box;
use super::super::row::{choice, color, number, positive, row, text};
use super::super::unit::Unit;
use super::object::ShownObject;
use super::preview::Preview;
use super::slots::slots;
use crate::panel::row::submit;
use crate::request::Request;

/// Which slot is shown, and its picture.
#[derive(Debug, Default)]
pub(super) struct MaterialState {
    slot: usize,
    preview: Preview,
}

/// Shows the slots and the material of the chosen one.
pub(super) fn material(
    ui: &mut Ui,
    shown: ShownObject<'_>,
    state: &mut MaterialState,
    requests: &mut Vec<Request>,
) {
    let ShownObject { document, node, .. } = shown;
    slots(ui, shown, &mut state.slot, requests);
    let materials = &document.nodes().materials;
    if let Some((id, material)) =
        node.materials.get(state.slot).and_then(|&id| Some((id, materials.get(id)?)))
    {
        state.preview.show(ui, document, id, material);
        let fields = Fields { document, id, material };
        fields.show(ui, requests);
    }
}

/// A number from 0 to 1, and its label.
struct ShareRow<'l> {
    label: &'l str,
    hover: &'l str,
    value: f32,
}

/// The values of a material.
struct Fields<'f> {
    document: &'f Document,
    id: MaterialId,
    material: &'f Material,
}

impl Fields<'_> {
    fn show(&self, ui: &mut Ui, requests: &mut Vec<Request>) {
        let mut name = self.material.name.clone();
        if row(ui, "Material name", "", |ui, width| text(ui, width, &mut name)).changed() {
            requests.push(Request::Run(SetMaterial { name: Some(name), ..self.unchanged() }.into()));
        }
        self.shading(ui, requests);
        self.base_color(ui, requests);
        match self.material.shading {
            Shading::MetallicRoughness(model) => self.physical(ui, &model, requests),
            Shading::BlinnPhong { specular, shininess, .. } => {
                self.highlight(ui, specular, shininess, requests);
            }
            Shading::Lambert | Shading::Unlit => {}
        }
        let mut emissive = self.material.emissive.to_array();
        if let Some(response) = color(ui, "Emission", "The color of emitted light.", &mut emissive) {
            let command = SetMaterial { emissive: Some(emissive), ..self.unchanged() };
            submit(ui, self.document, &response, command.into(), requests);
        }
        self.alpha(ui, requests);
        let mut double_sided = self.material.double_sided;
        if check_box(ui, &mut double_sided, "Show back faces").changed() {
            let command = SetMaterial { double_sided: Some(double_sided), ..self.unchanged() };
            requests.push(Request::Run(command.into()));
        }
        self.textures(ui, requests);
    }

    fn unchanged(&self) -> SetMaterial {
        SetMaterial { material: Some(MaterialName::of(self.id)), ..SetMaterial::default() }
    }

    fn shading(&self, ui: &mut Ui, requests: &mut Vec<Request>) {
        let mut chosen = match self.material.shading {
            Shading::Unlit => SurfaceShading::Unlit,
            Shading::Lambert => SurfaceShading::Lambert,
            Shading::BlinnPhong { .. } => SurfaceShading::BlinnPhong,
            Shading::MetallicRoughness(_) => SurfaceShading::MetallicRoughness,
        };
        let choices = [
            (SurfaceShading::MetallicRoughness, "Physical", "Metallic-roughness, as in glTF."),
            (SurfaceShading::BlinnPhong, "Blinn-Phong", "Diffuse with a highlight."),
            (SurfaceShading::Lambert, "Lambert", "Diffuse."),
            (SurfaceShading::Unlit, "Unlit", "The base color, independent of light."),
        ];
        if choice(ui, "Surface", "How the surface reflects light.", &mut chosen, &choices).changed() {
            let command = SetMaterial { shading: Some(chosen), ..self.unchanged() };
            requests.push(Request::Run(command.into()));
        }
    }

    fn physical(&self, ui: &mut Ui, model: &MetallicRoughness, requests: &mut Vec<Request>) {
        let given = |metallic| SetMaterial { metallic: Some(metallic), ..self.unchanged() };
        let metallic =
            ShareRow { label: "Metallic", hover: "0 is a dielectric, 1 a metal.", value: model.metallic };
        self.share(ui, metallic, &given, requests);
        let given = |roughness| SetMaterial { roughness: Some(roughness), ..self.unchanged() };
        let roughness =
            ShareRow { label: "Roughness", hover: "0 is a mirror, 1 is matt.", value: model.roughness };
        self.share(ui, roughness, &given, requests);
        let given = |transmission| SetMaterial { transmission: Some(transmission), ..self.unchanged() };
        let hover = "1 is glass: light goes through. Seen in Rendered and in images.";
        let value = self.material.transmission;
        self.share(ui, ShareRow { label: "Transmission", hover, value }, &given, requests);
        if self.material.transmission > 0.0 {
            self.index_of_refraction(ui, requests);
        }
    }

    fn index_of_refraction(&self, ui: &mut Ui, requests: &mut Vec<Request>) {
        let mut shown = f64::from(self.material.ior);
        let form = NumberForm { least: 1.0, most: 10.0, is_integer: false, unit: Unit::None };
        let hover = "How much light is bent: 1.33 is water, 1.5 glass.";
        let response =
            row(ui, "Refraction index", hover, |ui, width| number(ui, width, &mut shown, &form, ""));
        if response.changed() {
            let command = SetMaterial { ior: Some(shown as f32), ..self.unchanged() };
            submit(ui, self.document, &response, command.into(), requests);
        }
    }

    fn highlight(&self, ui: &mut Ui, specular: Vec3, shininess: f32, requests: &mut Vec<Request>) {
        let mut chosen = specular.to_array();
        if let Some(response) = color(ui, "Highlight", "The color of the highlight.", &mut chosen) {
            let command = SetMaterial { specular: Some(chosen), ..self.unchanged() };
            submit(ui, self.document, &response, command.into(), requests);
        }
        let mut exponent = f64::from(shininess);
        let form = positive(1e4, Unit::None);
        let hover = "The exponent of the highlight: the larger, the smaller it is.";
        let response = row(ui, "Shininess", hover, |ui, width| number(ui, width, &mut exponent, &form, ""));
        if response.changed() {
            let command = SetMaterial { shininess: Some(exponent as f32), ..self.unchanged() };
            submit(ui, self.document, &response, command.into(), requests);
        }
    }

    fn base_color(&self, ui: &mut Ui, requests: &mut Vec<Request>) {
        let [red, green, blue, alpha] = self.material.base_color.to_array();
        let mut chosen = [red, green, blue];
        if let Some(response) = color(ui, "Base color", "Multiplies its texture.", &mut chosen) {
            let [red, green, blue] = chosen;
            let command = SetMaterial { base_color: Some([red, green, blue, alpha]), ..self.unchanged() };
            submit(ui, self.document, &response, command.into(), requests);
        }
        // Who makes something translucent wants to see through it.
        let is_ignored = self.material.alpha_mode == AlphaMode::Opaque;
        let given = |alpha| SetMaterial {
            base_color: Some([red, green, blue, alpha]),
            alpha: (is_ignored && alpha < 1.0).then_some(SurfaceAlpha::Blend),
            ..self.unchanged()
        };
        self.share(
            ui,
            ShareRow {
                label: "Alpha",
                hover: "Opacity; below 1 the alpha mode becomes Blend.",
                value: alpha,
            },
            &given,
            requests,
        );
    }

    /// Shows a number from 0 to 1.
    fn share(
        &self,
        ui: &mut Ui,
        ShareRow { label, hover, value }: ShareRow<'_>,
        given: &dyn Fn(f32) -> SetMaterial,
        requests: &mut Vec<Request>,
    ) {
        let mut shown = f64::from(value);
        let form = positive(1.0, Unit::None);
        let response = row(ui, label, hover, |ui, width| number(ui, width, &mut shown, &form, ""));
        if response.changed() {
            submit(ui, self.document, &response, given(shown as f32).into(), requests);
        }
    }

    fn alpha(&self, ui: &mut Ui, requests: &mut Vec<Request>) {
        let mut chosen = match self.material.alpha_mode {
            AlphaMode::Opaque => SurfaceAlpha::Opaque,
            AlphaMode::Mask { .. } => SurfaceAlpha::Mask,
            AlphaMode::Blend => SurfaceAlpha::Blend,
        };
        let choices = [
            (SurfaceAlpha::Opaque, "Opaque", "Alpha is ignored."),
            (SurfaceAlpha::Mask, "Mask", "Holes where alpha is below the cutoff."),
            (SurfaceAlpha::Blend, "Blend", "What lies behind shows through."),
        ];
        if choice(ui, "Alpha mode", "What alpha means.", &mut chosen, &choices).changed() {
            requests.push(Request::Run(SetMaterial { alpha: Some(chosen), ..self.unchanged() }.into()));
        }
        if let AlphaMode::Mask { cutoff } = self.material.alpha_mode {
            let given = |cutoff| SetMaterial { alpha_cutoff: Some(cutoff), ..self.unchanged() };
            self.share(
                ui,
                ShareRow {
                    label: "Alpha cutoff",
                    hover: "The smallest alpha that is surface.",
                    value: cutoff,
                },
                &given,
                requests,
            );
        }
    }

    fn textures(&self, ui: &mut Ui, requests: &mut Vec<Request>) {
        let slots = [
            (TextureSlot::BaseColor, "Base color image"),
            (TextureSlot::MetallicRoughness, "Metallic-roughness image"),
            (TextureSlot::Normal, "Normal map"),
            (TextureSlot::Occlusion, "Occlusion map"),
            (TextureSlot::Emissive, "Emission image"),
        ];
        for (slot, label) in slots {
            ui.push_id(label, |ui| self.texture(ui, slot, label, requests));
        }
    }

    /// The image of a slot: which, another one, none.
    fn texture(&self, ui: &mut Ui, slot: TextureSlot, label: &str, requests: &mut Vec<Request>) {
        let material = MaterialName::of(self.id);
        let textures = &self.document.nodes().textures;
        let asset = slot.of(self.material).and_then(|binding| textures.get(binding.texture));
        let name = asset.map_or("none", |asset| if asset.name.is_empty() { "no name" } else { &asset.name });
        ui.add(egui::Label::new(format!("{label}: {name}")).wrap());
        ui.horizontal_wrapped(|ui| {
            let open = ui.button("Open…").accessible_name(format!("Open {label}"));
            if open.on_hover_text("Choose a PNG, JPEG or WebP file").clicked() {
                requests.push(Request::ChooseTexture { material: material.clone(), slot });
            }
            let remove = ui.add_enabled(asset.is_some(), egui::Button::new("Remove"));
            if remove.accessible_name(format!("Remove {label}")).clicked() {
                let material = Some(material);
                requests.push(Request::Run(AssignTexture { material, slot, ..Default::default() }.into()));
            }
        });
    }
}
