//! Converts an editable mesh to one that is shown and saved: without free slots, in the order of indices.

use trigon_math::{Vec3, or_if_zero};
use trigon_mesh::{Attributes, Deltas, Mesh, MeshColumns, MorphTarget, SkinWeights};

use super::column::Column;
use super::edit_mesh::EditMesh;
use super::ids::{CornerId, EdgeId, FaceId, VertexId};
use super::layers::{LayerKind, LayerValues};
use super::records::{POINT, SMOOTH};
use super::skin::{Influences, MOST};

/// For each element of a [`Mesh`] which one it was while it was edited.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ElementMap {
    /// By the mesh's vertices.
    pub vertices: Vec<VertexId>,
    /// By the mesh's faces.
    pub faces: Vec<FaceId>,
    /// By the mesh's corners.
    pub corners: Vec<CornerId>,
    /// By [`Mesh::loose_edges`].
    pub loose_edges: Vec<EdgeId>,
}

impl ElementMap {
    /// By the mesh's edges, those of faces first.
    pub fn edges(&self, mesh: &Mesh, edited: &EditMesh) -> Vec<EdgeId> {
        let mut edges = vec![EdgeId(super::ids::NONE); mesh.face_edge_count()];
        for (index, &corner) in self.corners.iter().enumerate() {
            if let Some(edge) = mesh.corner_edge(index) {
                edges[edge as usize] = edited.corner_edge(corner);
            }
        }
        edges.extend(&self.loose_edges);
        edges
    }
}

impl EditMesh {
    /// The mesh without free slots, elements in the order of their indices, and which
    /// element each was. First positions, creases, seams, vertex groups and what is hidden have no place in it;
    /// sharp edges between smooth faces show in the normals of the corners there.
    #[must_use]
    pub fn to_mesh(&self) -> (Mesh, ElementMap) {
        self.mesh_of(ElementMap {
            vertices: self.vertices().collect(),
            faces: self.faces().collect(),
            corners: Vec::with_capacity(self.corner_count()),
            loose_edges: self.edges().filter(|&edge| self.edge_corners(edge).next().is_none()).collect(),
        })
    }

    /// The same without what is hidden from the user. An edge all of whose faces are hidden
    /// is a loose one.
    #[must_use]
    pub fn to_visible_mesh(&self) -> (Mesh, ElementMap) {
        let is_vertex_shown = |vertex: VertexId| !self.is_vertex_hidden(vertex);
        let is_face_shown =
            |face: FaceId| !self.is_face_hidden(face) && self.face_vertices(face).all(is_vertex_shown);
        let is_edge_loose = |&edge: &EdgeId| {
            !self.is_edge_hidden(edge)
                && self.edge_vertices(edge).into_iter().all(is_vertex_shown)
                && !self.edge_faces(edge).any(is_face_shown)
        };
        self.mesh_of(ElementMap {
            vertices: self.vertices().filter(|&vertex| is_vertex_shown(vertex)).collect(),
            faces: self.faces().filter(|&face| is_face_shown(face)).collect(),
            corners: Vec::new(),
            loose_edges: self.edges().filter(is_edge_loose).collect(),
        })
    }

    /// The mesh of some elements; their corners are added to the map.
    fn mesh_of(&self, mut map: ElementMap) -> (Mesh, ElementMap) {
        let mut mesh = Mesh::from_valid_columns(self.columns_of(&mut map));
        mesh.set_attributes(self.attributes(&map)).expect("one value for each element");
        (mesh, map)
    }

    /// The columns of some elements; their corners are added to the map.
    pub(super) fn columns_of(&self, map: &mut ElementMap) -> MeshColumns {
        let mut numbers = vec![0u32; self.vertex_capacity()];
        for (number, vertex) in (0u32..).zip(&map.vertices) {
            numbers[vertex.0 as usize] = number;
        }
        let number = |vertex: VertexId| numbers[vertex.0 as usize];
        let mut face_sizes = Vec::with_capacity(map.faces.len());
        let mut corner_vertices = Vec::with_capacity(self.corner_count());
        for &face in &map.faces {
            let first = corner_vertices.len();
            for corner in self.face_corners(face) {
                map.corners.push(corner);
                corner_vertices.push(number(self.corner_vertex(corner)));
            }
            face_sizes.push((corner_vertices.len() - first) as u32);
        }
        let is_point = |&&vertex: &&VertexId| self.vertices[vertex.0].flags & POINT != 0;
        MeshColumns {
            positions: map.vertices.iter().map(|&vertex| self.position(vertex)).collect(),
            face_sizes,
            corner_vertices,
            loose_edges: map.loose_edges.iter().map(|&edge| self.edge_vertices(edge).map(number)).collect(),
            loose_points: map.vertices.iter().filter(is_point).map(|&vertex| number(vertex)).collect(),
        }
    }

