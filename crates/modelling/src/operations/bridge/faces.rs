//! Bridging two regions of faces: a handle, or a hole through a solid.

use super::BridgeSettings;
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId};
use crate::operations::fill::Filled;
use crate::refusal::Refusal;

impl EditMesh {
    /// Removes faces and joins the remaining outlines with a strip of faces, as
    /// [`bridge_edges`](Self::bridge_edges) does. Given edges that belong to none of the faces are also part
    /// of the loops: the other end may be a hole.
    ///
    /// # Errors
    /// One does not exist, or the outlines are not two loops without a common vertex; a parameter is out of
    /// range; there would be too many elements.
    pub fn bridge_faces(
        &mut self,
        faces: &[FaceId],
        edges: &[EdgeId],
        settings: &BridgeSettings,
    ) -> Result<Filled, Refusal> {
        faces.iter().try_for_each(|&face| self.check_face(face))?;
        edges.iter().try_for_each(|&edge| self.check_edge(edge))?;
        let mut sorted = faces.to_vec();
        sorted.sort_unstable();
        sorted.dedup();
        let is_removed = |face: FaceId| sorted.binary_search(&face).is_ok();
        let mut own: Vec<EdgeId> = sorted.iter().flat_map(|&face| self.face_edges(face)).collect();
        own.sort_unstable();
        own.dedup();
        let removed_at = |edge: EdgeId| self.edge_faces(edge).filter(|&face| is_removed(face)).count();
        // An edge between two of the faces is inside the region, and is removed with them.
        let (outline, inner): (Vec<EdgeId>, Vec<EdgeId>) =
            own.iter().copied().partition(|&edge| removed_at(edge) == 1);
        let mut loops: Vec<EdgeId> =
            edges.iter().copied().filter(|edge| own.binary_search(edge).is_err()).collect();
        loops.extend(outline);
        self.whole(|mesh| {
            sorted.iter().try_for_each(|&face| mesh.remove_face(face))?;
            mesh.remove_loose(&inner);
            mesh.bridge_edges(&loops, settings)
        })
    }
}

#[cfg(test)]
mod tests {

    use trigon_math::DVec3;
    use trigon_mesh::primitives;

    use super::*;
    use crate::Inset;

    /// The faces of a block of 3×3×3 whose middles are there.
    fn faces_at(mesh: &EditMesh, is_there: impl Fn(DVec3) -> bool) -> Vec<FaceId> {
        mesh.faces().filter(|&face| is_there(mesh.face_center(face))).collect()
    }

    /// A cube whose two sides in x are cut into nine squares each.
    fn block() -> EditMesh {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        let sides = faces_at(&mesh, |middle| middle.x.abs() > 0.9);
        mesh.inset_individual(&sides, Inset { thickness: 0.5, ..Inset::default() }).expect("a rim on both");
        mesh
    }

    #[test]
    fn two_faces_of_a_block_become_a_hole_through_it() {
        let mut mesh = block();
        let ends = faces_at(&mesh, |middle| middle.x.abs() > 0.9 && middle.y.abs() + middle.z.abs() < 0.1);
        assert_eq!(ends.len(), 2, "one on each side");
        let made = mesh.bridge_faces(&ends, &[], &BridgeSettings::default()).expect("two loops");
        mesh.check_structure().expect("whole");
        assert_eq!(made.faces.len(), 4, "the sides of the hole");
        let [v, e, f] = [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()];
        assert_eq!(v + f, e, "genus 1");
        assert!(mesh.edges().all(|edge| mesh.edge_faces(edge).count() == 2), "closed");
    }

    #[test]
    fn a_region_and_a_hole_are_joined_and_a_refusal_changes_nothing() {
        let mut mesh = block();
        let end = |mesh: &EditMesh, side: f64| {
            faces_at(mesh, |middle| middle.x * side > 0.9 && middle.y.abs() + middle.z.abs() < 0.1)
        };
        let (one, other) = (end(&mesh, 1.0), end(&mesh, -1.0));
        let counts = |mesh: &EditMesh| [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()];
        let before = counts(&mesh);
        mesh.bridge_faces(&one, &[], &BridgeSettings::default()).expect_err("one loop alone");
        assert_eq!(counts(&mesh), before, "as it was");
        let hole: Vec<EdgeId> = mesh.face_edges(other[0]).collect();
        mesh.delete_faces(&other).expect("it is there");
        mesh.bridge_faces(&one, &hole, &BridgeSettings::default()).expect("a face and a hole");
        mesh.check_structure().expect("whole");
        assert!(mesh.edges().all(|edge| mesh.edge_faces(edge).count() == 2), "closed");
    }

    #[test]
    fn what_lies_within_a_region_is_removed() {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::grid(2.0, 2.0, 6, 2));
        let all = mesh.face_count();
        let faces = faces_at(&mesh, |middle| middle.x.abs() > 0.4);
        let (left, right): (Vec<FaceId>, Vec<FaceId>) =
            faces.iter().partition(|&&face| mesh.face_center(face).x < 0.0);
        assert_eq!((left.len(), right.len(), all), (4, 4, 12), "two columns of two at each end");
        mesh.bridge_faces(&faces, &[], &BridgeSettings::default()).expect("two loops");
        mesh.check_structure().expect("whole");
        assert!(mesh.vertices().all(|vertex| mesh.vertex_edges(vertex).next().is_some()), "no loose vertex");
    }
}
