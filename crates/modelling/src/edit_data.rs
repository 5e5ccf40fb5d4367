//! The data of an editable mesh that a [`Mesh`] does not have, as [`EditData`]: original positions, marks of
//! edges, hidden elements, pins, vertex groups, modifiers. Together with the mesh of [`EditMesh::to_mesh`] they are complete, so a file that
//! holds both loses nothing.

use thiserror::Error;
use trigon_math::Vec3;
use trigon_mesh::{EdgeMark, EditData, Mesh, VertexGroupData};

use super::column::Column;
use super::edit_mesh::EditMesh;
use super::from_mesh::LeftOut;
use super::group_weight::GroupWeight;
use super::ids::{CornerId, FaceId, VertexId};
use super::layers::LayerKind;
use super::modifier::StackedModifier;
use super::records::{HIDDEN, SEAM, SHARP};
use super::to_mesh::ElementMap;

/// Why edit data does not belong to a mesh.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum EditDataError {
    /// There is not one first position for each vertex.
    #[error("there are {found} original positions for {expected} vertices")]
    FirstPositions {
        /// How many vertices the mesh has.
        expected: usize,
        /// How many were given.
        found: usize,
    },
    /// Two vertices that are marked as an edge are not joined.
    #[error("vertices {} and {} are marked as an edge and are not joined by one", .0[0], .0[1])]
    NoSuchEdge([u32; 2]),
    /// There is no such vertex.
    #[error("vertex {0} is hidden and does not exist")]
    NoSuchVertex(u32),
    /// There is no such face.
    #[error("face {0} is hidden and does not exist")]
    NoSuchFace(u32),
    /// There is no such corner.
    #[error("corner {0} has a normal made by sharp edges and does not exist")]
    NoSuchCorner(u32),
    /// There is no such corner.
    #[error("the texture coordinates of corner {0} are pinned and it does not exist")]
    NoSuchPinnedCorner(u32),
    /// A vertex group is not as they are written; its name and the reason.
    #[error("the vertex group {name:?} cannot be read: {reason}")]
    VertexGroup {
        /// The name.
        name: String,
        /// What is wrong.
        reason: String,
    },
    /// The modifiers are not as they are written, or out of their ranges; the reason.
    #[error("the modifiers cannot be read: {0}")]
    Modifiers(String),
}

impl EditMesh {
    /// The edit data, by the indices of the mesh of [`EditMesh::to_mesh`], which gave `map`.
    #[must_use]
    pub fn edit_data(&self, map: &ElementMap) -> EditData {
        let position = |&vertex: &VertexId| self.first_position(vertex);
        let is_moved = |vertex: &VertexId| position(vertex) != self.position(*vertex);
        let first_positions = match map.vertices.iter().any(is_moved) {
            true => map.vertices.iter().map(position).collect(),
            false => Vec::new(),
        };
        let hidden_vertices =
            (0u32..).zip(&map.vertices).filter(|(_, vertex)| self.is_vertex_hidden(**vertex));
        let hidden_faces = (0u32..).zip(&map.faces).filter(|(_, face)| self.is_face_hidden(**face));
        EditData {
            first_positions,
            edges: self.edge_marks(map),
            hidden_vertices: hidden_vertices.map(|(index, _)| index).collect(),
            hidden_faces: hidden_faces.map(|(index, _)| index).collect(),
            sharp_corners: self.sharp_corners(map),
            pinned_corners: self.pinned_corners(map),
            vertex_groups: self.vertex_group_data(map),
            modifiers: self.modifiers_as_text(),
        }
    }

    /// The corners of the mesh of [`EditMesh::to_mesh`] whose normals sharp edges make.
    fn sharp_corners(&self, map: &ElementMap) -> Vec<u32> {
        let Some(of_fans) = self.sharp_normals() else { return Vec::new() };
        let is_made = |corner: CornerId| {
            of_fans[corner.0 as usize] != Vec3::ZERO && self.custom_normal(corner).is_none()
        };
        (0u32..).zip(&map.corners).filter(|(_, corner)| is_made(**corner)).map(|(index, _)| index).collect()
    }

    /// The corners of the mesh of [`EditMesh::to_mesh`] with pins, and the sets.
    fn pinned_corners(&self, map: &ElementMap) -> Vec<[u32; 2]> {
        let Some(pins) = self.pins() else { return Vec::new() };
        let numbered = (0u32..).zip(map.corners.iter().map(|corner| pins[corner.0].0));
        numbered.filter(|(_, sets)| *sets != 0).map(|(corner, sets)| [corner, sets]).collect()
    }

