//! A mesh as plain lists, as in files, and what an editor knows of a mesh besides. Columns are checked as a
//! whole, so that millions of faces do not need one call each.

use trigon_math::Vec3;

use super::builder::{check_capacity, check_face, check_triangles, check_vertices};
use super::mesh::{FaceStarts, Parts};
use super::{Mesh, MeshError};

/// The elements of a mesh as lists. [`Mesh::from_columns`] checks them; attributes are set
/// afterwards with [`Mesh::set_attributes`].
///
/// ```
/// use trigon_mesh::math::Vec3;
/// use trigon_mesh::{Mesh, MeshColumns};
///
/// let columns = MeshColumns {
///     positions: vec![Vec3::ZERO, Vec3::X, Vec3::ONE, Vec3::Y],
///     face_sizes: vec![4],
///     corner_vertices: vec![0, 1, 2, 3],
///     ..MeshColumns::default()
/// };
/// assert_eq!(Mesh::from_columns(columns)?.edge_count(), 4);
/// # Ok::<(), trigon_mesh::MeshError>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MeshColumns {
    /// Metres; any value is kept, even if it is not finite.
    pub positions: Vec<Vec3>,
    /// The number of corners of each face.
    pub face_sizes: Vec<u32>,
    /// The vertices of all faces, face after face, counter-clockwise seen from outside.
    pub corner_vertices: Vec<u32>,
    /// As for [`MeshBuilder::push_loose_edge`](crate::MeshBuilder::push_loose_edge).
    pub loose_edges: Vec<[u32; 2]>,
    /// Vertices to be shown as points.
    pub loose_points: Vec<u32>,
}

impl MeshColumns {
    /// Whether [`Mesh::from_columns`] takes them.
    ///
    /// # Errors
    /// The errors of [`Mesh::from_columns`].
    pub fn check(&self) -> Result<(), MeshError> {
        let Self { positions, face_sizes, corner_vertices, loose_edges, loose_points } = self;
        check_capacity("corners and loose edges", corner_vertices.len() + loose_edges.len())?;
        check_capacity("vertices", positions.len())?;
        let expected = face_sizes.iter().map(|&size| u64::from(size)).sum();
        if expected != corner_vertices.len() as u64 {
            return Err(MeshError::CornerCount { expected, found: corner_vertices.len() });
        }
        self.check_faces()?;
        for (index, ends) in loose_edges.iter().enumerate() {
            check_vertices("loose edge", index, ends, positions.len())?;
            if ends[0] == ends[1] {
                return Err(MeshError::EdgeWithoutLength { index, vertex: ends[0] });
            }
        }
        for (index, point) in loose_points.iter().enumerate() {
            check_vertices("loose point", index, std::slice::from_ref(point), positions.len())?;
        }
        Ok(())
    }

    /// The sizes add up to the number of corners.
    fn check_faces(&self) -> Result<(), MeshError> {
        let vertex_count = self.positions.len();
        if self.face_sizes.iter().all(|&size| size == 3) {
            let (triangles, _) = self.corner_vertices.as_chunks();
            return check_triangles(triangles, 0, vertex_count);
        }
        let mut rest = self.corner_vertices.as_slice();
        for (face, &size) in self.face_sizes.iter().enumerate() {
            let (vertices, after) = rest.split_at(size as usize);
            check_face(face, vertices, vertex_count)?;
            rest = after;
        }
        Ok(())
    }
}

impl Mesh {
    /// The mesh with these elements, in this order.
    ///
    /// # Errors
    /// A face has fewer than three different vertices, a vertex does not exist, or sizes do not add up to the
    /// number of corners. A loose edge leads from a vertex to itself, or there are more elements than indices
    /// can count.
    pub fn from_columns(mut columns: MeshColumns) -> Result<Self, MeshError> {
        columns.check()?;
        let MeshColumns { positions, loose_points, .. } = &mut columns;
        if !loose_points.is_empty() {
            let mut visited = vec![false; positions.len()];
            loose_points.retain(|&point| !std::mem::replace(&mut visited[point as usize], true));
        }
        Ok(Self::from_valid_columns(columns))
    }

