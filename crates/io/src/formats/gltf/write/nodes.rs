//! The nodes of a scene that are written, with their cameras and lights: only what differs from what the file says.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::json;
use trigon_camera::Projection;
use trigon_math::{DAffine3, DVec3};
use trigon_scene::{Light, LightKind, Node, NodeId, Scene, Transform};

use super::draft::{Draft, LIGHTS};
use super::raw::RawObject;
use super::raw::RetainedFile;
use crate::formats::gltf::native;
use crate::formats::gltf::native::{AmbientExtras, NodeExtras};

/// Changes the members of a node that refer to nothing else, from what the file says.
/// `is_animated`: glTF animates no matrices.
pub(super) fn write_node(
    draft: &mut Draft<'_>,
    object: &mut RawObject,
    was: &Node,
    now: &Node,
    is_animated: bool,
) {
    if now.name != was.name {
        object.set_or_remove("name", Some(&now.name).filter(|name| !name.is_empty()));
    }
    if now.transform != was.transform {
        write_transform(object, &now.transform, is_animated);
    }
    if now.morph_weights != was.morph_weights {
        let weights = Some(&now.morph_weights).filter(|weights| !weights.is_empty());
        object.set_or_remove("weights", weights);
    }
    if now.camera != was.camera {
        let camera = now.camera.as_deref().and_then(camera).map(|camera| draft.push("cameras", &camera));
        object.set_or_remove("camera", camera.as_ref());
    }
    if now.light != was.light {
        write_light(draft, object, now);
    }
    if own_extras(now) != own_extras(was) {
        let own = own_extras(now);
        let mut extras = object.object("extras");
        let is_plain = own == own_extras(&Node::default());
        extras.set_or_remove(native::MEMBER, Some(&own).filter(|_| !is_plain));
        object.set_object("extras", &extras);
    }
}

/// All digits: other programs round them as they need.
fn write_transform(object: &mut RawObject, transform: &Transform, is_animated: bool) {
    for name in ["matrix", "translation", "rotation", "scale"] {
        object.remove(name);
    }
    let (scale, rotation, translation) = match transform {
        Transform::Decomposed { translation, rotation, scale } => (*scale, *rotation, *translation),
        Transform::Affine(map) if is_animated => map.to_scale_rotation_translation(),
        Transform::Affine(map) => {
            if map.is_finite() && *map != DAffine3::IDENTITY {
                object.set("matrix", &matrix(map));
            }
            return;
        }
    };
    if translation != DVec3::ZERO && translation.is_finite() {
        object.set("translation", &translation.to_array());
    }
    if rotation.to_array() != [0.0, 0.0, 0.0, 1.0] && rotation.is_finite() {
        object.set("rotation", &rotation.to_array());
    }
    if scale != DVec3::ONE && scale.is_finite() {
        object.set("scale", &scale.to_array());
    }
}

pub(super) fn matrix(map: &DAffine3) -> [f64; 16] {
    let [x, y, z] = [map.matrix3.x_axis, map.matrix3.y_axis, map.matrix3.z_axis];
    let w = map.translation;
    [x.x, x.y, x.z, 0.0, y.x, y.y, y.z, 0.0, z.x, z.y, z.z, 0.0, w.x, w.y, w.z, 1.0]
}

/// The camera as glTF has it; none of those that it does not have.
pub(super) fn camera(projection: &Projection) -> Option<serde_json::Value> {
    match *projection {
        Projection::Perspective { vertical_fov, near, far, .. } => {
            let mut perspective = json!({"yfov": vertical_fov, "znear": near});
            if let Some(far) = far {
                perspective["zfar"] = json!(far);
            }
            Some(json!({"type": "perspective", "perspective": perspective}))
        }
        // A window as wide as it is tall: glTF wants a width, and readers take the image's.
        Projection::Orthographic { height, near, far, .. } if near >= 0.0 => {
            let half = height / 2.0;
            let orthographic = json!({"xmag": half, "ymag": half, "znear": near, "zfar": far});
            Some(json!({"type": "orthographic", "orthographic": orthographic}))
        }
        _ => None,
    }
}

/// What the format lacks of a node.
fn own_extras(node: &Node) -> NodeExtras {
    let light = node.light.as_deref();
    let ambient = light.filter(|light| light.kind == LightKind::Ambient);
    NodeExtras {
        version: native::VERSION,
        hidden: !node.visible,
        ambient: ambient
            .map(|light| AmbientExtras { color: light.color.to_array(), intensity: light.intensity }),
        radius: light.map_or(0.0, |light| light.radius).clamp(0.0, f32::MAX),
    }
}

