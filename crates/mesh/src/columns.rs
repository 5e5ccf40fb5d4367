//! A mesh as plain lists, as in files. They are checked as a whole, so that millions of faces do not need
//! one call each.

use trigon_math::Vec3;

use crate::builder::{check_room, distinct_up_to_3};
use crate::mesh::Parts;
use crate::{Mesh, MeshError};

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

impl Mesh {
    /// The mesh with these elements, in this order.
    ///
    /// # Errors
    /// A face with fewer than three different vertices, a vertex that does not exist, sizes that do
    /// not add up to the number of corners, a loose edge from a vertex to itself, or more elements
    /// than indices can count.
    pub fn from_columns(columns: MeshColumns) -> Result<Self, MeshError> {
        let MeshColumns { positions, face_sizes, corner_vertices, loose_edges, mut loose_points } = columns;
        check_room("corners and loose edges", corner_vertices.len() + loose_edges.len())?;
        check_room("vertices", positions.len())?;
        let face_starts = face_starts(&face_sizes, corner_vertices.len())?;
        for (face, ends) in face_starts.windows(2).enumerate() {
            let vertices = &corner_vertices[ends[0] as usize..ends[1] as usize];
            check_vertices("face", face, vertices, positions.len())?;
            let distinct = distinct_up_to_3(vertices);
            if distinct < 3 {
                return Err(MeshError::TooFewVertices { face, distinct });
            }
        }
        for (index, ends) in loose_edges.iter().enumerate() {
            check_vertices("loose edge", index, ends, positions.len())?;
            if ends[0] == ends[1] {
                return Err(MeshError::EdgeWithoutLength { index, vertex: ends[0] });
            }
        }
        for (index, point) in loose_points.iter().enumerate() {
            check_vertices("loose point", index, std::slice::from_ref(point), positions.len())?;
        }
        if !loose_points.is_empty() {
            let mut seen = vec![false; positions.len()];
            loose_points.retain(|&point| !std::mem::replace(&mut seen[point as usize], true));
        }
        Ok(Self::from_parts(Parts { positions, face_starts, corner_vertices, loose_edges, loose_points }))
    }
}

/// The first corner of each face, and the number of corners at the end.
fn face_starts(face_sizes: &[u32], corners: usize) -> Result<Vec<u32>, MeshError> {
    let mut starts = Vec::with_capacity(face_sizes.len() + 1);
    starts.push(0);
    let mut end = 0u64;
    for &size in face_sizes {
        end += u64::from(size);
        if end > corners as u64 {
            break;
        }
        // Corners have been counted: there are fewer than `u32::MAX`.
        starts.push(end as u32);
    }
    let expected = face_sizes.iter().map(|&size| u64::from(size)).sum();
    if expected == corners as u64 {
        Ok(starts)
    } else {
        Err(MeshError::CornerCount { expected, found: corners })
    }
}

fn check_vertices(
    element: &'static str,
    index: usize,
    vertices: &[u32],
    vertex_count: usize,
) -> Result<(), MeshError> {
    match vertices.iter().find(|&&vertex| vertex as usize >= vertex_count) {
        None => Ok(()),
        Some(&vertex) => Err(MeshError::VertexOutOfRange { element, index, vertex, vertex_count }),
    }
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
