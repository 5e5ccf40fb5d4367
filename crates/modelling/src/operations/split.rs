//! Splitting: faces are detached from the rest and stay in the mesh.

use super::region::{Region, SplitVertices};
use crate::edit_mesh::EditMesh;
use crate::ids::{FaceId, VertexId};
use crate::refusal::Refusal;
use crate::slots::NewElements;

impl EditMesh {
    /// Detaches faces from the rest of the mesh, in place: where they shared edges and vertices with other
    /// faces or loose edges, these get new ones, with the same values and marks. The given faces stay joined
    /// to each other. Returns the new vertices of the rest.
    ///
    /// # Errors
    /// No face is given, or one does not exist; nothing else is joined to the faces; there would be too
    /// many elements.
    pub fn split_off(&mut self, faces: &[FaceId]) -> Result<Vec<VertexId>, Refusal> {
        let region = Region::new(self, faces, "splitting off")?;
        let mut border = region.border(self);
        border.retain(|edge| edge.outer.is_some());
        let vertices = region.vertices(self);
        let (split, edges) = (vertices.len() as u64, border.len() as u64);
        self.check_capacity_for(NewElements { vertices: split, edges, ..NewElements::default() })?;
        let mut splits = SplitVertices::new(self, vertices.len());
        for &vertex in &vertices {
            if self.has_others(vertex, &region) {
                splits.split(self, vertex);
            }
        }
        if splits.list.is_empty() {
            let reason = "nothing else is joined to these faces; select a part of them";
            return Err(Refusal::NotPossible { operation: "splitting off", reason });
        }
        self.part_from_outside(&region, &border, &splits);
        Ok(splits.list.iter().map(|split| split.base).collect())
    }

    /// Whether a vertex has loose edges or faces outside of a region.
    fn has_others(&self, vertex: VertexId, region: &Region) -> bool {
        self.vertex_edges(vertex).any(|edge| {
            let mut faces = self.edge_faces(edge);
            let is_loose = faces.clone().next().is_none();
            is_loose || faces.any(|face| !region.contains(face))
        })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_mesh::primitives;

    use super::super::region::tests::{check_change, chosen_faces, counts, open_edges};
    use super::*;
    use crate::tests::{keeps_affine_values, meshes, with_affine_values};

    #[test]
    fn a_cubes_lid_comes_off_and_stays_in_the_mesh() {
        let start = with_affine_values(primitives::cube(2.0));
        let (mesh, new) = check_change(&start, |mesh| mesh.split_off(&[FaceId(4)])).expect("a face");
        assert_eq!(counts(&mesh), [12, 16, 6], "four vertices and edges are there twice");
        assert_eq!((new.len(), open_edges(&mesh)), (4, 8), "two open borders");
        let before = EditMesh::from_mesh(&start).0;
        assert!(mesh.face_vertices(FaceId(4)).eq(before.face_vertices(FaceId(4))), "the lid keeps its own");
    }

    #[test]
    fn what_is_joined_to_nothing_cannot_be_split_off() {
        let all: Vec<FaceId> = (0..6).map(FaceId).collect();
        let whole = check_change(&primitives::cube(2.0), |mesh| mesh.split_off(&all));
        assert!(matches!(whole, Err(Refusal::NotPossible { .. })), "there is nothing else");
    }

    proptest! {
        #[test]
        fn no_face_outside_shares_a_vertex_with_what_was_split_off(start in meshes(), bits in any::<u64>()) {
            let faces = chosen_faces(&start, bits);
            if let Ok((mesh, _)) = check_change(&start, |mesh| mesh.split_off(&faces)) {
                prop_assert_eq!(mesh.face_count(), start.face_count());
                prop_assert_eq!(keeps_affine_values(&mesh), Ok(()));
                for &face in &faces {
                    let mut around = mesh.face_vertices(face).flat_map(|vertex| mesh.vertex_faces(vertex));
                    prop_assert!(around.all(|other| faces.contains(&other)), "{} is still joined", face);
                }
            }
        }
    }
}
