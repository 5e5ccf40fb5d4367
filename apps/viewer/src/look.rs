//! What the flags change about a model: colour, opacity, back faces.

use std::collections::HashSet;

use trigon_math::Vec3;
use trigon_scene::{AlphaMode, Material, MaterialId, Scene, Shading};

/// What the flags change about a model.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Look {
    /// Linear RGB of every material.
    pub(crate) color: Option<Vec3>,
    /// Alpha of every material.
    pub(crate) opacity: Option<f32>,
    /// Whether light does not matter.
    pub(crate) unlit: bool,
    /// Back faces, if not as the file has them.
    pub(crate) backfaces: Option<Backfaces>,
}

/// What happens to faces seen from behind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Backfaces {
    Visible,
    Hidden,
}

impl Look {
    /// Changes the scene's materials.
    pub(crate) fn apply(&self, scene: &mut Scene) {
        if *self == Self::default() {
            return;
        }
        give_every_slot_a_material(scene);
        for (_, material) in scene.materials.iter_mut() {
            self.apply_to(material);
        }
    }

    fn apply_to(&self, material: &mut Material) {
        if let Some(color) = self.color {
            material.base_color = color.extend(material.base_color.w);
        }
        if let Some(opacity) = self.opacity {
            material.base_color.w = opacity;
            material.alpha_mode = if opacity < 1.0 { AlphaMode::Blend } else { AlphaMode::Opaque };
        }
        if self.unlit {
            material.shading = Shading::Unlit;
        }
        if let Some(backfaces) = self.backfaces {
            material.double_sided = backfaces == Backfaces::Visible;
        }
    }
}

/// Slots without a material are drawn with the default one, which cannot be
/// changed: they get one that can.
fn give_every_slot_a_material(scene: &mut Scene) {
    let default = scene.add_material(Material::default());
    let slots: Vec<usize> = slots_by_mesh(scene);
    let known: HashSet<MaterialId> = scene.materials.iter().map(|(id, _)| id).collect();
    for (_, node) in scene.nodes_mut() {
        let Some(mesh) = node.mesh else { continue };
        let wanted = slots.get(mesh.index()).copied().unwrap_or(0);
        for material in &mut node.materials {
            if !known.contains(material) {
                *material = default;
            }
        }
        let length = node.materials.len().max(wanted);
        node.materials.resize(length, default);
    }
}

/// How many material slots each mesh uses, by the index of its id.
fn slots_by_mesh(scene: &Scene) -> Vec<usize> {
    let mut slots = vec![0; scene.meshes().index_bound()];
    for (id, asset) in scene.meshes().iter() {
        let last = asset.mesh().attributes().face_materials.iter().flatten().max();
        slots[id.index()] = last.map_or(0, |&last| last as usize) + 1;
    }
    slots
}
