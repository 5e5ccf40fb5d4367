//! Unwrapping again after pins were moved: "live unwrap".

use fixedbitset::FixedBitSet;

use super::charts::{UvChart, charts};
use super::{UnwrapSettings, Unwrapped};
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, FaceId};
use crate::numbering::sorted_once;
use crate::refusal::Refusal;

impl EditMesh {
    /// Unwraps the parts again, between seams and hidden faces, of which some pinned corners were moved and others were
    /// not. All others are unchanged.
    ///
    /// # Errors
    /// Those of [`Self::unwrap_faces`].
    pub fn unwrap_around_moved_pins(
        &mut self,
        moved: &[CornerId],
        settings: &UnwrapSettings,
    ) -> Result<Unwrapped, Refusal> {
        let is_pinned = |corner: CornerId| self.is_uv_pinned(settings.uv_set, corner);
        let moved: Vec<CornerId> = moved.iter().copied().filter(|&corner| is_pinned(corner)).collect();
        let moved = sorted_once(moved);
        let follows = |chart: &UvChart| {
            let pinned = || chart.corners.iter().map(|at| at.corner).filter(|&corner| is_pinned(corner));
            let was_moved = |corner: CornerId| moved.binary_search(&corner).is_ok();
            pinned().any(was_moved) && !pinned().all(was_moved)
        };
        let around = self.faces_between_seams(moved.iter().map(|&corner| self.corner_face(corner)).collect());
        let charts = charts(self, &around, |edge, _| !self.is_seam(edge));
        let corners = charts.iter().filter(|chart| follows(chart)).flat_map(|chart| &chart.corners);
        let faces: Vec<FaceId> = sorted_once(corners.map(|at| self.corner_face(at.corner)).collect());
        if faces.is_empty() {
            return Ok(Unwrapped::default());
        }
        self.unwrap_faces(&faces, settings)
    }

    /// The faces in view that are reached from some across edges that are no seams.
    fn faces_between_seams(&self, mut waiting: Vec<FaceId>) -> Vec<FaceId> {
        let mut found = FixedBitSet::with_capacity(self.face_capacity());
        waiting.retain(|&face| !self.is_face_hidden(face) && !found.put(face.0 as usize));
        while let Some(face) = waiting.pop() {
            for edge in self.face_edges(face).filter(|&edge| !self.is_seam(edge)) {
                let beside = self.edge_faces(edge).filter(|&other| !self.is_face_hidden(other));
                waiting.extend(beside.filter(|other| !found.put(other.0 as usize)));
            }
        }
        found.ones().map(|index| FaceId(index as u32)).collect()
    }
}

#[cfg(test)]
mod tests {
    use trigon_math::Vec2;
    use trigon_mesh::primitives;

    use super::*;
    use crate::ids::VertexId;

    fn uvs(mesh: &EditMesh, corners: &[CornerId]) -> Vec<Vec2> {
        corners.iter().map(|&corner| mesh.uv(0, corner).expect("the set exists")).collect()
    }

    /// Two halves of a grid, apart by a seam, each with two pins.
    #[test]
    fn only_the_part_of_a_moved_pin_follows() {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::grid(4.0, 2.0, 4, 2));
        let x = |mesh: &EditMesh, vertex: VertexId| mesh.position(vertex).x;
        let is_middle = |mesh: &EditMesh, vertex| x(mesh, vertex).abs() < 1e-3;
        let middle =
            mesh.edges().filter(|&edge| mesh.edge_vertices(edge).iter().all(|&v| is_middle(&mesh, v)));
        let middle: Vec<_> = middle.collect();
        mesh.mark_seams(&middle).expect("two");
        let faces: Vec<FaceId> = mesh.faces().collect();
        mesh.unwrap_faces(&faces, &UnwrapSettings::default()).expect("two halves");
        let ends = |mesh: &EditMesh, side: f32| -> Vec<CornerId> {
            mesh.corners().filter(|&corner| x(mesh, mesh.corner_vertex(corner)) * side > 1.9).collect()
        };
        let [left, right] = [ends(&mesh, -1.0), ends(&mesh, 1.0)];
        mesh.pin_uvs(0, &[&left[..], &right].concat()).expect("six vertices");
        let (mine, others): (Vec<CornerId>, Vec<CornerId>) = mesh.corners().partition(|&corner| {
            mesh.face_vertices(mesh.corner_face(corner)).all(|vertex| x(&mesh, vertex) < 1e-3)
        });
        let before = mesh.clone();
        let settings = UnwrapSettings::default();
        let still = mesh.unwrap_around_moved_pins(&left, &settings).expect("nothing follows");
        assert!(still == Unwrapped::default() && mesh == before, "all pins of a part were moved");
        let top: Vec<CornerId> = left
            .iter()
            .copied()
            .filter(|&corner| mesh.position(mesh.corner_vertex(corner)).z < -0.9)
            .collect();
        let away = mesh.uv(0, top[0]).expect("the set exists") + 0.25;
        top.iter().for_each(|&corner| mesh.set_uv(0, corner, away));
        let unwrapped = mesh.unwrap_around_moved_pins(&top, &settings).expect("it can be laid flat");
        assert_eq!((unwrapped.islands, unwrapped.pinned), (1, 1));
        assert_eq!(uvs(&mesh, &others), uvs(&before, &others), "the other half");
        assert!(top.iter().all(|&corner| mesh.uv(0, corner) == Some(away)), "the pin");
        let free: Vec<CornerId> =
            mine.iter().copied().filter(|&corner| !mesh.is_uv_pinned(0, corner)).collect();
        assert_ne!(uvs(&mesh, &free), uvs(&before, &free), "the rest follows");
        let all: Vec<FaceId> = mesh.faces().collect();
        let mut whole = mesh.clone();
        whole.unwrap_faces(&all, &settings).expect("both halves");
        assert_eq!(uvs(&whole, &mine), uvs(&mesh, &mine), "as an unwrapping of all");
    }
}
