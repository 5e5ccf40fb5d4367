//! What edit mode shows of a mesh with modifiers: what they make of it, and over it the mesh itself, its cage.

use trigon_mesh::{Attributes, Mesh, MeshColumns};

use super::evaluation::Evaluation;
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, NONE, VertexId};
use crate::to_mesh::ElementMap;

impl Evaluation {
    /// The mesh after the modifiers, and over it the mesh itself, from which they were evaluated: the vertices of that follow,
    /// and its edges are loose ones. What is hidden is left out. `None` if the modifiers change nothing.
    ///
    /// In the map, vertices and loose edges of the result have no element of the mesh ([`EditMesh::has_vertex`] is false for
    /// them) and come first. Its faces
    /// are those of which they are parts or copies, and these follow one another; a face that came from none is none of the
    /// mesh. There are no corners in it. The result has no skin and no morph targets: while it is edited it is at rest.
    #[must_use]
    pub fn to_mesh_with_cage(&self, cage: &EditMesh) -> Option<(Mesh, ElementMap)> {
        let mut result = self.evaluated()?.clone();
        result.vertex_layers.clear();
        let mut map = result.shown_by_origin();
        let mut columns = result.columns_of(&mut map);
        let attributes = Attributes { morph_targets: Vec::new(), ..result.attributes(&map) };
        let faces = map.faces.iter().map(|&face| result.face_origin(face)).collect();
        let mut vertices = vec![VertexId(NONE); map.vertices.len()];
        vertices.extend(cage.vertices().filter(|&vertex| !cage.is_vertex_hidden(vertex)));
        let is_shown = |&edge: &EdgeId| {
            let is_hidden = |vertex| cage.is_vertex_hidden(vertex);
            !cage.is_edge_hidden(edge) && !cage.edge_vertices(edge).into_iter().any(is_hidden)
        };
        let mut loose_edges = vec![EdgeId(NONE); map.loose_edges.len()];
        loose_edges.extend(cage.edges().filter(is_shown));
        let of_cage = &loose_edges[map.loose_edges.len()..];
        cage.add_cage(&mut columns, &vertices[map.vertices.len()..], of_cage);
        let mut mesh = Mesh::from_valid_columns(columns);
        mesh.set_attributes(attributes).expect("no value is one of a vertex");
        Some((mesh, ElementMap { vertices, faces, corners: Vec::new(), loose_edges }))
    }
}

impl EditMesh {
    /// The faces of a result that are not hidden, those of one origin after one another, and edges without faces.
    fn shown_by_origin(&self) -> ElementMap {
        let is_shown = |vertex: VertexId| !self.is_vertex_hidden(vertex);
        let mut faces: Vec<FaceId> = self
            .faces()
            .filter(|&face| !self.is_face_hidden(face) && self.face_vertices(face).all(is_shown))
            .collect();
        faces.sort_by_key(|&face| self.face_origin(face));
        let is_loose = |&edge: &EdgeId| {
            self.edge_corners(edge).next().is_none()
                && !self.is_edge_hidden(edge)
                && self.edge_vertices(edge).into_iter().all(is_shown)
        };
        let loose_edges = self.edges().filter(is_loose).collect();
        ElementMap { vertices: self.vertices().collect(), faces, loose_edges, ..ElementMap::default() }
    }

    /// Adds vertices and edges of this mesh to those of a result.
    fn add_cage(&self, surface: &mut MeshColumns, vertices: &[VertexId], edges: &[EdgeId]) {
        let first = surface.positions.len() as u32;
        let mut numbers = vec![NONE; self.vertex_capacity()];
        for (number, vertex) in (first..).zip(vertices) {
            numbers[vertex.0 as usize] = number;
        }
        let ends = |&edge: &EdgeId| self.edge_vertices(edge).map(|vertex| numbers[vertex.0 as usize]);
        surface.positions.extend(vertices.iter().map(|&vertex| self.position(vertex)));
        surface.loose_edges.extend(edges.iter().map(ends));
    }
}
