//! Selections along a surface: edge loops and rings of quad meshes, the shortest path from one element to
//! another, and growing and shrinking: linked, more, less.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use fixedbitset::FixedBitSet;
use trigon_modelling::{CornerId, EdgeId, EditMesh, FaceId, VertexId};

use super::{ElementKind, MeshSelection, bits};

/// The edge loop through an edge. It continues across vertices where four edges and four faces meet, to the
/// opposite edge; an edge at the border continues along the border. It ends everywhere else, and where it
/// closes.
#[must_use]
pub fn edge_loop(mesh: &EditMesh, start: EdgeId) -> Vec<EdgeId> {
    let mut found = vec![start];
    let [a, b] = mesh.edge_vertices(start);
    for first in [b, a] {
        let (mut edge, mut vertex) = (start, first);
        while let Some(next) = loop_continues(mesh, edge, vertex) {
            if next == start {
                // It is closed: the other direction would find the same edges.
                return found;
            }
            if found.len() > mesh.edge_count() {
                return found;
            }
            found.push(next);
            vertex = mesh.other_vertex(next, vertex);
            edge = next;
        }
    }
    found
}

fn loop_continues(mesh: &EditMesh, edge: EdgeId, vertex: VertexId) -> Option<EdgeId> {
    if mesh.is_boundary(edge) {
        let mut others = mesh.vertex_edges(vertex).filter(|&other| other != edge && mesh.is_boundary(other));
        let next = others.next()?;
        return others.next().is_none().then_some(next);
    }
    if mesh.edge_faces(edge).count() == 0 {
        // Loose edges continue across vertices that have exactly two.
        let mut others = mesh.vertex_edges(vertex).filter(|&other| other != edge);
        let next = others.next()?;
        let is_wire = mesh.edge_faces(next).count() == 0;
        return (others.next().is_none() && is_wire).then_some(next);
    }
    if mesh.vertex_edges(vertex).take(5).count() != 4 || mesh.vertex_faces(vertex).take(5).count() != 4 {
        return None;
    }
    let shares_face =
        |other: EdgeId| mesh.edge_faces(other).any(|face| mesh.edge_faces(edge).any(|f| f == face));
    mesh.vertex_edges(vertex).find(|&other| other != edge && !shares_face(other))
}

/// The edge ring across quads, from an edge to the opposite one and so on, in both directions.
#[must_use]
pub fn edge_ring(mesh: &EditMesh, start: EdgeId) -> Vec<EdgeId> {
    let mut found = vec![start];
    walk_ring(mesh, start, |_, edge| found.push(edge));
    found
}

/// The quads that the ring of an edge crosses.
#[must_use]
pub fn face_loop(mesh: &EditMesh, start: EdgeId) -> Vec<FaceId> {
    let mut found = Vec::new();
    walk_ring(mesh, start, |face, _| found.push(face));
    found.sort_unstable();
    found.dedup();
    found
}

/// Calls back with each quad and the edge on its other side.
fn walk_ring(mesh: &EditMesh, start: EdgeId, mut call: impl FnMut(FaceId, EdgeId)) {
    let sides: Vec<CornerId> = mesh.edge_corners(start).take(2).collect();
    for side in sides {
        let mut corner = side;
        for _ in 0..mesh.face_count() {
            let face = mesh.corner_face(corner);
            if mesh.face_size(face) != 4 {
                break;
            }
            let opposite = mesh.next_corner(mesh.next_corner(corner));
            let edge = mesh.corner_edge(opposite);
            if edge == start {
                call(face, edge);
                return;
            }
            call(face, edge);
            let Some(pair) = mesh.edge_pair(edge) else { break };
            corner = if pair[0] == opposite { pair[1] } else { pair[0] };
        }
    }
}

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

impl MeshSelection {
    /// Selects everything connected to the selection by edges.
    pub fn grow_linked(&mut self, mesh: &EditMesh, kind: ElementKind) {
        let mut reached = FixedBitSet::with_capacity(mesh.vertex_capacity());
        let mut waiting = self.vertices(mesh, kind);
        waiting.iter().for_each(|vertex| reached.insert(vertex.index() as usize));
        while let Some(vertex) = waiting.pop() {
            for neighbor in mesh.vertex_neighbors(vertex) {
                if !reached.put(neighbor.index() as usize) {
                    waiting.push(neighbor);
                }
            }
        }
        let has = |vertex: VertexId| reached.contains(vertex.index() as usize);
        match kind {
            ElementKind::Vertex => {
                let hidden: Vec<usize> =
                    reached.ones().filter(|&v| mesh.is_vertex_hidden(VertexId::new(v as u32))).collect();
                hidden.into_iter().for_each(|vertex| reached.set(vertex, false));
                self.set(reached);
            }
            ElementKind::Edge => {
                let linked = mesh.edges().filter(|&edge| has(mesh.edge_vertices(edge)[0]));
                let visible = linked.filter(|&edge| !mesh.is_edge_hidden(edge));
                self.set(bits(mesh.edge_capacity(), visible.map(EdgeId::index)));
            }
            ElementKind::Face => {
                // All vertices of a face are connected, so one represents all.
                let is_linked = |&face: &FaceId| mesh.face_vertices(face).next().is_some_and(has);
                let visible = mesh.faces().filter(is_linked).filter(|&face| !mesh.is_face_hidden(face));
                self.set(bits(mesh.face_capacity(), visible.map(FaceId::index)));
            }
        }
    }

