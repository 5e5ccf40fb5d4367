//! Mirroring: in place, or as a copy that may share the vertices on the plane.

use fixedbitset::FixedBitSet;
use smallvec::SmallVec;
use trigon_math::{DMat3, DVec3, Plane, Vec3};

use super::transform::GivenNormals;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::refusal::Refusal;
use crate::slots::NewElements;

/// A mirrored copy.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Mirrored {
    /// The new vertices.
    pub vertices: Vec<VertexId>,
    /// The new edges.
    pub edges: Vec<EdgeId>,
    /// The new faces.
    pub faces: Vec<FaceId>,
    /// The vertices on the plane, which both halves share.
    pub shared: Vec<VertexId>,
}

impl EditMesh {
    /// Mirrors vertices in place. Faces all of whose vertices are among them are flipped, so that their
    /// outside stays outside, and given normals and tangents of their corners are mirrored. At other faces of
    /// mirrored vertices, given normals are cleared. Morph target deltas of the vertices are mirrored, too.
    ///
    /// # Errors
    /// None is given, or one does not exist.
    pub fn mirror(&mut self, vertices: &[VertexId], plane: &Plane) -> Result<(), Refusal> {
        self.check_vertices(vertices, "mirroring")?;
        let mut vertices = vertices.to_vec();
        vertices.sort_unstable();
        vertices.dedup();
        let whole = self.faces_within(&vertices);
        let given = GivenNormals::at(self, &vertices, |_| true);
        for &vertex in &vertices {
            self.set_position(vertex, reflected(self.point(vertex), plane));
            self.vertex_layers.iter_mut().for_each(|layer| layer.reflect(vertex.0, plane.normal()));
        }
        given.apply(self, Some(&reflection(plane.normal())));
        whole.into_iter().try_for_each(|face| self.flip_face(face))
    }

    /// The faces all of whose vertices are among some.
    fn faces_within(&self, vertices: &[VertexId]) -> Vec<FaceId> {
        let mut is_given = FixedBitSet::with_capacity(self.vertex_capacity());
        vertices.iter().for_each(|vertex| is_given.insert(vertex.0 as usize));
        let mut visited = FixedBitSet::with_capacity(self.face_capacity());
        let faces = vertices.iter().flat_map(|&vertex| self.vertex_faces(vertex));
        let is_within =
            |face: FaceId| self.face_vertices(face).all(|vertex| is_given.contains(vertex.0 as usize));
        faces.filter(|face| !visited.put(face.0 as usize)).filter(|&face| is_within(face)).collect()
    }

    /// Adds a mirrored copy of faces, with their edges and vertices, and of other given edges.
    /// Copies of faces wind the other way, so that their outside is outside; all values and marks
    /// are copied, and directions mirrored.
    ///
    /// With a `merge_distance` (metres, from 0 on) vertices within that distance of the plane are
    /// moved onto it and shared by both halves. A face or edge entirely on the plane then gets no
    /// copy, which would be identical.
    ///
    /// # Errors
    /// Neither a face nor an edge is given, one does not exist, the distance is negative or not
    /// finite, or there is no room for the copy. Nothing is changed then.
    pub fn mirror_copy(
        &mut self,
        faces: &[FaceId],
        edges: &[EdgeId],
        plane: &Plane,
        merge_distance: Option<f64>,
    ) -> Result<Mirrored, Refusal> {
        if edges.is_empty() {
            self.check_faces(faces, "mirroring a copy")?;
        }
        faces.iter().try_for_each(|&face| self.check_face(face))?;
        edges.iter().try_for_each(|&edge| self.check_edge(edge))?;
        if let Some(distance) = merge_distance {
            check_merge_distance(distance)?;
        }
        self.check_capacity_for_copies(faces, edges.len())?;
        let is_near = |mesh: &Self, vertex: VertexId| {
            merge_distance.is_some_and(|most| plane.signed_distance(mesh.point(vertex)).abs() <= most)
        };
        self.whole(|mesh| Copy::make(mesh, faces, edges, plane, is_near))
    }

