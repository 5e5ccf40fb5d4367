//! The shortest paths along edges from any of several vertices to all vertices near them.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use fixedbitset::FixedBitSet;

use crate::edit_mesh::EditMesh;
use crate::ids::VertexId;

/// By vertex, the length of the shortest path to the nearest of `sources`; infinite where that
/// is `radius` or more, or where every path leads through a hidden vertex (E. W. Dijkstra, "A
/// Note on Two Problems in Connexion with Graphs", 1959).
pub(super) fn distances_along_edges(
    mesh: &EditMesh,
    sources: &[VertexId],
    is_source: &FixedBitSet,
    radius: f64,
) -> Vec<f64> {
    let mut distances = vec![f64::INFINITY; mesh.vertex_capacity()];
    let mut queue = BinaryHeap::new();
    for &vertex in sources {
        distances[vertex.0 as usize] = 0.0;
        let is_outer = |other: VertexId| !is_source.contains(other.0 as usize);
        // The others are all around at no distance themselves.
        if mesh.vertex_neighbors(vertex).any(is_outer) {
            queue.push(Reverse((0, vertex)));
        }
    }
    while let Some(Reverse((bits, vertex))) = queue.pop() {
        let distance = f64::from_bits(bits);
        if distance > distances[vertex.0 as usize] {
            // A shorter way was found since.
            continue;
        }
        let here = mesh.point(vertex);
        for neighbor in mesh.vertex_neighbors(vertex) {
            let longer = distance + here.distance(mesh.point(neighbor));
            let known = distances[neighbor.0 as usize];
            // Also false for a length that is not a number.
            if longer < known && longer < radius && !mesh.is_vertex_hidden(neighbor) {
                distances[neighbor.0 as usize] = longer;
                // Numbers from 0 on are ordered as their bits.
                queue.push(Reverse((longer.to_bits(), neighbor)));
            }
        }
    }
    distances
}
