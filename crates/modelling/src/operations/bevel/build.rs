//! Builds the planned bevel.

use smallvec::SmallVec;

use super::finish::Finish;
use super::laid::End;
use super::shape::{Blueprint, NewCorner};
use crate::blends::CornerBlends;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, NONE, VertexId};
use crate::records::SEAM;

impl EditMesh {
    /// Carries out a plan, and what comes after it; the new faces and vertices.
    pub(super) fn build_bevel(
        &mut self,
        mut plan: Blueprint,
        edges: &[EdgeId],
        finish: &Finish,
    ) -> (Vec<FaceId>, Vec<VertexId>) {
        let vertices = self.add_bevel_points(&plan);
        let rims = self.move_beveled_edges(&plan, edges, &vertices);
        let mut made = Vec::with_capacity(plan.corners.len());
        for moved in &plan.laid.moves {
            self.corners.write(moved.corner.0).vertex = vertices[moved.node as usize].0;
            plan.blends.assign(moved.sum, moved.corner);
        }
        let mut start = 0;
        for insertion in &plan.insertions {
            let new = &plan.corners[start..insertion.end];
            made.extend(self.insert_bevel_corners(new, insertion.of, &vertices, &mut plan.blends));
            start = insertion.end;
        }
        let faces = self.add_bevel_faces(&mut plan, start, &vertices);
        made.extend(faces.iter().flat_map(|&face| self.face_corners(face)));
        self.mark_bevel_seams(&plan, edges, &vertices);
        self.mark_bevel_rims(finish, &rims);
        self.blend_corners(&plan.blends);
        self.harden_bevel_normals(finish, &plan, &faces, &made);
        for round in &plan.laid.rounds {
            // Wires and faces of other fans may still be there.
            let vertex = round.fan.vertex;
            if self.has_vertex(vertex) && self.vertices[vertex.0].edge == NONE {
                self.free_vertex(vertex.0);
            }
        }
        (faces, vertices)
    }

    /// Makes the new faces, whose corners begin at `start`.
    fn add_bevel_faces(
        &mut self,
        plan: &mut Blueprint,
        mut start: usize,
        vertices: &[VertexId],
    ) -> Vec<FaceId> {
        let mut faces = Vec::with_capacity(plan.faces.len());
        let mut outline = SmallVec::<[VertexId; 8]>::new();
        for face in &plan.faces {
            let new = &plan.corners[start..face.end];
            start = face.end;
            outline.clear();
            outline.extend(new.iter().map(|corner| vertices[corner.point as usize]));
            let id = self.face_of(&outline);
            self.copy_face(face.of, id);
            let mut corner = CornerId(self.faces[id.0].corner);
            for &NewCorner { sum, .. } in new {
                plan.blends.assign(sum, corner);
                corner = self.next_corner(corner);
            }
            faces.push(id);
        }
        faces
    }

    fn add_bevel_points(&mut self, plan: &Blueprint) -> Vec<VertexId> {
        let mut vertices = Vec::with_capacity(plan.positions.len());
        let mut parts = SmallVec::<[(VertexId, f64); 16]>::new();
        for (&position, &sum) in plan.positions.iter().zip(&plan.point_sums) {
            let vertex = VertexId(self.new_vertex(position.as_vec3()));
            parts.clear();
            // The old corners still have their old vertices.
            parts.extend(plan.blends.parts(sum).map(|(corner, weight)| (self.corner_vertex(corner), weight)));
            self.blend_vertex(&parts, vertex);
            vertices.push(vertex);
        }
        vertices
    }

    /// Lets the edges round each vertex end at the new ones, and makes each beveled edge the rim on its
    /// left, beside a new one on its right. Returns all rims.
    fn move_beveled_edges(
        &mut self,
        plan: &Blueprint,
        edges: &[EdgeId],
        vertices: &[VertexId],
    ) -> Vec<EdgeId> {
        let mut rims = Vec::with_capacity(2 * edges.len());
        for round in &plan.laid.rounds {
            for stop in &plan.laid.stops[round.stops[0]..round.stops[1]] {
                if stop.beveled == NONE && stop.edge.0 != NONE {
                    self.move_beveled_end(stop.edge, round.fan.vertex, vertices[stop.left as usize]);
                }
            }
        }
        for (&edge, [start, end]) in edges.iter().zip(&plan.laid.ends) {
            // Seen from its other end, right is left.
            self.move_beveled_end(edge, start.vertex, vertices[start.left as usize]);
            self.move_beveled_end(edge, end.vertex, vertices[end.right as usize]);
            let right = self.join(vertices[start.right as usize], vertices[end.left as usize]);
            rims.extend([edge, right]);
            if right != edge {
                self.unlink_at_edge(end.left_corner.0);
                self.link_at_edge(end.left_corner.0, right.0);
                self.copy_edge(edge, right);
                self.edges.write(right.0).flags &= !SEAM;
            }
        }
        rims
    }

    /// Lets an edge end at another vertex.
    fn move_beveled_end(&mut self, edge: EdgeId, from: VertexId, to: VertexId) {
        let end = self.edges[edge.0].end(from.0);
        self.unlink_at_vertex(edge.0, end);
        self.edges.write(edge.0).vertices[end] = to.0;
        self.link_at_vertex(edge.0, end);
    }

    /// Puts new corners before an old one in its face, and returns them.
    fn insert_bevel_corners(
        &mut self,
        new: &[NewCorner],
        before: CornerId,
        vertices: &[VertexId],
        blends: &mut CornerBlends,
    ) -> SmallVec<[CornerId; 8]> {
        let mut made = SmallVec::new();
        let face = self.corners[before.0].face;
        for (i, corner) in new.iter().enumerate() {
            let vertex = vertices[corner.point as usize];
            let next = match new.get(i + 1) {
                Some(next) => vertices[next.point as usize],
                None => self.corner_vertex(before),
            };
            let edge = self.join(vertex, next);
            let id = self.new_corner(vertex.0, face);
            self.link_in_face(self.corners[before.0].previous, id);
            self.link_in_face(id, before.0);
            self.link_at_edge(id, edge.0);
            blends.assign(corner.sum, CornerId(id));
            made.push(CornerId(id));
        }
        self.faces.write(face).size += new.len() as u32;
        made
    }

    /// Moves seams from beveled edges to where their two sides meet now.
    fn mark_bevel_seams(&mut self, plan: &Blueprint, edges: &[EdgeId], vertices: &[VertexId]) {
        for (&edge, ends) in edges.iter().zip(&plan.laid.ends) {
            if self.edges[edge.0].flags & SEAM == 0 {
                continue;
            }
            self.edges.write(edge.0).flags &= !SEAM;
            let step = plan.segments.div_ceil(2);
            let steps = [step, plan.segments - step];
            let point = |i: usize| {
                let end: &End = &ends[i];
                vertices[plan.curve_point(end.arc, end.is_reversed, steps[i]) as usize]
            };
            if let Some(line) = self.find_edge(point(0), point(1)) {
                self.edges.write(line.0).flags |= SEAM;
            }
        }
    }
}
