//! Which edges of a mesh have marks, and whether anything is hidden: computed once after a change of marks.

use trigon_mesh::edit::{EdgeId, EditMesh};

/// The marks of a mesh.
#[derive(Debug)]
pub(crate) struct MarkedElements {
    pub(crate) sharp: Vec<EdgeId>,
    pub(crate) seams: Vec<EdgeId>,
    pub(crate) creases: Vec<EdgeId>,
    /// Whether any vertex, edge or face is hidden.
    pub(crate) has_hidden: bool,
}

impl MarkedElements {
    pub(crate) const NONE: Self =
        Self { sharp: Vec::new(), seams: Vec::new(), creases: Vec::new(), has_hidden: false };

    /// Takes time proportional to the mesh.
    pub(crate) fn of(mesh: &EditMesh) -> Self {
        let mut marked = Self::NONE;
        for edge in mesh.edges() {
            if mesh.is_sharp(edge) {
                marked.sharp.push(edge);
            }
            if mesh.is_seam(edge) {
                marked.seams.push(edge);
            }
            if mesh.crease(edge) > 0.0 {
                marked.creases.push(edge);
            }
        }
        marked.has_hidden = mesh.vertices().any(|vertex| mesh.is_vertex_hidden(vertex))
            || mesh.edges().any(|edge| mesh.is_edge_hidden(edge))
            || mesh.faces().any(|face| mesh.is_face_hidden(face));
        marked
    }
}
