//! Meshes in the world: placed by their nodes, and deformed by their joints and morph weights.

use std::sync::Arc;

use trigon_math::glam::Affine3;
use trigon_math::{Bounds3, DAffine3, DVec3, Vec3};
use trigon_mesh::Mesh;

use super::Scene;
use super::skin_pose::SkinPose;
use crate::mesh_asset::MeshAsset;
use crate::node::NodeId;

/// What bends a mesh.
pub(crate) struct Bend {
    /// Joints, if it has any.
    pub(crate) joints: Option<SkinPose>,
    /// Whether it is moved towards morph targets.
    pub(crate) is_morphed: bool,
}

/// A mesh in the world, in its pose.
pub(crate) struct PlacedMesh<'s> {
    asset: &'s MeshAsset,
    /// `None` at rest.
    posed: Option<Vec<Vec3>>,
    world: DAffine3,
}

impl Scene {
    /// What bends the mesh of a node; `None` where that is at rest.
    pub(crate) fn bend(&self, id: NodeId, asset: &MeshAsset) -> Option<Bend> {
        let attributes = asset.mesh().attributes();
        let joints = attributes.skin.as_ref().and_then(|_| self.skin_pose(id));
        let weights = &self.node(id)?.morph_weights;
        let is_morphed = !attributes.morph_targets.is_empty() && weights.iter().any(|&weight| weight != 0.0);
        (joints.is_some() || is_morphed).then_some(Bend { joints, is_morphed })
    }

    /// The mesh of a node, if it has one. `world` is the node's place, for meshes
    /// without joints.
    pub(crate) fn placed_mesh(&self, id: NodeId, world: DAffine3) -> Option<PlacedMesh<'_>> {
        let node = self.node(id)?;
        let asset = self.meshes.get(node.mesh?)?;
        let Some(bend) = self.bend(id, asset) else {
            return Some(PlacedMesh { asset, posed: None, world });
        };
        let posed = asset.mesh().deformed_positions(&node.morph_weights, bend.palette());
        Some(PlacedMesh { asset, posed: Some(posed), world: bend.joints.map_or(world, |pose| pose.world) })
    }

    /// The vertices in the world, in their poses, of what is visible at a node and below it, without those that
    /// no face, edge or point uses: what a camera is fitted to that is to show this node.
    pub fn visible_points_below(&self, id: NodeId) -> impl Iterator<Item = DVec3> {
        let transforms = self.visible_transforms();
        let is_below = move |node: &NodeId| *node == id || self.ancestors(*node).any(|above| above == id);
        let nodes = self.nodes.iter().map(|(node, _)| node).filter(is_below);
        nodes
            .filter_map(move |node| self.placed_mesh(node, transforms[node.index()]?))
            .flat_map(PlacedMesh::into_used_points)
    }

    /// All meshes that are visible.
    pub(crate) fn placed_meshes(&self) -> impl Iterator<Item = PlacedMesh<'_>> {
        let transforms = self.visible_transforms();
        self.nodes.iter().filter_map(move |(id, _)| self.placed_mesh(id, transforms[id.index()]?))
    }
}

impl Bend {
    /// For each joint the map from the mesh at rest; none without joints.
    pub(crate) fn palette(&self) -> &[Affine3] {
        self.joints.as_ref().map_or(&[], |pose| &pose.palette)
    }
}

impl<'s> PlacedMesh<'s> {
    pub(crate) fn mesh(&self) -> &'s Mesh {
        self.asset.mesh()
    }

    /// Where a vertex is in the world.
    pub(crate) fn place(&self, vertex: u32) -> DVec3 {
        self.world.transform_point3(self.positions()[vertex as usize].as_dvec3())
    }

    /// The vertices in the world that faces, edges or points use.
    pub(crate) fn into_used_points(self) -> impl Iterator<Item = DVec3> {
        let used = Arc::clone(self.asset.used_vertices());
        let vertices = (0..used.len() as u32).filter(move |&vertex| used[vertex as usize]);
        vertices.map(move |vertex| self.place(vertex))
    }

    /// A box in the world around them.
    pub(crate) fn bounds(&self) -> Bounds3 {
        let local = match &self.posed {
            Some(positions) => self.asset.bounds_of(positions),
            None => self.asset.bounds(),
        };
        local.transformed(&self.world)
    }

    /// The map from the positions into the world.
    pub(crate) fn world(&self) -> &DAffine3 {
        &self.world
    }

    /// Where each vertex is in its pose.
    pub(crate) fn positions(&self) -> &[Vec3] {
        self.posed.as_deref().unwrap_or(self.asset.mesh().positions())
    }
}
