//! From selected elements of one kind to those of another that follow from them.

use trigon_mesh::edit::{EdgeId, EditMesh, FaceId, VertexId};

use super::{ElementKind, Elements, MeshSelection, bits, each_once};

impl MeshSelection {
    /// The selected vertices that exist and are not hidden, increasing. It takes time
    /// proportional to what is selected, and so do the others.
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

    /// The selected edges that exist and are not hidden, increasing.
    #[must_use]
    pub fn edges(&self, mesh: &EditMesh, kind: ElementKind) -> Vec<EdgeId> {
        let edges: Vec<u32> = match kind {
            ElementKind::Vertex => {
                let at = self.own_vertices(mesh).flat_map(|vertex| mesh.vertex_edges(vertex));
                let is_whole =
                    |edge: &EdgeId| mesh.edge_vertices(*edge).iter().all(|v| self.contains(v.index()));
                at.filter(|edge| is_whole(edge) && !mesh.is_edge_hidden(*edge)).map(EdgeId::index).collect()
            }
            ElementKind::Edge => return self.own_edges(mesh).collect(),
            ElementKind::Face => {
                self.own_faces(mesh).flat_map(|face| mesh.face_edges(face)).map(EdgeId::index).collect()
            }
        };
        each_once(mesh.edge_capacity(), edges).into_iter().map(EdgeId::new).collect()
    }

    /// The selected faces that exist and are not hidden, increasing.
    #[must_use]
    pub fn faces(&self, mesh: &EditMesh, kind: ElementKind) -> Vec<FaceId> {
        let faces: Vec<u32> = match kind {
            ElementKind::Vertex => {
                let at = self.own_vertices(mesh).flat_map(|vertex| mesh.vertex_faces(vertex));
                let is_whole = |face: FaceId| mesh.face_vertices(face).all(|v| self.contains(v.index()));
                at.filter(|&face| !mesh.is_face_hidden(face) && is_whole(face)).map(FaceId::index).collect()
            }
            ElementKind::Edge => {
                let at = self.own_edges(mesh).flat_map(|edge| mesh.edge_faces(edge));
                let is_whole = |face: FaceId| mesh.face_edges(face).all(|e| self.contains(e.index()));
                at.filter(|&face| !mesh.is_face_hidden(face) && is_whole(face)).map(FaceId::index).collect()
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

    /// Selects elements of another kind: those that followed from what was selected.
    pub(super) fn convert(&mut self, mesh: &EditMesh, from: ElementKind, to: ElementKind) {
        let elements = match to {
            ElementKind::Vertex => Elements::Vertices(self.vertices(mesh, from)),
            ElementKind::Edge => Elements::Edges(self.edges(mesh, from)),
            ElementKind::Face => Elements::Faces(self.faces(mesh, from)),
        };
        self.select(mesh, to, &elements);
    }

    /// Selects elements and no others, as far as they are not hidden. Those of another kind than the
    /// selection's are represented by what they consist of, or by what consists of them alone.
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
