//! Bridging two edge loops with a strip of faces.

use trigon_math::{DVec3, area_vector};

use super::delete::require;
use super::fill::Filled;
use super::outlines::Chain;
use super::parts::fill_strip;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::refusal::Refusal;
use crate::slots::NewElements;

const BRIDGING: &str = "bridging";

/// The two rows of a strip: indices into a list of vertices.
struct Rows {
    vertices: Vec<VertexId>,
    /// For each of them an adjacent corner, whose values new corners take.
    sources: Vec<Option<CornerId>>,
    /// A loop repeats its first vertex at the end.
    row: Vec<u32>,
    other: Vec<u32>,
}

impl EditMesh {
    /// Joins two edge loops, or two open chains, with a strip of faces: quads, and evenly
    /// distributed triangles where the counts differ.
    ///
    /// The order and direction of the edges do not matter. The twist is chosen for the shortest edges across:
    /// the sum of their squared lengths is compared for both directions and every start, at up to 64 evenly
    /// spread positions. New faces are wound like the neighbours of both loops; without neighbours they face
    /// away from the middle of the strip. New faces have the material of the first neighbour, and its values
    /// at the corners there. Faces that fill a loop stay; [`bridge_faces`](Self::bridge_faces) removes them.
    ///
    /// # Errors
    /// No edge is given, one does not exist, or they are not two loops or two chains without a common vertex.
    pub fn bridge_edges(&mut self, edges: &[EdgeId]) -> Result<Filled, Refusal> {
        require(edges, BRIDGING, "two loops of edges")?;
        let chains = self.chains(edges, BRIDGING)?;
        let refused = |reason| Err(Refusal::NotPossible { operation: BRIDGING, reason });
        let [first, second] = &chains[..] else {
            return refused("exactly two separate loops or chains are needed");
        };
        if first.is_closed != second.is_closed {
            return refused("one is a loop and the other is open: close or open one");
        }
        let second = self.aligned(first, second);
        let rows = self.rows(first, &second);
        let mut pieces: Vec<Vec<u32>> = Vec::new();
        fill_strip(&rows.row, &rows.other, |piece| pieces.push(piece.to_vec()));
        if self.is_turned_over(first, &second, &pieces, &rows) {
            pieces.iter_mut().for_each(|piece| piece.reverse());
        }
        self.check_capacity_for(NewElements {
            vertices: 0,
            edges: 3 * pieces.len() as u64,
            corners: 4 * pieces.len() as u64,
            faces: pieces.len() as u64,
        })?;
        self.whole(|mesh| {
            let mut filled = Filled::default();
            for piece in pieces {
                mesh.add_piece(&piece, &rows, &mut filled)?;
            }
            if let Some(&source) = rows.sources.iter().flatten().next() {
                let neighbor = mesh.corner_face(source);
                filled.faces.iter().for_each(|&face| mesh.copy_face(neighbor, face));
            }
            Ok(filled)
        })
    }

    /// The second chain, rotated for the shortest edges across.
    fn aligned(&self, first: &Chain, second: &Chain) -> Chain {
        let from: Vec<DVec3> = first.vertices.iter().map(|&vertex| self.point(vertex)).collect();
        let mut best: Option<(f64, Chain)> = None;
        for is_reversed in [false, true] {
            let mut vertices = second.vertices.clone();
            if is_reversed {
                vertices.reverse();
            }
            let to: Vec<DVec3> = vertices.iter().map(|&vertex| self.point(vertex)).collect();
            let starts = if second.is_closed { to.len() } else { 1 };
            for start in 0..starts {
                let cost = cost_across(&from, &to, start, first.is_closed);
                // A cost of NaN is never better.
                if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                    let mut vertices = vertices.clone();
                    vertices.rotate_left(start);
                    best = Some((cost, Chain { vertices, is_closed: second.is_closed }));
                }
            }
        }
        best.expect("a chain has vertices").1
    }

    fn rows(&self, first: &Chain, second: &Chain) -> Rows {
        let mut sources = self.corners_beside(first);
        sources.append(&mut self.corners_beside(second));
        let vertices = [&first.vertices[..], &second.vertices].concat();
        let counts = [first, second].map(|chain| chain.vertices.len() as u32);
        let mut row: Vec<u32> = (0..counts[0]).collect();
        let mut other: Vec<u32> = (counts[0]..counts[0] + counts[1]).collect();
        if first.is_closed {
            row.push(0);
            other.push(counts[0]);
        }
        Rows { vertices, sources, row, other }
    }

    /// Whether the strip, which runs along the first chain and back along the second, must be wound
    /// the other way.
    fn is_turned_over(&self, first: &Chain, second: &Chain, pieces: &[Vec<u32>], rows: &Rows) -> bool {
        let votes = self.winding_votes(first.steps()) - self.winding_votes(second.steps());
        if votes != 0 {
            return votes < 0;
        }
        let count = rows.vertices.len() as f64;
        let middle = rows.vertices.iter().map(|&vertex| self.point(vertex)).sum::<DVec3>() / count;
        let outwards: f64 = pieces
            .iter()
            .map(|piece| {
                let points = || piece.iter().map(|&index| self.point(rows.vertices[index as usize]) - middle);
                area_vector(points()).dot(points().sum())
            })
            .sum();
        outwards < 0.0
    }

    fn add_piece(&mut self, piece: &[u32], rows: &Rows, filled: &mut Filled) -> Result<(), Refusal> {
        let vertices: Vec<VertexId> = piece.iter().map(|&index| rows.vertices[index as usize]).collect();
        for (i, &vertex) in vertices.iter().enumerate() {
            self.join_new(vertex, vertices[(i + 1) % vertices.len()], &mut filled.edges);
        }
        let face: FaceId = self.add_first_face(&vertices, BRIDGING)?;
        let corners: Vec<CornerId> = self.face_corners(face).collect();
        for (&corner, &index) in corners.iter().zip(piece) {
            if let Some(source) = rows.sources[index as usize] {
                self.copy_corner(source, corner);
            }
        }
        filled.faces.push(face);
        Ok(())
    }
}

