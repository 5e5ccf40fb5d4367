//! Texture coordinates of quads that follow a given one, as rows and columns of a grid: "Follow Active Quads".

use std::collections::VecDeque;

use fixedbitset::FixedBitSet;
use trigon_math::DVec2;

use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId};
use crate::refusal::Refusal;

const OPERATION: &str = "following a quad";

/// How far a quad that follows another one reaches.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize, schemars::JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum QuadLength {
    /// As far as the one before, whatever its size on the surface.
    Even,
    /// In proportion to the lengths of its edges on the surface.
    #[default]
    Length,
}

impl EditMesh {
    /// Lays quads beside the active one, and on beside those: across each edge the next quad continues the lines of the
    /// one before. Only faces of `faces` with four corners are reached, and not across seams. Returns how many faces
    /// got new coordinates; the active one keeps its own.
    ///
    /// # Errors
    /// A face does not exist, the active one is no quad or not among them, or there is no such set.
    pub fn follow_quad(
        &mut self,
        faces: &[FaceId],
        active: FaceId,
        uv_set: usize,
        length: QuadLength,
    ) -> Result<usize, Refusal> {
        let not_possible = |reason| Err(Refusal::NotPossible { operation: OPERATION, reason });
        self.check_faces(faces, OPERATION)?;
        self.check_face(active)?;
        if uv_set >= self.uv_set_count() {
            return not_possible("there are no texture coordinates; unwrap the active face first");
        }
        if self.face_size(active) != 4 || !faces.contains(&active) {
            return not_possible("the active face has to be a selected quad; click one with Shift last");
        }
        let mut waits = FixedBitSet::with_capacity(self.face_capacity());
        let quads = faces.iter().filter(|&&face| self.face_size(face) == 4);
        quads.for_each(|face| waits.insert(face.0 as usize));
        waits.set(active.0 as usize, false);
        let (mut queue, mut laid) = (VecDeque::from([active]), 0);
        while let Some(face) = queue.pop_front() {
            for corner in self.face_corners(face).collect::<Vec<_>>() {
                let Some(across) = self.corner_across(corner) else { continue };
                let next = self.corner_face(across);
                if waits.contains(next.0 as usize) {
                    waits.set(next.0 as usize, false);
                    self.lay_beside(corner, across, uv_set, length);
                    laid += 1;
                    queue.push_back(next);
                }
            }
        }
        Ok(laid)
    }

    /// The corner on the other side of an edge with two faces that wind alike and no seam.
    fn corner_across(&self, corner: CornerId) -> Option<CornerId> {
        let edge = self.corner_edge(corner);
        let pair = self.edge_pair(edge).filter(|_| !self.is_seam(edge))?;
        let other = if pair[0] == corner { pair[1] } else { pair[0] };
        (self.corner_vertex(other) == self.corner_vertex(self.next_corner(corner))).then_some(other)
    }

    /// Lays the quad of `across` beside that of `corner`, with which it shares the edge.
    fn lay_beside(&mut self, corner: CornerId, across: CornerId, uv_set: usize, length: QuadLength) {
        let uv = |mesh: &Self, corner| mesh.uv(uv_set, corner).expect("the set exists").as_dvec2();
        // From the edge's ends along the sides of the quad that lies already.
        let [start, end] = [corner, self.next_corner(corner)];
        let [start_side, end_side] = [self.previous_corner(start), end];
        let behind = [start_side, self.next_corner(end)];
        let at = [uv(self, start), uv(self, end)];
        let sides = [at[0] - uv(self, behind[0]), at[1] - uv(self, behind[1])];
        // The same of the next quad: its corner `across` is at the end of the edge.
        let (to_start, to_end) = (self.next_corner(across), self.previous_corner(across));
        let beyond = [self.next_corner(to_start), to_end];
        let ratio = |known: CornerId, next: CornerId| match length {
            QuadLength::Even => 1.0,
            QuadLength::Length => self.length_ratio(self.corner_edge(next), self.corner_edge(known)),
        };
        let ratios = [ratio(start_side, to_start), ratio(end_side, to_end)];
        let far: [DVec2; 2] = [at[0] + sides[0] * ratios[0], at[1] + sides[1] * ratios[1]];
        for (corner, uv) in [(to_start, at[0]), (across, at[1]), (beyond[0], far[0]), (beyond[1], far[1])] {
            self.set_uv(uv_set, corner, uv.as_vec2());
        }
    }