    /// Grows the selection: vertices with a common face or edge, edges and faces with a common
    /// vertex.
    pub fn grow(&mut self, mesh: &EditMesh, kind: ElementKind) {
        let vertices = self.vertices(mesh, kind);
        let mut grown = self.bits().clone();
        match kind {
            ElementKind::Vertex => {
                grown.grow(mesh.vertex_capacity());
                for vertex in vertices {
                    for neighbor in around(mesh, vertex).filter(|&v| !mesh.is_vertex_hidden(v)) {
                        grown.insert(neighbor.index() as usize);
                    }
                }
            }
            ElementKind::Edge => {
                grown.grow(mesh.edge_capacity());
                for vertex in vertices {
                    for edge in mesh.vertex_edges(vertex).filter(|&e| !mesh.is_edge_hidden(e)) {
                        grown.insert(edge.index() as usize);
                    }
                }
            }
            ElementKind::Face => {
                grown.grow(mesh.face_capacity());
                for vertex in vertices {
                    for face in mesh.vertex_faces(vertex).filter(|&f| !mesh.is_face_hidden(f)) {
                        grown.insert(face.index() as usize);
                    }
                }
            }
        }
        self.set(grown);
    }

    /// Shrinks the selection: deselects elements that touch an unselected one, in the sense of
    /// [`Self::grow`]. The border of a mesh does not count.
    pub fn shrink(&mut self, mesh: &EditMesh, kind: ElementKind) {
        let mut shrunk = self.bits().clone();
        let is_border = |vertex: VertexId| match kind {
            ElementKind::Vertex => around(mesh, vertex).any(|other| !self.contains(other.index())),
            ElementKind::Edge => mesh.vertex_edges(vertex).any(|edge| !self.contains(edge.index())),
            ElementKind::Face => mesh.vertex_faces(vertex).any(|face| !self.contains(face.index())),
        };
        for index in self.indices() {
            let stays = match kind {
                ElementKind::Vertex => !is_border(VertexId::new(index)),
                ElementKind::Edge => !mesh.edge_vertices(EdgeId::new(index)).into_iter().any(is_border),
                ElementKind::Face => !mesh.face_vertices(FaceId::new(index)).any(is_border),
            };
            shrunk.set(index as usize, stays);
        }
        self.set(shrunk);
    }
}

/// The vertices that share a face or an edge with a vertex, including itself.
fn around(mesh: &EditMesh, vertex: VertexId) -> impl Iterator<Item = VertexId> + '_ {
    let by_faces = mesh.vertex_faces(vertex).flat_map(|face| mesh.face_vertices(face));
    by_faces.chain(mesh.vertex_neighbors(vertex))
}

#[cfg(test)]
mod tests {
    use super::*;
    use trigon_mesh::primitives;

    #[test]
    fn loops_and_rings_of_a_torus_go_around_it() {
        let (torus, _) = EditMesh::from_mesh(&primitives::torus(2.0, 0.5, 12, 7));
        let mut lengths = Vec::new();
        for edge in torus.edges() {
            let (around, across) = (edge_loop(&torus, edge), edge_ring(&torus, edge));
            let distinct = |mut edges: Vec<EdgeId>| {
                let count = edges.len();
                edges.sort_unstable();
                edges.dedup();
                (edges.len(), count)
            };
            let faces = face_loop(&torus, edge).len();
            let (distinct_around, length) = distinct(around);
            assert_eq!(distinct_around, length, "no edge of a loop twice");
            lengths.push((length, distinct(across).0, faces));
        }
        lengths.sort_unstable();
        lengths.dedup();
        assert_eq!(lengths, [(7, 12, 12), (12, 7, 7)], "around the tube, and around the axis");
    }

    #[test]
    fn the_loop_of_a_border_is_the_border_and_others_end_there() {
        let (grid, _) = EditMesh::from_mesh(&primitives::grid(2.0, 2.0, 4, 3));
        for edge in grid.edges() {
            let length = edge_loop(&grid, edge).len();
            if grid.is_boundary(edge) {
                assert_eq!(length, 14, "all around");
            } else {
                assert!(length == 3 || length == 4, "from side to side: {length}");
            }
        }
    }

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