    fn set_pinned_corners(&mut self, pinned: &[[u32; 2]]) -> Result<(), EditDataError> {
        for &[index, sets] in pinned {
            if !self.has_corner(CornerId(index)) {
                return Err(EditDataError::NoSuchPinnedCorner(index));
            }
            self.pins_mut().write(index).0 = sets;
        }
        Ok(())
    }

    /// Takes away normals that were not given, and all of them if none was.
    fn clear_sharp_corners(&mut self, corners: &[u32]) -> Result<(), EditDataError> {
        for &index in corners {
            let corner = CornerId(index);
            if !self.has_corner(corner) {
                return Err(EditDataError::NoSuchCorner(index));
            }
            self.set_custom_normal(corner, Vec3::ZERO);
        }
        if !corners.is_empty() && self.corners().all(|corner| self.custom_normal(corner).is_none()) {
            self.corner_layers.retain(|layer| layer.kind != LayerKind::Normal);
        }
        Ok(())
    }

    fn vertex_group_data(&self, map: &ElementMap) -> Vec<VertexGroupData> {
        let of_group = |name: &str| {
            let group = self.vertex_group(name).expect("it is the name of one");
            let numbered = (0u32..).zip(&map.vertices);
            let (vertices, weights) =
                numbered.filter_map(|(number, &vertex)| Some((number, group.weight(vertex)?))).unzip();
            VertexGroupData { name: name.to_owned(), vertices, weights }
        };
        self.vertex_group_names().map(of_group).collect()
    }

    fn set_vertex_group(&mut self, group: &VertexGroupData) -> Result<(), EditDataError> {
        let VertexGroupData { name, vertices, weights } = group;
        let refused = |reason: String| EditDataError::VertexGroup { name: name.clone(), reason };
        if vertices.len() != weights.len() {
            return Err(refused(format!("it has {} weights for {} vertices", weights.len(), vertices.len())));
        }
        self.add_vertex_group(name).map_err(|refusal| refused(refusal.to_string()))?;
        for (&vertex, &weight) in vertices.iter().zip(weights) {
            self.check_vertex(VertexId(vertex)).map_err(|refusal| refused(refusal.to_string()))?;
            if !(0.0..=1.0).contains(&weight) {
                return Err(refused(format!("a weight is {weight}, but must be 0 to 1")));
            }
        }
        let column = self.group_weights_mut(name).expect("it was added");
        for (&vertex, &weight) in vertices.iter().zip(weights) {
            *column.write(vertex) = GroupWeight::new(Some(weight));
        }
        Ok(())
    }

    fn edge_marks(&self, map: &ElementMap) -> Vec<EdgeMark> {
        let is_marked = |edge: &super::ids::EdgeId| {
            let record = &self.edges[edge.0];
            record.flags & (SHARP | SEAM | HIDDEN) != 0 || record.crease != 0.0
        };
        if !self.edges().any(|edge| is_marked(&edge)) {
            return Vec::new();
        }
        let mut numbers = vec![0; self.vertex_capacity()];
        for (number, vertex) in (0u32..).zip(&map.vertices) {
            numbers[vertex.0 as usize] = number;
        }
        let ends = |edge| {
            let mut ends = self.edge_vertices(edge).map(|vertex| numbers[vertex.0 as usize]);
            ends.sort_unstable();
            ends
        };
        let mark = |edge| EdgeMark {
            vertices: ends(edge),
            is_sharp: self.is_sharp(edge),
            is_seam: self.is_seam(edge),
            is_hidden: self.is_edge_hidden(edge),
            crease: self.crease(edge),
        };
        let mut marks: Vec<EdgeMark> = self.edges().filter(is_marked).map(mark).collect();
        // Edges are numbered anew when a mesh is made editable.
        marks.sort_unstable_by_key(|mark| mark.vertices);
        marks
    }

