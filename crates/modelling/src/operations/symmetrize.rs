//! Symmetrizing: one side of a plane replaces the other.

use fixedbitset::FixedBitSet;
use smallvec::SmallVec;
use trigon_math::{DVec3, Plane};

use super::mirror::{Mirrored, check_merge_distance};
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::refusal::Refusal;

/// The result of symmetrizing.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Symmetrized {
    /// The new half, and the vertices of the middle.
    pub mirrored: Mirrored,
    /// The faces of the kept half, including those on the plane.
    pub retained: Vec<FaceId>,
    /// The number of faces removed on the other side, including parts of cut ones.
    pub removed: usize,
}

impl EditMesh {
    /// Makes faces symmetric about a plane: removes what is behind it, and adds a mirrored copy of what is in
    /// front (the side of its normal). Faces and edges that cross the plane are cut along it, with
    /// interpolated values. Vertices within `merge_distance` (metres, from 0 on) of the plane are moved onto
    /// it. The halves share the vertices there, so that there are no duplicates, and a face on the plane
    /// stays as it is.
    ///
    /// Other faces, and edges without faces, are unchanged. A vertex whose position is NaN counts
    /// as in front: nothing is removed for it.
    ///
    /// # Errors
    /// No face is given, one does not exist, none is in front of the plane, or the distance is negative or
    /// not finite. Or a face crosses the plane so that no cuts between its corners divide it: triangulate it
    /// first. Nothing is changed then.
    pub fn symmetrize(
        &mut self,
        faces: &[FaceId],
        plane: &Plane,
        merge_distance: f64,
    ) -> Result<Symmetrized, Refusal> {
        self.check_faces(faces, "symmetrizing")?;
        check_merge_distance(merge_distance)?;
        // Twice, since faces that cross the plane are cut.
        self.check_capacity_for_copies(&[faces, faces].concat(), 0)?;
        self.whole(|mesh| {
            let mut halves = Halves::of(mesh, faces, plane, merge_distance);
            let pieces = halves.cut(mesh, faces)?;
            let is_behind = |face: &FaceId| halves.has(mesh, *face, Side::Behind);
            let (removed, retained): (Vec<FaceId>, Vec<FaceId>) = pieces.iter().copied().partition(is_behind);
            if !retained.iter().any(|&face| halves.has(mesh, face, Side::InFront)) {
                return refused("no face is in front of the plane; turn it around");
            }
            if !removed.is_empty() {
                mesh.delete_faces(&removed)?;
            }
            let is_middle = |_: &Self, vertex| halves.side(vertex) == Side::Middle;
            let mirrored = mesh.mirror_faces_sharing(&retained, plane, is_middle)?;
            Ok(Symmetrized { mirrored, retained, removed: removed.len() })
        })
    }
}

fn refused<T>(reason: &'static str) -> Result<T, Refusal> {
    Err(Refusal::NotPossible { operation: "symmetrizing", reason })
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    InFront,
    Middle,
    Behind,
}

/// On which side vertices are.
struct Halves<'a> {
    plane: &'a Plane,
    /// By vertex; those of other faces count as in front.
    sides: Vec<Side>,
}

impl<'a> Halves<'a> {
    /// Tells the sides of all vertices of some faces, and moves those near the plane onto it.
    fn of(mesh: &mut EditMesh, faces: &[FaceId], plane: &'a Plane, merge_distance: f64) -> Self {
        let mut halves = Self { plane, sides: vec![Side::InFront; mesh.vertex_capacity()] };
        let mut vertices: Vec<VertexId> = faces.iter().flat_map(|&face| mesh.face_vertices(face)).collect();
        vertices.sort_unstable();
        vertices.dedup();
        for vertex in vertices {
            let distance = plane.signed_distance(mesh.point(vertex));
            if distance.abs() <= merge_distance {
                mesh.snap_to_plane(vertex, plane);
                halves.sides[vertex.0 as usize] = Side::Middle;
            } else if distance < 0.0 {
                halves.sides[vertex.0 as usize] = Side::Behind;
            }
        }
        halves
    }

