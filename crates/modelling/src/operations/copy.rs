//! Extracting part of a mesh as a separate mesh, and adding a whole mesh to another: the basis of
//! duplicating, separating and joining.

use super::tables::{IndexSet, IndexTable};
use crate::column::Column;
use crate::edit_mesh::EditMesh;
use crate::group_weight::GroupLayers;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::layers::{Layer, LayerKind, LayerValues};

/// Copies of elements, in the order of the originals' ids.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct CopiedElements {
    /// The new vertices.
    pub vertices: Vec<VertexId>,
    /// The new edges.
    pub edges: Vec<EdgeId>,
    /// The new faces.
    pub faces: Vec<FaceId>,
}

/// Elements by index, each once.
#[derive(Debug, Default)]
pub(super) struct Elements {
    pub(super) vertices: Vec<VertexId>,
    pub(super) edges: Vec<EdgeId>,
    pub(super) faces: Vec<FaceId>,
}

impl Elements {
    /// Faces with their edges, edges with their ends, and vertices.
    pub(super) fn with_parts(
        mesh: &EditMesh,
        vertices: &[VertexId],
        edges: &[EdgeId],
        faces: &[FaceId],
    ) -> Self {
        let corners: usize = faces.iter().map(|&face| mesh.face_size(face)).sum();
        let expected = corners + 2 * edges.len() + vertices.len();
        let mut listed_faces = IndexSet::new(mesh.face_capacity(), faces.len());
        let mut listed_edges = IndexSet::new(mesh.edge_capacity(), expected);
        let mut listed_vertices = IndexSet::new(mesh.vertex_capacity(), expected);
        let mut elements = Self::default();
        elements.faces.extend(faces.iter().copied().filter(|face| listed_faces.insert(face.0)));
        let of_faces = elements.faces.iter().flat_map(|&face| mesh.face_edges(face));
        let all_edges = of_faces.chain(edges.iter().copied());
        elements.edges.extend(all_edges.filter(|edge| listed_edges.insert(edge.0)));
        let of_edges = elements.edges.iter().flat_map(|&edge| mesh.edge_vertices(edge));
        let all_vertices = of_edges.chain(vertices.iter().copied());
        elements.vertices.extend(all_vertices.filter(|vertex| listed_vertices.insert(vertex.0)));
        elements.faces.sort_unstable();
        elements.edges.sort_unstable();
        elements.vertices.sort_unstable();
        elements
    }

    /// The whole mesh.
    pub(super) fn all(mesh: &EditMesh) -> Self {
        Self {
            vertices: mesh.vertices().collect(),
            edges: mesh.edges().collect(),
            faces: mesh.faces().collect(),
        }
    }
}

impl EditMesh {
    /// A mesh of some elements, which must include everything they consist of. They get indices in
    /// order. All layers are included.
    pub(super) fn part(&self, elements: &Elements) -> Self {
        let layers = |layers: &[Layer]| layers.iter().map(Layer::empty_like).collect();
        let mut part = Self {
            vertex_layers: layers(&self.vertex_layers),
            corner_layers: layers(&self.corner_layers),
            groups: self.groups.clone(),
            ..Self::new()
        };
        let all = |count: usize| (0..count).map(Some).collect::<Vec<_>>();
        let pairs = LayerPairs {
            of_vertices: all(self.vertex_layers.len()),
            of_corners: all(self.corner_layers.len()),
        };
        part.add_copies(self, elements, &pairs);
        part
    }

    /// Adds another mesh as a whole. Layers that either lacks are added: with zeros, or white for
    /// colours, which is how a mesh without colours is displayed. Vertex groups of the same name become one; the caller has
    /// checked how many there will be.
    pub(super) fn append(&mut self, other: &Self) -> CopiedElements {
        let vertices = self.vertices.len();
        let corners = self.corners.len();
        let groups = self.unite_groups(other);
        let pairs = LayerPairs {
            of_vertices: unite_layers(&mut self.vertex_layers, &other.vertex_layers, vertices, &groups),
            of_corners: unite_layers(&mut self.corner_layers, &other.corner_layers, corners, &[]),
        };
        self.add_copies(other, &Elements::all(other), &pairs)
    }

    fn add_copies(&mut self, other: &Self, elements: &Elements, layers: &LayerPairs) -> CopiedElements {
        let mut vertices = IndexTable::new(other.vertex_capacity(), elements.vertices.len());
        let copied_vertices = elements.vertices.iter().map(|&vertex| {
            let new = self.copy_of_vertex(other, vertex, layers);
            vertices.insert(vertex.0, new.0);
            new
        });
        let copied_vertices = copied_vertices.collect();
        let mut edges = IndexTable::new(other.edge_capacity(), elements.edges.len());
        let copied_edges = elements.edges.iter().map(|&edge| {
            let new = self.copy_of_edge(other, edge, &vertices);
            edges.insert(edge.0, new.0);
            new
        });
        let copied_edges = copied_edges.collect();
        let mut outline = Vec::new();
        let copied_faces = elements.faces.iter().map(|&face| {
            outline.clear();
            outline.extend(other.face_corners(face).map(|corner| {
                let vertex = vertices.get(other.corner_vertex(corner).0);
                let edge = edges.get(other.corner_edge(corner).0);
                let (vertex, edge) = vertex.zip(edge).expect("faces have their parts along");
                (VertexId(vertex), EdgeId(edge))
            }));
            self.copy_of_face(other, face, &outline, layers)
        });
        let copied_faces = copied_faces.collect();
        CopiedElements { vertices: copied_vertices, edges: copied_edges, faces: copied_faces }
    }

