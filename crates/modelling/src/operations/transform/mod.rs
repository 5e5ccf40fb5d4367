//! Moving vertices: translate, rotate, scale, shear, to sphere, along normals, push and pull,
//! with proportional falloff.
//!
//! Everything starts from the positions of the vertices when a [`MoveSession`] began. Each new position is
//! computed from these in f64 and rounded once, so a drag of a thousand steps ends where one step would.

mod along_edges;
mod clip;
mod falloff;
mod given_normals;
mod kind;
mod nearest;
mod reset;
mod session;
#[cfg(test)]
mod tests;

pub(super) use falloff::Weighted;
pub(super) use given_normals::GivenNormals;
pub(super) use session::sorted;

pub use falloff::{Falloff, FalloffDistance, FalloffShape};
pub use kind::Transform;
pub use session::MoveSession;
