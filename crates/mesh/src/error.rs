//! What can be wrong with a mesh that is being built.
//!
//! Each error says which element it means and what to do about it. Importers
//! catch them per face and turn them into warnings: one bad face must not
//! lose the model.

use thiserror::Error;

/// Why an element was refused.
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
        /// The vertex asked for.
        vertex: u32,
        /// How many vertices the builder has.
        vertex_count: usize,
    },
    /// A face has fewer than three distinct vertices and so bounds nothing.
    #[error(
        "face {face} has {distinct} distinct vertices and a face needs 3: skip it, or keep it as a loose edge or point"
    )]
    TooFewVertices {
        /// The number that the face would have had.
        face: usize,
        /// How many distinct vertices it names.
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
    /// The mesh would have more elements than 32-bit indices can name.
    #[error("the mesh would have more than {limit} {what}: split it into several meshes")]
    TooMany {
        /// What there is too much of.
        what: &'static str,
        /// The most that fits.
        limit: u32,
    },
    /// The sizes of faces do not add up to the number of corners.
    #[error("the faces have {expected} corners in all, but {found} are given: give each face its corners")]
    CornerCount {
        /// The sum of the faces' sizes.
        expected: u64,
        /// How many were given.
        found: usize,
    },
    /// An attribute list has not one value per element.
    #[error("{attribute} has {found} values, but the mesh has {expected} {element}: give one each")]
    AttributeLength {
        /// The field of [`Attributes`](crate::Attributes).
        attribute: &'static str,
        /// What it is stored on: "corners", "faces" or "vertices".
        element: &'static str,
        /// How many the mesh has.
        expected: usize,
        /// How many were given.
        found: usize,
    },
}
