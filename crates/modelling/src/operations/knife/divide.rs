//! Values within faces, and faces divided as a net says.

use smallvec::SmallVec;
use trigon_math::{DVec3, Vec3};
use trigon_mesh::Triangulator;

use super::net::{CornerParts, NetParts};
use crate::edit_mesh::EditMesh;
use crate::euler::{Divided, PartPoint, Parts};
use crate::ids::{CornerId, FaceId, VertexId};
use crate::operations::boolean::SourceFace;
use crate::refusal::Refusal;

/// The largest sum of the sizes of weights that add up to 1. Inside a convex polygon it is 1, inside a
/// hollow one little more; far outside, or where a polygon crosses itself, weights grow without bound
/// and what they give is rounding.
const LARGEST: f64 = 16.0;

impl EditMesh {
    /// The mean value coordinates of a position in a face, as seen along its normal. `None` on its border, and outside.
    pub(super) fn mean_value_parts(&self, face: FaceId, position: DVec3) -> Option<CornerParts> {
        let corners: Vec<CornerId> = self.face_corners(face).collect();
        let arm = |&corner: &CornerId| self.point(self.corner_vertex(corner)) - position;
        let mut arms: Vec<DVec3> = corners.iter().map(arm).collect();
        let count = arms.len();
        let turn = |arms: &[DVec3], i: usize| arms[i].cross(arms[(i + 1) % count]);
        let normal = (0..count).map(|i| turn(&arms, i)).sum::<DVec3>().normalize_or_zero();
        arms.iter_mut().for_each(|arm| *arm -= normal * arm.dot(normal));
        // The tangent of half the angle between two arms.
        let half = |i: usize| {
            let (a, b) = (arms[i], arms[(i + 1) % count]);
            (a.length() * b.length() - a.dot(b)) / turn(&arms, i).dot(normal)
        };
        let halves: Vec<f64> = (0..count).map(half).collect();
        let weights: Vec<f64> =
            (0..count).map(|i| (halves[(i + count - 1) % count] + halves[i]) / arms[i].length()).collect();
        let sum: f64 = weights.iter().sum();
        let size: f64 = weights.iter().map(|weight| (weight / sum).abs()).sum();
        if size.is_nan() || size >= LARGEST {
            return None;
        }
        Some(corners.into_iter().zip(weights).map(|(corner, weight)| (corner, weight / sum)).collect())
    }

    /// What values in a position within a face are made of: by the triangles of the face where it is too near to the
    /// border for mean value coordinates.
    pub(super) fn parts_within(&self, face: FaceId, position: Vec3) -> CornerParts {
        let position = position.as_dvec3();
        self.mean_value_parts(face, position).unwrap_or_else(|| {
            let outline: Vec<Vec3> = self.face_vertices(face).map(|vertex| self.position(vertex)).collect();
            let mut triangles = Vec::new();
            Triangulator::default().complete_polygon(&outline, &mut triangles);
            SourceFace::new(self, face, &triangles).parts_at(self, position).to_vec()
        })
    }

    /// Divides a face into the parts of a net, of whose outline all vertices are there. The vertices of the net's
    /// points, and all parts: the first has the face's id.
    pub(super) fn divide_by_net(
        &mut self,
        face: FaceId,
        net: &NetParts,
    ) -> Result<(Vec<VertexId>, Vec<FaceId>), Refusal> {
        let mut points: Vec<PartPoint> = self
            .face_corners(face)
            .map(|corner| PartPoint { vertex: self.corner_vertex(corner), corner, is_taken: false })
            .collect();
        for point in &net.points[net.outline..] {
            let vertex = self.add_vertex(point.position)?;
            let of_vertex: SmallVec<[(VertexId, f64); 8]> =
                point.parts.iter().map(|&(corner, weight)| (self.corner_vertex(corner), weight)).collect();
            self.blend_vertex(&of_vertex, vertex);
            let corner = CornerId(self.new_corner(vertex.0, face.0));
            self.blend_corner(&point.parts, corner);
            points.push(PartPoint { vertex, corner, is_taken: false });
        }
        let vertices = points.iter().map(|point| point.vertex).collect();
        if net.parts.is_empty() {
            return Ok((vertices, vec![face]));
        }
        let mut parts = Parts::default();
        net.parts.iter().for_each(|part| parts.push(part.iter().copied()));
        let mut divided = Divided::default();
        self.divide_face(face, &mut points, &parts, &mut divided);
        Ok((vertices, divided.faces))
    }
}
