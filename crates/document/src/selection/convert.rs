//! Converts selected elements of one kind to those of another.

use rayon::prelude::*;
use trigon_modelling::{EdgeId, EditMesh, FaceId, VertexId};

use super::{ElementKind, Elements, MeshSelection, bits, each_once};

impl MeshSelection {
    /// The selected vertices that exist and are not hidden, in increasing order. Takes time
    /// proportional to the selection, like the functions below.
    #[must_use]
    pub fn vertices(&self, mesh: &EditMesh, kind: ElementKind) -> Vec<VertexId> {
        let vertices: Vec<u32> = match kind {
            ElementKind::Vertex => return self.own_vertices(mesh).collect(),
            ElementKind::Edge => {
                self.own_edges(mesh).flat_map(|edge| mesh.edge_vertices(edge)).map(VertexId::index).collect()
            }
            ElementKind::Face => {
                self.own_faces(mesh).flat_map(|face| mesh.face_vertices(face)).map(VertexId::index).collect()
            }
        };
        each_once(mesh.vertex_capacity(), vertices).into_iter().map(VertexId::new).collect()
    }

    /// The selected edges that exist and are not hidden, in increasing order.
    #[must_use]
    pub fn edges(&self, mesh: &EditMesh, kind: ElementKind) -> Vec<EdgeId> {
        let edges: Vec<u32> = match kind {
            ElementKind::Vertex => {
                let is_whole = |edge: EdgeId| {
                    mesh.edge_vertices(edge).iter().all(|v| self.contains(v.index()))
                        && !mesh.is_edge_hidden(edge)
                };
                if self.is_much_of(mesh.vertex_capacity()) {
                    let is_whole = |edge: EdgeId| mesh.has_edge(edge) && is_whole(edge);
                    return those(mesh.edge_capacity(), |edge| is_whole(EdgeId::new(edge)), EdgeId::new);
                }
                let at = self.own_vertices(mesh).flat_map(|vertex| mesh.vertex_edges(vertex));
                at.filter(|&edge| is_whole(edge)).map(EdgeId::index).collect()
            }
            ElementKind::Edge => return self.own_edges(mesh).collect(),
            ElementKind::Face => {
                self.own_faces(mesh).flat_map(|face| mesh.face_edges(face)).map(EdgeId::index).collect()
            }
        };
        each_once(mesh.edge_capacity(), edges).into_iter().map(EdgeId::new).collect()
    }

    /// The selected faces that exist and are not hidden, in increasing order.
    #[must_use]
    pub fn faces(&self, mesh: &EditMesh, kind: ElementKind) -> Vec<FaceId> {
        let faces: Vec<u32> = match kind {
            ElementKind::Vertex => {
                let is_whole = |face: FaceId| {
                    !mesh.is_face_hidden(face) && mesh.face_vertices(face).all(|v| self.contains(v.index()))
                };
                if self.is_much_of(mesh.vertex_capacity()) {
                    let is_whole = |face: FaceId| mesh.has_face(face) && is_whole(face);
                    return those(mesh.face_capacity(), |face| is_whole(FaceId::new(face)), FaceId::new);
                }
                let at = self.own_vertices(mesh).flat_map(|vertex| mesh.vertex_faces(vertex));
                at.filter(|&face| is_whole(face)).map(FaceId::index).collect()
            }
            ElementKind::Edge => {
                let is_whole = |face: FaceId| {
                    !mesh.is_face_hidden(face) && mesh.face_edges(face).all(|e| self.contains(e.index()))
                };
                if self.is_much_of(mesh.edge_capacity()) {
                    let is_whole = |face: FaceId| mesh.has_face(face) && is_whole(face);
                    return those(mesh.face_capacity(), |face| is_whole(FaceId::new(face)), FaceId::new);
                }
                let at = self.own_edges(mesh).flat_map(|edge| mesh.edge_faces(edge));
                at.filter(|&face| is_whole(face)).map(FaceId::index).collect()
            }
            ElementKind::Face => return self.own_faces(mesh).collect(),
        };
        each_once(mesh.face_capacity(), faces).into_iter().map(FaceId::new).collect()
    }

    fn own_vertices<'a>(&'a self, mesh: &'a EditMesh) -> impl Iterator<Item = VertexId> + 'a {
        let all = self.indices().map(VertexId::new);
        all.filter(|&vertex| mesh.has_vertex(vertex) && !mesh.is_vertex_hidden(vertex))
    }

    fn own_edges<'a>(&'a self, mesh: &'a EditMesh) -> impl Iterator<Item = EdgeId> + 'a {
        let all = self.indices().map(EdgeId::new);
        all.filter(|&edge| mesh.has_edge(edge) && !mesh.is_edge_hidden(edge))
    }

