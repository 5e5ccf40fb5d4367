//! Animations: curves over time for what nodes do.
//!
//! `curve` (keyframes and what is between them) → `channel` (which property of
//! which node) → `pose` (everything that an animation says of one moment).
//! A pose is a pure function of scene, animation and time, and has the same
//! bits on every machine.

mod channel;
mod curve;
mod pose;

pub use channel::{Animation, Channel, Property};
pub use curve::{Curve, Interpolation};
pub use pose::{NodePose, Pose};
