//! Follows changes of an editable mesh in the mesh that is displayed.
//!
//! A displayed mesh of a million faces takes longer to build than to draw. Most edits move vertices
//! or change corner values, which the displayed mesh can follow with a [`MeshChange`], in time
//! proportional to the change and its neighbourhood. All others need [`EditMesh::to_mesh`].

use trigon_math::{Vec2, Vec3, Vec4};
use trigon_mesh::{Mesh, MeshChange};

use super::column::{Column, ColumnDifference};
use super::edit_mesh::EditMesh;
use super::ids::{CornerId, EdgeId, FaceId, NONE, VertexId};
use super::layers::{Layer, LayerDifference, LayerKind, LayerValues};
use super::records::{EdgeRecord, FaceRecord, HIDDEN, SEAM, VertexRecord};
use super::to_mesh::ElementMap;
use super::transaction::{Difference, LayersDifference};

/// For each edited element its number in the displayed mesh: the inverse of an [`ElementMap`].
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ElementNumbers {
    vertices: Vec<u32>,
    faces: Vec<u32>,
    corners: Vec<u32>,
    edges: Vec<u32>,
    /// By the edges of the displayed mesh.
    edges_of_mesh: Vec<EdgeId>,
    /// Whether the displayed mesh has corner normals.
    has_normals: bool,
}

impl ElementNumbers {
    /// From the result of [`EditMesh::to_mesh`]. Takes time proportional to the whole mesh.
    pub fn new(edited: &EditMesh, mesh: &Mesh, map: &ElementMap) -> Self {
        let edges_of_mesh = map.edges(mesh, edited);
        Self {
            vertices: inverse(edited.vertex_capacity(), map.vertices.iter().map(|id| id.0)),
            faces: inverse(edited.face_capacity(), map.faces.iter().map(|id| id.0)),
            corners: inverse(edited.corner_capacity(), map.corners.iter().map(|id| id.0)),
            edges: inverse(edited.edge_capacity(), edges_of_mesh.iter().map(|id| id.0)),
            edges_of_mesh,
            has_normals: mesh.attributes().corner_normals.is_some(),
        }
    }

    /// The number of a vertex in the displayed mesh; `None` if it is not displayed.
    #[must_use]
    pub fn vertex(&self, vertex: VertexId) -> Option<u32> {
        number(&self.vertices, vertex.0)
    }

    /// The number of a face in the displayed mesh; `None` if it is not displayed.
    #[must_use]
    pub fn face(&self, face: FaceId) -> Option<u32> {
        number(&self.faces, face.0)
    }

    /// The number of an edge in [`Mesh::edges`]; `None` if it is not displayed.
    #[must_use]
    pub fn edge(&self, edge: EdgeId) -> Option<u32> {
        number(&self.edges, edge.0)
    }

    /// How many edges the displayed mesh has.
    #[must_use]
    pub fn edge_count(&self) -> usize {
        self.edges_of_mesh.len()
    }

    /// The edge with a number in [`Mesh::edges`].
    #[must_use]
    pub fn edge_of_mesh(&self, number: u32) -> Option<EdgeId> {
        self.edges_of_mesh.get(number as usize).copied()
    }

    fn corner(&self, corner: CornerId) -> Option<u32> {
        number(&self.corners, corner.0)
    }
}

fn inverse(capacity: usize, ids: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut numbers = vec![NONE; capacity];
    for (number, id) in (0u32..).zip(ids) {
        // Of several parts of a face the first counts.
        if let Some(entry) = numbers.get_mut(id as usize).filter(|entry| **entry == NONE) {
            *entry = number;
        }
    }
    numbers
}

fn number(numbers: &[u32], id: u32) -> Option<u32> {
    numbers.get(id as usize).copied().filter(|&number| number != NONE)
}

/// Vertices and corners with other values than before.
#[derive(Debug, Clone, Default)]
pub struct ChangedValues {
    vertices: Vec<VertexId>,
    corners: Vec<CornerId>,
}

impl ChangedValues {
    /// Whether it is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.vertices.is_empty() && self.corners.is_empty()
    }

    /// Merges another change.
    pub fn append(&mut self, mut other: Self) {
        self.vertices.append(&mut other.vertices);
        self.corners.append(&mut other.corners);
        // Undo and redo report the same elements again and again.
        sort(&mut self.vertices);
        sort(&mut self.corners);
    }
}

fn sort<T: Ord>(ids: &mut Vec<T>) {
    if !ids.is_sorted() {
        ids.sort_unstable();
    }
    ids.dedup();
}

impl Difference {
    /// Whether elements, or any of their marks (sharp, seam, crease, hidden, …) may differ between
    /// the two states.
    #[must_use]
    pub fn changes_marks(&self) -> bool {
        self.vertices.is_some() || self.edges.is_some() || self.corners.is_some() || self.faces.is_some()
    }
}

impl EditMesh {
    /// What a difference changed in the displayed mesh; `None` if that must be rebuilt. The mesh is
    /// in one of the difference's two states. Takes time proportional to the difference.
    pub fn changed_values(&self, difference: &Difference) -> Option<ChangedValues> {
        if difference.slots != self.slots || !self.shows_the_same(difference) {
            return None;
        }
        let mut changed = ChangedValues::default();
        if let Some(positions) = &difference.positions {
            let moved = self.positions.differing(positions, |a, b| bits(a) != bits(b))?;
            changed.vertices.extend(moved.into_iter().map(VertexId));
        }
        let [of_vertices, of_corners] = [&difference.vertex_layers, &difference.corner_layers];
        if !self.only_weights_differ(of_vertices)
            || !of_corners.added.is_empty()
            || of_corners.common.len() != self.corner_layers.len()
        {
            return None;
        }
        for (layer, difference) in self.corner_layers.iter().zip(&of_corners.common) {
            changed.corners.extend(changed_corners(layer, difference)?);
        }
        sort(&mut changed.vertices);
        sort(&mut changed.corners);
        Some(changed)
    }

