//! What is known of a mesh before its attributes.

use super::corners::CornerTable;

/// The triangles of a mesh, before its attributes are known.
pub(super) struct Shape {
    pub(super) points: usize,
    /// Three points each.
    pub(super) triangles: Vec<u32>,
    /// How the triangles hang together, if the stream says so.
    pub(super) tables: Option<Tables>,
}

/// The corners of a mesh: for positions, and for each kind of attribute with seams of its own.
pub(super) struct Tables {
    pub(super) positions: CornerTable,
    pub(super) attributes: Vec<CornerTable>,
}