    /// Refuses copies of some faces and edges for which there is no room.
    pub(super) fn check_capacity_for_copies(&self, faces: &[FaceId], edges: usize) -> Result<(), Refusal> {
        let corners: usize = faces.iter().map(|&face| self.face_size(face)).sum();
        // Each corner has an edge of its own at most, and each edge two vertices.
        let (corners, edges) = (corners as u64, edges as u64);
        self.check_capacity_for(NewElements {
            vertices: corners + 2 * edges,
            edges: corners + edges,
            corners,
            faces: faces.len() as u64,
        })
    }

    /// Moves a vertex onto a plane.
    pub(super) fn snap_to_plane(&mut self, vertex: VertexId, plane: &Plane) {
        let point = self.point(vertex);
        let onto = point - plane.normal() * plane.signed_distance(point);
        self.set_position(vertex, onto.as_vec3());
    }

    /// The mirrored copy of faces that share the vertices for which `is_shared` returns true.
    pub(super) fn mirror_faces_sharing(
        &mut self,
        faces: &[FaceId],
        plane: &Plane,
        is_shared: impl Fn(&Self, VertexId) -> bool,
    ) -> Result<Mirrored, Refusal> {
        Copy::make(self, faces, &[], plane, is_shared)
    }
}

pub(super) fn check_merge_distance(value: f64) -> Result<(), Refusal> {
    if value >= 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(Refusal::OutOfRange { parameter: "the distance for merging", value, range: "at least 0 and finite" })
}

fn reflected(point: DVec3, plane: &Plane) -> Vec3 {
    (point - plane.normal() * (2.0 * plane.signed_distance(point))).as_vec3()
}

/// The matrix that mirrors directions (A. S. Householder, 1958).
fn reflection(normal: DVec3) -> DMat3 {
    let column = |axis: DVec3| axis - normal * (2.0 * normal.dot(axis));
    DMat3::from_cols(column(DVec3::X), column(DVec3::Y), column(DVec3::Z))
}

/// A copy in progress.
struct Copy<'a> {
    mesh: &'a mut EditMesh,
    plane: &'a Plane,
    /// For each old vertex, one more than the index of its copy; 0 without one.
    copies: Vec<u32>,
    visited_edges: FixedBitSet,
    made: Mirrored,
}

impl<'a> Copy<'a> {
    fn make(
        mesh: &'a mut EditMesh,
        faces: &[FaceId],
        edges: &[EdgeId],
        plane: &'a Plane,
        is_shared: impl Fn(&EditMesh, VertexId) -> bool,
    ) -> Result<Mirrored, Refusal> {
        let copies = vec![0; mesh.vertex_capacity()];
        let visited_edges = FixedBitSet::with_capacity(mesh.edge_capacity());
        let mut visited_faces = FixedBitSet::with_capacity(mesh.face_capacity());
        let mut copy = Self { mesh, plane, copies, visited_edges, made: Mirrored::default() };
        for &edge in edges {
            copy.edge(edge, &is_shared)?;
        }
        for &face in faces {
            if !visited_faces.put(face.0 as usize) {
                copy.face(face, &is_shared)?;
            }
        }
        Ok(copy.made)
    }

    /// The copy of a vertex: created now, known already, or the vertex itself.
    fn vertex(
        &mut self,
        vertex: VertexId,
        is_shared: &impl Fn(&EditMesh, VertexId) -> bool,
    ) -> Result<VertexId, Refusal> {
        let known = self.copies[vertex.0 as usize];
        if known > 0 {
            return Ok(VertexId(known - 1));
        }
        let copy = if is_shared(self.mesh, vertex) {
            self.mesh.snap_to_plane(vertex, self.plane);
            self.made.shared.push(vertex);
            vertex
        } else {
            let copy = self.mesh.add_vertex(reflected(self.mesh.point(vertex), self.plane))?;
            self.mesh.copy_vertex(vertex, copy);
            let normal = self.plane.normal();
            self.mesh.vertex_layers.iter_mut().for_each(|layer| layer.reflect(copy.0, normal));
            self.made.vertices.push(copy);
            copy
        };
        self.copies[vertex.0 as usize] = copy.0 + 1;
        Ok(copy)
    }