    /// Makes a mesh editable, with its edit data: what [`EditMesh::from_mesh`] makes of it, and
    /// then each mark set.
    ///
    /// ```
    /// use trigon_mesh::primitives;
    /// use trigon_modelling::{EdgeId, EditMesh};
    ///
    /// let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    /// cube.set_crease(EdgeId::new(3), 0.5);
    /// let (mesh, map) = cube.to_mesh();
    /// let (again, _) = EditMesh::from_mesh_and_data(&mesh, &cube.edit_data(&map))?;
    /// assert!(again == cube);
    /// # Ok::<(), trigon_modelling::EditDataError>(())
    /// ```
    ///
    /// # Errors
    /// The data name what the mesh has not, or modifiers that cannot be in a stack.
    pub fn from_mesh_and_data(mesh: &Mesh, data: &EditData) -> Result<(Self, LeftOut), EditDataError> {
        let (mut editable, mut left_out) = Self::from_mesh_uncut(mesh);
        let (expected, found) = (editable.vertex_count(), data.first_positions.len());
        if found != 0 && found != expected {
            return Err(EditDataError::FirstPositions { expected, found });
        }
        if found != 0 {
            editable.first_positions = Column::new(data.first_positions.clone());
        }
        for mark in &data.edges {
            editable.set_edge_mark(mark)?;
        }
        for &index in &data.hidden_vertices {
            let vertex = VertexId(index);
            editable.check_vertex(vertex).map_err(|_| EditDataError::NoSuchVertex(index))?;
            editable.set_vertex_hidden(vertex, true);
        }
        for &index in &data.hidden_faces {
            let face = FaceId(index);
            editable.check_face(face).map_err(|_| EditDataError::NoSuchFace(index))?;
            editable.set_face_hidden(face, true);
        }
        editable.clear_sharp_corners(&data.sharp_corners)?;
        editable.set_pinned_corners(&data.pinned_corners)?;
        data.vertex_groups.iter().try_for_each(|group| editable.set_vertex_group(group))?;
        editable.modifiers = modifiers_of_text(&data.modifiers)?;
        // Faces and corners were named by their numbers until here.
        left_out.cut_faces = editable.make_all_simple();
        Ok((editable, left_out))
    }

    /// The stack of modifiers as JSON; empty without any.
    fn modifiers_as_text(&self) -> String {
        if self.modifiers.is_empty() {
            return String::new();
        }
        serde_json::to_string(&self.modifiers).expect("names and finite numbers can be written")
    }

    fn set_edge_mark(&mut self, mark: &EdgeMark) -> Result<(), EditDataError> {
        let [a, b] = mark.vertices.map(VertexId);
        let exist = self.has_vertex(a) && self.has_vertex(b);
        let edge = exist.then(|| self.find_edge(a, b)).flatten();
        let edge = edge.ok_or(EditDataError::NoSuchEdge(mark.vertices))?;
        self.set_sharp(edge, mark.is_sharp);
        self.set_seam(edge, mark.is_seam);
        self.set_edge_hidden(edge, mark.is_hidden);
        self.set_crease(edge, mark.crease);
        Ok(())
    }
}

