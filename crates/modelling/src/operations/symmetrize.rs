//! Symmetrizing: one side of a plane replaces the other.

use trigon_math::Plane;

use super::halves::{Halves, Side};
use super::mirror::{Mirrored, check_merge_distance};
use crate::edit_mesh::EditMesh;
use crate::ids::FaceId;
use crate::numbering::sorted_once;
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
        self.check_faces(faces, OPERATION)?;
        check_merge_distance(merge_distance)?;
        // Twice, since faces that cross the plane are cut.
        self.check_capacity_for_copies(&[faces, faces].concat(), 0)?;
        self.whole(|mesh| {
            let mut halves = snapped(mesh, faces, plane, merge_distance);
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

/// Tells the sides of all vertices of some faces, and moves those near the plane onto it.
fn snapped<'a>(mesh: &mut EditMesh, faces: &[FaceId], plane: &'a Plane, merge_distance: f64) -> Halves<'a> {
    let mut halves = Halves::new(mesh, plane, OPERATION);
    let vertices = sorted_once(faces.iter().flat_map(|&face| mesh.face_vertices(face)).collect());
    for vertex in vertices {
        let distance = plane.signed_distance(mesh.point(vertex));
        if distance.abs() <= merge_distance {
            mesh.snap_to_plane(vertex, plane);
            halves.set_side(vertex, Side::Middle);
        } else if distance < 0.0 {
            halves.set_side(vertex, Side::Behind);
        }
    }
    halves
}

const OPERATION: &str = "symmetrizing";

fn refused<T>(reason: &'static str) -> Result<T, Refusal> {
    Err(Refusal::NotPossible { operation: OPERATION, reason })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::{DVec3, Vec3};
    use trigon_mesh::primitives;

    use super::*;
    use crate::ids::VertexId;
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
