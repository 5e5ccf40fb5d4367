//! The slots of new elements.

use crate::edit_mesh::EditMesh;
use crate::records::ALIVE;

/// The elements of one kind that live, numbered without gaps by index.
pub(super) struct Ranks {
    capacity: u32,
    count: u32,
    /// Both empty where every slot is in use: then a rank is an index.
    rank_of: Vec<u32>,
    index_of: Vec<u32>,
}

impl Ranks {
    fn new(alive: u32, is_alive: impl ExactSizeIterator<Item = bool>) -> Self {
        let capacity = is_alive.len() as u32;
        let mut ranks = Self { capacity, count: alive, rank_of: Vec::new(), index_of: Vec::new() };
        if alive < capacity {
            for (index, is_alive) in (0..).zip(is_alive) {
                ranks.rank_of.push(ranks.index_of.len() as u32);
                if is_alive {
                    ranks.index_of.push(index);
                }
            }
        }
        ranks
    }

    pub(super) fn count(&self) -> u32 {
        self.count
    }

    pub(super) fn capacity(&self) -> u32 {
        self.capacity
    }

    #[inline]
    pub(super) fn rank(&self, index: u32) -> u32 {
        if self.rank_of.is_empty() { index } else { self.rank_of[index as usize] }
    }

    #[inline]
    pub(super) fn index(&self, rank: u32) -> u32 {
        if self.index_of.is_empty() { rank } else { self.index_of[rank as usize] }
    }
}

/// The slots of new elements: they follow the old ones.
///
/// - Vertices: one on each edge, then one in each face.
/// - Edges: the second half of each edge, then a *spoke* for each corner, from the vertex on its edge to
///   the one in its face.
/// - Corners: three more for each corner: on its edge, in its face, on the edge before.
/// - Faces: one for each corner that is not the first of its face.
pub(super) struct Numbers {
    pub(super) vertices: u32,
    pub(super) edges: Ranks,
    pub(super) corners: Ranks,
    pub(super) faces: Ranks,
    /// By corner: the part at it.
    pub(super) part_of: Vec<u32>,
}

impl Numbers {
    pub(super) fn of(mesh: &EditMesh) -> Self {
        let flags = mesh.edges.values().iter().map(|record| record.flags & ALIVE != 0);
        let edges = Ranks::new(mesh.slots.edges.alive, flags);
        let is_alive = mesh.corners.values().iter().map(|record| record.face != crate::ids::NONE);
        let corners = Ranks::new(mesh.slots.corners.alive, is_alive);
        let flags = mesh.faces.values().iter().map(|record| record.flags & ALIVE != 0);
        let faces = Ranks::new(mesh.slots.faces.alive, flags);
        let mut part_of = vec![0; corners.capacity() as usize];
        let mut next = faces.capacity();
        for rank in 0..corners.count() {
            let corner = corners.index(rank);
            let face = mesh.corners[corner].face;
            let is_first = mesh.faces[face].corner == corner;
            part_of[corner as usize] = if is_first { face } else { next };
            next += u32::from(!is_first);
        }
        Self { vertices: mesh.vertices.len(), edges, corners, faces, part_of }
    }

    pub(super) fn vertex_total(&self) -> u32 {
        self.vertices + self.edges.count() + self.faces.count()
    }

    pub(super) fn edge_total(&self) -> u32 {
        self.edges.capacity() + self.edges.count() + self.corners.count()
    }

    pub(super) fn corner_total(&self) -> u32 {
        self.corners.capacity() + 3 * self.corners.count()
    }

    /// The vertex on an edge.
    #[inline]
    pub(super) fn on_edge(&self, edge: u32) -> u32 {
        self.vertices + self.edges.rank(edge)
    }

    /// The vertex in a face.
    #[inline]
    pub(super) fn in_face(&self, face: u32) -> u32 {
        self.vertices + self.edges.count() + self.faces.rank(face)
    }

    /// The second half of an edge; the first is the edge itself.
    #[inline]
    pub(super) fn second_half(&self, edge: u32) -> u32 {
        self.edges.capacity() + self.edges.rank(edge)
    }

    #[inline]
    pub(super) fn spoke(&self, corner: u32) -> u32 {
        self.edges.capacity() + self.edges.count() + self.corners.rank(corner)
    }

    /// The corner whose spoke has this number.
    pub(super) fn corner_of_spoke(&self, number: u32) -> u32 {
        self.corners.index(number)
    }

    /// A new corner at a corner: 0 on its edge, 1 in its face, 2 on the edge before.
    #[inline]
    pub(super) fn new_corner(&self, corner: u32, which: u32) -> u32 {
        self.corners.capacity() + 3 * self.corners.rank(corner) + which
    }
}
