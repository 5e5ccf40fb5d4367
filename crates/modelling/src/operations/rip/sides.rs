//! The sides of the edges along which a mesh opens, and which side is detached.

use std::collections::{BTreeMap, BTreeSet};

use trigon_math::DVec3;

use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, VertexId};

/// The corners around the edges, in fans: corners at one vertex that edges of the rip do not part.
pub(super) struct RipSides {
    /// For each corner at an end of an edge, the number of its fan.
    fans: BTreeMap<CornerId, usize>,
    /// Which fans lie on one side of the edges.
    sides: Groups,
    /// Which sides are beside each other along a chain of edges.
    chains: Groups,
    /// How far the faces of each fan lie in the direction, from the edges.
    distances: Vec<f64>,
    /// Vertices at which the edges part corners.
    parted: BTreeSet<VertexId>,
    /// Both ends of all edges.
    ends: BTreeSet<VertexId>,
    /// The face corners that leave along the edges.
    along: Vec<CornerId>,
    /// How far the face of each of these lies in the direction from its edge, as a part of its distance.
    far: Vec<f64>,
}

impl RipSides {
    /// For edges in ascending order, each between two faces.
    pub(super) fn new(mesh: &EditMesh, edges: Vec<EdgeId>, direction: DVec3) -> Self {
        let ends: BTreeSet<VertexId> = edges.iter().flat_map(|&edge| mesh.edge_vertices(edge)).collect();
        let corners = ends.iter().flat_map(|&vertex| mesh.vertex_corners(vertex));
        let mut sides = Self {
            fans: corners.zip(0..).collect(),
            sides: Groups::default(),
            chains: Groups::default(),
            distances: Vec::new(),
            parted: BTreeSet::new(),
            along: edges.iter().flat_map(|&edge| mesh.edge_corners(edge)).collect(),
            far: Vec::new(),
            ends,
        };
        sides.join_fans(mesh, &edges);
        sides.measure(mesh, direction);
        for pair in sides.along.chunks_exact(2) {
            let [one, other] = [pair[0], pair[1]].map(|corner| sides.fans[&corner]);
            sides.chains.join(one, other);
        }
        sides.chains.flatten();
        sides
    }

    /// Numbers corners at a vertex alike that edges outside of the rip join, then what lies on one side.
    fn join_fans(&mut self, mesh: &EditMesh, edges: &[EdgeId]) {
        let mut fans = Groups::new(self.fans.len());
        for &vertex in &self.ends {
            for edge in mesh.vertex_edges(vertex).filter(|edge| edges.binary_search(edge).is_err()) {
                let mut at_vertex =
                    mesh.edge_corners(edge).map(|corner| self.fans[&at(mesh, corner, vertex)]);
                if let Some(first) = at_vertex.next() {
                    at_vertex.for_each(|other| fans.join(first, other));
                }
            }
        }
        fans.flatten();
        self.fans.values_mut().for_each(|fan| *fan = fans.first(*fan));
        for &vertex in &self.ends {
            let mut around = mesh.vertex_corners(vertex).map(|corner| self.fans[&corner]);
            let first = around.next();
            if around.any(|fan| Some(fan) != first) {
                self.parted.insert(vertex);
            }
        }
        (self.sides, self.chains) = (Groups::new(fans.firsts.len()), Groups::new(fans.firsts.len()));
        for &corner in &self.along {
            let next = mesh.next_corner(corner);
            let is_parted = |corner| self.parted.contains(&mesh.corner_vertex(corner));
            let [here, there] = [corner, next].map(|corner| self.fans[&corner]);
            self.chains.join(here, there);
            if is_parted(corner) && is_parted(next) {
                self.sides.join(here, there);
            }
        }
        self.sides.flatten();
    }

    fn measure(&mut self, mesh: &EditMesh, direction: DVec3) {
        self.distances = vec![0.0; self.sides.firsts.len()];
        for &corner in &self.along {
            let next = mesh.next_corner(corner);
            let middle =
                0.5 * (mesh.point(mesh.corner_vertex(corner)) + mesh.point(mesh.corner_vertex(next)));
            let way = mesh.face_center(mesh.corner_face(corner)) - middle;
            let distance = way.normalize_or_zero().dot(direction);
            self.far.push(distance);
            for corner in [corner, next] {
                if self.parted.contains(&mesh.corner_vertex(corner)) {
                    self.distances[self.sides.first(self.fans[&corner])] += distance;
                }
            }
        }
    }

    /// Whether a vertex is an end of one of the edges.
    pub(super) fn is_at_edge(&self, vertex: VertexId) -> bool {
        self.ends.contains(&vertex)
    }

    /// The corners of the side of each chain that lies farthest in the direction. Of an edge whose ends are
    /// not parted, those of its face that does.
    pub(super) fn loose_corners(&self, mesh: &EditMesh) -> Vec<CornerId> {
        let mut best: BTreeMap<usize, (f64, usize)> = BTreeMap::new();
        for (&corner, &fan) in &self.fans {
            if self.parted.contains(&mesh.corner_vertex(corner)) {
                let side = self.sides.first(fan);
                let found = (self.distances[side], side);
                let best = best.entry(self.chains.first(fan)).or_insert(found);
                if found.0 > best.0 {
                    *best = found;
                }
            }
        }
        let is_loose = |&(corner, fan): &(&CornerId, &usize)| {
            let side = self.sides.first(*fan);
            self.parted.contains(&mesh.corner_vertex(*corner))
                && best.get(&self.chains.first(*fan)).is_some_and(|(_, best)| *best == side)
        };
        let mut loose: Vec<CornerId> = self.fans.iter().filter(is_loose).map(|(&corner, _)| corner).collect();
        for (pair, far) in self.along.chunks_exact(2).zip(self.far.chunks_exact(2)) {
            if !best.contains_key(&self.chains.first(self.fans[&pair[0]])) {
                let corner = pair[usize::from(far[1] > far[0])];
                loose.extend([corner, mesh.next_corner(corner)]);
            }
        }
        loose
    }
}

/// The corner at a vertex of the face side that a corner leaves along.
fn at(mesh: &EditMesh, side: CornerId, vertex: VertexId) -> CornerId {
    if mesh.corner_vertex(side) == vertex { side } else { mesh.next_corner(side) }
}

/// Numbers in groups, each known by its first member.
#[derive(Default)]
struct Groups {
    firsts: Vec<usize>,
}

impl Groups {
    fn new(count: usize) -> Self {
        Self { firsts: (0..count).collect() }
    }

    fn first(&self, mut number: usize) -> usize {
        while self.firsts[number] != number {
            number = self.firsts[number];
        }
        number
    }

    fn join(&mut self, one: usize, other: usize) {
        let (one, other) = (self.shortened(one), self.shortened(other));
        self.firsts[one.max(other)] = one.min(other);
    }

    /// The first member; halves the path for the next search.
    fn shortened(&mut self, mut number: usize) -> usize {
        while self.firsts[number] != number {
            self.firsts[number] = self.firsts[self.firsts[number]];
            number = self.firsts[number];
        }
        number
    }

    /// Lets each number know its first member itself.
    fn flatten(&mut self) {
        // A first member is never greater, so it is known already.
        for number in 0..self.firsts.len() {
            self.firsts[number] = self.firsts[self.firsts[number]];
        }
    }
}
