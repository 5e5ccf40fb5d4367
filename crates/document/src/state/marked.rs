//! Which edges of a mesh have marks, and whether anything is hidden: computed once after a change of marks.

use trigon_modelling::{EdgeId, EditMesh};

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

#[cfg(test)]
mod tests {
    use trigon_mesh::primitives;
    use trigon_modelling::{FaceId, VertexId};

    use super::*;

    #[test]
    fn each_mark_is_in_its_own_list() {
        type Hide = fn(&mut EditMesh);
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::cube(1.0));
        let of = |mesh: &EditMesh| {
            let MarkedElements { sharp, seams, creases, has_hidden } = MarkedElements::of(mesh);
            (
                [sharp, seams, creases].map(|edges| edges.into_iter().map(EdgeId::index).collect::<Vec<_>>()),
                has_hidden,
            )
        };
        assert_eq!(of(&mesh), ([vec![], vec![], vec![]], false), "a cube has none");
        mesh.set_sharp(EdgeId::new(2), true);
        mesh.set_seam(EdgeId::new(3), true);
        mesh.set_seam(EdgeId::new(5), true);
        mesh.set_crease(EdgeId::new(7), 0.25);
        let marked = [vec![2], vec![3, 5], vec![7]];
        assert_eq!(of(&mesh), (marked.clone(), false), "one sharp, two seams, one crease");
        let hide: [Hide; 3] = [
            |mesh| mesh.set_vertex_hidden(VertexId::new(1), true),
            |mesh| mesh.set_edge_hidden(EdgeId::new(1), true),
            |mesh| mesh.set_face_hidden(FaceId::new(1), true),
        ];
        for hide in hide {
            let mut mesh = mesh.clone();
            hide(&mut mesh);
            assert_eq!(of(&mesh), (marked.clone(), true), "one element is hidden");
        }
    }
}
