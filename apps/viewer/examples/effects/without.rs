//! Images without one of their effects.

use trigon_mesh::Attributes;
use trigon_scene::{AlphaMode, Effect, LightKind, MeshId, RenderSettings, Scene};

/// The same scene and settings without an effect. What belongs to the scene itself, and so has no switch in the viewer, is
/// taken out of the scene.
pub(crate) fn without(effect: Effect, scene: &Scene, settings: &RenderSettings) -> (Scene, RenderSettings) {
    effect.left_out(scene, settings).unwrap_or_else(|| {
        let mut scene = scene.clone();
        match effect {
            Effect::Lamps => put_out(&mut scene, |kind| kind != LightKind::Ambient),
            Effect::AmbientLight => put_out(&mut scene, |kind| kind == LightKind::Ambient),
            Effect::Masks => make_opaque(&mut scene, |mode| matches!(mode, AlphaMode::Mask { .. })),
            Effect::Transparency => make_opaque(&mut scene, |mode| mode == AlphaMode::Blend),
            Effect::VertexColors => each_mesh(&mut scene, |attributes| attributes.corner_colors = None),
            Effect::Poses => scene.nodes_mut().for_each(|(_, node)| node.morph_weights.clear()),
            _ => {}
        }
        (scene, settings.clone())
    })
}

fn put_out(scene: &mut Scene, is_meant: impl Fn(LightKind) -> bool) {
    for (_, node) in scene.nodes_mut() {
        node.light.take_if(|light| is_meant(light.kind));
    }
}

fn make_opaque(scene: &mut Scene, is_meant: impl Fn(AlphaMode) -> bool) {
    for (_, material) in scene.materials.iter_mut().filter(|(_, material)| is_meant(material.alpha_mode)) {
        material.alpha_mode = AlphaMode::Opaque;
    }
}

fn each_mesh(scene: &mut Scene, change: impl Fn(&mut Attributes)) {
    let meshes: Vec<MeshId> = scene.meshes().iter().map(|(id, _)| id).collect();
    for id in meshes {
        let mut mesh = scene.meshes().get(id).expect("listed").mesh().clone();
        let mut attributes = mesh.attributes().clone();
        change(&mut attributes);
        mesh.set_attributes(attributes).expect("less than before");
        scene.replace_mesh(id, mesh);
    }
}
