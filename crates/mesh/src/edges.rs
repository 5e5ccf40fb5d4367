//! Finding the edges of faces: every undirected pair of vertices once.
//!
//! Half-edges are grouped by their smaller vertex and sorted within the group by the larger one. This takes O(n
//! log n) in the worst case, whatever the input: a fan with a million triangles around one vertex is one large
//! group. The numbering follows the faces, so no hash order can affect it.

use crate::groups::Groups;

/// Stands for "no edge": a corner whose next corner is at the same vertex.
pub(crate) const NO_EDGE: u32 = u32::MAX;

/// The edges of a mesh, and the edge that starts at each corner.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Edges {
    /// Smaller vertex first; the faces' edges in order of first use, then loose ones that no face
    /// has.
    pub(crate) edges: Vec<[u32; 2]>,
    /// The number of `edges` that belong to faces.
    pub(crate) face_edge_count: usize,
    /// Per corner the edge to the face's next corner, or [`NO_EDGE`].
    pub(crate) corner_edges: Vec<u32>,
}

/// Finds the edges of all faces and adds the loose ones.
///
/// `next_vertices` holds the vertex of the corner that follows, per corner.
/// The caller has checked that corners and loose edges together are fewer
/// than `u32::MAX`.
pub(crate) fn find_edges(
    vertex_count: usize,
    corner_vertices: &[u32],
    next_vertices: &[u32],
    loose: &[[u32; 2]],
) -> Edges {
    let half_edges = || {
        let of_faces = corner_vertices.iter().zip(next_vertices);
        let of_faces = of_faces.map(|(&from, &to)| [from, to]);
        of_faces.chain(loose.iter().copied()).map(sorted)
    };
    let count = corner_vertices.len() + loose.len();
    let first = first_alike(vertex_count, count, half_edges().zip(0u32..));
    let mut edges = Vec::with_capacity(corner_vertices.len() / 2 + loose.len());
    let mut numbers = first;
    let mut face_edge_count = 0;
    for (index, edge) in half_edges().enumerate() {
        if index == corner_vertices.len() {
            face_edge_count = edges.len();
        }
        let first = numbers[index];
        if first as usize == index {
            numbers[index] = edges.len() as u32;
            edges.push(edge);
        } else if first != NO_EDGE {
            // Earlier half-edges have their final number already.
            numbers[index] = numbers[first as usize];
        }
    }
    if loose.is_empty() {
        face_edge_count = edges.len();
    }
    numbers.truncate(corner_vertices.len());
    Edges { edges, face_edge_count, corner_edges: numbers }
}

/// For each half-edge the first one that joins the same two vertices.
fn first_alike(
    vertex_count: usize,
    count: usize,
    half_edges: impl Iterator<Item = ([u32; 2], u32)> + Clone,
) -> Vec<u32> {
    let with_length = half_edges.filter(|([low, high], _)| low != high);
    let keyed = with_length.map(|([low, high], index)| (low, pack(high, index)));
    let mut first = vec![NO_EDGE; count];
    let mut groups = Groups::new(vertex_count, keyed);
    for group in groups.iter_mut() {
        group.sort_unstable();
        let mut run = (NO_EDGE, NO_EDGE);
        for &item in group.iter() {
            let (high, index) = unpack(item);
            if run.0 != high {
                run = (high, index);
            }
            first[index as usize] = run.1;
        }
    }
    first
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    if a <= b { [a, b] } else { [b, a] }
}

/// Sorts by vertex first, then by half-edge.
fn pack(high: u32, index: u32) -> u64 {
    u64::from(high) << 32 | u64::from(index)
}

fn unpack(item: u64) -> (u32, u32) {
    ((item >> 32) as u32, item as u32)
}
