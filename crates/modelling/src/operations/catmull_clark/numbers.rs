//! The slots of new elements.

use crate::edit_mesh::EditMesh;
use crate::ids::FaceId;
use crate::numbering::sorted_once;
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
///   the one in its face. Corners of a face that leave along the same edge share a spoke.
/// - Corners: three more for each corner: on its edge, in its face, on the edge before.
/// - Faces: one for each corner that is not the first of its face.
pub(super) struct Numbers {
    pub(super) vertices: u32,
    pub(super) edges: Ranks,
    pub(super) corners: Ranks,
    pub(super) faces: Ranks,
    /// By corner: the part at it.
    pub(super) part_of: Vec<u32>,
    shared: SharedSpokes,
}

/// Corners whose face leaves along their edge more than once: rare, and mostly none.
#[derive(Default)]
struct SharedSpokes {
    /// (corner, first of those that share its spoke, next of them, previous), by corner.
    corners: Vec<[u32; 4]>,
    /// The ranks of those that have the spoke of another, ascending.
    without: Vec<u32>,
    /// For each of these how many spokes corners of lower rank have.
    spokes_before: Vec<u32>,
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
        let shared = SharedSpokes::of(mesh, &corners);
        Self { vertices: mesh.vertices.len(), edges, corners, faces, part_of, shared }
    }

    pub(super) fn vertex_total(&self) -> u32 {
        self.vertices + self.edges.count() + self.faces.count()
    }

    pub(super) fn edge_total(&self) -> u32 {
        self.edges.capacity() + self.edges.count() + self.spoke_count()
    }

    pub(super) fn corner_total(&self) -> u32 {
        self.corners.capacity() + 3 * self.corners.count()
    }

    pub(super) fn spoke_count(&self) -> u32 {
        self.corners.count() - self.shared.without.len() as u32
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
        let before = self.edges.capacity() + self.edges.count();
        if self.shared.corners.is_empty() {
            return before + self.corners.rank(corner);
        }
        let rank = self.corners.rank(self.first_sharing(corner));
        before + rank - self.shared.without.partition_point(|&without| without < rank) as u32
    }

    /// The corner whose spoke has this number.
    pub(super) fn corner_of_spoke(&self, number: u32) -> u32 {
        let before = self.shared.spokes_before.partition_point(|&spokes| spokes <= number);
        self.corners.index(number + before as u32)
    }

    /// A new corner at a corner: 0 on its edge, 1 in its face, 2 on the edge before.
    #[inline]
    pub(super) fn new_corner(&self, corner: u32, which: u32) -> u32 {
        self.corners.capacity() + 3 * self.corners.rank(corner) + which
    }

    /// The first corner with the same spoke.
    #[inline]
    pub(super) fn first_sharing(&self, corner: u32) -> u32 {
        self.shared.get(corner).map_or(corner, |entry| entry[1])
    }

    /// The next corner with the same spoke, and the previous one; mostly the corner itself.
    #[inline]
    pub(super) fn sharing(&self, corner: u32) -> [u32; 2] {
        self.shared.get(corner).map_or([corner; 2], |entry| [entry[2], entry[3]])
    }
}

impl SharedSpokes {
    #[inline]
    fn get(&self, corner: u32) -> Option<&[u32; 4]> {
        if self.corners.is_empty() {
            return None;
        }
        let index = self.corners.binary_search_by_key(&corner, |entry| entry[0]).ok()?;
        Some(&self.corners[index])
    }

    fn of(mesh: &EditMesh, ranks: &Ranks) -> Self {
        let mut shared = Self::default();
        let mut sides = Vec::new();
        for face in mesh.faces() {
            if mesh.repeats_an_edge(face) {
                sides.clear();
                sides.extend(mesh.face_corners(face).map(|corner| (mesh.corner_edge(corner).0, corner.0)));
                sides.sort_unstable();
                for group in sides.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1) {
                    shared.add(group);
                }
            }
        }
        shared.corners.sort_unstable();
        let others = shared.corners.iter().filter(|entry| entry[0] != entry[1]);
        shared.without = sorted_once(others.map(|entry| ranks.rank(entry[0])).collect());
        shared.spokes_before = (0..).zip(&shared.without).map(|(before, rank)| rank - before).collect();
        shared
    }

    /// Corners of a face that leave along one edge.
    fn add(&mut self, group: &[(u32, u32)]) {
        for (i, &(_, corner)) in group.iter().enumerate() {
            let next = group[(i + 1) % group.len()].1;
            let previous = group[(i + group.len() - 1) % group.len()].1;
            self.corners.push([corner, group[0].1, next, previous]);
        }
    }
}

impl EditMesh {
    /// Whether a face may leave along the same edge more than once.
    fn repeats_an_edge(&self, face: FaceId) -> bool {
        match self.face_size(face) {
            // Two neighbouring sides of a triangle share one vertex only.
            3 => false,
            4 => {
                let corner = self.faces[face.0].corner;
                let opposite = self.corners[self.corners[corner].next].next;
                // Otherwise all four vertices differ, or the sides at one of them do.
                let is_same = |a: u32, b: u32| self.corners[a].vertex == self.corners[b].vertex;
                let (next, last) = (self.corners[corner].next, self.corners[corner].previous);
                is_same(corner, opposite) || is_same(next, last)
            }
            size => {
                let edges = sorted_once(self.face_edges(face).collect());
                edges.len() < size
            }
        }
    }
}
