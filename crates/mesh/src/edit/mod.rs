//! Meshes that can be edited, and the operations on them.
//!
//! [`EditMesh`] knows every neighbour of every element, so that an operation finds what it needs
//! at once. Each operation is a file with one function, which returns what it made or a
//! [`Refusal`] that says why it did nothing. Run in [`EditMesh::transaction`], it can be
//! undone to the last byte.
//!
//! From low to high: `ids`, `column` (values with a record of changes), `records` and
//! `layers` (what is stored), `edit_mesh` (all columns), `slots` and `rings` (the only places
//! that write neighbours), `walk` (from element to element), `euler` (elementary changes), and the
//! operations.

mod blends;
mod column;
mod edit_mesh;
mod euler;
mod follow;
mod from_mesh;
mod ids;
mod inspect;
mod layers;
mod marks;
mod measure;
mod operations;
mod records;
mod refusal;
mod rings;
mod sharp_normals;
mod skin;
mod slots;
mod subdivision;
#[cfg(test)]
mod tests;
mod to_mesh;
mod transaction;
mod validate;
mod values;
mod walk;

pub use edit_mesh::EditMesh;
pub use euler::{SplitEdge, SplitFace};
pub use follow::{ChangedValues, ElementNumbers};
pub use from_mesh::LeftOut;
pub use ids::{CornerId, EdgeId, FaceId, VertexId};
pub use inspect::{
    BoundaryLoop, DoubledFace, DoubledVertex, Inspection, InspectionSettings, NonPlanarFace, TouchingFaces,
};
pub use marks::{EdgeMark, Marks, MarksError};
pub use operations::*;
pub use refusal::Refusal;
pub use to_mesh::ElementMap;
pub use transaction::Difference;
