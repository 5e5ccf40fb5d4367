//! Extending vertices: a new vertex on an edge at each of them.

use trigon_math::DVec3;

use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, VertexId};
use crate::numbering::sorted_once;
use crate::operations::delete::require;
use crate::refusal::Refusal;
use crate::slots::NewElements;

const EXTENDING: &str = "extending vertices";

impl EditMesh {
    /// Gives each vertex a new one beside it, in the same position, on the edge that is closest to a direction, and in
    /// the faces of that edge ([`Self::edge_towards`]); a vertex without edges gets a loose edge to its new one. What is extended is seen once
    /// the new vertices are moved, which are returned. Values at the new vertices are those of the old ones.
    ///
    /// # Errors
    /// No vertex is given, or one does not exist; there would be too many elements.
    pub fn extend_vertices(
        &mut self,
        vertices: &[VertexId],
        direction: DVec3,
    ) -> Result<Vec<VertexId>, Refusal> {
        require(vertices, EXTENDING, "at least one vertex")?;
        vertices.iter().try_for_each(|&vertex| self.check_vertex(vertex))?;
        let vertices = sorted_once(vertices.to_vec());
        let edges: Vec<Option<EdgeId>> =
            vertices.iter().map(|&vertex| self.edge_towards(vertex, direction)).collect();
        let faces = |edge: &Option<EdgeId>| edge.map_or(0, |edge| self.edge_faces(edge).count() as u64);
        self.check_capacity_for(NewElements {
            corners: edges.iter().map(faces).sum(),
            faces: 0,
            ..NewElements::each(vertices.len())
        })?;
        self.whole(|mesh| vertices.iter().map(|&vertex| mesh.extend_vertex(vertex, direction)).collect())
    }

    fn extend_vertex(&mut self, vertex: VertexId, direction: DVec3) -> Result<VertexId, Refusal> {
        // Another vertex may have divided the edge that was found before.
        let Some(edge) = self.edge_towards(vertex, direction) else {
            let twin = self.twin_vertex(vertex);
            self.fresh_edge(vertex, twin);
            return Ok(twin);
        };
        let at = if self.edge_vertices(edge)[0] == vertex { 0.0 } else { 1.0 };
        Ok(self.split_edge(edge, at)?.vertex)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_mesh::primitives;

    use super::*;
    use crate::tests::{check_operation, keeps_affine_values, meshes, with_affine_values};

    #[test]
    fn a_corner_of_a_square_is_extended_along_a_side() {
        let (mut mesh, _) = EditMesh::from_mesh(&with_affine_values(primitives::grid(2.0, 2.0, 1, 1)));
        let corner = mesh.vertices().find(|&vertex| mesh.position(vertex).x < 0.0).expect("two");
        let made = mesh.extend_vertices(&[corner], DVec3::X).expect("a corner");
        mesh.check_structure().expect("whole");
        assert_eq!([mesh.vertex_count(), mesh.edge_count(), mesh.face_count()], [5, 5, 1]);
        assert_eq!(mesh.position(made[0]), mesh.position(corner));
        keeps_affine_values(&mesh).expect("those of the corner");
        let edge = mesh.find_edge(made[0], corner).expect("between both");
        assert!(mesh.is_boundary(edge));
        let on_the_way = mesh.vertex_edges(made[0]).map(|edge| mesh.other_vertex(edge, made[0]));
        let other = on_the_way.into_iter().find(|&end| end != corner).expect("two edges");
        assert!(mesh.position(other).x > 0.0 && mesh.position(other).z == mesh.position(corner).z);
        let mut lone = EditMesh::new();
        let vertex = lone.add_vertex(trigon_math::Vec3::ONE).expect("room");
        lone.extend_vertices(&[vertex], DVec3::X).expect("a vertex");
        assert_eq!((lone.vertex_count(), lone.edge_count()), (2, 1), "a loose edge");
        assert!(lone.extend_vertices(&[], DVec3::X).is_err(), "nothing");
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn extending_keeps_every_rule(start in meshes(), bits in any::<u64>(), x in -1.0_f64..1.0) {
            let (mesh, _) = EditMesh::from_mesh(&start);
            let vertices: Vec<VertexId> =
                mesh.vertices().filter(|vertex| bits >> (vertex.0 % 64) & 1 != 0).collect();
            let direction = DVec3::new(x, 0.5, -x);
            let outcome = check_operation(&mesh, |mesh| mesh.extend_vertices(&vertices, direction));
            if let Some((after, made)) = outcome.map_err(TestCaseError::fail)? {
                prop_assert_eq!(made.len(), vertices.len());
                prop_assert_eq!(after.vertex_count(), mesh.vertex_count() + made.len());
                prop_assert_eq!(after.edge_count(), mesh.edge_count() + made.len());
                prop_assert_eq!(after.face_count(), mesh.face_count());
                for (&vertex, &new) in vertices.iter().zip(&made) {
                    prop_assert!(after.find_edge(vertex, new).is_some());
                }
            }
        }
    }
}
