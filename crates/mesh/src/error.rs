//! Errors of building a mesh.
//!
//! Each error names the element and a remedy. Importers turn errors of single faces into warnings:
//! one bad face must not lose the model.

use thiserror::Error;

/// Why an element was rejected.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum MeshError {
    /// An element names a vertex that does not exist (yet).
    #[error(
        "{element} {index} uses vertex {vertex}, but there are {vertex_count} vertices: push all vertices of an element before the element"
    )]
    VertexOutOfRange {
        /// What was being pushed: "face", "loose edge" or "loose point".
        element: &'static str,
        /// Its number among its kind, from 0.
        index: usize,
        /// The missing vertex.
        vertex: u32,
        /// The number of vertices in the builder.
        vertex_count: usize,
    },
    /// A face has fewer than three distinct vertices and so has no area.
    #[error(
        "face {face} has {distinct} distinct vertices and a face needs 3: skip it, or keep it as a loose edge or point"
    )]
    TooFewVertices {
        /// The number that the face would have had.
        face: usize,
        /// The number of distinct vertices.
        distinct: usize,
    },
    /// A loose edge runs from a vertex to itself.
    #[error("loose edge {index} runs from vertex {vertex} to itself: keep it as a loose point")]
    EdgeWithoutLength {
        /// Its number among the loose edges, from 0.
        index: usize,
        /// Both its ends.
        vertex: u32,
    },
    /// The mesh would have more elements than 32-bit indices can count.
    #[error("the mesh would have more than {limit} {what}: split it into several meshes")]
    TooMany {
        /// The kind of element.
        what: &'static str,
        /// The maximum.
        limit: u32,
    },
    /// The sizes of faces do not add up to the number of corners.
    #[error("the faces have {expected} corners in all, but {found} are given: give each face its corners")]
    CornerCount {
        /// The sum of the faces' sizes.
        expected: u64,
        /// The number given.
        found: usize,
    },
    /// An attribute list does not have one value per element.
    #[error("{attribute} has {found} values, but the mesh has {expected} {element}: give one each")]
    AttributeLength {
        /// The field of [`Attributes`](crate::Attributes), or what the values are.
        attribute: &'static str,
        /// What it is stored on: "corners", "faces" or "vertices".
        element: &'static str,
        /// The number of elements in the mesh.
        expected: usize,
        /// The number given.
        found: usize,
    },
}
