//! The mesh: vertices, edges and faces as modelled. Here is also where the corners of each face begin.
//!
//! Everything that a renderer needs is derived from it (the triangulation, the welded
//! [`RenderMesh`](crate::RenderMesh)); none of that is stored here, so it cannot become stale.
//! Edges are also derived from the faces, and many images show none: they are computed on first
//! use, and then kept.

use std::ops::Range;
use std::sync::OnceLock;

use trigon_math::{Bounds3, Vec3, Vec4};

use super::edges::{Edges, NO_EDGE, find_edges};
use super::{Attributes, MeshError};

/// A polygon mesh with explicit vertices, edges and faces.
///
/// Faces are polygons with any number of corners, counter-clockwise seen from outside. A *corner*
/// is one vertex of one face; the corners of all faces are numbered consecutively, and each knows
/// the edge that leads from it to the face's next corner. Loose edges and points are kept. Any
/// number of faces may share an edge.
///
/// One type serves both wire objects (points and edges: a mesh without faces) and surface objects, which add
/// faces. A surface can always be shown as its wires: the solid's own edges, never the diagonals of a
/// triangulation.
///
/// Built by [`MeshBuilder`](crate::MeshBuilder); see there for an example.
#[derive(Debug, Clone)]
pub struct Mesh {
    positions: Vec<Vec3>,
    face_starts: FaceStarts,
    corner_vertices: Vec<u32>,
    /// As given: some may be edges of faces.
    loose_edges: Vec<[u32; 2]>,
    edges: OnceLock<Edges>,
    loose_points: Vec<u32>,
    attributes: Attributes,
}

/// The checked data from a builder.
pub(crate) struct Parts {
    pub(crate) positions: Vec<Vec3>,
    pub(crate) face_starts: FaceStarts,
    pub(crate) corner_vertices: Vec<u32>,
    pub(crate) loose_edges: Vec<[u32; 2]>,
    pub(crate) loose_points: Vec<u32>,
}

impl PartialEq for Mesh {
    /// Whether all elements have the same numbers, places and values.
    fn eq(&self, other: &Self) -> bool {
        self.positions == other.positions
            && self.face_starts == other.face_starts
            && self.corner_vertices == other.corner_vertices
            && self.loose_points == other.loose_points
            && self.attributes == other.attributes
            // All others follow from the faces.
            && self.loose_edges() == other.loose_edges()
    }
}

impl Mesh {
    pub(crate) fn from_parts(parts: Parts) -> Self {
        Self {
            positions: parts.positions,
            face_starts: parts.face_starts,
            corner_vertices: parts.corner_vertices,
            loose_edges: parts.loose_edges,
            edges: OnceLock::new(),
            loose_points: parts.loose_points,
            attributes: Attributes::default(),
        }
    }

    /// The edges, computed on first use.
    fn found_edges(&self) -> &Edges {
        self.edges.get_or_init(|| {
            let mut next_vertices = Vec::with_capacity(self.corner_count());
            for vertices in self.faces().map(|corners| &self.corner_vertices[corners]) {
                next_vertices.extend_from_slice(&vertices[1..]);
                next_vertices.push(vertices[0]);
            }
            find_edges(self.vertex_count(), &self.corner_vertices, &next_vertices, &self.loose_edges)
        })
    }

    /// The position of each vertex, in metres.
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// The positions, mutable. Corner normals do not follow: use [`Mesh::transform`] for a
    /// transform.
    pub fn positions_mut(&mut self) -> &mut [Vec3] {
        &mut self.positions
    }

    /// The number of vertices, used or not.
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// The number of polygons.
    pub fn face_count(&self) -> usize {
        self.face_starts.len()
    }

    /// The number of edges, including loose ones.
    pub fn edge_count(&self) -> usize {
        self.edges().len()
    }

    /// The number of corners of all faces.
    pub fn corner_count(&self) -> usize {
        self.corner_vertices.len()
    }

    /// The vertices of a face, counter-clockwise seen from outside.
    ///
    /// # Panics
    ///
    /// The face does not exist.
    pub fn face_vertices(&self, face: usize) -> &[u32] {
        &self.corner_vertices[self.face_corners(face)]
    }

    /// The corners of a face: indices into per-corner attributes.
    ///
    /// # Panics
    ///
    /// The face does not exist.
    pub fn face_corners(&self, face: usize) -> Range<usize> {
        self.face_starts.corners(face)
    }

    /// The face of a corner.
    pub(crate) fn face_at(&self, corner: u32) -> usize {
        self.face_starts.face_at(corner)
    }