    /// Whether two states differ in no layer of vertices but those of vertex groups, which a displayed mesh has not.
    fn only_weights_differ(&self, difference: &LayersDifference) -> bool {
        let is_group = |layer: &Layer| matches!(layer.kind, LayerKind::Group(_));
        let common = self.vertex_layers.iter().zip(&difference.common);
        let mut others = common.filter(|(layer, _)| !is_group(layer));
        let is_same = others.all(|(_, difference)| matches!(difference, LayerDifference::Unchanged));
        let mut added = self.vertex_layers.iter().skip(difference.common.len()).chain(&difference.added);
        is_same && added.all(is_group)
    }

    /// Whether both states have the same elements with the same adjacency, and the same of those
    /// marks that a displayed mesh has.
    fn shows_the_same(&self, difference: &Difference) -> bool {
        let vertex = |record: &VertexRecord| VertexRecord { flags: record.flags & !HIDDEN, ..*record };
        let edge = |record: &EdgeRecord| EdgeRecord {
            flags: record.flags & !(HIDDEN | SEAM),
            crease: 0.0,
            ..*record
        };
        let face = |record: &FaceRecord| FaceRecord { flags: record.flags & !HIDDEN, ..*record };
        is_same(&self.vertices, &difference.vertices, vertex)
            && is_same(&self.edges, &difference.edges, edge)
            && is_same(&self.corners, &difference.corners, |record| *record)
            && is_same(&self.faces, &difference.faces, face)
    }

    /// The change that gives a displayed mesh, whose numbers are given, the changed values. Takes
    /// time proportional to these and their neighbours.
    #[must_use]
    pub fn mesh_change(&self, changed: &ChangedValues, numbers: &ElementNumbers) -> MeshChange {
        let vertices = changed.vertices.iter();
        let position = |&vertex: &VertexId| Some((numbers.vertex(vertex)?, self.position(vertex)));
        let mut change =
            MeshChange { positions: vertices.filter_map(position).collect(), ..MeshChange::default() };
        if numbers.has_normals {
            let normals = self.shown_normals(changed).into_iter();
            let numbered = normals.filter_map(|(corner, normal)| Some((numbers.corner(corner)?, normal)));
            change.corner_normals = numbered.collect();
        }
        for layer in &self.corner_layers {
            match (&layer.values, layer.kind) {
                (LayerValues::Vec2(column), _) => {
                    change.uv_sets.push(values(&changed.corners, column, numbers));
                }
                (LayerValues::Vec4(column), LayerKind::Color) => {
                    change.corner_colors = values(&changed.corners, column, numbers);
                }
                _ => {}
            }
        }
        change
    }

    /// The normals that the shown mesh has at changed corners, and at all corners whose
    /// normals follow from vertices that were moved.
    fn shown_normals(&self, changed: &ChangedValues) -> Vec<(CornerId, Vec3)> {
        let moved = changed.vertices.iter().filter(|&&vertex| self.has_vertex(vertex));
        let mut faces: Vec<FaceId> = moved.flat_map(|&vertex| self.vertex_faces(vertex)).collect();
        sort(&mut faces);
        let mut around: Vec<VertexId> = faces.iter().flat_map(|&face| self.face_vertices(face)).collect();
        around
            .extend(changed.corners.iter().filter(|&&c| self.has_corner(c)).map(|&c| self.corner_vertex(c)));
        sort(&mut around);
        self.normals_at(&around)
    }
}

/// The corners with other values; `None` where the shown mesh cannot be given them.
fn changed_corners(layer: &Layer, difference: &LayerDifference) -> Option<Vec<CornerId>> {
    let found = match (&layer.values, difference, layer.kind) {
        // Pins are not in the shown mesh.
        (_, LayerDifference::Unchanged, _) | (LayerValues::Pins(_), ..) => Vec::new(),
        (LayerValues::Vec2(column), LayerDifference::Vec2(difference), _) => column
            .differing(difference, |a: &Vec2, b| {
                a.to_array().map(f32::to_bits) != b.to_array().map(f32::to_bits)
            })?,
        (LayerValues::Vec3(column), LayerDifference::Vec3(difference), LayerKind::Normal) => {
            column.differing(difference, |a, b| bits(a) != bits(b))?
        }
        (LayerValues::Vec4(column), LayerDifference::Vec4(difference), LayerKind::Color) => column
            .differing(difference, |a: &Vec4, b| {
                a.to_array().map(f32::to_bits) != b.to_array().map(f32::to_bits)
            })?,
        _ => return None,
    };
    Some(found.into_iter().map(CornerId).collect())
}

fn bits(value: &Vec3) -> [u32; 3] {
    value.to_array().map(f32::to_bits)
}

fn is_same<T: Copy + PartialEq>(
    column: &Column<T>,
    difference: &Option<ColumnDifference<T>>,
    shown: impl Fn(&T) -> T,
) -> bool {
    let Some(difference) = difference else { return true };
    column.differing(difference, |a, b| shown(a) != shown(b)).is_some_and(|found| found.is_empty())
}

fn values<T: Copy>(corners: &[CornerId], column: &Column<T>, numbers: &ElementNumbers) -> Vec<(u32, T)> {
    let value = |&corner: &CornerId| Some((numbers.corner(corner)?, column[corner.0]));
    corners.iter().filter_map(value).collect()
}