/// The sum of squared lengths across, from evenly spread positions of one row to those of another
/// that begins at `start`.
fn cost_across(from: &[DVec3], to: &[DVec3], start: usize, is_closed: bool) -> f64 {
    /// Comparing this many positions aligns a loop of any length in time proportional to it.
    const MOST: usize = 64;
    let sample_count = from.len().max(to.len()).min(MOST);
    let sample = |count: usize, i: usize| match is_closed {
        true => i * count / sample_count,
        false => i * (count - 1) / (sample_count - 1).max(1),
    };
    let squared = |i: usize| {
        let other = to[(start + sample(to.len(), i)) % to.len()];
        from[sample(from.len(), i)].distance_squared(other)
    };
    (0..sample_count).map(squared).sum()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::{Vec3, elementary::sin_cos};
    use trigon_mesh::primitives;

    use super::*;
    use crate::tests::{check_operation, meshes};

    fn counts(mesh: &EditMesh) -> [usize; 3] {
        mesh.check_structure().expect("whole");
        [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()]
    }

    /// A ring of edges around the Z axis, from an angle in turns.
    fn ring(mesh: &mut EditMesh, sides: usize, z: f64, turn: f64) -> Vec<EdgeId> {
        let vertices: Vec<VertexId> = (0..sides)
            .map(|i| {
                let (sin, cos) = sin_cos(std::f64::consts::TAU * (i as f64 / sides as f64 + turn));
                mesh.add_vertex(DVec3::new(cos, sin, z).as_vec3()).expect("room")
            })
            .collect();
        let next = vertices.iter().cycle().skip(1);
        vertices.iter().zip(next).map(|(&a, &b)| mesh.add_edge(a, b).expect("two")).collect()
    }

    /// Positive where the faces of a tube around the origin face outwards.
    fn sum_of_outward_areas(mesh: &EditMesh) -> f64 {
        let of_face = |face| {
            let points: Vec<DVec3> = mesh.face_vertices(face).map(|vertex| mesh.point(vertex)).collect();
            area_vector(points.iter().copied()).dot(points[0])
        };
        mesh.faces().map(of_face).sum()
    }

    #[test]
    fn two_rings_make_a_tube_whatever_the_order() {
        for turn in [0.0, 0.2, 0.5, 0.9] {
            let mut mesh = EditMesh::new();
            let mut edges = ring(&mut mesh, 8, 0.0, 0.0);
            edges.extend(ring(&mut mesh, 8, 1.0, turn));
            let mut turned = mesh.clone();
            let filled = mesh.bridge_edges(&edges).expect("two loops");
            assert_eq!((counts(&mesh), filled.edges.len()), ([16, 24, 8], 8), "eight quads");
            assert!(sum_of_outward_areas(&mesh) > 0.0, "they face outwards");
            // A turn by less than half a side: the nearest vertex is at most that far away.
            let longest = filled.edges.iter().map(|&edge| {
                let [a, b] = mesh.edge_vertices(edge).map(|vertex| mesh.point(vertex));
                a.distance(b)
            });
            // √(1² + (2 sin(π/16))²) and a margin for rounding.
            assert!(longest.fold(0.0, f64::max) < 1.074, "no twist at {turn}");
            edges.reverse();
            turned.bridge_edges(&edges).expect("two loops");
            assert!(turned == mesh, "the order does not matter");
        }
    }

    #[test]
    fn loops_of_unequal_counts_are_joined_evenly() {
        let mut mesh = EditMesh::new();
        let mut edges = ring(&mut mesh, 12, 0.0, 0.0);
        edges.extend(ring(&mut mesh, 5, 1.0, 0.0));
        let filled = mesh.bridge_edges(&edges).expect("two loops");
        counts(&mesh);
        let corners: usize = filled.faces.iter().map(|&face| mesh.face_size(face)).sum();
        // Each side of both loops is in one face, each edge across in two.
        assert_eq!(corners, 12 + 5 + 2 * filled.edges.len(), "a closed strip");
        assert!(edges.iter().all(|&edge| mesh.is_boundary(edge)), "each side is used once");
        assert!(filled.edges.iter().all(|&edge| mesh.edge_pair(edge).is_some()), "no gap");
    }

    #[test]
    fn the_missing_side_of_a_box_is_wound_like_the_faces_around_it() {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        let is_lid = |mesh: &EditMesh, face: FaceId| {
            mesh.face_vertices(face).all(|vertex| mesh.position(vertex).y == 1.0)
                || mesh.face_vertices(face).all(|vertex| mesh.position(vertex).y == -1.0)
        };
        let lids: Vec<FaceId> = mesh.faces().filter(|&face| is_lid(&mesh, face)).collect();
        let sides: Vec<FaceId> = mesh.faces().filter(|face| !lids.contains(face)).collect();
        sides.iter().for_each(|&face| mesh.set_material(face, 3));
        mesh.delete_faces(&lids).expect("they are there");
        mesh.delete_faces(&sides[..1]).expect("it is there");
        // What is left is a U of three sides: its open ends are two chains.
        let ends: Vec<EdgeId> = mesh
            .edges()
            .filter(|&edge| {
                let [a, b] = mesh.edge_vertices(edge).map(|vertex| mesh.position(vertex));
                mesh.is_boundary(edge) && a.y != b.y
            })
            .collect();
        let filled = mesh.bridge_edges(&ends).expect("two edges");
        assert_eq!((filled.faces.len(), counts(&mesh)), (1, [8, 12, 4]), "the fourth side");
        assert_eq!(mesh.material(filled.faces[0]), 3, "like its neighbours");
        let is_opposite = |[a, b]: [CornerId; 2]| mesh.corner_vertex(a) != mesh.corner_vertex(b);
        assert!(ends.iter().all(|&edge| mesh.edge_pair(edge).is_some_and(is_opposite)), "wound alike");
    }

    #[test]
    fn what_cannot_be_bridged_is_said() {
        let mut mesh = EditMesh::new();
        let one = ring(&mut mesh, 4, 0.0, 0.0);
        assert!(mesh.bridge_edges(&one).is_err(), "one loop");
        let two = ring(&mut mesh, 4, 1.0, 0.0);
        let (open, mut all) = ([&one[..], &two[1..]].concat(), [&one[..], &two].concat());
        assert!(mesh.bridge_edges(&open).is_err(), "a loop and a chain");
        all.extend(ring(&mut mesh, 4, 2.0, 0.0));
        assert!(mesh.bridge_edges(&all).is_err(), "three loops");
        assert!(mesh.bridge_edges(&[]).is_err(), "nothing");
        mesh.set_position(VertexId(0), Vec3::NAN);
        mesh.bridge_edges(&all[..8]).expect("places are not asked for more than they tell");
        counts(&mesh);
    }

    proptest! {
        #[test]
        fn bridging_keeps_every_rule(start in meshes(), picks in prop::collection::vec(any::<u32>(), 2..4)) {
            let (mesh, _) = EditMesh::from_mesh(&start);
            // Two edges without a common vertex are two chains.
            let all: Vec<EdgeId> = mesh.edges().collect();
            let edges = picks.iter().filter_map(|&pick| all.get(pick as usize % all.len().max(1)).copied());
            let edges: Vec<EdgeId> = edges.collect();
            let outcome = check_operation(&mesh, |mesh| mesh.bridge_edges(&edges));
            if let Some((after, filled)) = outcome.map_err(TestCaseError::fail)? {
                prop_assert_eq!(after.face_count(), mesh.face_count() + filled.faces.len());
                prop_assert_eq!(after.edge_count(), mesh.edge_count() + filled.edges.len());
            }
        }
    }
}
