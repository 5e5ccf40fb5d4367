//! What an animation changes, and in which nodes.

use super::Curve;
use crate::node::NodeId;

/// What of a node changes, and how wide the curve's vectors are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Property {
    /// Three numbers: metres in the parent's space.
    Translation,
    /// Four numbers: a quaternion, x, y, z, w.
    Rotation,
    /// Three factors.
    Scale,
    /// A number for each morph target of the node's mesh.
    MorphWeights,
}

/// A curve for one property of one node.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Whose; a channel of a removed node does nothing.
    pub node: NodeId,
    /// Which.
    pub property: Property,
    /// Over time.
    pub curve: Curve,
}

/// Movements that belong together. Of several channels for the same property
/// of the same node, the last counts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Animation {
    /// For people; need not be unique.
    pub name: String,
    /// What moves.
    pub channels: Vec<Channel>,
}

impl Animation {
    /// Seconds from 0 to its last keyframe; 0 without any. Whether it then
    /// starts again is for the caller to say: `time % duration`.
    pub fn duration(&self) -> f64 {
        let ends = self.channels.iter().filter_map(|channel| channel.curve.times().last());
        ends.fold(0.0, |longest, &end| if f64::from(end) > longest { f64::from(end) } else { longest })
    }
}
