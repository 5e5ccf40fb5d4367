//! Points inside faces, and cuts through faces along them.

use trigon_math::{DVec3, Vec3};

use super::OPERATION;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, FaceId, VertexId};
use crate::refusal::Refusal;

/// The largest sum of the sizes of weights that add up to 1. Inside a convex polygon it is 1, inside a
/// hollow one little more; far outside, or where a polygon crosses itself, weights grow without bound
/// and what they give is rounding.
const LARGEST: f64 = 16.0;

/// A new vertex within a face.
#[derive(Debug, Clone)]
pub(super) struct Inside {
    pub(super) vertex: VertexId,
    /// The parts of the values that its corners get.
    corners: Vec<(CornerId, f64)>,
}

impl Inside {
    /// A vertex that is there already.
    pub(super) fn at(vertex: VertexId) -> Self {
        Self { vertex, corners: Vec::new() }
    }
}

impl EditMesh {
    /// A new vertex on a face.
    pub(super) fn vertex_within(&mut self, face: FaceId, position: Vec3) -> Result<Inside, Refusal> {
        let corners = self.mean_value_parts(face, position.as_dvec3())?;
        let parts: Vec<(VertexId, f64)> =
            corners.iter().map(|&(corner, weight)| (self.corner_vertex(corner), weight)).collect();
        let position: DVec3 = parts.iter().map(|&(vertex, weight)| self.point(vertex) * weight).sum();
        let vertex = self.add_vertex(position.as_vec3())?;
        self.blend_vertex(&parts, vertex);
        Ok(Inside { vertex, corners })
    }

    /// The mean value coordinates of a place in a face, as seen along its normal.
    fn mean_value_parts(&self, face: FaceId, position: DVec3) -> Result<Vec<(CornerId, f64)>, Refusal> {
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
            let reason =
                "a point within a face is on its border or outside; give it on an edge, or in its face";
            return Err(Refusal::NotPossible { operation: OPERATION, reason });
        }
        Ok(corners.into_iter().zip(weights).map(|(corner, weight)| (corner, weight / sum)).collect())
    }

    /// Cuts a face from one of its corners to another, along vertices with the values of their corners. The
    /// new part.
    pub(super) fn split_face_along(
        &mut self,
        from: CornerId,
        to: CornerId,
        inside: &[Inside],
    ) -> Result<FaceId, Refusal> {
        if inside.is_empty() {
            return Ok(self.split_face(from, to)?.face);
        }
        self.check_capacity()?;
        let (old, first, last) = (self.corner_face(from), self.corner_vertex(from), self.corner_vertex(to));
        let new = FaceId(self.new_face());
        self.copy_face(old, new);
        let mut moved = 0;
        let mut corner = to;
        while corner != from {
            self.corners.write(corner.0).face = new.0;
            moved += 1;
            corner = self.next_corner(corner);
        }
        let (before_from, before_to) = (self.previous_corner(from), self.previous_corner(to));
        // The old part closes from the last vertex back to the first, the new part the other way.
        let there: Vec<VertexId> = inside.iter().map(|point| point.vertex).collect();
        let back: Vec<VertexId> = there.iter().rev().copied().collect();
        let closing_old = self.add_chain(old, before_to, last, &back, from);
        let closing_new = self.add_chain(new, before_from, first, &there, to);
        self.copy_corner(to, closing_old[0]);
        self.copy_corner(from, closing_new[0]);
        for (i, point) in inside.iter().enumerate() {
            self.blend_corner(&point.corners, closing_new[i + 1]);
            self.copy_corner(closing_new[i + 1], closing_old[inside.len() - i]);
        }
        let added = inside.len() as u32 + 1;
        let record = self.faces.write(old.0);
        record.corner = from.0;
        record.size = record.size - moved + added;
        let record = self.faces.write(new.0);
        record.corner = to.0;
        record.size = moved + added;
        Ok(new)
    }

    /// Adds corners to a face after one corner: at a vertex and then at others, before the corner
    /// `end`.
    fn add_chain(
        &mut self,
        face: FaceId,
        after: CornerId,
        start: VertexId,
        vertices: &[VertexId],
        end: CornerId,
    ) -> Vec<CornerId> {
        let mut made = Vec::with_capacity(vertices.len() + 1);
        let mut before = after;
        let mut vertex = start;
        for &next in vertices.iter().chain([&self.corner_vertex(end)]) {
            let edge = self.join(vertex, next);
            let corner = self.new_corner(vertex.0, face.0);
            self.link_in_face(before.0, corner);
            self.link_at_edge(corner, edge.0);
            made.push(CornerId(corner));
            (before, vertex) = (CornerId(corner), next);
        }
        self.link_in_face(before.0, end.0);
        made
    }
}
