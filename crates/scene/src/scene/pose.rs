//! The state of an animation at one moment: a pure function of scene, animation and time, with the same bits on every
//! machine.

use std::collections::BTreeMap;

use trigon_math::{DQuat, DVec3};

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::animation::{Curve, Interpolation};
    use crate::node::Node;

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
}