fn write_light(draft: &mut Draft<'_>, object: &mut RawObject, node: &Node) {
    let mut extensions = object.object("extensions");
    match node.light.as_deref().and_then(punctual) {
        Some(light) => {
            let index = draft.light(&light);
            extensions.set(LIGHTS, &json!({"light": index}));
        }
        None => extensions.remove(LIGHTS),
    }
    object.set_object("extensions", &extensions);
}

fn punctual(light: &Light) -> Option<RawObject> {
    let kind = match light.kind {
        LightKind::Ambient => return None,
        LightKind::Directional => "directional",
        LightKind::Point => "point",
        LightKind::Spot { .. } => "spot",
    };
    let mut object = RawObject::default();
    object.set("type", kind);
    let color = light.color.to_array().map(|channel| if channel > 0.0 { channel.min(1.0) } else { 0.0 });
    object.set("color", &color);
    object.set("intensity", &photometric(light.intensity));
    if light.range.is_finite() && light.range > 0.0 && light.kind != LightKind::Directional {
        object.set("range", &light.range);
    }
    if let LightKind::Spot { inner, outer } = light.kind {
        // The extension wants a rim that is not hard.
        let outer = outer.max(f32::MIN_POSITIVE);
        let inner = inner.min(outer.next_down());
        let mut spot = RawObject::default();
        spot.set("innerConeAngle", &inner);
        spot.set("outerConeAngle", &outer);
        object.set("spot", &spot);
    }
    Some(object)
}

/// Lux or candela, which are read as the same intensity again, to the bit where that is
/// possible: reading multiplies by 1/π.
fn photometric(intensity: f32) -> f32 {
    if !(intensity > 0.0 && intensity.is_finite()) {
        return 0.0;
    }
    let near = (f64::from(intensity) * std::f64::consts::PI) as f32;
    let is_exact = |value: &f32| value * std::f32::consts::FRAC_1_PI == intensity;
    let found = [near, near.next_up(), near.next_down()].into_iter().find(is_exact).unwrap_or(near);
    if found.is_finite() { found } else { f32::MAX }
}

/// Which nodes are written.
pub(super) struct Choice {
    /// All of them, or none if that is everything.
    chosen: Option<BTreeSet<NodeId>>,
    /// Those that only hold others: what these hang on, and joints.
    pub(super) bare: BTreeSet<NodeId>,
}

impl Choice {
    pub(super) fn new(scene: &Scene, nodes: Option<&[NodeId]>) -> Self {
        let Some(nodes) = nodes else { return Self { chosen: None, bare: BTreeSet::new() } };
        let chosen: BTreeSet<NodeId> = nodes.iter().copied().filter(|&id| scene.node(id).is_some()).collect();
        let skins = chosen.iter().filter_map(|&id| scene.skins.get(scene.node(id)?.skin?));
        let joints: Vec<NodeId> = skins.flat_map(|skin| skin.joints.iter().copied()).collect();
        let mut bare = BTreeSet::new();
        for &id in chosen.iter().chain(&joints) {
            // What is known has been followed to its root.
            let above = scene.ancestors(id).take_while(|above| *above == id || !bare.contains(above));
            let above: Vec<NodeId> = above.filter(|&above| scene.node(above).is_some()).collect();
            bare.extend(above);
        }
        bare.retain(|id| !chosen.contains(id));
        Self { chosen: Some(chosen), bare }
    }

    pub(super) fn has(&self, id: NodeId) -> bool {
        self.chosen.as_ref().is_none_or(|chosen| chosen.contains(&id) || self.bare.contains(&id))
    }
}

/// The nodes that EXT_mesh_gpu_instancing made when a file was read, if all that hang on one
/// node are as they were: the file need not name them. By that node.
pub(super) fn unchanged_copies(scene: &Scene, retained: &RetainedFile) -> BTreeMap<NodeId, Vec<NodeId>> {
    let mut copies: BTreeMap<NodeId, Vec<NodeId>> = BTreeMap::new();
    for (id, node) in retained.scene.nodes().iter() {
        if let (None, Some(parent)) = (retained.source.node(id), node.parent()) {
            copies.entry(parent).or_default().push(id);
        }
    }
    copies.retain(|&parent, copies| {
        let holder = scene.node(parent).is_some_and(|node| node.mesh.is_none());
        let is_same = |&id: &NodeId| match (scene.node(id), retained.scene.node(id)) {
            (Some(now), Some(was)) => same_node(now, was) && now.materials == was.materials,
            _ => false,
        };
        holder && copies.iter().all(is_same)
    });
    copies
}

fn same_node(now: &Node, was: &Node) -> bool {
    now.parent() == was.parent()
        && now.children() == was.children()
        && (&now.name, now.transform, now.mesh, now.skin, now.visible)
            == (&was.name, was.transform, was.mesh, was.skin, was.visible)
        && (&now.morph_weights, &now.light, &now.camera) == (&was.morph_weights, &was.light, &was.camera)
}