    fn own_faces<'a>(&'a self, mesh: &'a EditMesh) -> impl Iterator<Item = FaceId> + 'a {
        let all = self.indices().map(FaceId::new);
        all.filter(|&face| mesh.has_face(face) && !mesh.is_face_hidden(face))
    }

    /// Whether the selection is so large that testing each element of another kind is faster than
    /// visiting the neighbours of the selected ones.
    fn is_much_of(&self, capacity: usize) -> bool {
        /// The fraction of all elements above which it is.
        const PART: usize = 16;
        self.len() * PART > capacity
    }

    /// Converts the selection to another kind of element.
    pub(super) fn convert(&mut self, mesh: &EditMesh, from: ElementKind, to: ElementKind) {
        let elements = match to {
            ElementKind::Vertex => Elements::Vertices(self.vertices(mesh, from)),
            ElementKind::Edge => Elements::Edges(self.edges(mesh, from)),
            ElementKind::Face => Elements::Faces(self.faces(mesh, from)),
        };
        self.select(mesh, to, &elements);
    }

    /// Selects exactly these elements, as far as they are not hidden. Elements of another kind than
    /// the selection's are represented by their parts, or by the elements that consist only of
    /// them.
    pub fn select(&mut self, mesh: &EditMesh, kind: ElementKind, elements: &Elements) {
        let own = match elements {
            Elements::Vertices(vertices) => bits(mesh.vertex_capacity(), vertices.iter().map(|v| v.index())),
            Elements::Edges(edges) => bits(mesh.edge_capacity(), edges.iter().map(|e| e.index())),
            Elements::Faces(faces) => bits(mesh.face_capacity(), faces.iter().map(|f| f.index())),
        };
        let given = match elements {
            Elements::Vertices(_) => ElementKind::Vertex,
            Elements::Edges(_) => ElementKind::Edge,
            Elements::Faces(_) => ElementKind::Face,
        };
        self.set(own);
        self.retain(|index| given.is_selectable(mesh, index));
        if given != kind {
            self.convert(mesh, given, kind);
        }
    }
}

/// The elements for which a predicate holds, in increasing order, computed on all threads.
fn those<T: Send>(capacity: usize, is_so: impl Fn(u32) -> bool + Sync, name: fn(u32) -> T) -> Vec<T> {
    /// The number of elements that a thread tests at a time.
    const SHARE: usize = 1 << 14;
    let starts: Vec<usize> = (0..capacity).step_by(SHARE).collect();
    let found = starts.into_par_iter().map(|start| {
        let share = start as u32..capacity.min(start + SHARE) as u32;
        share.filter(|&element| is_so(element)).map(name).collect::<Vec<T>>()
    });
    found.collect::<Vec<_>>().into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use trigon_mesh::primitives;

    use super::*;

    /// Few and many selected elements are tested in different ways with the same result.
    #[test]
    fn what_follows_from_many_elements_is_what_follows_from_few() {
        let mut mesh = EditMesh::from_mesh(&primitives::grid(1.0, 1.0, 9, 7)).0;
        let hidden: Vec<FaceId> = mesh.faces().step_by(11).collect();
        hidden.into_iter().for_each(|face| mesh.set_face_hidden(face, true));
        for kind in [ElementKind::Vertex, ElementKind::Edge] {
            let capacity = kind.capacity(&mesh);
            for left_out in 0..7 {
                let mut many = MeshSelection::default();
                many.set(bits(capacity, (0..capacity as u32).filter(|index| index % 7 != left_out)));
                assert!(many.is_much_of(capacity), "{kind:?}: asked element by element");
                assert!(!many.is_much_of(20 * capacity), "{kind:?}: few of a larger mesh");
                let contains = |index: u32| many.contains(index);
                let edges: Vec<EdgeId> = mesh
                    .edges()
                    .filter(|&edge| match kind {
                        ElementKind::Vertex => mesh.edge_vertices(edge).iter().all(|v| contains(v.index())),
                        _ => contains(edge.index()),
                    })
                    .filter(|&edge| !mesh.is_edge_hidden(edge))
                    .collect();
                let faces: Vec<FaceId> = mesh
                    .faces()
                    .filter(|&face| match kind {
                        ElementKind::Vertex => mesh.face_vertices(face).all(|v| contains(v.index())),
                        _ => mesh.face_edges(face).all(|e| contains(e.index())),
                    })
                    .filter(|&face| !mesh.is_face_hidden(face))
                    .collect();
                assert!(!faces.is_empty() && !edges.is_empty(), "{kind:?}: something follows");
                assert_eq!(many.edges(&mesh, kind), edges, "{kind:?} without {left_out}");
                assert_eq!(many.faces(&mesh, kind), faces, "{kind:?} without {left_out}");
            }
        }
    }
}
