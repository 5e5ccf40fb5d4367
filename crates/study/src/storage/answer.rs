//! The tasks that each representation performs, and the code that all of them share.

use trigon_math::Vec3;

/// A representation of a closed triangle mesh.
pub trait Storage {
    /// What the lists hold in memory.
    fn bytes(&self) -> usize;

    /// How many indices of vertices, edges, faces and corners were read so far: counted where they are read, in a
    /// representation that was made for counting, and 0 in the others.
    fn reads(&self) -> u64;

    /// The edge nearest to a point of a face: the one that a click means. Its smaller
    /// vertex is first.
    fn nearest_edge(&self, face: u32, point: Vec3) -> [u32; 2];

    /// The triangles about a vertex, whose planes change with it: vertices in ascending
    /// order, triangles likewise.
    fn triangles_around(&self, vertex: u32) -> Vec<[u32; 3]>;

    /// The vertices that share an edge with a vertex, in ascending order.
    fn neighbours(&self, vertex: u32) -> Vec<u32>;
}

/// The smaller vertex first.
pub(super) fn edge(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// The edge nearest to a point.
pub(super) fn nearest(
    edges: impl IntoIterator<Item = [u32; 2]>,
    positions: &[Vec3],
    point: Vec3,
) -> [u32; 2] {
    let distance = |[a, b]: [u32; 2]| {
        let [from, to] = [a, b].map(|vertex| positions[vertex as usize]);
        let along = to - from;
        let share = ((point - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        point.distance_squared(from + along * share)
    };
    let edges = edges.into_iter().map(|[a, b]| edge(a, b));
    let best = edges.min_by(|&a, &b| distance(a).total_cmp(&distance(b)));
    best.expect("a closed mesh has edges")
}

/// In the order that [`Storage`] promises.
pub(super) fn in_order(mut triangles: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
    triangles.iter_mut().for_each(|triangle| triangle.sort_unstable());
    triangles.sort_unstable();
    triangles
}

/// What a list holds in memory.
pub(super) fn byte_count<T>(list: &[T]) -> usize {
    size_of_val(list)
}
