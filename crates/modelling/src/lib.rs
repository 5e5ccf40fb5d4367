//! Editable polygon meshes and their operations.
//!
//! [`EditMesh`] stores the full adjacency of every element, so an operation finds what it needs at
//! once. Each operation is a file with one function, which returns what it made or a [`Refusal`]
//! with the reason why it did nothing. Within [`EditMesh::transaction`] it can be undone to the
//! last byte. [`EditMesh::from_mesh`] and [`EditMesh::to_mesh`] convert from and to the
//! [`Mesh`](trigon_mesh::Mesh) that is drawn and saved.
//!
//! This crate knows no documents, selections, files or windows, and gives the same bits on every machine.
//!
//! # Modules
//! From low to high: `ids`, `column` (values with a record of changes), `records` and `layers` (the stored data),
//! `edit_mesh` (all columns). `slots` adds and removes single elements, `rings` links and unlinks them, `walk`
//! goes from one to its neighbours. `euler` has the elementary changes of which `operations` consist. `modifier` has
//! operations as data, and `stack` evaluates a mesh's stack of them.

mod blends;
mod column;
mod edit_data;
mod edit_mesh;
mod euler;
mod follow;
mod from_mesh;
mod group_weight;
mod ids;
mod inspect;
mod layers;
mod measure;
mod modifier;
mod numbering;
mod operations;
mod records;
mod refusal;
mod rings;
mod sharp_normals;
mod skin;
mod slots;
mod stack;
#[cfg(test)]
mod tests;
mod to_mesh;
mod transaction;
mod validate;
mod values;
mod vertex_groups;
mod walk;

pub use edit_data::EditDataError;
pub use edit_mesh::EditMesh;
pub use euler::{SplitEdge, SplitFace};
pub use follow::{ChangedValues, ElementNumbers};
pub use from_mesh::LeftOut;
pub use ids::{CornerId, EdgeId, FaceId, VertexId};
pub use inspect::{
    BoundaryLoop, DoubledFace, DoubledVertex, FaceThickness, Inspection, InspectionSettings, NonPlanarFace,
    OverhangSettings, TouchingFaces,
};
pub use measure::{PRINT_MATERIALS, PrintMaterial};
pub use modifier::{
    ArrayModifier, BevelModifier, BeveledEdges, BooleanModifier, BooleanOperation, DecimateGoal,
    DecimateSettings, MirrorModifier, Modifier, ScrewModifier, SolidifySettings, StackedModifier,
    SubdivisionModifier, TriangulateModifier, WeldModifier,
};
pub use operations::*;
pub use refusal::{Refusal, SolidFault};
pub use stack::{Evaluation, ModifierObjects, ModifierState, NoObjects, ObjectState};
pub use to_mesh::ElementMap;
pub use transaction::Difference;
pub use vertex_groups::VertexGroup;

/// Re-export of the crate below, so that programs need no other dependency.
pub use trigon_mesh as mesh;

/// Runs the README's example as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
