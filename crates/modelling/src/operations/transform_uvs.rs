//! Moving texture coordinates by hand: which corners go together, and where they go.

use fixedbitset::FixedBitSet;
use trigon_math::{DAffine2, DVec2};

use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::refusal::Refusal;

const OPERATION: &str = "moving texture coordinates";

/// The elements whose texture coordinates are moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum UvElements<'e> {
    /// All corners at these vertices.
    Vertices(&'e [VertexId]),
    /// The corners at the ends of these edges, in the faces on both sides.
    Edges(&'e [EdgeId]),
    /// All corners of these faces.
    Faces(&'e [FaceId]),
}

impl EditMesh {
    /// The corners of elements, and those that share vertex and coordinates with one of them: so that an island is not
    /// torn where a part of it is moved. Each once, in the order of their ids; none where there is no such set.
    #[must_use]
    pub fn uv_corners(&self, uv_set: usize, elements: UvElements<'_>) -> Vec<CornerId> {
        if uv_set >= self.uv_set_count() {
            return Vec::new();
        }
        let mut own = FixedBitSet::with_capacity(self.corner_capacity());
        match elements {
            UvElements::Vertices(vertices) => {
                let corners = vertices.iter().flat_map(|&vertex| self.vertex_corners(vertex));
                corners.for_each(|corner| own.insert(corner.0 as usize));
            }
            UvElements::Edges(edges) => {
                for corner in edges.iter().flat_map(|&edge| self.edge_corners(edge)) {
                    own.insert(corner.0 as usize);
                    own.insert(self.next_corner(corner).0 as usize);
                }
            }
            UvElements::Faces(faces) => {
                let corners = faces.iter().flat_map(|&face| self.face_corners(face));
                corners.for_each(|corner| own.insert(corner.0 as usize));
            }
        }
        let mut all = own.clone();
        for corner in own.ones().map(|index| CornerId(index as u32)) {
            let uv = self.uv(uv_set, corner);
            let beside = self.vertex_corners(self.corner_vertex(corner));
            let shares = beside.filter(|&other| self.uv(uv_set, other) == uv);
            shares.for_each(|other| all.insert(other.0 as usize));
        }
        all.ones().map(|index| CornerId(index as u32)).collect()
    }

    /// Moves the texture coordinates of corners. v grows downwards in them, as in glTF.
    ///
    /// # Errors
    /// There is no such set, or the coordinates would not be finite.
    pub fn transform_uvs(
        &mut self,
        uv_set: usize,
        corners: &[CornerId],
        map: &DAffine2,
    ) -> Result<(), Refusal> {
        let not_possible = |reason| Refusal::NotPossible { operation: OPERATION, reason };
        if uv_set >= self.uv_set_count() {
            return Err(not_possible("there are no texture coordinates; unwrap the faces first"));
        }
        let moved = |corner| {
            let uv = self.uv(uv_set, corner).expect("the set exists").as_dvec2();
            map.transform_point2(uv).as_vec2()
        };
        let moved: Vec<_> = corners.iter().map(|&corner| moved(corner)).collect();
        if !moved.iter().all(|uv| uv.is_finite()) {
            return Err(not_possible("the coordinates would not be finite"));
        }
        for (&corner, uv) in corners.iter().zip(moved) {
            self.set_uv(uv_set, corner, uv);
        }
        Ok(())
    }

    /// The middle of the box around the texture coordinates of corners; `None` of no corner.
    #[must_use]
    pub fn uv_center(&self, uv_set: usize, corners: &[CornerId]) -> Option<DVec2> {
        let uvs = || corners.iter().filter_map(|&corner| self.uv(uv_set, corner)).map(|uv| uv.as_dvec2());
        let low = uvs().reduce(DVec2::min)?;
        let high = uvs().reduce(DVec2::max)?;
        Some((low + high) / 2.0)
    }

    /// The faces of the island of a face: those that are reached across edges with the same texture coordinates on both
    /// sides, in the order of their ids.
    #[must_use]
    pub fn uv_island(&self, uv_set: usize, face: FaceId) -> Vec<FaceId> {
        let mut found = FixedBitSet::with_capacity(self.face_capacity());
        let mut waiting = vec![face];
        found.insert(face.0 as usize);
        while let Some(face) = waiting.pop() {
            for corner in self.face_corners(face) {
                for other in self.edge_corners(self.corner_edge(corner)) {
                    let face = self.corner_face(other);
                    if self.shares_uvs(uv_set, corner, other) && !found.put(face.0 as usize) {
                        waiting.push(face);
                    }
                }
            }
        }
        found.ones().map(|index| FaceId(index as u32)).collect()
    }

    /// Whether two corners of one edge have the same texture coordinates at both of its ends.
    pub(super) fn shares_uvs(&self, uv_set: usize, a: CornerId, b: CornerId) -> bool {
        let at = |corner| (self.corner_vertex(corner), self.uv(uv_set, corner));
        let ends = |corner| [at(corner), at(self.next_corner(corner))];
        let ([a_first, a_second], [b_first, b_second]) = (ends(a), ends(b));
        (a_first == b_first && a_second == b_second) || (a_first == b_second && a_second == b_first)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::{Vec2, Vec3};
    use trigon_mesh::primitives;

    use super::*;

    /// A grid of faces with texture coordinates of its own in each face of the left half, and common ones in the right.
    fn grid() -> EditMesh {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::grid(2.0, 2.0, 4, 4));
        mesh.add_uv_set(0).expect("room");
        for corner in mesh.corners().collect::<Vec<_>>() {
            let Vec3 { x, z, .. } = mesh.position(mesh.corner_vertex(corner));
            let face = mesh.corner_face(corner);
            let left = mesh.face_vertices(face).all(|vertex| mesh.position(vertex).x <= 1e-6);
            let apart = if left { face.0 as f32 * 10.0 } else { 0.0 };
            mesh.set_uv(0, corner, Vec2::new(x + apart, z));
        }
        mesh
    }

    #[test]
    fn an_island_ends_where_coordinates_differ() {
        let mesh = grid();
        let sizes: Vec<usize> = mesh.faces().map(|face| mesh.uv_island(0, face).len()).collect();
        assert_eq!(sizes.iter().filter(|&&size| size == 1).count(), 8, "faces of their own: {sizes:?}");
        assert_eq!(sizes.iter().filter(|&&size| size == 8).count(), 8, "all of the right half: {sizes:?}");
    }

    #[test]
    fn corners_at_the_same_coordinates_go_together() {
        let mesh = grid();
        let right = mesh
            .faces()
            .find(|&face| mesh.face_vertices(face).all(|vertex| mesh.position(vertex).x >= 0.4))
            .expect("a face of the right half");
        let corners = mesh.uv_corners(0, UvElements::Faces(&[right]));
        assert!(corners.len() > 4, "those of its neighbours, too");
        for &corner in &corners {
            let at = |other| (mesh.corner_vertex(other), mesh.uv(0, other));
            assert!(mesh.face_corners(right).any(|own| at(own) == at(corner)), "at one of its corners");
        }
        let left = mesh.faces().find(|face| mesh.uv_island(0, *face).len() == 1).expect("one apart");
        assert_eq!(mesh.uv_corners(0, UvElements::Faces(&[left])).len(), 4, "only its own");
        assert_eq!(mesh.uv_corners(1, UvElements::Faces(&[left])), [], "there is no such set");
    }

    proptest! {
        /// Areas of triangles follow the determinant, and what is not moved stays.
        #[test]
        fn transforms_scale_areas_by_their_determinant(
            x in prop::array::uniform2(-3.0..3.0_f64),
            y in prop::array::uniform2(-3.0..3.0_f64),
            offset in prop::array::uniform2(-5.0..5.0_f64),
            chosen in any::<u16>(),
        ) {
            let (mut mesh, map) = (grid(), DAffine2::from_cols(x.into(), y.into(), offset.into()));
            let faces: Vec<FaceId> = mesh.faces().filter(|face| chosen >> face.0 & 1 != 0).collect();
            let corners = mesh.uv_corners(0, UvElements::Faces(&faces));
            let area = |mesh: &EditMesh, face: FaceId| -> f64 {
                let uvs: Vec<DVec2> =
                    mesh.face_corners(face).map(|corner| mesh.uv(0, corner).expect("set").as_dvec2()).collect();
                (0..uvs.len()).map(|i| uvs[i].perp_dot(uvs[(i + 1) % uvs.len()])).sum::<f64>() / 2.0
            };
            let before = mesh.clone();
            mesh.transform_uvs(0, &corners, &map).expect("finite");
            let determinant = x[0] * y[1] - x[1] * y[0];
            for &face in &faces {
                let expected = area(&before, face) * determinant;
                // Coordinates of up to some hundred are rounded to f32.
                prop_assert!((area(&mesh, face) - expected).abs() < 1e-2, "{} for {}", area(&mesh, face), expected);
            }
            for corner in mesh.corners().filter(|corner| !corners.contains(corner)) {
                prop_assert_eq!(mesh.uv(0, corner), before.uv(0, corner));
            }
        }
    }
}
