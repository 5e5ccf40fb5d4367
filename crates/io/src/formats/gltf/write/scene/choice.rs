//! Which nodes of a scene are written.

use std::collections::{BTreeMap, BTreeSet};

use trigon_scene::{Node, NodeId, Scene};

use crate::formats::gltf::write::retained_file::RetainedFile;

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
        && (&now.morph_weights, now.light, now.camera) == (&was.morph_weights, was.light, was.camera)
}
