//! The node tree: checked without recursion, at any depth.
//!
//! A node may have one parent and no loop. Files that break this are refused:
//! drawing them could mean 2³⁰ copies.

use std::path::Path;

use gltf::json::Root;

use crate::error::{LoadError, LoadErrorKind, Location};
use crate::options::{LoadOptions, SceneChoice};

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