    /// How many times as long an edge is as another one; 1 where that is no number.
    fn length_ratio(&self, edge: EdgeId, other: EdgeId) -> f64 {
        let length = |edge| {
            let [a, b] = self.edge_vertices(edge).map(|vertex| self.point(vertex));
            a.distance(b)
        };
        let ratio = length(edge) / length(other);
        if ratio.is_finite() && ratio > 0.0 { ratio } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use trigon_math::{Vec2, Vec3};
    use trigon_mesh::primitives;

    use super::*;

    /// A bent grid: columns of different widths in x.
    fn bent() -> EditMesh {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::grid(4.0, 4.0, 4, 4));
        for vertex in mesh.vertices().collect::<Vec<_>>() {
            let Vec3 { x, z, .. } = mesh.position(vertex);
            // Wider and wider to the right, and folded by right angles.
            mesh.set_position(vertex, Vec3::new(x + 0.25 * (x + 2.0) * (x + 2.0), z.rem_euclid(2.0), z));
        }
        mesh.add_uv_set(0).expect("room");
        mesh
    }

    fn all(mesh: &EditMesh) -> Vec<FaceId> {
        mesh.faces().collect()
    }

    #[test]
    fn a_grid_follows_its_active_quad_exactly() {
        for length in [QuadLength::Even, QuadLength::Length] {
            let (mut mesh, _) = EditMesh::from_mesh(&primitives::grid(4.0, 4.0, 4, 4));
            mesh.add_uv_set(0).expect("room");
            let faces = all(&mesh);
            let active = faces[5];
            // A slanted quad.
            let uv_of = |position: Vec3| Vec2::new(position.x * 0.25 + position.z * 0.125, position.z * 0.5);
            for corner in mesh.face_corners(active).collect::<Vec<_>>() {
                mesh.set_uv(0, corner, uv_of(mesh.position(mesh.corner_vertex(corner))));
            }
            let laid = mesh.follow_quad(&faces, active, 0, length).expect("a quad");
            assert_eq!(laid, 15, "all others");
            for corner in mesh.corners() {
                let expected = uv_of(mesh.position(mesh.corner_vertex(corner)));
                let found = mesh.uv(0, corner).expect("set");
                assert!(found.distance(expected) < 1e-6, "{found} for {expected}");
            }
        }
    }

    #[test]
    fn lengths_are_those_on_the_surface() {
        let mut mesh = bent();
        let faces = all(&mesh);
        let active = faces[0];
        let unit = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let corners: Vec<CornerId> = mesh.face_corners(active).collect();
        for (&corner, uv) in corners.iter().zip(unit) {
            mesh.set_uv(0, corner, Vec2::from_array(uv));
        }
        mesh.follow_quad(&faces, active, 0, QuadLength::Even).expect("a quad");
        let span = |mesh: &EditMesh| {
            let uvs = mesh.corners().map(|corner| mesh.uv(0, corner).expect("set"));
            let (low, high) =
                uvs.fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(low, high), uv| (low.min(uv), high.max(uv)));
            high - low
        };
        assert!((span(&mesh) - Vec2::splat(4.0)).length() < 1e-5, "as long as the first: {}", span(&mesh));
        mesh.follow_quad(&faces, active, 0, QuadLength::Length).expect("a quad");
        assert!(span(&mesh).max_element() > 5.0, "wider ones are longer: {}", span(&mesh));
    }

    #[test]
    fn seams_and_triangles_are_not_crossed() {
        let mut mesh = bent();
        let faces = all(&mesh);
        let active = faces[0];
        for edge in mesh.face_edges(active).collect::<Vec<_>>() {
            mesh.set_seam(edge, true);
        }
        assert_eq!(mesh.follow_quad(&faces, active, 0, QuadLength::Even).expect("a quad"), 0);
        mesh.triangulate_faces(&[faces[5]]).expect("a face");
        let refused = mesh.follow_quad(&faces, faces[5], 0, QuadLength::Even).expect_err("a triangle");
        assert!(refused.to_string().contains("quad"), "{refused}");
    }
}