    /// Whether no face has more than three corners.
    pub(crate) fn has_only_triangles(&self) -> bool {
        self.face_starts.are_triangles()
    }

    /// The corners of every face, in order.
    pub fn faces(&self) -> impl ExactSizeIterator<Item = Range<usize>> + Clone + '_ {
        self.face_starts.iter()
    }

    /// The vertex at each corner of every face.
    pub fn corner_vertices(&self) -> &[u32] {
        &self.corner_vertices
    }

    /// The edge from a corner to the next corner of its face. `None` if both are at the same vertex
    /// (a repeated vertex in a face).
    ///
    /// # Panics
    ///
    /// The corner does not exist.
    pub fn corner_edge(&self, corner: usize) -> Option<u32> {
        Some(self.found_edges().corner_edges[corner]).filter(|&edge| edge != NO_EDGE)
    }

    /// Every edge once, its smaller vertex first. Edges are computed on first use. The faces' edges come
    /// first, in order of first use, then the loose ones.
    pub fn edges(&self) -> &[[u32; 2]] {
        &self.found_edges().edges
    }

    /// The number of edges that belong to faces.
    pub fn face_edge_count(&self) -> usize {
        self.found_edges().face_edge_count
    }

    /// The edges that belong to no face.
    pub fn loose_edges(&self) -> &[[u32; 2]] {
        if self.loose_edges.is_empty() {
            return &[];
        }
        &self.edges()[self.face_edge_count()..]
    }

    /// The vertices to be shown as points, each once.
    pub fn loose_points(&self) -> &[u32] {
        &self.loose_points
    }

    /// Which vertices belong to a face, an edge or a point.
    pub fn used_vertices(&self) -> Vec<bool> {
        let mut used = vec![false; self.vertex_count()];
        let loose = self.loose_edges.as_flattened().iter().chain(&self.loose_points);
        for &vertex in self.corner_vertices.iter().chain(loose) {
            used[vertex as usize] = true;
        }
        used
    }

    /// The box around all vertices, used or not. Empty if there are none.
    pub fn bounds(&self) -> Bounds3 {
        Bounds3::from_points(self.positions.iter().map(|p| p.as_dvec3()))
    }

    /// The attributes of corners, faces and vertices.
    pub fn attributes(&self) -> &Attributes {
        &self.attributes
    }

    /// Replaces all attributes of corners, faces and vertices.
    ///
    /// # Errors
    ///
    /// A list does not have one value per corner, face or vertex. The mesh is unchanged.
    pub fn set_attributes(&mut self, attributes: Attributes) -> Result<(), MeshError> {
        attributes.check(self.vertex_count(), self.corner_count(), self.face_count())?;
        self.attributes = attributes;
        Ok(())
    }

    /// Replaces the tangents of the corners.
    ///
    /// # Errors
    ///
    /// The list does not have one tangent per corner. The mesh is unchanged.
    pub fn set_corner_tangents(&mut self, tangents: Vec<Vec4>) -> Result<(), MeshError> {
        let (expected, found) = (self.corner_count(), tangents.len());
        if found != expected {
            let (attribute, element) = ("corner_tangents", "corners");
            return Err(MeshError::AttributeLength { attribute, element, expected, found });
        }
        self.attributes.corner_tangents = Some(tangents);
        Ok(())
    }

    /// Whether vertices, edges and faces are the same: not their places, nor any other values.
    pub(crate) fn has_same_elements(&self, other: &Self) -> bool {
        self.positions.len() == other.positions.len()
            && self.face_starts == other.face_starts
            && self.corner_vertices == other.corner_vertices
            && self.loose_edges == other.loose_edges
            && self.loose_points == other.loose_points
    }

    /// For changes that keep the right lengths.
    pub(crate) fn attributes_mut(&mut self) -> &mut Attributes {
        &mut self.attributes
    }

    /// Flips every face: its first corner stays first, and the others follow in the opposite
    /// direction with all their values. Edges keep their numbers. Corner normals are moved, not
    /// negated.
    pub fn flip_faces(&mut self) {
        let mut order: Vec<u32> = (0..self.corner_count() as u32).collect();
        self.found_edges();
        let edges = self.edges.get_mut().expect("they were just found");
        for corners in self.face_starts.iter() {
            order[corners.clone()][1..].reverse();
            edges.corner_edges[corners].reverse();
        }
        let old = std::mem::take(&mut self.corner_vertices);
        self.corner_vertices = order.iter().map(|&from| old[from as usize]).collect();
        self.attributes.reorder_corners(&order);
    }
}

