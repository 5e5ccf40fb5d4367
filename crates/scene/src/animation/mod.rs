//! Animations: curves over time for properties of nodes.
//!
//! `curve` (keyframes and interpolation) → `channel` (which property of which node) → `scene/pose` (the
//! state of an animation at one moment).

mod channel;
mod curve;

pub use channel::{Animation, Channel, Property};
pub use curve::{Curve, Interpolation};
