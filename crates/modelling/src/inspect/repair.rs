//! Repairs: each fixes one kind of finding and returns how many it has fixed.

use smallvec::SmallVec;

use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, VertexId};
use crate::refusal::Refusal;

impl EditMesh {
    /// Removes all edges without a face; their vertices stay.
    ///
    /// # Errors
    /// None: it can always be done.
    pub fn remove_loose_edges(&mut self) -> Result<usize, Refusal> {
        let edges = self.loose_edges();
        edges.iter().try_for_each(|&edge| self.remove_edge(edge))?;
        Ok(edges.len())
    }

    /// Removes all vertices without an edge, but for those that are shown as points.
    ///
    /// # Errors
    /// None: it can always be done.
    pub fn remove_loose_vertices(&mut self) -> Result<usize, Refusal> {
        let vertices = self.loose_vertices();
        vertices.iter().try_for_each(|&vertex| self.remove_vertex(vertex))?;
        Ok(vertices.len())
    }

    /// Removes all faces that have the same vertices as one with a smaller id.
    ///
    /// # Errors
    /// None: it can always be done.
    pub fn remove_doubled_faces(&mut self) -> Result<usize, Refusal> {
        let doubles = self.doubled_faces();
        doubles.iter().try_for_each(|double| self.remove_face(double.face))?;
        Ok(doubles.len())
    }

    /// Makes one vertex of the ends of all edges no longer than `most` metres: that with the smallest
    /// id of all that such edges join. Faces that are left with fewer than three vertices go.
    /// How many vertices went.
    ///
    /// # Errors
    /// None: it can always be done.
    pub fn collapse_zero_length_edges(&mut self, most: f64) -> Result<usize, Refusal> {
        let edges = self.zero_length_edges(most);
        let pairs = self.joined_by(&edges);
        self.merge_vertices(&pairs)?;
        Ok(pairs.len())
    }

    /// For each vertex that edges join to one with a smaller id, that and the smallest.
    fn joined_by(&self, edges: &[EdgeId]) -> Vec<(VertexId, VertexId)> {
        let mut vertices: Vec<VertexId> = edges.iter().flat_map(|&edge| self.edge_vertices(edge)).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let mut roots: Vec<u32> = (0..vertices.len() as u32).collect();
        let root = |roots: &mut [u32], vertex: VertexId| {
            let mut at = vertices.partition_point(|&other| other < vertex) as u32;
            while roots[at as usize] != at {
                // Halves the path for the next search.
                roots[at as usize] = roots[roots[at as usize] as usize];
                at = roots[at as usize];
            }
            at
        };
        for &edge in edges {
            let [a, b] = self.edge_vertices(edge).map(|vertex| root(&mut roots, vertex));
            roots[a.max(b) as usize] = a.min(b);
        }
        let target = |&vertex: &VertexId| (vertex, vertices[root(&mut roots, vertex) as usize]);
        vertices.iter().map(target).filter(|(vertex, target)| vertex != target).collect()
    }

    /// Takes away faces no larger than `most` square metres: each is joined with the face at its
    /// longest edge, so that a closed surface stays closed. Where no single face is there, that runs
    /// in the opposite direction and shares no other edge, it is removed. How many faces went.
    ///
    /// # Errors
    /// None: it can always be done.
    pub fn dissolve_zero_area_faces(&mut self, most: f64) -> Result<usize, Refusal> {
        let mut faces = 0;
        for face in self.zero_area_faces(most) {
            if !self.has_face(face) {
                // It was joined with another of these.
                continue;
            }
            faces += 1;
            let is_joined = self.edge_to_dissolve(face).is_some_and(|edge| self.join_faces(edge).is_ok());
            if !is_joined {
                self.remove_face(face)?;
            }
        }
        Ok(faces)
    }

