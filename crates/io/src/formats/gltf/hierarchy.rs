//! The node tree, checked without recursion at any depth, and the instances of EXT_mesh_gpu_instancing: one node that
//! draws its mesh many times.

use std::path::Path;

use gltf::json::Root;
use gltf::json::accessor::Type;
use serde_json::Value;
use trigon_math::{DQuat, DVec3};
use trigon_scene::Transform;

use super::accessor::Accessors;
use super::buffers::{Unplaced, UnreadReason};
use crate::error::{LoadError, LoadErrorKind, Location};
use crate::options::{LoadOptions, SceneChoice};
use crate::warning::Warnings;

/// The nodes to load, and how they hang together.
pub(crate) struct Hierarchy {
    /// For each node of the document: whether its scene reaches it.
    pub(crate) included: Vec<bool>,
    /// For each node its parent, unless the scene does not reach that.
    pub(crate) parents: Vec<Option<usize>>,
    /// The reached nodes, parents before children.
    pub(crate) order: Vec<usize>,
    /// The nodes that the scene lists, in its order.
    pub(crate) roots: Vec<usize>,
    /// The nodes that the scene lists although they hang on others.
    pub(crate) listed_children: Vec<usize>,
    /// The scene that is loaded, if the file has scenes.
    pub(crate) scene: Option<usize>,
}

pub(crate) fn find_hierarchy(
    path: &Path,
    root: &Root,
    options: &LoadOptions<'_>,
) -> Result<Hierarchy, LoadError> {
    let (limits, count) = (&options.limits, root.nodes.len());
    if count > limits.nodes {
        return Err(LoadError::limit(path, format!("it has {count} nodes; the limit is {}", limits.nodes)));
    }
    let error = |node: usize, what: String| {
        LoadError::malformed(path, what, "export the model again").at(Location::Item("node", node))
    };
    let mut parents = vec![None; count];
    for (parent, child) in links(root) {
        if let Some(other) = parents[child].replace(parent) {
            return Err(error(child, format!("it is a child twice, of node {other} and of node {parent}")));
        }
    }
    let depths = find_depths(root, &parents);
    if let Some(node) = depths.iter().position(Option::is_none) {
        return Err(error(node, "it is its own ancestor: the nodes form a cycle".to_owned()));
    }
    if let Some(node) = depths.iter().position(|&depth| depth > Some(limits.depth)) {
        return Err(error(
            node,
            format!("nodes are nested more than {} deep, which is the limit", limits.depth),
        ));
    }
    let scene = chosen_scene(path, root, options.scene.as_ref())?;
    let roots = scene_roots(root, scene, &parents);
    let listed_children = roots.iter().copied().filter(|&node| parents[node].is_some()).collect();
    let (included, order) = reach(root, roots.clone());
    for parent in &mut parents {
        *parent = parent.filter(|&parent| included[parent]);
    }
    let scene = Some(scene).filter(|&scene| scene < root.scenes.len());
    Ok(Hierarchy { included, parents, order, roots, listed_children, scene })
}

fn links(root: &Root) -> impl Iterator<Item = (usize, usize)> {
    let children = |node: &gltf::json::Node| node.children.clone().unwrap_or_default();
    root.nodes
        .iter()
        .enumerate()
        .flat_map(move |(parent, node)| children(node).into_iter().map(move |child| (parent, child.value())))
}

/// How deep each node hangs below its root; `None` for nodes in or below a loop.
fn find_depths(root: &Root, parents: &[Option<usize>]) -> Vec<Option<usize>> {
    let mut depths = vec![None; parents.len()];
    let mut waiting: Vec<(usize, usize)> =
        (0..parents.len()).filter(|&node| parents[node].is_none()).map(|node| (node, 0)).collect();
    while let Some((node, depth)) = waiting.pop() {
        depths[node] = Some(depth);
        waiting.extend(root.nodes[node].children.iter().flatten().map(|child| (child.value(), depth + 1)));
    }
    depths
}

/// The name of each scene.
pub(crate) fn scene_names(root: &Root) -> Vec<String> {
    let name = |(index, scene): (usize, &gltf::json::Scene)| {
        scene.name.clone().unwrap_or_else(|| format!("scene {index}"))
    };
    root.scenes.iter().enumerate().map(name).collect()
}

/// The scene that was asked for, else the default one, else the first.
fn chosen_scene(path: &Path, root: &Root, choice: Option<&SceneChoice>) -> Result<usize, LoadError> {
    let names = scene_names(root);
    let (found, wanted) = match choice {
        None => return Ok(root.scene.map_or(0, |scene| scene.value())),
        Some(SceneChoice::Index(index)) => {
            (Some(*index).filter(|&index| index < names.len()), format!("scene {index}"))
        }
        Some(SceneChoice::Name(name)) => {
            (names.iter().position(|other| other == name), format!("scene \"{name}\""))
        }
    };
    found.ok_or_else(|| {
        const MOST_NAMES: usize = 8;
        let mut listed = names.iter().take(MOST_NAMES).cloned().collect::<Vec<_>>().join("\", \"");
        if names.len() > MOST_NAMES {
            listed.push_str("\", …");
        }
        let remedy = if names.is_empty() {
            "load it without a choice".to_owned()
        } else {
            format!("choose one of \"{listed}\"")
        };
        LoadError::new(LoadErrorKind::Empty, path, format!("there is no {wanted}"), remedy)
    })
}

/// The roots of a scene; all roots when the file has no scenes.
fn scene_roots(root: &Root, scene: usize, parents: &[Option<usize>]) -> Vec<usize> {
    match root.scenes.get(scene) {
        Some(scene) => scene.nodes.iter().map(|node| node.value()).collect(),
        None => (0..parents.len()).filter(|&node| parents[node].is_none()).collect(),
    }
}

fn reach(root: &Root, roots: Vec<usize>) -> (Vec<bool>, Vec<usize>) {
    let mut included = vec![false; root.nodes.len()];
    let (mut waiting, mut order) = (roots, Vec::new());
    waiting.reverse();
    while let Some(node) = waiting.pop() {
        // A scene may list a node twice, or one that hangs below another.
        if !std::mem::replace(&mut included[node], true) {
            order.push(node);
            waiting.extend(root.nodes[node].children.iter().flatten().rev().map(|child| child.value()));
        }
    }
    (included, order)
}

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
            UnreadReason { kind: LoadErrorKind::Malformed, what, remedy },
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