/// The stack of modifiers that a text describes. It is not refused for the memory of what the modifiers make: opening a file
/// does not make that.
fn modifiers_of_text(text: &str) -> Result<Vec<StackedModifier>, EditDataError> {
    if text.is_empty() {
        return Ok(Vec::new());
    }
    let stack: Vec<StackedModifier> =
        serde_json::from_str(text).map_err(|error| EditDataError::Modifiers(error.to_string()))?;
    let most = EditMesh::MOST_MODIFIERS;
    if stack.len() > most {
        return Err(EditDataError::Modifiers(format!("there are {}, and {most} are the most", stack.len())));
    }
    for stacked in &stack {
        stacked.modifier.check().map_err(|refusal| EditDataError::Modifiers(refusal.to_string()))?;
    }
    Ok(stack)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_mesh::primitives;

    use super::*;
    use crate::GroupAssignment;
    use crate::ids::EdgeId;
    use crate::tests::meshes;

    #[test]
    fn normals_that_sharp_edges_make_are_not_frozen() {
        let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        let faces: Vec<FaceId> = cube.faces().collect();
        let edges: Vec<EdgeId> = cube.edges().collect();
        cube.shade_smooth(&faces).expect("a cube has faces");
        cube.mark_sharp(&edges[..5]).expect("a cube has edges");
        let (mesh, map) = cube.to_mesh();
        assert!(mesh.attributes().corner_normals.is_some(), "they are shown");
        let (again, _) = EditMesh::from_mesh_and_data(&mesh, &cube.edit_data(&map)).expect("its own");
        assert!(again == cube, "and not given");
    }

    /// Marks elements by their indices and a number.
    fn marked(mesh: &Mesh, seed: u32) -> EditMesh {
        let (mut mesh, _) = EditMesh::from_mesh(mesh);
        mesh.add_vertex_group("empty").expect("room");
        mesh.add_vertex_group("one").expect("room");
        let is_chosen = |index: u32, kind: u32| (index ^ seed).wrapping_mul(2_654_435_769) >> 28 == kind;
        for edge in mesh.edges().collect::<Vec<_>>() {
            mesh.set_sharp(edge, is_chosen(edge.0, 0));
            mesh.set_seam(edge, is_chosen(edge.0, 1));
            mesh.set_edge_hidden(edge, is_chosen(edge.0, 2));
            mesh.set_crease(edge, if is_chosen(edge.0, 3) { 0.375 } else { 0.0 });
        }
        for vertex in mesh.vertices().collect::<Vec<_>>() {
            mesh.set_vertex_hidden(vertex, is_chosen(vertex.0, 4));
            if is_chosen(vertex.0, 8) {
                let weight =
                    GroupAssignment { weight: f64::from(seed) / f64::from(u32::MAX), ..Default::default() };
                mesh.assign_to_vertex_group("one", &[vertex], &weight).expect("there is one");
            }
            if is_chosen(vertex.0, 5) {
                mesh.set_position(vertex, Vec3::splat(seed as f32));
            }
        }
        for face in mesh.faces().collect::<Vec<_>>() {
            mesh.set_face_hidden(face, is_chosen(face.0, 6));
        }
        for corner in mesh.corners().collect::<Vec<_>>() {
            mesh.set_uv_pinned((corner.0 % 32) as usize, corner, is_chosen(corner.0, 7));
        }
        mesh
    }

    proptest! {
        /// Also with holes in the numbering, which the first step closes.
        #[test]
        fn mesh_and_edit_data_are_all_there_is(start in meshes(), seed in any::<u32>(), removed in any::<u32>()) {
            let mut first = marked(&start, seed);
            let face = FaceId(removed % first.face_capacity().max(1) as u32);
            drop(first.remove_face(face));
            let (mesh, map) = first.to_mesh();
            let data = first.edit_data(&map);
            let (second, _) = EditMesh::from_mesh_and_data(&mesh, &data).expect("they belong together");
            prop_assert_eq!(second.check_structure(), Ok(()));
            let (again, map) = second.to_mesh();
            prop_assert_eq!(&again, &mesh);
            prop_assert_eq!(second.edit_data(&map), data);
        }
    }

    #[test]
    fn edit_data_of_another_mesh_are_refused() {
        let cube = primitives::cube(2.0);
        let refused =
            |data: EditData| EditMesh::from_mesh_and_data(&cube, &data).expect_err("not of this mesh");
        let edge = |vertices| EditData {
            edges: vec![EdgeMark { vertices, ..EdgeMark::default() }],
            ..EditData::default()
        };
        let (mesh, _) = EditMesh::from_mesh(&cube);
        let [a, _] = mesh.edge_vertices(EdgeId(0)).map(VertexId::index);
        assert_eq!(
            refused(edge([a, a])),
            EditDataError::NoSuchEdge([a, a]),
            "no edge from a vertex to itself"
        );
        assert_eq!(refused(edge([0, u32::MAX])), EditDataError::NoSuchEdge([0, u32::MAX]), "no such vertex");
        refused(EditData { hidden_vertices: vec![8], ..EditData::default() });
        refused(EditData { hidden_faces: vec![6], ..EditData::default() });
        refused(EditData { pinned_corners: vec![[24, 1]], ..EditData::default() });
        let surface = |levels: u32| {
            format!(r#"[{{"modifier":{{"kind":"subdivision","levels":{levels}}},"is_on":true}}]"#)
        };
        let group = |name: &str, vertices: Vec<u32>, weights: Vec<f32>| EditData {
            vertex_groups: vec![VertexGroupData { name: name.to_owned(), vertices, weights }],
            ..EditData::default()
        };
        refused(group("one", vec![8], vec![1.0]));
        refused(group("one", vec![0, 1], vec![1.0]));
        refused(group("one", vec![0], vec![1.5]));
        refused(group("one", vec![0], vec![f32::NAN]));
        refused(group("", vec![0], vec![1.0]));
        let twice = [group("one", vec![0], vec![1.0]), group("one", vec![1], vec![1.0])];
        let twice = twice.into_iter().flat_map(|data| data.vertex_groups).collect();
        refused(EditData { vertex_groups: twice, ..EditData::default() });
        refused(EditData { modifiers: surface(6), ..EditData::default() });
        refused(EditData { modifiers: "[{}]".to_owned(), ..EditData::default() });
        refused(EditData { first_positions: vec![Vec3::ZERO; 7], ..EditData::default() });
    }
}