    /// The mesh with these elements, in this order, without a check: for a program that keeps all rules of
    /// [`Mesh::from_columns`] itself and names each loose point once. Elements that break a rule make the mesh's
    /// functions panic or give nonsense.
    #[must_use]
    pub fn from_valid_columns(columns: MeshColumns) -> Self {
        debug_assert!(columns.check().is_ok(), "the program keeps the rules: {:?}", columns.check());
        let MeshColumns { positions, face_sizes, corner_vertices, loose_edges, loose_points } = columns;
        let face_starts = FaceStarts::of_sizes(&face_sizes);
        Self::from_parts(Parts { positions, face_starts, corner_vertices, loose_edges, loose_points })
    }
}

/// What an editor knows of a [`Mesh`] besides its elements and attributes: original positions,
/// marks of edges, hidden elements, vertex groups. Elements are named by the mesh's indices. Nothing is drawn of them, and
/// files keep them with the mesh.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct EditData {
    /// To where each vertex can be reset, in metres; empty if each is where it was.
    pub first_positions: Vec<Vec3>,
    /// Edges with any mark, by their vertices.
    pub edges: Vec<EdgeMark>,
    /// Vertices that are hidden from the user.
    pub hidden_vertices: Vec<u32>,
    /// Faces that are hidden from the user.
    pub hidden_faces: Vec<u32>,
    /// Corners whose normal in the mesh was not given: sharp edges make it, and it follows them.
    pub sharp_corners: Vec<u32>,
    /// Corners whose texture coordinates are pinned in any set: the corner, and one bit for each set, from the lowest.
    pub pinned_corners: Vec<[u32; 2]>,
    /// Named sets of weighted vertices, in their order.
    pub vertex_groups: Vec<VertexGroupData>,
    /// The stack of modifiers that the mesh is shown with, as text that `trigon-modelling` reads and writes; empty without
    /// any.
    pub modifiers: String,
}

/// A named set of weighted vertices.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct VertexGroupData {
    /// No other group of the mesh has the same.
    pub name: String,
    /// The vertices in it, in increasing order.
    pub vertices: Vec<u32>,
    /// The weight of each of them, 0 to 1.
    pub weights: Vec<f32>,
}

/// The marks of one edge.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct EdgeMark {
    /// Its two vertices, the smaller one first.
    pub vertices: [u32; 2],
    /// It stays sharp in smooth shading.
    pub is_sharp: bool,
    /// Texture coordinates are cut there when they are laid out.
    pub is_seam: bool,
    /// It is hidden from the user.
    pub is_hidden: bool,
    /// How sharp it stays in Catmull-Clark subdivision, 0 to 1.
    pub crease: f32,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::primitives;

    fn columns_of(mesh: &Mesh) -> MeshColumns {
        MeshColumns {
            positions: mesh.positions().to_vec(),
            face_sizes: mesh.faces().map(|corners| corners.len() as u32).collect(),
            corner_vertices: mesh.corner_vertices().to_vec(),
            loose_edges: mesh.loose_edges().to_vec(),
            loose_points: mesh.loose_points().to_vec(),
        }
    }

    #[test]
    fn columns_make_the_mesh_that_they_came_from() {
        for mesh in [
            primitives::cube(2.0),
            primitives::torus(2.0, 0.5, 7, 5),
            primitives::polyline(&[Vec3::ZERO, Vec3::X]),
        ] {
            let again = Mesh::from_columns(columns_of(&mesh)).expect("it was a mesh");
            assert!(
                again.positions() == mesh.positions() && again.edges() == mesh.edges(),
                "the same elements"
            );
            assert_eq!(again.corner_vertices(), mesh.corner_vertices(), "the same faces");
        }
    }

    #[test]
    fn lists_that_contradict_each_other_are_refused() {
        let broken = |damage: &dyn Fn(&mut MeshColumns)| {
            let mut columns = columns_of(&primitives::cube(2.0));
            damage(&mut columns);
            Mesh::from_columns(columns).expect_err("the damage is found")
        };
        broken(&|columns| columns.corner_vertices[5] = 8);
        broken(&|columns| columns.corner_vertices[..4].copy_from_slice(&[1, 1, 2, 2]));
        broken(&|columns| columns.face_sizes[0] = 5);
        broken(&|columns| columns.face_sizes[0] = u32::MAX);
        broken(&|columns| columns.face_sizes.push(0));
        broken(&|columns| columns.face_sizes.truncate(5));
        broken(&|columns| columns.loose_edges.push([1, 1]));
        broken(&|columns| columns.loose_edges.push([1, 8]));
        broken(&|columns| columns.loose_points.push(8));
        broken(&|columns| columns.positions.truncate(7));
    }
}