    /// The longest edge of a face, the first of several, if its faces can be joined there.
    fn edge_to_dissolve(&self, face: FaceId) -> Option<EdgeId> {
        let longer = |best: EdgeId, edge: EdgeId| {
            if self.edge_length(edge) > self.edge_length(best) { edge } else { best }
        };
        let longest = self.face_edges(face).reduce(longer)?;
        let [one, two] = self.edge_pair(longest)?;
        let faces = [one, two].map(|corner| self.corner_face(corner));
        let opposed = self.corner_vertex(one) != self.corner_vertex(two);
        let other = if faces[0] == face { faces[1] } else { faces[0] };
        let edges: SmallVec<[EdgeId; 8]> = self.face_edges(face).collect();
        let shared = self.face_edges(other).filter(|edge| edges.contains(edge)).count();
        (opposed && other != face && shared == 1).then_some(longest)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::Vec3;
    use trigon_mesh::primitives;

    use super::super::InspectionSettings;
    use super::*;
    use crate::tests::meshes;

    #[test]
    fn loose_ends_and_doubles_are_removed_and_counted() {
        let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        let before = cube.clone();
        let [a, b] = [3.0, 4.0].map(|x| cube.add_vertex(Vec3::X * x).expect("room"));
        cube.add_edge(a, b).expect("two vertices");
        let vertices: Vec<VertexId> = cube.face_vertices(FaceId(1)).collect();
        cube.add_face(&vertices).expect("a second time");
        let found = cube.inspect(&InspectionSettings::default());
        assert_eq!(
            (found.loose_edges.len(), found.doubled_faces.len(), found.parts.len()),
            (1, 1, 1),
            "found"
        );
        assert_eq!(cube.remove_loose_edges(), Ok(1), "an edge");
        assert_eq!(cube.remove_loose_vertices(), Ok(2), "its ends");
        assert_eq!(cube.remove_doubled_faces(), Ok(1), "the second face");
        assert_eq!(cube.to_mesh().0, before.to_mesh().0, "as it was");
    }

    #[test]
    fn ends_at_one_place_become_one_vertex() {
        let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        let vertices: Vec<VertexId> = cube.face_vertices(FaceId(0)).collect();
        vertices.iter().for_each(|&vertex| cube.set_position(vertex, Vec3::Y * 3.0));
        assert_eq!(cube.collapse_zero_length_edges(1e-6), Ok(3), "four into one");
        cube.check_structure().expect("whole");
        assert_eq!((cube.vertex_count(), cube.face_count()), (5, 5), "a pyramid");
        assert!(cube.is_watertight(), "closed");
    }

    #[test]
    fn a_sliver_is_dissolved_and_the_solid_stays_closed() {
        let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        // A triangle without area along an edge of the cube.
        let corners: Vec<_> = cube.face_corners(FaceId(0)).collect();
        let edge = cube.corner_edge(corners[0]);
        let split = cube.split_edge(edge, 0.5).expect("it exists");
        let at = cube.face_corner_at(FaceId(0), split.vertex).expect("it is in the face");
        let (from, to) = (cube.previous_corner(at), cube.next_corner(at));
        cube.split_face(from, to).expect("a sliver");
        assert_eq!(cube.zero_area_faces(1e-12).len(), 1, "it has no area");
        assert_eq!(cube.dissolve_zero_area_faces(1e-12), Ok(1), "joined with the face beside it");
        cube.check_structure().expect("whole");
        assert!(cube.is_watertight() && cube.zero_area_faces(1e-12).is_empty(), "closed");
        // Summed over other triangles.
        assert!((cube.volume() - 8.0).abs() < 1e-12, "{}", cube.volume());
    }

    proptest! {
        /// Whatever is repaired, the structure is whole, findings are gone, and it can be undone.
        #[test]
        fn repairs_leave_none_of_their_findings(start in meshes(), kind in 0u8..5) {
            let (mut mesh, _) = EditMesh::from_mesh(&start);
            let before = mesh.clone();
            let repair = |mesh: &mut EditMesh| match kind {
                0 => mesh.remove_loose_edges(),
                1 => mesh.remove_loose_vertices(),
                2 => mesh.remove_doubled_faces(),
                3 => mesh.collapse_zero_length_edges(0.0),
                _ => mesh.dissolve_zero_area_faces(0.0),
            };
            let (_, mut difference) = mesh.transaction(repair).expect("it can always be done");
            prop_assert_eq!(mesh.check_structure(), Ok(()));
            let left = match kind {
                0 => mesh.loose_edges().len(),
                1 => mesh.loose_vertices().len(),
                2 => mesh.doubled_faces().len(),
                3 => mesh.zero_length_edges(0.0).len(),
                // Joining may make another one: two that fold onto each other.
                _ => 0,
            };
            prop_assert_eq!(left, 0);
            difference.apply(&mut mesh);
            prop_assert!(mesh == before);
        }
    }
}
