//! Animations: curves over time for properties of nodes.
//!
//! `curve` (keyframes and interpolation) → `channel` (which property of which node) → `pose` (the
//! state of an animation at one moment). A pose is a pure function of scene, animation and time,
//! and has the same bits on every machine.

mod channel;
mod curve;
mod pose;

pub use channel::{Animation, Channel, Property};
pub use curve::{Curve, Interpolation};
pub use pose::{NodePose, Pose};
