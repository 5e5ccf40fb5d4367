//! The properties that an animation changes, and their nodes.

use super::Curve;
use crate::node::NodeId;

/// The property of a node that changes, and the width of the curve's vectors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Property {
    /// Three numbers: metres in the parent's space.
    Translation,
    /// Four numbers: a quaternion, x, y, z, w.
    Rotation,
    /// Three factors.
    Scale,
    /// One number for each morph target of the node's mesh.
    MorphWeights,
}

/// A curve for one property of one node.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// The node; a channel of a removed node does nothing.
    pub node: NodeId,
    /// Which.
    pub property: Property,
    /// Over time.
    pub curve: Curve,
}

/// An animation. If several channels change the same property of the same node, the last one
/// counts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Animation {
    /// A display name; need not be unique.
    pub name: String,
    /// What moves.
    pub channels: Vec<Channel>,
}

impl Animation {
    /// Seconds from 0 to its last keyframe; 0 without keyframes. The caller decides whether it
    /// repeats: `time % duration`.
    #[must_use]
    pub fn duration(&self) -> f64 {
        let ends = self.channels.iter().filter_map(|channel| channel.curve.times().last());
        ends.fold(0.0, |longest, &end| if f64::from(end) > longest { f64::from(end) } else { longest })
    }
}
