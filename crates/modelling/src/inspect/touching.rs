//! Findings about faces that touch or cross other faces without being joined to them.

use trigon_math::{DVec3, Vec3};
use trigon_mesh::Triangulator;

use super::triangle_tree::{PairSearch, TriangleTree};
use super::triangles_touch::triangles_touch;
use crate::edit_mesh::EditMesh;
use crate::ids::{FaceId, VertexId};

/// Pairs of faces that touch or cross each other.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct TouchingFaces {
    /// The smaller id first, in ascending order, each pair once.
    pub pairs: Vec<[FaceId; 2]>,
    /// Whether these are all. If not, there are so many, or so many nearly touch, that the search
    /// was ended.
    pub is_complete: bool,
}

/// A triangle of a face.
#[derive(Debug, Clone, Copy)]
pub(super) struct FaceTriangle {
    pub(super) face: FaceId,
    pub(super) vertices: [VertexId; 3],
    pub(super) positions: [Vec3; 3],
}

impl EditMesh {
    /// The pairs of faces that touch or cross each other although they share no vertex; up to
    /// `most` pairs of their triangles are looked for. Faces without area and those at places that are not
    /// finite are left out.
    ///
    /// It is decided in f64: a gap of less than about 10⁻¹⁵ of the size of a face may be taken for
    /// none.
    #[must_use]
    pub fn touching_faces(&self, most: usize) -> TouchingFaces {
        let tree = TriangleTree::new(self.triangles());
        let mut found: Vec<[FaceId; 2]> = Vec::new();
        let mut search = PairSearch::new(&tree);
        let is_complete = search.for_each_pair(|a, b| {
            if a.face != b.face
                && !a.vertices.iter().any(|vertex| b.vertices.contains(vertex))
                && triangles_touch(a.positions.map(Vec3::as_dvec3), b.positions.map(Vec3::as_dvec3))
                && !self.share_vertex(a.face, b.face)
            {
                found.push([a.face.min(b.face), a.face.max(b.face)]);
            }
            found.len() < most
        });
        found.sort_unstable();
        found.dedup();
        TouchingFaces { pairs: found, is_complete }
    }

    /// In time proportional to the smaller face's neighbourhood.
    fn share_vertex(&self, a: FaceId, b: FaceId) -> bool {
        let (small, large) = if self.face_size(a) <= self.face_size(b) { (a, b) } else { (b, a) };
        self.face_vertices(small).any(|vertex| self.vertex_faces(vertex).any(|face| face == large))
    }

    /// The triangles of all faces that have an area.
    pub(super) fn triangles(&self) -> Vec<FaceTriangle> {
        let mut triangulator = Triangulator::default();
        let (mut vertices, mut positions, mut cut) = (Vec::new(), Vec::new(), Vec::new());
        let mut triangles = Vec::with_capacity(2 * self.face_count());
        for face in self.faces() {
            vertices.clear();
            vertices.extend(self.face_vertices(face));
            positions.clear();
            positions.extend(vertices.iter().map(|&vertex| self.position(vertex)));
            if !positions.iter().all(|position| position.is_finite()) {
                continue;
            }
            cut.clear();
            triangulator.polygon(&positions, &mut cut);
            let triangle = |indices: &[u32; 3]| FaceTriangle {
                face,
                vertices: indices.map(|index| vertices[index as usize]),
                positions: indices.map(|index| positions[index as usize]),
            };
            triangles.extend(cut.iter().map(triangle).filter(|triangle| {
                let [a, b, c] = triangle.positions.map(Vec3::as_dvec3);
                (b - a).cross(c - a) != DVec3::ZERO
            }));
        }
        triangles
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_mesh::primitives;

    use super::*;
    use crate::Transform;
    use crate::tests::meshes;

    /// Two cubes of 2 m, the second one moved.
    fn two_cubes(offset: DVec3) -> EditMesh {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        let faces: Vec<Vec<VertexId>> = mesh.faces().map(|face| mesh.face_vertices(face).collect()).collect();
        let old: Vec<VertexId> = mesh.vertices().collect();
        let new: Vec<VertexId> =
            old.iter().map(|&vertex| mesh.add_vertex(mesh.position(vertex)).expect("room")).collect();
        for face in faces {
            let moved: Vec<VertexId> = face.iter().map(|vertex| new[vertex.index() as usize]).collect();
            mesh.add_face(&moved).expect("as the first");
        }
        mesh.transform_vertices(&new, &Transform::Translate { offset }, None).expect("possible");
        mesh
    }

    #[test]
    fn solids_that_reach_into_each_other_touch() {
        let count = |offset| {
            let found = two_cubes(offset).touching_faces(1000);
            assert!(found.is_complete, "there are few");
            found.pairs.len()
        };
        assert_eq!(count(DVec3::X * 3.0), 0, "apart");
        // The end wall of each in four of the other, four pairs of side walls in one plane, and each
        // side wall with the two of the other that it meets along the edges there.
        assert_eq!(count(DVec3::X), 20, "half way in");
        // Walls face to face, and the rims of each on the other's walls.
        assert!(count(DVec3::X * 2.0) >= 1, "side by side");
        assert_eq!(count(DVec3::ONE), 6, "a corner of one in the other: three walls of each cross two");
    }

    #[test]
    fn the_search_ends_when_enough_is_found() {
        let found = two_cubes(DVec3::X).touching_faces(1);
        assert_eq!((found.pairs.len(), found.is_complete), (1, false), "one of twenty");
        let (torus, _) = EditMesh::from_mesh(&primitives::torus(2.0, 0.5, 24, 12));
        let none = TouchingFaces { pairs: vec![], is_complete: true };
        assert_eq!(torus.touching_faces(10), none, "neighbours do not count");
    }

    proptest! {
        /// Against a comparison of all with all.
        #[test]
        fn all_pairs_are_found(start in meshes()) {
            let (mesh, _) = EditMesh::from_mesh(&start);
            let triangles = mesh.triangles();
            let mut expected = Vec::new();
            for a in &triangles {
                for b in &triangles {
                    let apart = !mesh.share_vertex(a.face, b.face);
                    if a.face < b.face && apart
                        && triangles_touch(a.positions.map(Vec3::as_dvec3), b.positions.map(Vec3::as_dvec3))
                    {
                        expected.push([a.face, b.face]);
                    }
                }
            }
            expected.sort_unstable();
            expected.dedup();
            prop_assert_eq!(mesh.touching_faces(usize::MAX).pairs, expected);
        }
    }
}
