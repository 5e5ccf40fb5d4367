//! What lies around changed elements.

use rayon::prelude::*;

use super::ChangedElements;
use super::corner_faces::CornerFaces;
use super::face_normals::PIECE;
use super::marks::Marks;

use crate::Mesh;
use crate::groups::Groups;

/// The elements of a mesh that a change affects. They follow from which elements were changed and not from
/// their values, so they are found once for a drag that changes the same vertices in each frame.
#[derive(Debug, Clone, Default)]
pub(super) struct Neighborhood {
    /// The vertices that were moved, increasing.
    pub(super) moved: Vec<u32>,
    /// The corners with other attributes, increasing.
    pub(super) corners: Vec<u32>,
    /// The faces with a vertex that was moved, increasing.
    pub(super) faces: Vec<u32>,
    /// Those of them that can be cut in more than one way.
    pub(super) polygons: Vec<u32>,
    /// The vertices at which a corner may show other values, increasing.
    pub(super) vertices: Vec<u32>,
    /// Whether normals of vertices depend on faces.
    has_face_normals: bool,
}

impl Neighborhood {
    /// Takes the place of the one of an earlier change; returns whether that was of other elements.
    pub(super) fn update(
        &mut self,
        mesh: &Mesh,
        corners_at: &Groups<u32>,
        changed: &ChangedElements,
        has_face_normals: bool,
    ) -> bool {
        let (moved, corners) = (changed.vertices(), changed.corners());
        let is_same =
            (&self.moved, &self.corners, self.has_face_normals) == (&moved, &corners, has_face_normals);
        if is_same {
            return false;
        }
        let faces = faces_around(mesh, corners_at, &moved);
        let mut vertices = Marks::new(mesh.vertex_count());
        moved.iter().for_each(|&vertex| vertices.insert(vertex));
        corners.iter().for_each(|&corner| vertices.insert(mesh.corner_vertices()[corner as usize]));
        if has_face_normals {
            let mark = |marks: &mut Marks, face: u32| {
                mesh.face_vertices(face as usize).iter().for_each(|&vertex| marks.insert(vertex));
            };
            vertices = vertices.union(marked(mesh.vertex_count(), &faces, mark));
        }
        let is_polygon = |&face: &u32| mesh.face_corners(face as usize).len() > 3;
        let polygons = match mesh.has_only_triangles() {
            true => Vec::new(),
            false => faces.iter().copied().filter(is_polygon).collect(),
        };
        *self = Self { moved, corners, faces, polygons, vertices: vertices.listed(), has_face_normals };
        true
    }
}

/// The faces that have one of these vertices, increasing.
fn faces_around(mesh: &Mesh, corners_at: &Groups<u32>, vertices: &[u32]) -> Vec<u32> {
    let of_corner = CornerFaces::new(mesh);
    let mark = |marks: &mut Marks, vertex: u32| {
        corners_at.get(vertex).iter().for_each(|&corner| marks.insert(of_corner.of(corner).0 as u32));
    };
    marked(mesh.face_count(), vertices, mark).listed()
}

/// What is marked for some elements, one after the other.
fn marked(count: usize, elements: &[u32], mark: impl Fn(&mut Marks, u32) + Sync) -> Marks {
    let piece = |elements: &[u32]| {
        let mut marks = Marks::new(count);
        elements.iter().for_each(|&element| mark(&mut marks, element));
        marks
    };
    // Each piece has marks for the whole mesh.
    let pieces = elements.par_chunks(8 * PIECE).map(piece);
    pieces.reduce_with(Marks::union).unwrap_or_else(|| Marks::new(count))
}