    /// The attributes of elements that the map names, with the normals that sharp edges make.
    pub(super) fn attributes(&self, map: &ElementMap) -> Attributes {
        let mut attributes = self.stored_attributes(map);
        self.show_sharp_edges(map, &mut attributes);
        attributes
    }

    /// Gives normals to corners at sharp edges that have none of their own.
    fn show_sharp_edges(&self, map: &ElementMap, attributes: &mut Attributes) {
        let Some(of_fans) = self.sharp_normals() else { return };
        let normals = attributes.corner_normals.get_or_insert_with(|| vec![Vec3::ZERO; map.corners.len()]);
        for (normal, corner) in normals.iter_mut().zip(&map.corners) {
            *normal = or_if_zero(*normal, of_fans[corner.0 as usize]);
        }
    }

    fn stored_attributes(&self, map: &ElementMap) -> Attributes {
        let faces = || map.faces.iter().map(|face| &self.faces[face.0]);
        let mut attributes = Attributes::default();
        if faces().any(|face| face.material != 0) {
            attributes.face_materials = Some(faces().map(|face| face.material).collect());
        }
        if faces().any(|face| face.flags & SMOOTH != 0) {
            attributes.face_smooth = Some(faces().map(|face| face.flags & SMOOTH != 0).collect());
        }
        for layer in &self.vertex_layers {
            match (&layer.values, layer.kind) {
                (LayerValues::Vec3(column), LayerKind::MorphPosition(number)) => {
                    let values = map.vertices.iter().map(|vertex| column[vertex.0]);
                    morph_target(&mut attributes, number).positions = Deltas::from_dense(values);
                }
                (LayerValues::Influences(column), _) => attributes.skin = skin(map, column),
                (LayerValues::Vec4(column), _) => {
                    attributes.vertex_colors = Some(map.vertices.iter().map(|at| column[at.0]).collect());
                }
                _ => {}
            }
        }
        for layer in &self.corner_layers {
            match (&layer.values, layer.kind) {
                (LayerValues::Vec2(column), _) => attributes.uv_sets.push(of_corners(map, column)),
                (LayerValues::Vec4(column), LayerKind::Tangent) => {
                    attributes.corner_tangents = Some(of_corners(map, column));
                }
                (LayerValues::Vec4(column), _) => attributes.corner_colors = Some(of_corners(map, column)),
                (LayerValues::Vec3(column), LayerKind::MorphNormal(number)) => {
                    let values = Deltas::from_dense(of_corners(map, column));
                    morph_target(&mut attributes, number).normals = values;
                }
                (LayerValues::Vec3(column), LayerKind::MorphTangent(number)) => {
                    let values = Deltas::from_dense(of_corners(map, column));
                    morph_target(&mut attributes, number).tangents = values;
                }
                (LayerValues::Vec3(column), _) => attributes.corner_normals = Some(of_corners(map, column)),
                (LayerValues::Influences(_) | LayerValues::Pins(_) | LayerValues::Weights(_), _) => {}
            }
        }
        attributes
    }
}

fn of_corners<T: Copy>(map: &ElementMap, column: &Column<T>) -> Vec<T> {
    map.corners.iter().map(|corner| column[corner.0]).collect()
}

fn morph_target(attributes: &mut Attributes, number: u16) -> &mut MorphTarget {
    let targets = &mut attributes.morph_targets;
    if targets.len() <= number as usize {
        targets.resize_with(number as usize + 1, MorphTarget::default);
    }
    &mut targets[number as usize]
}

/// As many joints for each vertex as the busiest has; a vertex without any follows the first.
/// All others keep the bits of their weights.
fn skin(map: &ElementMap, column: &Column<Influences>) -> Option<SkinWeights> {
    let lone = |mut influences: Influences| {
        if influences.weights[0] == 0.0 {
            influences.weights[0] = 1.0;
        }
        influences
    };
    let of_vertices = || map.vertices.iter().map(|vertex| lone(column[vertex.0]));
    let used = |influences: Influences| influences.weights.iter().take_while(|&&weight| weight > 0.0).count();
    let per_vertex = of_vertices().map(used).max().unwrap_or(0).clamp(1, MOST);
    let joints = of_vertices().flat_map(|influences| influences.joints.into_iter().take(per_vertex));
    let weights = of_vertices().flat_map(|influences| influences.weights.into_iter().take(per_vertex));
    SkinWeights::from_normalized(per_vertex, joints.collect(), weights.collect())
}
