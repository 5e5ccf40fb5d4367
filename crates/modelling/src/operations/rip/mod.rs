//! Ripping: opens a mesh along edges or at vertices, and detaches one side (a modeller's V).
//!
//! `sides` finds which corners lie on which side of the edges. Here one side gets new vertices and edges.

mod extend;
mod sides;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use smallvec::SmallVec;

use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::numbering::sorted_once;
use crate::refusal::Refusal;
use sides::RipSides;
use trigon_math::DVec3;

const RIPPING: &str = "ripping";

/// The result of a rip.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Ripped {
    /// The new vertices, on the side that came loose.
    pub vertices: Vec<VertexId>,
    /// The new faces, if the gap was filled.
    pub faces: Vec<FaceId>,
}

/// A face side that got an edge of its own.
struct SplitSide {
    /// The corner that leaves along the new edge.
    corner: CornerId,
    /// Corners of a face that kept the old edge: opposite that corner, and opposite the one after it.
    retained: [CornerId; 2],
}

impl EditMesh {
    /// Opens a mesh along edges between two faces, and at vertices that are on none of these edges.
    ///
    /// Of the faces on both sides of the edges, those that lie farther in a direction come loose: their corners
    /// along the edges get new vertices, in the same places, with the same values. Edges that form one chain or
    /// loop have the same side loose all along. A chain that ends within the mesh stays joined at its ends; if
    /// that is all of it, as for one edge, its ends come loose with the faces at it. At a vertex, the face
    /// that lies farthest in the direction comes loose. With `fill`, faces join both sides, as is seen once
    /// one of them is moved.
    ///
    /// New faces are wound and have values and materials like the faces that came loose.
    ///
    /// # Errors
    /// One of the elements does not exist; there is nothing to open: no edge is between two faces, and no
    /// vertex has more than one; there would be too many elements.
    pub fn rip(
        &mut self,
        edges: &[EdgeId],
        vertices: &[VertexId],
        direction: DVec3,
        fill: bool,
    ) -> Result<Ripped, Refusal> {
        edges.iter().try_for_each(|&edge| self.check_edge(edge))?;
        vertices.iter().try_for_each(|&vertex| self.check_vertex(vertex))?;
        let edges = edges.iter().copied().filter(|&edge| self.edge_pair(edge).is_some()).collect();
        let sides = RipSides::new(self, sorted_once(edges), direction);
        let mut loose = sides.loose_corners(self);
        for vertex in sorted_once(vertices.to_vec()) {
            if !sides.is_at_edge(vertex) {
                loose.extend(self.farthest_corner(vertex, direction));
            }
        }
        if loose.is_empty() {
            let reason = "an edge between two faces or a vertex with more than one is needed";
            return Err(Refusal::NotPossible { operation: RIPPING, reason });
        }
        let corners: usize = loose.iter().map(|&corner| self.face_size(self.corner_face(corner))).sum();
        self.check_capacity_for_each(corners)?;
        self.whole(|mesh| mesh.loosen(&sorted_once(loose), fill))
    }

    /// The corner at a vertex whose face lies farthest in a direction; `None` if there is nothing else.
    fn farthest_corner(&self, vertex: VertexId, direction: DVec3) -> Option<CornerId> {
        let corners: SmallVec<[CornerId; 8]> = self.vertex_corners(vertex).collect();
        let here = self.point(vertex);
        let far = |corner: CornerId| {
            (self.face_center(self.corner_face(corner)) - here).normalize_or_zero().dot(direction)
        };
        let best =
            corners.iter().copied().reduce(|best, next| if far(next) > far(best) { next } else { best });
        best.filter(|_| corners.len() > 1)
    }

    /// Gives corners, of which none is there twice, vertices of their own.
    fn loosen(&mut self, loose: &[CornerId], fill: bool) -> Result<Ripped, Refusal> {
        let twins = self.twins_of(loose);
        let mut sides = Vec::new();
        let edges =
            |&corner: &CornerId| [corner, self.previous_corner(corner)].map(|side| self.corner_edge(side));
        for edge in sorted_once(loose.iter().flat_map(edges).collect()) {
            self.loosen_edge(edge, &twins, &mut sides);
        }
        for (&corner, &vertex) in &twins {
            self.corners.write(corner.0).vertex = vertex.0;
        }
        let vertices = sorted_once(twins.values().copied().collect());
        let faces = if fill { self.fill_rip(&sides)? } else { Vec::new() };
        Ok(Ripped { vertices, faces })
    }