    fn copy_of_vertex(&mut self, other: &Self, vertex: VertexId, layers: &LayerPairs) -> VertexId {
        let new = VertexId(self.new_vertex(other.position(vertex)));
        *self.first_positions.write(new.0) = other.first_position(vertex);
        self.vertices.write(new.0).flags = other.vertices[vertex.0].flags;
        copy_values(&mut self.vertex_layers, &other.vertex_layers, &layers.of_vertices, [vertex.0, new.0]);
        new
    }

    fn copy_of_edge(&mut self, other: &Self, edge: EdgeId, vertices: &IndexTable) -> EdgeId {
        let new_end = |end: VertexId| VertexId(vertices.get(end.0).expect("edges have their ends along"));
        let [a, b] = other.edge_vertices(edge).map(new_end);
        let new = self.fresh_edge(a, b);
        let record = self.edges.write(new.0);
        record.flags = other.edges[edge.0].flags;
        record.crease = other.edges[edge.0].crease;
        new
    }

    fn copy_of_face(
        &mut self,
        other: &Self,
        face: FaceId,
        outline: &[(VertexId, EdgeId)],
        layers: &LayerPairs,
    ) -> FaceId {
        let new = self.face_along(outline);
        let record = self.faces.write(new.0);
        record.material = other.faces[face.0].material;
        record.flags = other.faces[face.0].flags;
        let mut corner = CornerId(self.faces[new.0].corner);
        for from in other.face_corners(face) {
            let pair = [from.0, corner.0];
            copy_values(&mut self.corner_layers, &other.corner_layers, &layers.of_corners, pair);
            corner = self.next_corner(corner);
        }
        new
    }
}

/// For each layer of the receiving mesh, the corresponding one of the other mesh.
struct LayerPairs {
    of_vertices: Vec<Option<usize>>,
    of_corners: Vec<Option<usize>>,
}

fn copy_values(to: &mut [Layer], from: &[Layer], pairs: &[Option<usize>], [source, target]: [u32; 2]) {
    for (layer, pair) in to.iter_mut().zip(pairs) {
        match pair {
            Some(other) => layer.copy_from(&from[*other], source, target),
            None => layer.set_usual(target),
        }
    }
}

/// Adds the missing layers of another mesh, with this length. Returns which of the other's layers
/// corresponds to each own one. Of each vertex group of the other the numbers of both layers are given; both exist.
fn unite_layers(
    own: &mut Vec<Layer>,
    other: &[Layer],
    length: u32,
    groups: &[GroupLayers],
) -> Vec<Option<usize>> {
    let mut pairs: Vec<Option<usize>> = vec![None; own.len()];
    for (number, layer) in other.iter().enumerate() {
        let kind = match layer.kind {
            LayerKind::Group(theirs) => match groups.iter().find(|pair| pair.theirs == theirs) {
                Some(pair) => LayerKind::Group(pair.own),
                // Of a group that was removed.
                None => continue,
            },
            kind => kind,
        };
        // Sets of texture coordinates correspond by order.
        let same = |slot: &usize| own[*slot].kind == kind && pairs[*slot].is_none();
        if let Some(slot) = (0..own.len()).find(same) {
            pairs[slot] = Some(number);
            continue;
        }
        let mut added = layer.empty_like();
        for index in 0..length {
            added.push_default();
            added.set_usual(index);
        }
        own.push(added);
        pairs.push(Some(number));
    }
    pairs
}

impl Layer {
    /// Without elements.
    fn empty_like(&self) -> Self {
        let values = match &self.values {
            LayerValues::Vec2(_) => LayerValues::Vec2(Column::new(Vec::new())),
            LayerValues::Vec3(_) => LayerValues::Vec3(Column::new(Vec::new())),
            LayerValues::Vec4(_) => LayerValues::Vec4(Column::new(Vec::new())),
            LayerValues::Influences(_) => LayerValues::Influences(Column::new(Vec::new())),
            LayerValues::Pins(_) => LayerValues::Pins(Column::new(Vec::new())),
            LayerValues::Weights(_) => LayerValues::Weights(Column::new(Vec::new())),
        };
        Self { kind: self.kind, values }
    }

    /// Gives an element the value from another layer of the same kind.
    fn copy_from(&mut self, other: &Self, from: u32, to: u32) {
        match (&mut self.values, &other.values) {
            (LayerValues::Vec2(own), LayerValues::Vec2(other)) => *own.write(to) = other[from],
            (LayerValues::Vec3(own), LayerValues::Vec3(other)) => *own.write(to) = other[from],
            (LayerValues::Vec4(own), LayerValues::Vec4(other)) => *own.write(to) = other[from],
            (LayerValues::Influences(own), LayerValues::Influences(other)) => *own.write(to) = other[from],
            (LayerValues::Pins(own), LayerValues::Pins(other)) => *own.write(to) = other[from],
            (LayerValues::Weights(own), LayerValues::Weights(other)) => *own.write(to) = other[from],
            _ => unreachable!("layers of the same kind have values of the same type"),
        }
    }
}
