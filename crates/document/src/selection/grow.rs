//! Growing and shrinking selections: linked, more, less.

use fixedbitset::FixedBitSet;
use trigon_modelling::{EdgeId, EditMesh, FaceId, VertexId};

use super::{ElementKind, MeshSelection, bits};

impl MeshSelection {
    /// Selects everything connected to the selection by edges.
    pub fn grow_linked(&mut self, mesh: &EditMesh, kind: ElementKind) {
        let mut reached = FixedBitSet::with_capacity(mesh.vertex_capacity());
        let mut waiting = self.vertices(mesh, kind);
        waiting.iter().for_each(|vertex| reached.insert(vertex.index() as usize));
        while let Some(vertex) = waiting.pop() {
            for neighbor in mesh.vertex_neighbors(vertex) {
                if !reached.put(neighbor.index() as usize) {
                    waiting.push(neighbor);
                }
            }
        }
        let has = |vertex: VertexId| reached.contains(vertex.index() as usize);
        match kind {
            ElementKind::Vertex => {
                let hidden: Vec<usize> =
                    reached.ones().filter(|&v| mesh.is_vertex_hidden(VertexId::new(v as u32))).collect();
                hidden.into_iter().for_each(|vertex| reached.set(vertex, false));
                self.set(reached);
            }
            ElementKind::Edge => {
                let linked = mesh.edges().filter(|&edge| has(mesh.edge_vertices(edge)[0]));
                let visible = linked.filter(|&edge| !mesh.is_edge_hidden(edge));
                self.set(bits(mesh.edge_capacity(), visible.map(EdgeId::index)));
            }
            ElementKind::Face => {
                // All vertices of a face are connected, so one represents all.
                let is_linked = |&face: &FaceId| mesh.face_vertices(face).next().is_some_and(has);
                let visible = mesh.faces().filter(is_linked).filter(|&face| !mesh.is_face_hidden(face));
                self.set(bits(mesh.face_capacity(), visible.map(FaceId::index)));
            }
        }
    }

    /// Grows the selection: vertices with a common face or edge, edges and faces with a common
    /// vertex.
    pub fn grow(&mut self, mesh: &EditMesh, kind: ElementKind) {
        let vertices = self.vertices(mesh, kind);
        let mut grown = self.bits().clone();
        match kind {
            ElementKind::Vertex => {
                grown.grow(mesh.vertex_capacity());
                for vertex in vertices {
                    for neighbor in around(mesh, vertex).filter(|&v| !mesh.is_vertex_hidden(v)) {
                        grown.insert(neighbor.index() as usize);
                    }
                }
            }
            ElementKind::Edge => {
                grown.grow(mesh.edge_capacity());
                for vertex in vertices {
                    for edge in mesh.vertex_edges(vertex).filter(|&e| !mesh.is_edge_hidden(e)) {
                        grown.insert(edge.index() as usize);
                    }
                }
            }
            ElementKind::Face => {
                grown.grow(mesh.face_capacity());
                for vertex in vertices {
                    for face in mesh.vertex_faces(vertex).filter(|&f| !mesh.is_face_hidden(f)) {
                        grown.insert(face.index() as usize);
                    }
                }
            }
        }
        self.set(grown);
    }

    /// Shrinks the selection: deselects elements that touch an unselected one, in the sense of
    /// [`Self::grow`]. The border of a mesh does not count.
    pub fn shrink(&mut self, mesh: &EditMesh, kind: ElementKind) {
        let mut shrunk = self.bits().clone();
        let is_border = |vertex: VertexId| match kind {
            ElementKind::Vertex => around(mesh, vertex).any(|other| !self.contains(other.index())),
            ElementKind::Edge => mesh.vertex_edges(vertex).any(|edge| !self.contains(edge.index())),
            ElementKind::Face => mesh.vertex_faces(vertex).any(|face| !self.contains(face.index())),
        };
        for index in self.indices() {
            let stays = match kind {
                ElementKind::Vertex => !is_border(VertexId::new(index)),
                ElementKind::Edge => !mesh.edge_vertices(EdgeId::new(index)).into_iter().any(is_border),
                ElementKind::Face => !mesh.face_vertices(FaceId::new(index)).any(is_border),
            };
            shrunk.set(index as usize, stays);
        }
        self.set(shrunk);
    }
}

/// The vertices that share a face or an edge with a vertex, including itself.
fn around(mesh: &EditMesh, vertex: VertexId) -> impl Iterator<Item = VertexId> + '_ {
    let by_faces = mesh.vertex_faces(vertex).flat_map(|face| mesh.face_vertices(face));
    by_faces.chain(mesh.vertex_neighbors(vertex))
}