    /// Gives the sides of an edge with new ends an edge of their own, or moves the edge if all have.
    fn loosen_edge(
        &mut self,
        edge: EdgeId,
        twins: &BTreeMap<CornerId, VertexId>,
        sides: &mut Vec<SplitSide>,
    ) {
        let ends = |mesh: &Self, corner: CornerId| {
            let corners = [corner, mesh.next_corner(corner)];
            corners.map(|corner| twins.get(&corner).copied().unwrap_or_else(|| mesh.corner_vertex(corner)))
        };
        let corners: SmallVec<[CornerId; 4]> = self.edge_corners(edge).collect();
        let has_edge = |mesh: &Self, corner: CornerId| {
            let ([a, b], new) = (mesh.edge_vertices(edge), ends(mesh, corner));
            new == [a, b] || new == [b, a]
        };
        if !corners.iter().any(|&corner| has_edge(self, corner)) {
            // All of its faces came loose at an end.
            self.move_edge(edge, ends(self, corners[0]), corners[0]);
        }
        let (retained, split): (SmallVec<[CornerId; 4]>, SmallVec<[CornerId; 4]>) =
            corners.iter().copied().partition(|&corner| has_edge(self, corner));
        for corner in split {
            let [start, end] = ends(self, corner);
            let new = self.join(start, end);
            self.copy_edge(edge, new);
            self.unlink_at_edge(corner.0);
            self.link_at_edge(corner.0, new.0);
            let mut retained = [retained[0], self.next_corner(retained[0])];
            if self.corner_vertex(retained[0]) != self.corner_vertex(corner) {
                retained.swap(0, 1);
            }
            sides.push(SplitSide { corner, retained });
        }
    }

    /// The new vertex of each corner: one for all of a vertex.
    fn twins_of(&mut self, loose: &[CornerId]) -> BTreeMap<CornerId, VertexId> {
        let mut twins = BTreeMap::new();
        let mut of_vertex = BTreeMap::new();
        for &corner in loose {
            let vertex = self.corner_vertex(corner);
            let twin = *of_vertex.entry(vertex).or_insert_with(|| self.twin_vertex(vertex));
            twins.insert(corner, twin);
        }
        twins
    }

    /// Lets an edge end where one of its corners will begin and end.
    fn move_edge(&mut self, edge: EdgeId, [start, end]: [VertexId; 2], corner: CornerId) {
        let next = self.next_corner(corner);
        for (from, to) in [(self.corner_vertex(corner), start), (self.corner_vertex(next), end)] {
            if from != to {
                let end = self.edges[edge.0].end(from.0);
                self.unlink_at_vertex(edge.0, end);
                self.edges.write(edge.0).vertices[end] = to.0;
                self.link_at_vertex(edge.0, end);
            }
        }
    }

    /// Joins both sides of each edge that was split.
    fn fill_rip(&mut self, sides: &[SplitSide]) -> Result<Vec<FaceId>, Refusal> {
        let mut faces = Vec::new();
        for side in sides {
            // The face that came loose runs along the edge the other way, the one that stayed as the new one.
            let next = self.next_corner(side.corner);
            let mut outline = SmallVec::<[(VertexId, CornerId); 4]>::new();
            for corner in [next, side.corner, side.retained[0], side.retained[1]] {
                let vertex = self.corner_vertex(corner);
                if outline.iter().all(|&(other, _)| other != vertex) {
                    outline.push((vertex, corner));
                }
            }
            if outline.len() < 3 {
                continue;
            }
            let vertices: SmallVec<[VertexId; 4]> = outline.iter().map(|&(vertex, _)| vertex).collect();
            let face = self.add_face(&vertices)?;
            let corners: SmallVec<[CornerId; 4]> = self.face_corners(face).collect();
            for (corner, (_, source)) in corners.into_iter().zip(outline) {
                self.copy_corner_upright(source, corner);
            }
            self.copy_face(self.corner_face(side.corner), face);
            faces.push(face);
        }
        Ok(faces)
    }
}
