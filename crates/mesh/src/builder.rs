//! Building a mesh element by element, with every index checked once.

use trigon_math::Vec3;

use super::mesh::FaceStarts;
use crate::mesh::Parts;
use crate::{Mesh, MeshError};

/// The maximum number of vertices, and of corners, faces and loose edges together: `u32::MAX` itself
/// means "none" in buffers.
const LIMIT: u32 = u32::MAX - 1;

/// Collects vertices, faces, loose edges and loose points, then builds a
/// [`Mesh`].
///
/// ```
/// use trigon_math::Vec3;
/// use trigon_mesh::MeshBuilder;
///
/// let mut builder = MeshBuilder::new();
/// let corners = [Vec3::ZERO, Vec3::X, Vec3::Y].map(|position| builder.push_vertex(position));
/// builder.push_face(&corners)?;
/// let triangle = builder.build();
/// assert_eq!(triangle.edge_count(), 3);
/// # Ok::<(), trigon_mesh::MeshError>(())
/// ```
#[derive(Debug, Clone)]
pub struct MeshBuilder {
    positions: Vec<Vec3>,
    face_starts: FaceStarts,
    /// The number of faces that are expected.
    expected_faces: usize,
    corner_vertices: Vec<u32>,
    loose_edges: Vec<[u32; 2]>,
    loose_points: Vec<u32>,
}

impl Default for MeshBuilder {
    fn default() -> Self {
        Self::new()
    }
}

impl MeshBuilder {
    /// An empty builder.
    #[must_use]
    pub fn new() -> Self {
        Self::with_capacity(0, 0, 0)
    }

    /// A builder with reserved memory for this many vertices, faces and corners.
    #[must_use]
    pub fn with_capacity(vertices: usize, faces: usize, corners: usize) -> Self {
        Self {
            positions: Vec::with_capacity(vertices),
            face_starts: FaceStarts::default(),
            expected_faces: faces,
            corner_vertices: Vec::with_capacity(corners),
            loose_edges: Vec::new(),
            loose_points: Vec::new(),
        }
    }

    /// The positions of the vertices pushed so far.
    #[must_use]
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// The number of vertices pushed so far.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// The number of accepted faces.
    #[must_use]
    pub fn face_count(&self) -> usize {
        self.face_starts.len()
    }

    /// The number of corners of the accepted faces: the required length of per-corner attributes.
    #[must_use]
    pub fn corner_count(&self) -> usize {
        self.corner_vertices.len()
    }

    /// Adds a vertex and returns its index. Positions are in metres; any value is kept, even if it
    /// is not finite.
    ///
    /// # Panics
    ///
    /// There are `u32::MAX` vertices already, 48 GiB of them: importers limit their input long
    /// before.
    pub fn push_vertex(&mut self, position: Vec3) -> u32 {
        let index = self.positions.len() as u32;
        assert!(index < u32::MAX, "vertex indices have 32 bits");
        self.positions.push(position);
        index
    }

    /// Adds a polygon and returns its index. The vertices are in counter-clockwise order seen from
    /// outside. Vertices may repeat (an outline with holes traverses a bridge twice), and faces may
    /// repeat or share an edge with any number of others.
    ///
    /// # Errors
    ///
    /// Fewer than three distinct vertices, a vertex that does not exist, or more corners than
    /// indices can count. Nothing was added then.
    pub fn push_face(&mut self, vertices: &[u32]) -> Result<u32, MeshError> {
        let face = self.face_count();
        check_face(face, vertices, self.positions.len())?;
        self.check_capacity(vertices.len())?;
        self.corner_vertices.extend_from_slice(vertices);
        self.face_starts.push(vertices.len(), self.expected_faces);
        Ok(face as u32)
    }

    /// Adds triangles, as [`push_face`](Self::push_face) does each: all of them or none.
    ///
    /// # Errors
    ///
    /// One of them has fewer than three distinct vertices or a vertex that does not exist, or there are more
    /// corners than indices can count. Nothing was added then.
    pub fn push_triangles(&mut self, triangles: &[[u32; 3]]) -> Result<(), MeshError> {
        check_triangles(triangles, self.face_count(), self.positions.len())?;
        self.check_capacity(3 * triangles.len())?;
        self.corner_vertices.extend_from_slice(triangles.as_flattened());
        self.face_starts.push_triangles(triangles.len());
        Ok(())
    }

    /// Adds an edge that need not belong to a face. If a face also has it, it is the face's edge,
    /// not a loose one.
    ///
    /// # Errors
    ///
    /// Both ends are the same vertex, a vertex does not exist, or there are more edges than indices
    /// can count. Nothing was added then.
    pub fn push_loose_edge(&mut self, from: u32, to: u32) -> Result<(), MeshError> {
        let index = self.loose_edges.len();
        check_vertices("loose edge", index, &[from, to], self.positions.len())?;
        if from == to {
            let vertex = from;
            return Err(MeshError::EdgeWithoutLength { index, vertex });
        }
        self.check_capacity(1)?;
        self.loose_edges.push([from, to]);
        Ok(())
    }

