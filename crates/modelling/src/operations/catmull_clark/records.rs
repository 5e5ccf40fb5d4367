//! Adjacency after a level: the record of each slot, from the old mesh alone.
//!
//! The part of a face at a corner has four corners: the old one, at its vertex; one on its edge;
//! one in its face; one on the edge before. Rings keep the order of the old ones.

use super::numbers::Numbers;
use super::points::crease_after;
use crate::edit_mesh::EditMesh;
use crate::ids::NONE;
use crate::records::{ALIVE, CornerRecord, EdgeRecord, FaceRecord, HIDDEN, VertexRecord};

/// New corners of the part at a corner, see [`Numbers::new_corner`].
const ON_EDGE: u32 = 0;
const IN_FACE: u32 = 1;
const BEFORE: u32 = 2;

impl EditMesh {
    pub(super) fn refined_vertex(&self, numbers: &Numbers, index: u32) -> VertexRecord {
        if index < numbers.vertices {
            let record = self.vertices[index];
            if record.flags & ALIVE == 0 || record.edge == NONE {
                return record;
            }
            return VertexRecord { edge: self.half(numbers, record.edge, index), ..record };
        }
        let number = index - numbers.vertices;
        if number < numbers.edges.count() {
            let edge = numbers.edges.index(number);
            return VertexRecord { edge, flags: self.edges[edge].flags & (ALIVE | HIDDEN) };
        }
        let face = &self.faces[numbers.faces.index(number - numbers.edges.count())];
        VertexRecord { edge: numbers.spoke(face.corner), flags: face.flags & (ALIVE | HIDDEN) }
    }

    pub(super) fn refined_edge(&self, numbers: &Numbers, index: u32) -> EdgeRecord {
        if index < numbers.edges.capacity() {
            let record = self.edges[index];
            return if record.flags & ALIVE == 0 { record } else { self.first_half(numbers, index) };
        }
        let number = index - numbers.edges.capacity();
        if number < numbers.edges.count() {
            return self.second_half(numbers, numbers.edges.index(number));
        }
        self.spoke(numbers, numbers.corner_of_spoke(number - numbers.edges.count()))
    }

    /// The half of an edge at one of its ends.
    #[inline]
    fn half(&self, numbers: &Numbers, edge: u32, vertex: u32) -> u32 {
        if self.edges[edge].vertices[0] == vertex { edge } else { numbers.second_half(edge) }
    }

    /// The corner that leaves along the half of an edge at a vertex, of those that come from
    /// a corner that left along the whole edge.
    #[inline]
    fn on_half(&self, numbers: &Numbers, corner: u32, vertex: u32) -> u32 {
        let record = &self.corners[corner];
        if record.vertex == vertex { corner } else { numbers.new_corner(record.next, BEFORE) }
    }

    /// At the vertex on an edge, the ring is: first half, second half, spokes.
    fn first_half(&self, numbers: &Numbers, edge: u32) -> EdgeRecord {
        let record = self.edges[edge];
        let vertex = record.vertices[0];
        let (second, last) = (numbers.second_half(edge), self.last_spoke(numbers, edge));
        EdgeRecord {
            vertices: [vertex, numbers.on_edge(edge)],
            next: [self.half(numbers, record.next[0], vertex), second],
            previous: [self.half(numbers, record.previous[0], vertex), last.unwrap_or(second)],
            corner: self.first_on_half(numbers, &record, vertex),
            crease: crease_after(record.crease),
            flags: record.flags,
        }
    }

    fn second_half(&self, numbers: &Numbers, edge: u32) -> EdgeRecord {
        let record = self.edges[edge];
        let vertex = record.vertices[1];
        let first_spoke = if record.corner == NONE { edge } else { numbers.spoke(record.corner) };
        EdgeRecord {
            vertices: [numbers.on_edge(edge), vertex],
            next: [first_spoke, self.half(numbers, record.next[1], vertex)],
            previous: [edge, self.half(numbers, record.previous[1], vertex)],
            corner: self.first_on_half(numbers, &record, vertex),
            crease: crease_after(record.crease),
            flags: record.flags,
        }
    }

    fn first_on_half(&self, numbers: &Numbers, record: &EdgeRecord, vertex: u32) -> u32 {
        if record.corner == NONE { NONE } else { self.on_half(numbers, record.corner, vertex) }
    }

    /// The last of the spokes from an edge, in the order of its faces.
    fn last_spoke(&self, numbers: &Numbers, edge: u32) -> Option<u32> {
        let first = self.edges[edge].corner;
        (first != NONE).then(|| numbers.spoke(self.corners[first].radial_previous))
    }

