//! The state of an animation at one moment: a pure function of scene, animation and time, with the same bits on every
//! machine; and poses of skins: meshes whose vertices follow other nodes, their joints.
//!
//! The vertices of a skinned mesh are placed by joints; the transform of the mesh's own node has no effect (glTF 2.0
//! specification, section 3.7.3.3). Large offsets from the origin are removed in f64 before anything is rounded to f32.

use std::collections::{BTreeMap, HashMap};

use trigon_math::glam::{Affine3, DAffine3};
use trigon_math::{DQuat, DVec3, Mat3};

use super::Scene;
use crate::animation::{Animation, Channel, Property};
use crate::node::NodeId;
use crate::transform::Transform;

/// One node in a pose.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodePose {
    /// Its placement in its parent, if animated.
    pub transform: Option<Transform>,
    /// The weights of its morph targets, if animated.
    pub morph_weights: Option<Vec<f32>>,
}

/// All animated nodes at one moment. Other nodes are not included.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pose {
    /// By node.
    pub nodes: BTreeMap<NodeId, NodePose>,
}

impl Scene {
    /// The pose of an animation at a time in seconds: a pure function of the three. Before the
    /// first keyframe of a channel and after its last, it stays at that keyframe. Properties that
    /// no channel animates (a node's scale if only its rotation is animated) keep the node's own
    /// values.
    #[must_use]
    pub fn pose(&self, animation: &Animation, time: f64) -> Pose {
        let mut pose = Pose::default();
        for channel in &animation.channels {
            let Some(node) = self.node(channel.node) else { continue };
            let posed = pose.nodes.entry(channel.node).or_default();
            if channel.property == Property::MorphWeights {
                posed.morph_weights =
                    Some(channel.curve.at(time).into_iter().map(|weight| weight as f32).collect());
            } else {
                let parts = Parts::of(posed.transform.as_ref().unwrap_or(&node.transform));
                posed.transform = Some(parts.with(channel, time).into_transform());
            }
        }
        pose
    }

    /// Applies a pose to the nodes. What a light meter reads stays the same.
    pub fn apply_pose(&mut self, pose: &Pose) {
        for (&id, posed) in &pose.nodes {
            let Some(node) = self.nodes.get_mut(id) else { continue };
            if let Some(transform) = posed.transform {
                node.transform = transform;
            }
            if let Some(weights) = &posed.morph_weights {
                node.morph_weights.clone_from(weights);
            }
        }
    }
}

/// Splits a transform into its three parts.
struct Parts {
    translation: DVec3,
    rotation: DQuat,
    scale: DVec3,
}

impl Parts {
    /// Shear, which only a matrix can hold, is lost: animated transforms have none.
    fn of(transform: &Transform) -> Self {
        let (scale, rotation, translation) = match *transform {
            Transform::Decomposed { translation, rotation, scale } => (scale, rotation, translation),
            Transform::Affine(affine) => affine.to_scale_rotation_translation(),
        };
        Self { translation, rotation, scale }
    }

    fn with(mut self, channel: &Channel, time: f64) -> Self {
        let curve = &channel.curve;
        match channel.property {
            Property::Translation => self.translation = DVec3::from(curve.vector(time)),
            Property::Scale => self.scale = DVec3::from(curve.vector(time)),
            Property::Rotation => self.rotation = curve.rotation(time).unwrap_or(self.rotation),
            Property::MorphWeights => {}
        }
        self
    }

    fn into_transform(self) -> Transform {
        Transform::from_scale_rotation_translation(self.scale, self.rotation, self.translation)
    }
}

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
    use crate::animation::{Curve, Interpolation};
    use crate::node::{Node, Skin};

    fn channel(node: NodeId, property: Property, width: usize, values: &[f32]) -> Channel {
        let times = (0..values.len() / width).map(|key| key as f32).collect();
        let curve = Curve::new(Interpolation::Linear, width, times, values.to_vec()).expect("a curve");
        Channel { node, property, curve }
    }

    #[test]
    fn a_pose_moves_what_is_animated_and_keeps_the_rest() {
        let mut scene = Scene::new();
        let mut node = Node::default().at(DVec3::X);
        node.transform.scale_by(DVec3::splat(3.0));
        let (moving, gone) = (scene.add(node), scene.add(Node::default()));
        scene.remove(gone);
        let translation = channel(moving, Property::Translation, 3, &[0.0, 0.0, 0.0, 0.0, 2.0, 0.0]);
        let rotation = channel(moving, Property::Rotation, 4, &[0.0, 1.0, 0.0, 0.0]);
        let weights = channel(moving, Property::MorphWeights, 2, &[0.0, 1.0, 1.0, 0.5]);
        let lost = channel(gone, Property::Scale, 3, &[9.0; 3]);
        let animation =
            Animation { name: String::new(), channels: vec![translation, rotation, weights, lost] };
        assert_eq!(animation.duration(), 1.0, "the last keyframe");
        let pose = scene.pose(&animation, 0.5);
        assert_eq!(pose.nodes.len(), 1, "what is gone does not move");
        scene.apply_pose(&pose);
        let expected = Transform::from_scale_rotation_translation(
            DVec3::splat(3.0),
            DQuat::from_xyzw(0.0, 1.0, 0.0, 0.0),
            DVec3::Y,
        );
        let node = scene.node(moving).expect("it is there");
        assert_eq!(node.transform, expected, "its own scale");
        assert_eq!(node.morph_weights, [0.5, 0.75], "weights");
        assert_eq!(scene.pose(&animation, 0.5), pose, "a pure function, wherever the node is now");
    }

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
