//! EXT_mesh_gpu_instancing: one node that draws its mesh many times.
//!
//! The copies become children of the file's node and share its mesh.

use gltf::json::Root;
use gltf::json::accessor::Type;
use serde_json::Value;
use trigon_math::{DQuat, DVec3};
use trigon_scene::Transform;

use super::accessor::Accessors;
use super::buffers::{Unplaced, Unread};
use crate::error::{LoadErrorKind, Location};
use crate::warning::Warnings;

/// What an instance may have of its own.
const ATTRIBUTES: [&str; 3] = ["TRANSLATION", "ROTATION", "SCALE"];

/// Whether a node draws its mesh many times.
pub(crate) fn has_instances(root: &Root, node: usize) -> bool {
    attributes(root, node).is_some()
}

fn attributes(root: &Root, node: usize) -> Option<&Value> {
    let others = &root.nodes[node].extensions.as_ref()?.others;
    others.get("EXT_mesh_gpu_instancing")?.get("attributes")
}

/// How many times a node draws its mesh: as its accessors claim.
pub(crate) fn instance_count(root: &Root, node: usize) -> usize {
    let Some(attributes) = attributes(root, node) else { return 1 };
    let accessors = ATTRIBUTES.map(|name| accessor(root, attributes, name));
    accessors
        .into_iter()
        .flatten()
        .map(|index| usize::try_from(root.accessors[index].count.0).unwrap_or(usize::MAX))
        .max()
        .unwrap_or(1)
        .max(1)
}

fn accessor(root: &Root, attributes: &Value, name: &str) -> Option<usize> {
    let index = usize::try_from(attributes.get(name)?.as_u64()?).ok()?;
    (index < root.accessors.len()).then_some(index)
}

/// The placements of a node's instances, in the node's space.
pub(crate) fn read_instances(
    accessors: &mut Accessors<'_>,
    node: usize,
    warnings: &mut Warnings,
) -> Result<Vec<Transform>, Unplaced> {
    let root = accessors.root;
    let Some(attributes) = attributes(root, node) else { return Ok(Vec::new()) };
    for name in ATTRIBUTES {
        if attributes.get(name).is_some() && accessor(root, attributes, name).is_none() {
            let what = format!("the {name} of its instances refers to no accessor and is ignored");
            warnings.push(Location::Item("node", node), what, "export the model again");
        }
    }
    accessors.spend(instance_count(root, node), &Location::Item("node", node))?;
    let find = |name| accessor(root, attributes, name);
    let translations = find("TRANSLATION").map(|index| accessors.vectors::<3>(index, &[Type::Vec3]));
    let translations = translations.transpose()?;
    let rotations = find("ROTATION").map(|index| accessors.vectors::<4>(index, &[Type::Vec4])).transpose()?;
    let scales = find("SCALE").map(|index| accessors.vectors::<3>(index, &[Type::Vec3])).transpose()?;
    let lengths = [
        translations.as_ref().map(Vec::len),
        rotations.as_ref().map(Vec::len),
        scales.as_ref().map(Vec::len),
    ];
    let mut lengths = lengths.into_iter().flatten();
    let count = lengths.next().unwrap_or(0);
    if lengths.any(|other| other != count) {
        let what = "its instances have attributes of different lengths".to_owned();
        let remedy = "export the model again";
        return Err(Unplaced(
            Location::Item("node", node),
            Unread { kind: LoadErrorKind::Malformed, what, remedy },
        ));
    }
    let vectors = translations.iter().chain(&scales).flatten().flatten();
    let numbers = vectors.chain(rotations.iter().flatten().flatten());
    let broken = numbers.filter(|number| !number.is_finite()).count();
    let what = "an instance has a value that is not finite; that translation, rotation or scale is ignored";
    warnings.push_counted(broken, Location::Item("node", node), what, "export the model again");
    let vector = |list: &Option<Vec<[f32; 3]>>, index: usize, otherwise: DVec3| {
        let value = list.as_ref().map_or(otherwise, |list| DVec3::from(list[index].map(f64::from)));
        if value.is_finite() { value } else { otherwise }
    };
    let rotation = |index: usize| {
        rotations.as_ref().map_or(DQuat::IDENTITY, |list| DQuat::from_array(list[index].map(f64::from)))
    };
    let transform = |index| {
        let (scale, translation) =
            (vector(&scales, index, DVec3::ONE), vector(&translations, index, DVec3::ZERO));
        Transform::from_scale_rotation_translation(scale, rotation(index), translation)
    };
    Ok((0..count).map(transform).collect())
}