    /// The spoke of a corner.
    fn spoke(&self, numbers: &Numbers, corner: u32) -> EdgeRecord {
        let record = self.corners[corner];
        let first = self.edges[record.edge].corner;
        // Around the vertex on the edge: after the last spoke comes the first half, before
        // the first spoke the second half.
        let (after, before) = (record.radial_next, record.radial_previous);
        let at_edge = [
            if after == first { record.edge } else { numbers.spoke(after) },
            if corner == first { numbers.second_half(record.edge) } else { numbers.spoke(before) },
        ];
        EdgeRecord {
            vertices: [numbers.on_edge(record.edge), numbers.in_face(record.face)],
            next: [at_edge[0], numbers.spoke(record.next)],
            previous: [at_edge[1], numbers.spoke(record.previous)],
            corner: numbers.new_corner(corner, ON_EDGE),
            crease: 0.0,
            flags: self.faces[record.face].flags & (ALIVE | HIDDEN),
        }
    }

    pub(super) fn refined_corner(&self, numbers: &Numbers, index: u32) -> CornerRecord {
        if index < numbers.corners.capacity() {
            let record = self.corners[index];
            return if record.face == NONE { record } else { self.at_vertex(numbers, index) };
        }
        let number = index - numbers.corners.capacity();
        let corner = numbers.corners.index(number / 3);
        match number % 3 {
            ON_EDGE => self.at_edge(numbers, corner),
            IN_FACE => self.at_face(numbers, corner),
            _ => self.at_edge_before(numbers, corner),
        }
    }

    fn at_vertex(&self, numbers: &Numbers, corner: u32) -> CornerRecord {
        let record = self.corners[corner];
        CornerRecord {
            vertex: record.vertex,
            edge: self.half(numbers, record.edge, record.vertex),
            face: numbers.part_of[corner as usize],
            next: numbers.new_corner(corner, ON_EDGE),
            previous: numbers.new_corner(corner, BEFORE),
            radial_next: self.on_half(numbers, record.radial_next, record.vertex),
            radial_previous: self.on_half(numbers, record.radial_previous, record.vertex),
        }
    }

    /// It leaves along the spoke of its corner, which the part at the next corner comes back by.
    fn at_edge(&self, numbers: &Numbers, corner: u32) -> CornerRecord {
        let record = self.corners[corner];
        CornerRecord {
            vertex: numbers.on_edge(record.edge),
            edge: numbers.spoke(corner),
            face: numbers.part_of[corner as usize],
            next: numbers.new_corner(corner, IN_FACE),
            previous: corner,
            radial_next: numbers.new_corner(record.next, IN_FACE),
            radial_previous: numbers.new_corner(record.next, IN_FACE),
        }
    }

    fn at_face(&self, numbers: &Numbers, corner: u32) -> CornerRecord {
        let record = self.corners[corner];
        CornerRecord {
            vertex: numbers.in_face(record.face),
            edge: numbers.spoke(record.previous),
            face: numbers.part_of[corner as usize],
            next: numbers.new_corner(corner, BEFORE),
            previous: numbers.new_corner(corner, ON_EDGE),
            radial_next: numbers.new_corner(record.previous, ON_EDGE),
            radial_previous: numbers.new_corner(record.previous, ON_EDGE),
        }
    }

    fn at_edge_before(&self, numbers: &Numbers, corner: u32) -> CornerRecord {
        let record = self.corners[corner];
        let before = self.corners[record.previous];
        CornerRecord {
            vertex: numbers.on_edge(before.edge),
            edge: self.half(numbers, before.edge, record.vertex),
            face: numbers.part_of[corner as usize],
            next: corner,
            previous: numbers.new_corner(corner, IN_FACE),
            radial_next: self.on_half(numbers, before.radial_next, record.vertex),
            radial_previous: self.on_half(numbers, before.radial_previous, record.vertex),
        }
    }

    pub(super) fn refined_faces(&self, numbers: &Numbers) -> Vec<FaceRecord> {
        let mut faces = self.faces.values().to_vec();
        faces.reserve((numbers.corners.count() - numbers.faces.count()) as usize);
        for rank in 0..numbers.corners.count() {
            let corner = numbers.corners.index(rank);
            let face = self.corners[corner].face;
            let part = FaceRecord { corner, size: 4, ..self.faces[face] };
            if part_is_face(numbers, corner, face) {
                faces[face as usize] = part;
            } else {
                faces.push(part);
            }
        }
        faces
    }
}

/// Whether the part at a corner keeps the face's id.
fn part_is_face(numbers: &Numbers, corner: u32, face: u32) -> bool {
    numbers.part_of[corner as usize] == face
}
