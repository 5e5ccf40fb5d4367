//! The shortest path from one element to another.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use trigon_modelling::{EdgeId, EditMesh, FaceId, VertexId};

use super::ElementKind;

/// The elements on the shortest path between two, both included, in order; `None` if they are not connected.
/// Vertices are connected by edges, and the path has the length of these; edges and faces are connected by
/// common vertices and common edges, and lengths are those between their centres. Of several shortest paths
/// the one with the smaller indices is taken. Both elements must exist.
#[must_use]
pub fn shortest_path(mesh: &EditMesh, kind: ElementKind, from: u32, to: u32) -> Option<Vec<u32>> {
    let capacity = kind.capacity(mesh);
    let mut search = Search { before: vec![u32::MAX; capacity], lengths: vec![f64::INFINITY; capacity] };
    search.run(mesh, kind, from, to)
}

struct Search {
    before: Vec<u32>,
    lengths: Vec<f64>,
}

/// An element and the length of the path to it; the heap returns the nearest first.
#[derive(PartialEq)]
struct Reached(f64, u32);

impl Eq for Reached {}

impl Ord for Reached {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0).then(self.1.cmp(&other.1))
    }
}

impl PartialOrd for Reached {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Search {
    /// Edsger Dijkstra, "A note on two problems in connexion with graphs", 1959.
    fn run(&mut self, mesh: &EditMesh, kind: ElementKind, from: u32, to: u32) -> Option<Vec<u32>> {
        let mut waiting = BinaryHeap::from([Reverse(Reached(0.0, from))]);
        self.lengths[from as usize] = 0.0;
        let mut neighbors = Vec::new();
        while let Some(Reverse(Reached(length, here))) = waiting.pop() {
            if here == to {
                return Some(self.way_back(from, to));
            }
            if length > self.lengths[here as usize] {
                continue;
            }
            neighbors_of(mesh, kind, here, &mut neighbors);
            let middle = kind.middle_of(mesh, here);
            for &next in &neighbors {
                let step = (kind.middle_of(mesh, next) - middle).length();
                // A position that is not finite is infinitely far away.
                let sum = if step.is_finite() { length + step } else { f64::MAX };
                let known = &mut self.lengths[next as usize];
                // Only steps that make progress: others could close the way back into a circle.
                let is_equal_but_smaller = sum == *known && length < sum && here < self.before[next as usize];
                if sum < *known {
                    *known = sum;
                    self.before[next as usize] = here;
                    waiting.push(Reverse(Reached(sum, next)));
                } else if is_equal_but_smaller && next != from {
                    self.before[next as usize] = here;
                }
            }
        }
        None
    }

    fn way_back(&self, from: u32, to: u32) -> Vec<u32> {
        let mut path = vec![to];
        let mut here = to;
        while here != from && path.len() <= self.before.len() {
            here = self.before[here as usize];
            path.push(here);
        }
        path.reverse();
        path
    }
}

fn neighbors_of(mesh: &EditMesh, kind: ElementKind, index: u32, neighbors: &mut Vec<u32>) {
    neighbors.clear();
    match kind {
        ElementKind::Vertex => {
            let visible = mesh.vertex_edges(VertexId::new(index)).filter(|&e| !mesh.is_edge_hidden(e));
            let vertex = VertexId::new(index);
            neighbors.extend(visible.map(|edge| mesh.other_vertex(edge, vertex).index()));
        }
        ElementKind::Edge => {
            let at = mesh.edge_vertices(EdgeId::new(index)).into_iter().flat_map(|v| mesh.vertex_edges(v));
            neighbors.extend(at.filter(|&e| !mesh.is_edge_hidden(e)).map(EdgeId::index));
        }
        ElementKind::Face => {
            let at = mesh.face_edges(FaceId::new(index)).flat_map(|edge| mesh.edge_faces(edge));
            neighbors.extend(at.filter(|&f| !mesh.is_face_hidden(f)).map(FaceId::index));
        }
    }
    neighbors.retain(|&other| other != index);
}

#[cfg(test)]
mod tests {
    use super::*;
    use trigon_mesh::primitives;

    #[test]
    fn the_path_through_a_grid_is_as_long_as_it_is_apart() {
        let (grid, _) = EditMesh::from_mesh(&primitives::grid(4.0, 3.0, 4, 3));
        let corner = |sign: f32| {
            let is_there = |&v: &VertexId| {
                let position = grid.position(v);
                position.x == 2.0 * sign && position.z == 1.5 * sign
            };
            grid.vertices().find(is_there).expect("a grid has corners").index()
        };
        let path = shortest_path(&grid, ElementKind::Vertex, corner(-1.0), corner(1.0)).expect("connected");
        assert_eq!(path.len(), 8, "seven edges");
        for pair in path.windows(2) {
            let [a, b] = [VertexId::new(pair[0]), VertexId::new(pair[1])];
            assert!(grid.find_edge(a, b).is_some(), "{a} and {b} are joined");
        }
        let faces = shortest_path(&grid, ElementKind::Face, 0, 11).expect("connected");
        assert_eq!(faces.len(), 6, "two to the side and three along, and the first");
        assert_eq!(shortest_path(&grid, ElementKind::Edge, 3, 3), Some(vec![3]), "to itself");
    }

    #[test]
    fn vertices_at_one_place_do_not_make_a_path_a_circle() {
        let mut mesh = EditMesh::new();
        // The last two are in the same place, and the first of them is connected to both others.
        let positions = [0.0, 3.0, 1.0, 3.0].map(|x| trigon_mesh::math::Vec3::new(x, 0.0, 0.0));
        let vertices = positions.map(|position| mesh.add_vertex(position).expect("room"));
        let [start, low, middle, high] = vertices;
        for [a, b] in [[start, middle], [middle, high], [high, low]] {
            mesh.add_edge(a, b).expect("room");
        }
        let way = shortest_path(&mesh, ElementKind::Vertex, start.index(), low.index());
        assert_eq!(way, Some([start, middle, high, low].map(VertexId::index).to_vec()));
    }

    #[test]
    fn no_path_leads_to_another_part() {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::cube(1.0));
        let far = mesh.add_vertex(trigon_mesh::math::Vec3::X).expect("room");
        assert_eq!(shortest_path(&mesh, ElementKind::Vertex, 0, far.index()), None, "a loose vertex");
    }
}
