//! Adds elements to the rings of their neighbours one by one, and removes them. (Conversions of whole meshes
//! and steps that move many corners write their rings themselves: `from_mesh`, `euler`.) The order within a
//! ring has no geometric meaning.

use super::edit_mesh::EditMesh;
use super::ids::NONE;

impl EditMesh {
    /// Puts an edge into the ring of the vertex at one of its ends, as the last one.
    pub(super) fn link_at_vertex(&mut self, edge: u32, end: usize) {
        let vertex = self.edges[edge].vertices[end];
        let first = self.vertices[vertex].edge;
        if first == NONE {
            self.vertices.write(vertex).edge = edge;
            let record = self.edges.write(edge);
            record.next[end] = edge;
            record.previous[end] = edge;
            return;
        }
        let first_end = self.edges[first].end(vertex);
        let last = self.edges[first].previous[first_end];
        let last_end = self.edges[last].end(vertex);
        self.edges.write(last).next[last_end] = edge;
        self.edges.write(first).previous[first_end] = edge;
        let record = self.edges.write(edge);
        record.next[end] = first;
        record.previous[end] = last;
    }

    /// Makes some edges that end at a vertex its ring, in their order. It has none yet.
    pub(super) fn link_all_at_vertex(&mut self, vertex: u32, edges: &[u32]) {
        for (i, &edge) in edges.iter().enumerate() {
            let next = if i + 1 == edges.len() { edges[0] } else { edges[i + 1] };
            let previous = if i == 0 { edges[edges.len() - 1] } else { edges[i - 1] };
            let record = self.edges.write(edge);
            let end = record.end(vertex);
            record.next[end] = next;
            record.previous[end] = previous;
        }
        self.vertices.write(vertex).edge = edges[0];
    }

    /// Takes an edge out of the ring of the vertex at one of its ends.
    pub(super) fn unlink_at_vertex(&mut self, edge: u32, end: usize) {
        let record = self.edges[edge];
        let (vertex, next, previous) = (record.vertices[end], record.next[end], record.previous[end]);
        if next == edge {
            self.vertices.write(vertex).edge = NONE;
            return;
        }
        let next_end = self.edges[next].end(vertex);
        self.edges.write(next).previous[next_end] = previous;
        let previous_end = self.edges[previous].end(vertex);
        self.edges.write(previous).next[previous_end] = next;
        if self.vertices[vertex].edge == edge {
            self.vertices.write(vertex).edge = next;
        }
    }

    /// Lets a corner leave along an edge, and puts it into that edge's ring as the last one.
    pub(super) fn link_at_edge(&mut self, corner: u32, edge: u32) {
        let first = self.edges[edge].corner;
        let (next, previous) = if first == NONE {
            self.edges.write(edge).corner = corner;
            (corner, corner)
        } else {
            let last = self.corners[first].radial_previous;
            self.corners.write(last).radial_next = corner;
            self.corners.write(first).radial_previous = corner;
            (first, last)
        };
        let record = self.corners.write(corner);
        record.edge = edge;
        record.radial_next = next;
        record.radial_previous = previous;
    }

    /// Takes a corner out of its edge's ring.
    pub(super) fn unlink_at_edge(&mut self, corner: u32) {
        let record = self.corners[corner];
        let (edge, next, previous) = (record.edge, record.radial_next, record.radial_previous);
        if next == corner {
            self.edges.write(edge).corner = NONE;
            return;
        }
        self.corners.write(next).radial_previous = previous;
        self.corners.write(previous).radial_next = next;
        if self.edges[edge].corner == corner {
            self.edges.write(edge).corner = next;
        }
    }

    /// Makes `next` follow `corner` in a face.
    pub(super) fn link_in_face(&mut self, corner: u32, next: u32) {
        self.corners.write(corner).next = next;
        self.corners.write(next).previous = corner;
    }
}