/// The first corner of each face. Meshes whose faces have equally many corners, as those of triangles alone and those of
/// quads alone, need no list of them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum FaceStarts {
    /// So many faces with so many corners each; with three if there is no face.
    Equal { count: usize, size: usize },
    /// The first corner of each face, and the number of corners at the end; at least two faces have not equally many.
    Listed(Vec<u32>),
}

impl Default for FaceStarts {
    /// No faces.
    fn default() -> Self {
        Self::Equal { count: 0, size: 3 }
    }
}

impl FaceStarts {
    /// Of faces with so many corners each. All corners can be numbered.
    pub(crate) fn of_sizes(sizes: &[u32]) -> Self {
        let mut starts = Self::default();
        sizes.iter().for_each(|&size| starts.push(size as usize, sizes.len()));
        starts
    }

    /// Adds a face with so many corners, at least three. `expected` is the number of faces that are expected in all.
    pub(crate) fn push(&mut self, size: usize, expected: usize) {
        match self {
            Self::Equal { count, size: each } if *count == 0 || *each == size => {
                (*count, *each) = (*count + 1, size);
            }
            Self::Equal { count, size: each } => {
                let mut starts = Vec::with_capacity(expected.max(*count + 1) + 1);
                starts.extend((0..=*count).map(|face| (*each * face) as u32));
                *self = Self::Listed(starts);
                self.push(size, expected);
            }
            Self::Listed(starts) => starts.push(starts[starts.len() - 1] + size as u32),
        }
    }

    /// Adds so many triangles.
    pub(crate) fn push_triangles(&mut self, more: usize) {
        match self {
            Self::Equal { count, size: 3 } => *count += more,
            Self::Equal { .. } | Self::Listed(_) => (0..more).for_each(|_| self.push(3, 0)),
        }
    }

    /// The number of faces.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Equal { count, .. } => *count,
            Self::Listed(starts) => starts.len() - 1,
        }
    }

    /// The corners of a face, which must exist.
    pub(crate) fn corners(&self, face: usize) -> Range<usize> {
        match self {
            Self::Equal { count, size } => {
                assert!(face < *count, "there is no face {face}: there are {count}");
                size * face..size * face + size
            }
            Self::Listed(starts) => starts[face] as usize..starts[face + 1] as usize,
        }
    }

    /// The corners of every face, in order.
    pub(crate) fn iter(&self) -> impl ExactSizeIterator<Item = Range<usize>> + Clone + '_ {
        (0..self.len()).map(|face| self.corners(face))
    }

    /// The face of a corner, which must exist.
    pub(crate) fn face_at(&self, corner: u32) -> usize {
        match self {
            Self::Equal { size, .. } => corner as usize / size,
            Self::Listed(starts) => starts.partition_point(|&start| start <= corner) - 1,
        }
    }

    /// Whether all faces are triangles.
    pub(crate) fn are_triangles(&self) -> bool {
        matches!(self, Self::Equal { size: 3, .. })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_follow_each_other_whatever_the_sizes() {
        for sizes in
            [vec![], vec![3], vec![3, 3, 3], vec![4], vec![4, 4], vec![4, 3], vec![3, 3, 5, 3], vec![6, 3, 4]]
        {
            let starts = FaceStarts::of_sizes(&sizes);
            let is_triangles = sizes.iter().all(|&size| size == 3);
            assert_eq!(starts.are_triangles(), is_triangles, "{sizes:?}");
            assert_eq!(starts.len(), sizes.len(), "{sizes:?}");
            let mut end = 0;
            for (face, (&size, corners)) in sizes.iter().zip(starts.iter()).enumerate() {
                assert_eq!(corners, end..end + size as usize, "face {face} of {sizes:?}");
                assert_eq!(starts.corners(face), corners, "one by one");
                assert!(corners.clone().all(|corner| starts.face_at(corner as u32) == face), "and back");
                end = corners.end;
            }
            let mut more = starts.clone();
            more.push_triangles(2);
            let expected: Vec<u32> = sizes.iter().copied().chain([3, 3]).collect();
            assert_eq!(more, FaceStarts::of_sizes(&expected), "two triangles more than {sizes:?}");
        }
    }

    #[test]
    #[should_panic(expected = "no face 2")]
    fn a_triangle_that_does_not_exist_has_no_corners() {
        let _ = FaceStarts::of_sizes(&[3, 3]).corners(2);
    }
}
