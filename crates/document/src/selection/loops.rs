//! Edge loops and rings of quad meshes.

use trigon_modelling::{CornerId, EdgeId, EditMesh, FaceId, VertexId};

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
}