    fn edge(
        &mut self,
        edge: EdgeId,
        is_shared: &impl Fn(&EditMesh, VertexId) -> bool,
    ) -> Result<(), Refusal> {
        if self.visited_edges.put(edge.0 as usize) {
            return Ok(());
        }
        let [a, b] = self.mesh.edge_vertices(edge);
        let (a, b) = (self.vertex(a, is_shared)?, self.vertex(b, is_shared)?);
        let before = self.mesh.edge_count();
        let copy = self.mesh.add_edge(a, b)?;
        if self.mesh.edge_count() > before {
            self.mesh.copy_edge(edge, copy);
            self.made.edges.push(copy);
        }
        Ok(())
    }

    fn face(
        &mut self,
        face: FaceId,
        is_shared: &impl Fn(&EditMesh, VertexId) -> bool,
    ) -> Result<(), Refusal> {
        let mut corners: SmallVec<[CornerId; 8]> = self.mesh.face_corners(face).collect();
        for &corner in &corners {
            self.edge(self.mesh.corner_edge(corner), is_shared)?;
        }
        // The first corner stays first, the others follow in the opposite direction.
        corners[1..].reverse();
        let mut outline = SmallVec::<[VertexId; 8]>::new();
        let mut is_on_plane = true;
        for &corner in &corners {
            let vertex = self.mesh.corner_vertex(corner);
            let copy = self.vertex(vertex, is_shared)?;
            is_on_plane &= copy == vertex;
            outline.push(copy);
        }
        if is_on_plane {
            return Ok(());
        }
        let copy = self.mesh.add_face(&outline)?;
        self.mesh.copy_face(face, copy);
        let new_corners: SmallVec<[CornerId; 8]> = self.mesh.face_corners(copy).collect();
        for (&from, &to) in corners.iter().zip(&new_corners) {
            self.mesh.copy_corner(from, to);
            let normal = self.plane.normal();
            self.mesh.corner_layers.iter_mut().for_each(|layer| layer.reflect(to.0, normal));
        }
        self.made.faces.push(copy);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_mesh::primitives;

    use super::*;
    use crate::tests::meshes;

    fn plane(point: DVec3, normal: DVec3) -> Plane {
        Plane::from_point_and_normal(point, normal).expect("a plane")
    }

    fn all_faces(mesh: &EditMesh) -> Vec<FaceId> {
        mesh.faces().collect()
    }

    #[test]
    fn half_a_box_and_its_copy_are_a_closed_box() {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        let left = mesh.faces().find(|&face| mesh.face_normal(face) == DVec3::NEG_X).expect("six faces");
        mesh.delete_faces(&[left]).expect("it exists");
        let edge = mesh.edges().next().expect("edges");
        mesh.set_crease(edge, 0.5);
        let faces = all_faces(&mesh);
        let x = plane(DVec3::NEG_X, DVec3::X);
        let made = mesh.mirror_copy(&faces, &[], &x, Some(1e-6)).expect("it is possible");
        assert_eq!((made.vertices.len(), made.edges.len(), made.faces.len()), (4, 8, 5), "the other half");
        assert_eq!(made.shared.len(), 4, "the four of the opening");
        assert_eq!(mesh.edges().filter(|&edge| mesh.crease(edge) == 0.5).count(), 2, "marks are copied");
        mesh.check_structure().expect("whole");
        let (solid, _) = mesh.to_mesh();
        assert!(solid.is_closed(), "no gap");
        assert_eq!(solid.volume(), 16.0, "four by two by two");
    }

    #[test]
    fn without_a_distance_nothing_is_shared_and_wires_come_along() {
        let mut mesh = EditMesh::new();
        let a = mesh.add_vertex(Vec3::ZERO).expect("room");
        let b = mesh.add_vertex(Vec3::X).expect("room");
        let wire = mesh.add_edge(a, b).expect("two vertices");
        let x = plane(DVec3::ZERO, DVec3::X);
        let made = mesh.mirror_copy(&[], &[wire, wire], &x, None).expect("it is possible");
        assert_eq!((made.vertices.len(), made.edges.len()), (2, 1), "a copy of its own");
        assert_eq!(mesh.position(made.vertices[1]), Vec3::NEG_X, "mirrored");
        let made = mesh.mirror_copy(&[], &[wire], &x, Some(0.0)).expect("it is possible");
        assert_eq!((made.vertices.len(), made.shared.len()), (1, 1), "exactly on the plane");
        assert!(mesh.mirror_copy(&[], &[], &x, None).is_err(), "nothing is given");
        assert!(mesh.mirror_copy(&[], &[wire], &x, Some(-1.0)).is_err(), "no distance");
    }

    #[test]
    fn a_face_on_the_plane_is_not_doubled() {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        let faces = all_faces(&mesh);
        let made = mesh.mirror_copy(&faces, &[], &plane(DVec3::X, DVec3::X), Some(0.0)).expect("possible");
        assert_eq!((made.faces.len(), mesh.face_count()), (5, 11), "the middle wall stays single");
    }

    #[test]
    fn given_normals_are_mirrored_in_both_ways_to_mirror() {
        let mut start = primitives::cone(1.0, 2.0, 7);
        start.smooth_by_angle(1.0);
        let (start, _) = EditMesh::from_mesh(&start);
        let tilted = plane(DVec3::new(0.5, 0.0, 0.25), DVec3::new(1.0, 2.0, -0.5));
        let matrix = reflection(tilted.normal());
        let mut moved = start.clone();
        let vertices: Vec<VertexId> = moved.vertices().collect();
        moved.mirror(&vertices, &tilted).expect("it is possible");
        for corner in moved.corners() {
            let expected = matrix * start.custom_normal(corner).expect("given").as_dvec3();
            let found = moved.custom_normal(corner).expect("given").as_dvec3();
            // Rounded to f32.
            assert!(found.abs_diff_eq(expected, 1e-7), "{corner}");
        }
        assert!(moved.to_mesh().0.volume() > 0.0, "outside stays outside");

        let mut copied = start.clone();
        let made = copied.mirror_copy(&all_faces(&start), &[], &tilted, None).expect("it is possible");
        for (&old, &new) in all_faces(&start).iter().zip(&made.faces) {
            let first = |mesh: &EditMesh, face| {
                let corner = mesh.face_corners(face).next().expect("at least three");
                mesh.custom_normal(corner).expect("given").as_dvec3()
            };
            assert!(first(&copied, new).abs_diff_eq(matrix * first(&start, old), 1e-7), "{new}");
        }
    }

    proptest! {
        /// Mirrored twice, every position is restored up to rounding, and the winding exactly.
        #[test]
        fn mirrored_twice_is_not_mirrored(start in meshes()) {
            let (mut mesh, _) = EditMesh::from_mesh(&start);
            let before = mesh.clone();
            let vertices: Vec<VertexId> = mesh.vertices().collect();
            let x = plane(DVec3::X, DVec3::X);
            mesh.mirror(&vertices, &x).expect("it is possible");
            prop_assert_eq!(mesh.check_structure(), Ok(()));
            mesh.mirror(&vertices, &x).expect("it is possible");
            for vertex in mesh.vertices() {
                // About x = 1 a coordinate is rounded once on each way.
                prop_assert!(mesh.position(vertex).abs_diff_eq(before.position(vertex), 1e-6));
            }
            for face in mesh.faces() {
                prop_assert!(mesh.face_corners(face).eq(before.face_corners(face)));
            }
        }

        /// A copy is closed if the original is, flips no old element, and can be undone.
        #[test]
        fn a_copy_is_as_closed_as_the_original(start in meshes(), at in -1.0f64..1.0) {
            let (mut mesh, _) = EditMesh::from_mesh(&start);
            let faces = all_faces(&mesh);
            prop_assume!(!faces.is_empty());
            let before = mesh.clone();
            let x = plane(DVec3::X * at, DVec3::X);
            let (made, mut difference) =
                mesh.transaction(|mesh| mesh.mirror_copy(&faces, &[], &x, None)).expect("it is possible");
            prop_assert_eq!(mesh.check_structure(), Ok(()));
            prop_assert_eq!(made.faces.len(), faces.len());
            let open = |mesh: &EditMesh| mesh.edges().filter(|&edge| mesh.is_boundary(edge)).count();
            prop_assert_eq!(open(&mesh), 2 * open(&before));
            difference.apply(&mut mesh);
            prop_assert!(mesh == before);
        }
    }
}
