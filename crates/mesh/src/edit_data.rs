//! What an editor knows of a mesh besides the mesh itself, as plain columns.

use trigon_math::Vec3;

/// What an editor knows of a [`Mesh`](crate::Mesh) besides its elements and attributes: original positions,
/// marks of edges, hidden elements. Elements are named by the mesh's indices. Nothing is drawn of them, and
/// files keep them with the mesh.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct EditData {
    /// To where each vertex can be reset, in metres; empty if each is where it was.
    pub first_positions: Vec<Vec3>,
    /// Edges with any mark, by their vertices.
    pub edges: Vec<EdgeMark>,
    /// Vertices that are hidden from the user.
    pub hidden_vertices: Vec<u32>,
    /// Faces that are hidden from the user.
    pub hidden_faces: Vec<u32>,
    /// Corners whose normal in the mesh was not given: sharp edges make it, and it follows them.
    pub sharp_corners: Vec<u32>,
    /// In how many Catmull-Clark levels the mesh is shown.
    pub subdivision: u32,
}

/// The marks of one edge.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct EdgeMark {
    /// Its two vertices, the smaller one first.
    pub vertices: [u32; 2],
    /// It stays sharp in smooth shading.
    pub is_sharp: bool,
    /// Texture coordinates are cut there when they are laid out.
    pub is_seam: bool,
    /// It is hidden from the user.
    pub is_hidden: bool,
    /// How sharp it stays in Catmull-Clark subdivision, 0 to 1.
    pub crease: f32,
}