    fn side(&self, vertex: VertexId) -> Side {
        self.sides[vertex.0 as usize]
    }

    fn has(&self, mesh: &EditMesh, face: FaceId, side: Side) -> bool {
        mesh.face_vertices(face).any(|vertex| self.side(vertex) == side)
    }

    fn crosses(&self, mesh: &EditMesh, face: FaceId) -> bool {
        self.has(mesh, face, Side::InFront) && self.has(mesh, face, Side::Behind)
    }

    /// Cuts all faces along the plane. All of their pieces, each face once.
    fn cut(&mut self, mesh: &mut EditMesh, faces: &[FaceId]) -> Result<Vec<FaceId>, Refusal> {
        let mut listed = FixedBitSet::with_capacity(mesh.face_capacity());
        let mut pieces: Vec<FaceId> = faces.to_vec();
        pieces.retain(|face| !listed.put(face.0 as usize));
        let mut edges: Vec<EdgeId> = pieces.iter().flat_map(|&face| mesh.face_edges(face)).collect();
        edges.sort_unstable();
        edges.dedup();
        for edge in edges {
            self.cut_edge(mesh, edge)?;
        }
        for index in 0..pieces.len() {
            let face = pieces[index];
            if self.crosses(mesh, face) {
                let first = pieces.len();
                self.cut_face(mesh, face, &mut pieces)?;
                if pieces[first..].iter().chain([&face]).any(|&piece| self.crosses(mesh, piece)) {
                    return cannot_cut();
                }
            }
        }
        Ok(pieces)
    }

    /// Puts a vertex where an edge crosses the plane.
    fn cut_edge(&mut self, mesh: &mut EditMesh, edge: EdgeId) -> Result<(), Refusal> {
        let ends = mesh.edge_vertices(edge);
        let sides = ends.map(|vertex| self.side(vertex));
        if sides != [Side::InFront, Side::Behind] && sides != [Side::Behind, Side::InFront] {
            return Ok(());
        }
        let [a, b] = ends.map(|vertex| self.plane.signed_distance(mesh.point(vertex)));
        // The ends are on different sides: the difference is not zero, and t is within 0 and 1. It
        // is not a number where an end is not, or is at infinity.
        let t = a / (a - b);
        let split = mesh.split_edge(edge, if t.is_finite() { t } else { 0.5 })?;
        mesh.snap_to_plane(split.vertex, self.plane);
        self.sides.resize(mesh.vertex_capacity(), Side::InFront);
        self.sides[split.vertex.0 as usize] = Side::Middle;
        Ok(())
    }

    /// Cuts a face that crosses the plane between the places where its outline does, taken in pairs
    /// along the plane: between the first and the second it is inside, then outside.
    fn cut_face(&self, mesh: &mut EditMesh, face: FaceId, pieces: &mut Vec<FaceId>) -> Result<(), Refusal> {
        let along = self.plane.normal().cross(mesh.face_normal(face));
        let mut crossings = self.crossings(mesh, face);
        let distance_along =
            |mesh: &EditMesh, corner: CornerId| along.dot(mesh.point(mesh.corner_vertex(corner)));
        crossings.sort_by(|a, b| distance_along(mesh, a[0]).total_cmp(&distance_along(mesh, b[0])));
        if !crossings.len().is_multiple_of(2) {
            return cannot_cut();
        }
        for pair in crossings.chunks_exact(2) {
            let (from, to) = nearest(mesh, pair[0], pair[1]);
            match mesh.split_face(from, to) {
                Ok(split) => pieces.push(split.face),
                Err(Refusal::NotPossible { .. }) => return cannot_cut(),
                Err(other) => return Err(other),
            }
        }
        Ok(())
    }

