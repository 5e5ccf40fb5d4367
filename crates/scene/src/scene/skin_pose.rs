//! Poses of skins: meshes whose vertices follow other nodes, their joints.
//!
//! The vertices of a skinned mesh are placed by its joints; the transform of its own node has no effect (glTF
//! 2.0 specification, section 3.7.3.3). Large offsets from the origin are removed in f64 before anything is
//! rounded to f32.

use std::collections::HashMap;

use trigon_math::glam::{Affine3, DAffine3};
use trigon_math::{DVec3, Mat3};

use super::Scene;
use crate::node::NodeId;

/// A skinned mesh at one moment: what `RenderMesh::deform` needs, and where the
/// result is.
#[derive(Clone, Debug, PartialEq)]
pub struct SkinPose {
    /// Places the deformed mesh in the world. Its determinant tells the
    /// winding of the faces, as for any mesh.
    pub world: DAffine3,
    /// For each joint the map from the mesh at rest to the deformed mesh.
    pub palette: Vec<Affine3>,
}

impl Scene {
    /// The pose of a node's skin; none when it has no skin, or that is gone.
    ///
    /// The deformed mesh is in the node's own space, so that large worlds stay
    /// precise and mirrored ones mirrored. A node that is flattened has no such
    /// space: then it is around the first joint.
    #[must_use]
    pub fn skin_pose(&self, id: NodeId) -> Option<SkinPose> {
        let skin = self.skins.get(self.node(id)?.skin?)?;
        let mut worlds = Worlds { scene: self, known: HashMap::new() };
        let joints: Vec<DAffine3> = skin.joints.iter().map(|&joint| worlds.of(joint)).collect();
        let own = worlds.of(id);
        let around = joints.first().map_or(DVec3::ZERO, |joint| joint.translation);
        let world = if is_invertible(&own) { own } else { DAffine3::from_translation(around) };
        let to_own = world.inverse();
        let entry = |(index, joint): (usize, &DAffine3)| {
            if self.node(skin.joints[index]).is_none() {
                return Affine3::IDENTITY;
            }
            let bind = skin.inverse_bind_matrices.get(index).copied().unwrap_or(DAffine3::IDENTITY);
            narrowed(&(to_own * *joint * bind))
        };
        Some(SkinPose { world, palette: joints.iter().enumerate().map(entry).collect() })
    }
}

/// World transforms, each computed once: the joints of a long chain would
/// otherwise take quadratic time.
struct Worlds<'s> {
    scene: &'s Scene,
    known: HashMap<NodeId, DAffine3>,
}

impl Worlds<'_> {
    fn of(&mut self, id: NodeId) -> DAffine3 {
        let (mut world, mut chain) = (DAffine3::IDENTITY, Vec::new());
        for above in self.scene.ancestors(id) {
            if let Some(known) = self.known.get(&above) {
                world = *known;
                break;
            }
            chain.push(above);
        }
        for id in chain.into_iter().rev() {
            let local = self.scene.node(id).map_or(DAffine3::IDENTITY, |node| node.transform.to_affine());
            world *= local;
            self.known.insert(id, world);
        }
        world
    }
}

fn is_invertible(map: &DAffine3) -> bool {
    let determinant = map.matrix3.determinant();
    determinant != 0.0 && determinant.is_finite() && map.inverse().is_finite()
}

fn narrowed(map: &DAffine3) -> Affine3 {
    let matrix = &map.matrix3;
    Affine3 {
        matrix3: Mat3::from_cols(matrix.x_axis.as_vec3(), matrix.y_axis.as_vec3(), matrix.z_axis.as_vec3()),
        translation: map.translation.as_vec3(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::node::{Node, Skin};

    #[test]
    fn a_skin_far_from_the_origin_keeps_its_joints_apart() {
        let far = DVec3::splat(1e7);
        let mut scene = Scene::new();
        let root = scene.add(Node::default().at(far));
        let joint = scene.add_child(root, Node::default().at(DVec3::new(0.125, 0.0, 0.0))).expect("a root");
        let gone = scene.add(Node::default());
        scene.remove(gone);
        let skin = Skin { joints: vec![joint, gone], ..Skin::default() };
        let skin = scene.skins.insert(skin);
        let body = scene.add_child(root, Node { skin: Some(skin), ..Node::default() }).expect("a root");
        let pose = scene.skin_pose(body).expect("it has a skin");
        assert_eq!(pose.world.translation, far, "in the node's space");
        assert_eq!(pose.palette[0].translation.to_array(), [0.125, 0.0, 0.0], "exact");
        assert_eq!(pose.palette[1], Affine3::IDENTITY, "a removed joint");
        assert_eq!(scene.skin_pose(root), None, "no skin");
    }

    /// 100 000 joints, each on the one before: in quadratic time a minute or more.
    #[test]
    fn the_joints_of_a_long_chain_take_linear_time() {
        const LENGTH: usize = 100_000;
        let mut scene = Scene::new();
        let mut joints = vec![scene.add(Node::default())];
        for index in 1..LENGTH {
            let next = scene.add_child(joints[index - 1], Node::default().at(DVec3::X));
            joints.push(next.expect("the one before is there"));
        }
        let last = joints[LENGTH - 1];
        let skin = scene.skins.insert(Skin { joints, ..Skin::default() });
        let body = scene.add(Node { skin: Some(skin), ..Node::default() });
        let pose = scene.skin_pose(body).expect("it has a skin");
        assert_eq!(pose.palette[LENGTH - 1].translation.x, (LENGTH - 1) as f32, "at the end of the chain");
        assert_eq!(scene.world_transform(last).translation.x, (LENGTH - 1) as f64, "as told by the scene");
    }

    #[test]
    fn a_flattened_node_does_not_flatten_what_its_joints_place() {
        let mut scene = Scene::new();
        let joint = scene.add(Node::default().at(DVec3::X));
        let skin = scene.skins.insert(Skin { joints: vec![joint], ..Skin::default() });
        let mut node = Node { skin: Some(skin), ..Node::default() };
        node.transform.scale_by(DVec3::ZERO);
        let body = scene.add(node);
        let pose = scene.skin_pose(body).expect("it has a skin");
        let world = pose.world * DAffine3::from_translation(pose.palette[0].translation.as_dvec3());
        assert_eq!(world.translation, DVec3::X, "where the joint is");
        assert_eq!(pose.palette[0].matrix3, Mat3::IDENTITY, "in its size");
    }
}
