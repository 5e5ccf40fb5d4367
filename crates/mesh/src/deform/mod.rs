//! Shapes that move: skins, morph targets, and what they make of a mesh.
//!
//! A mesh carries how strongly each vertex follows which joint
//! ([`SkinWeights`]) and how its vertices move for each morph target
//! ([`MorphTarget`]). Which pose it is in, is for the scene to say. This is
//! where a pose becomes positions, normals and tangents; renderers that do the
//! same in vectors are held to it.

mod deformed;
mod deltas;
mod flat_faces;
mod skin_weights;

pub use deformed::Deformed;
pub use deltas::{Deltas, MorphTarget};
pub use flat_faces::FlatFaces;
pub use skin_weights::SkinWeights;

pub(crate) use deltas::classes;
pub(crate) use flat_faces::flat_classes;