    /// Marks a vertex as a point to be shown on its own.
    ///
    /// # Errors
    ///
    /// The vertex does not exist.
    pub fn push_loose_point(&mut self, vertex: u32) -> Result<(), MeshError> {
        check_vertices("loose point", self.loose_points.len(), &[vertex], self.positions.len())?;
        self.loose_points.push(vertex);
        Ok(())
    }

    /// Builds the mesh, without attributes yet (see [`Mesh::set_attributes`]).
    #[must_use]
    pub fn build(mut self) -> Mesh {
        let mut visited = vec![false; self.positions.len()];
        self.loose_points.retain(|&point| !std::mem::replace(&mut visited[point as usize], true));
        Mesh::from_parts(Parts {
            positions: self.positions,
            face_starts: self.face_starts,
            corner_vertices: self.corner_vertices,
            loose_edges: self.loose_edges,
            loose_points: self.loose_points,
        })
    }

    /// Half-edges (corners and loose edges) are numbered together while edges are searched, so one
    /// limit applies to both; faces are fewer.
    fn check_capacity(&self, more: usize) -> Result<(), MeshError> {
        check_capacity("corners and loose edges", self.corner_vertices.len() + self.loose_edges.len() + more)
    }
}

/// Whether vertices exist. `index` is that of their element.
pub(crate) fn check_vertices(
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

/// Whether a face is one: its vertices exist, and three of them differ.
pub(crate) fn check_face(face: usize, vertices: &[u32], vertex_count: usize) -> Result<(), MeshError> {
    check_vertices("face", face, vertices, vertex_count)?;
    match distinct_up_to_3(vertices) {
        3 => Ok(()),
        distinct => Err(MeshError::TooFewVertices { face, distinct }),
    }
}

/// Whether all of some triangles are faces, the first of which has a number.
pub(crate) fn check_triangles(
    triangles: &[[u32; 3]],
    first: usize,
    vertex_count: usize,
) -> Result<(), MeshError> {
    let is_face = |&[a, b, c]: &[u32; 3]| {
        let exist = a.max(b).max(c) < u32::try_from(vertex_count).unwrap_or(u32::MAX);
        exist & (a != b) & (b != c) & (c != a)
    };
    // The compiler checks several at a time. Which one is wrong is needed only if one is.
    if triangles.iter().fold(true, |all, triangle| all & is_face(triangle)) {
        return Ok(());
    }
    let mut numbered = (first..).zip(triangles);
    numbered.try_for_each(|(face, triangle)| check_face(face, triangle, vertex_count))
}

/// Whether so many elements of a kind can be numbered.
pub(crate) fn check_capacity(what: &'static str, count: usize) -> Result<(), MeshError> {
    if count > LIMIT as usize { Err(MeshError::TooMany { what, limit: LIMIT }) } else { Ok(()) }
}

/// Counts distinct vertices, but stops at three.
pub(crate) fn distinct_up_to_3(vertices: &[u32]) -> usize {
    let Some(&a) = vertices.first() else { return 0 };
    let Some(&b) = vertices.iter().find(|&&v| v != a) else {
        return 1;
    };
    match vertices.iter().any(|&v| v != a && v != b) {
        true => 3,
        false => 2,
    }
}

impl Default for Mesh {
    /// An empty mesh.
    fn default() -> Self {
        MeshBuilder::new().build()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_as_can_be_numbered_are_not_too_many() {
        // 0xffff_ffff is no index, so the last one is 0xffff_fffd, and there are 0xffff_fffe.
        for (count, fits) in [(0, true), (0xffff_fffe, true), (0xffff_ffff, false), (usize::MAX, false)] {
            assert_eq!(check_capacity("vertices", count).is_ok(), fits, "{count}");
        }
        let message = check_capacity("vertices", usize::MAX).expect_err("too many").to_string();
        assert!(message.contains("vertices") && message.contains("4294967294"), "{message}");
    }

    #[test]
    fn vertices_are_counted_up_to_three_different_ones() {
        let lists: [(&[u32], usize); 7] = [
            (&[], 0),
            (&[7], 1),
            (&[7, 7, 7], 1),
            (&[7, 5], 2),
            (&[7, 5, 5, 7], 2),
            (&[7, 5, 7, 0], 3),
            (&[1, 2, 3, 4], 3),
        ];
        for (vertices, count) in lists {
            assert_eq!(distinct_up_to_3(vertices), count, "{vertices:?}");
        }
    }
}
