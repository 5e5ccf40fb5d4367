//! Meshes in the world: placed by their nodes, and deformed by their joints and morph weights.

use std::sync::Arc;

use trigon_math::glam::Affine3;
use trigon_math::{Bounds3, DAffine3, DVec3, Vec3};
use trigon_mesh::Mesh;

use super::Scene;
use super::pose::SkinPose;
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

    /// The vertices in the world, in their poses, of what is visible at a node and below it, without those
    /// that no face, edge or point uses. A camera that shows this node is fitted to them.
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

    /// Which vertices belong to a face, an edge or a point.
    pub(crate) fn used_vertices(&self) -> &'s [bool] {
        self.asset.used_vertices()
    }

    /// Where a vertex is in the world.
    pub(crate) fn position(&self, vertex: u32) -> DVec3 {
        self.world.transform_point3(self.positions()[vertex as usize].as_dvec3())
    }

    /// The vertices in the world that faces, edges or points use.
    pub(crate) fn into_used_points(self) -> impl Iterator<Item = DVec3> {
        let used = Arc::clone(self.asset.used_vertices());
        let vertices = (0..used.len() as u32).filter(move |&vertex| used[vertex as usize]);
        vertices.map(move |vertex| self.position(vertex))
    }

    /// A box in the world around them.
    pub(crate) fn bounds(&self) -> Bounds3 {
        let local = match &self.posed {
            Some(positions) => self.asset.bounds_of(positions),
            None => self.asset.bounds(),
        };
        local.transformed(&self.world)
    }

    /// The smallest box in the world around the vertices that faces, edges or points use.
    pub(crate) fn tight_bounds(self) -> Bounds3 {
        let bounds = self.bounds();
        let is_finite = bounds.is_empty() || (bounds.min.is_finite() && bounds.max.is_finite());
        // Then each coordinate in the world follows from one of the mesh, and the extremes stay the extremes.
        if is_finite && keeps_axes(&self.world) {
            return bounds;
        }
        let finite = |point: DVec3| DVec3::select(point.is_finite_mask(), point, DVec3::NAN);
        Bounds3::from_points(self.into_used_points().map(finite))
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

/// Whether a map takes each axis to an axis, or to nothing.
fn keeps_axes(map: &DAffine3) -> bool {
    let has_one = |row: DVec3| row.to_array().into_iter().filter(|&entry| entry != 0.0).count() <= 1;
    let rows = map.matrix3.transpose();
    [rows.x_axis, rows.y_axis, rows.z_axis].into_iter().all(has_one)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::DQuat;
    use trigon_mesh::primitives;

    use super::*;
    use crate::{Material, Node, Transform};

    /// Turns that keep axes, and others.
    fn turns() -> impl Strategy<Value = DQuat> {
        let quarter = (0..3_usize, 0..4_u8).prop_map(|(axis, quarters)| {
            DQuat::from_axis_angle(DVec3::AXES[axis], f64::from(quarters) * std::f64::consts::FRAC_PI_2)
        });
        let any = prop::array::uniform3(-3.0..3.0)
            .prop_map(|[x, y, z]| DQuat::from_scaled_axis(DVec3::new(x, y, z)));
        prop_oneof![Just(DQuat::IDENTITY), quarter, any]
    }

    proptest! {
        #[test]
        fn the_tight_box_is_that_of_all_visible_points(
            nodes in prop::collection::vec(
                (turns(), prop::array::uniform3(-3.0..3.0), prop::array::uniform3(-1e3..1e3), prop::option::of(0..3_u8)),
                0..5,
            ),
        ) {
            let mut scene = Scene::new();
            let mut last: Option<NodeId> = None;
            for (turn, scale, position, parent) in nodes {
                let id = scene.add_object("torus", primitives::torus(1.0, 0.4, 7, 5), Material::default());
                let node: &mut Node = scene.node_mut(id).expect("just added");
                node.transform = Transform::from_scale_rotation_translation(
                    DVec3::from_array(scale),
                    turn,
                    DVec3::from_array(position),
                );
                if let (Some(last), Some(0)) = (last, parent) {
                    scene.set_parent(id, Some(last)).expect("no circle");
                }
                last = Some(id);
            }
            let expected = Bounds3::from_points(scene.visible_points());
            prop_assert_eq!(scene.tight_bounds(), expected);
        }
    }

    #[test]
    fn coordinates_that_are_not_finite_do_not_count() {
        let mut scene = Scene::new();
        let mut torus = primitives::torus(1.0, 0.4, 7, 5);
        let clean = torus.bounds();
        torus.positions_mut()[3].x = f32::INFINITY;
        torus.positions_mut()[5].y = f32::NAN;
        scene.add_object("torus", torus, Material::default());
        let bounds = scene.tight_bounds();
        assert!(bounds.min.is_finite() && bounds.max.is_finite(), "{bounds:?}");
        assert!(bounds.min.cmpge(clean.min).all() && bounds.max.cmple(clean.max).all(), "{bounds:?}");
    }
}