    /// Where the outline of a face goes from one side to the other: the first and the last corner
    /// on the plane there.
    fn crossings(&self, mesh: &EditMesh, face: FaceId) -> SmallVec<[[CornerId; 2]; 4]> {
        let side = |corner: &CornerId| self.side(mesh.corner_vertex(*corner));
        let mut corners: SmallVec<[CornerId; 8]> = mesh.face_corners(face).collect();
        // Begins off the plane, so that no row of corners on it is cut in two.
        let start = corners.iter().position(|corner| side(corner) != Side::Middle).unwrap_or(0);
        corners.rotate_left(start);
        let mut crossings = SmallVec::new();
        let mut last = side(&corners[0]);
        let mut row: Option<[CornerId; 2]> = None;
        for corner in corners.iter().chain([&corners[0]]) {
            match side(corner) {
                Side::Middle => row = Some([row.map_or(*corner, |[first, _]| first), *corner]),
                here => {
                    crossings.extend(row.take().filter(|_| here != last));
                    last = here;
                }
            }
        }
        crossings
    }
}

fn cannot_cut<T>() -> Result<T, Refusal> {
    refused("a face crosses the plane so that no straight cut divides it; triangulate it first")
}

/// The two corners, one of each row, that are nearest to each other.
fn nearest(mesh: &EditMesh, one: [CornerId; 2], two: [CornerId; 2]) -> (CornerId, CornerId) {
    let position = |corner: CornerId| -> DVec3 { mesh.point(mesh.corner_vertex(corner)) };
    let mut best = (one[0], two[0]);
    for a in one {
        for b in two {
            let distance = |(a, b)| position(a).distance_squared(position(b));
            if distance((a, b)) < distance(best) {
                best = (a, b);
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::Vec3;
    use trigon_mesh::primitives;

    use super::*;
    use crate::tests::{affine_uv, meshes, with_affine_values};

    fn x_plane(at: f64) -> Plane {
        Plane::from_point_and_normal(DVec3::X * at, DVec3::X).expect("a plane")
    }

    fn symmetrize(mesh: &mut EditMesh, plane: &Plane) -> Result<Symmetrized, Refusal> {
        let faces: Vec<FaceId> = mesh.faces().collect();
        mesh.symmetrize(&faces, plane, 1e-6)
    }

    #[test]
    fn a_cube_becomes_the_box_of_its_right_part() {
        let (mut cube, _) = EditMesh::from_mesh(&with_affine_values(primitives::cube(2.0)));
        let made = symmetrize(&mut cube, &x_plane(0.5)).expect("it is possible");
        cube.check_structure().expect("whole");
        assert_eq!((made.retained.len(), made.removed, made.mirrored.faces.len()), (5, 5, 5), "five of each");
        assert_eq!(
            (cube.vertex_count(), cube.edge_count(), cube.face_count()),
            (12, 20, 10),
            "with a middle"
        );
        let (solid, _) = cube.to_mesh();
        assert!(solid.is_closed(), "no gap");
        assert_eq!(solid.volume(), 4.0, "from 0 to 1, two by two");
        for &face in &made.retained {
            for corner in cube.face_corners(face) {
                let position = cube.position(cube.corner_vertex(corner));
                assert_eq!(cube.uv(0, corner), Some(affine_uv(position)), "interpolated at the cut");
            }
        }
        let again = symmetrize(&mut cube, &x_plane(0.5)).expect("it is possible");
        assert_eq!(
            (again.retained.len(), again.removed, cube.vertex_count()),
            (5, 5, 12),
            "nothing is doubled"
        );
    }

    #[test]
    fn a_concave_face_is_cut_in_all_places() {
        // A comb with two teeth to the left.
        let outline = [(2, 0), (2, 3), (-1, 3), (-1, 2), (1, 2), (1, 1), (-1, 1), (-1, 0)];
        let mut mesh = EditMesh::new();
        let vertices: Vec<VertexId> = outline
            .iter()
            .map(|&(x, y)| mesh.add_vertex(Vec3::new(x as f32, y as f32, 0.0)).expect("room"))
            .collect();
        let face = mesh.add_face(&vertices).expect("a simple outline");
        let area =
            |mesh: &EditMesh| -> f64 { mesh.faces().map(|face| mesh.face_area_vector(face).length()).sum() };
        assert_eq!(area(&mesh), 7.0, "nine less two");
        let made = mesh.symmetrize(&[face], &x_plane(0.0), 0.0).expect("two cuts");
        mesh.check_structure().expect("whole");
        assert_eq!((made.retained.len(), made.removed), (1, 2), "two teeth are cut off");
        assert_eq!(area(&mesh), 10.0, "five on each side");
        let normal = mesh.face_normal(made.retained[0]);
        assert!(mesh.faces().all(|face| mesh.face_normal(face) == normal), "all look one way");
    }

    #[test]
    fn edges_on_the_plane_are_the_middle() {
        let (mut grid, _) = EditMesh::from_mesh(&primitives::grid(4.0, 1.0, 4, 1));
        let made = symmetrize(&mut grid, &x_plane(0.0)).expect("it is possible");
        assert_eq!((made.retained.len(), made.removed, made.mirrored.shared.len()), (2, 2, 2), "halves");
        assert_eq!((grid.vertex_count(), grid.edge_count(), grid.face_count()), (10, 13, 4), "as before");
        let before = grid.clone();
        let refusal = symmetrize(&mut grid, &x_plane(3.0)).expect_err("all is behind");
        assert!(refusal.to_string().contains("in front"), "{refusal}");
        assert!(grid == before, "nothing was done");
    }

    proptest! {
        /// All that was in front is there still, in one piece with its mirror image.
        #[test]
        fn both_sides_are_alike_and_the_kept_half_is_whole(start in meshes(), at in -1.0f64..1.0) {
            let (mut mesh, _) = EditMesh::from_mesh(&start);
            prop_assume!(mesh.face_count() > 0);
            let before = mesh.clone();
            let plane = x_plane(at);
            let result = mesh.transaction(|mesh| symmetrize(mesh, &plane));
            prop_assert_eq!(mesh.check_structure(), Ok(()));
            let Ok((made, mut difference)) = result else {
                prop_assert!(mesh == before, "a refusal changes nothing");
                return Ok(());
            };
            let distance = |mesh: &EditMesh, vertex| plane.signed_distance(mesh.point(vertex));
            for vertex in before.vertices().filter(|&vertex| distance(&before, vertex) > 1e-6) {
                prop_assert_eq!(mesh.position(vertex), before.position(vertex), "kept");
            }
            for face in before.faces() {
                let is_kept = before.face_vertices(face).all(|vertex| distance(&before, vertex) > 1e-6);
                prop_assert!(!is_kept || mesh.has_face(face), "{} was in front", face);
            }
            // As much area on either side.
            let area = |side: f64| -> f64 {
                let is_there = |face: &FaceId| (plane.signed_distance(mesh.face_center(*face)) * side) > 1e-5;
                mesh.faces().filter(is_there).map(|face| mesh.face_area_vector(face).length()).sum()
            };
            let (front, behind) = (area(1.0), area(-1.0));
            // Mirrored places are rounded to f32.
            prop_assert!((front - behind).abs() <= 1e-4 * (1.0 + front), "{} and {}", front, behind);
            let is_wall = |&face: &FaceId| mesh.face_vertices(face).all(|vertex| distance(&mesh, vertex).abs() <= 1e-6);
            if start.is_closed() && !made.retained.iter().any(is_wall) {
                // Four sides meet where the kept half only touches the plane with an edge.
                let fits = |edge| mesh.edge_corners(edge).count() % 2 == 0;
                prop_assert!(mesh.edges().all(fits), "the middle fits");
            }
            prop_assert!(!made.retained.is_empty());
            difference.apply(&mut mesh);
            prop_assert!(mesh == before, "undone");
        }
    }
}
