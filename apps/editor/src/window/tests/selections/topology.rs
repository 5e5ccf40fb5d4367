//! Loops, rings and shortest paths of a mesh by its polygons alone.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use trigon_window::scene::math::DVec3;
use trigon_window::scene::mesh::Mesh;

use super::oracle::Kind;

/// What lies beside what.
pub(super) struct Topology<'m> {
    mesh: &'m Mesh,
    /// The edges around each face, in their order.
    around: Vec<Vec<u32>>,
    faces_of: Vec<Vec<u32>>,
    edges_at: Vec<Vec<u32>>,
}

impl<'m> Topology<'m> {
    pub(super) fn new(mesh: &'m Mesh) -> Self {
        let numbers: BTreeMap<[u32; 2], u32> =
            mesh.edges().iter().map(|ends| sorted(*ends)).zip(0..).collect();
        let (mut faces_of, mut edges_at) =
            (vec![Vec::new(); mesh.edge_count()], vec![Vec::new(); mesh.vertex_count()]);
        for (edge, [a, b]) in (0..).zip(mesh.edges()) {
            edges_at[*a as usize].push(edge);
            edges_at[*b as usize].push(edge);
        }
        let mut around = Vec::new();
        for face in 0..mesh.face_count() {
            let corners = mesh.face_vertices(face);
            let side = |i: usize| numbers[&sorted([corners[i], corners[(i + 1) % corners.len()]])];
            let sides: Vec<u32> = (0..corners.len()).map(side).collect();
            sides.iter().for_each(|edge| faces_of[*edge as usize].push(face as u32));
            around.push(sides);
        }
        Self { mesh, around, faces_of, edges_at }
    }

    fn ends(&self, edge: u32) -> [u32; 2] {
        self.mesh.edges()[edge as usize]
    }

    /// The edges that go on straight over vertices of four edges and four faces, and along borders.
    pub(super) fn edge_loop(&self, start: u32) -> BTreeSet<u32> {
        let mut found = BTreeSet::from([start]);
        let mut waiting: Vec<(u32, u32)> = self.ends(start).map(|end| (start, end)).to_vec();
        while let Some((edge, vertex)) = waiting.pop() {
            if let Some(next) = self.straight_on(edge, vertex).filter(|next| found.insert(*next)) {
                let [a, b] = self.ends(next);
                waiting.push((next, if a == vertex { b } else { a }));
            }
        }
        found
    }

    fn straight_on(&self, edge: u32, vertex: u32) -> Option<u32> {
        let others = self.edges_at[vertex as usize].iter().copied().filter(|other| *other != edge);
        let count = |edge: u32| self.faces_of[edge as usize].len();
        let others: Vec<u32> = match count(edge) {
            1 => others.filter(|other| count(*other) == 1).collect(),
            0 if others.clone().all(|other| count(other) == 0) => others.collect(),
            0 => return None,
            _ => {
                let mut faces: Vec<u32> = self.edges_at[vertex as usize]
                    .iter()
                    .flat_map(|at| self.faces_of[*at as usize].clone())
                    .collect();
                faces.sort_unstable();
                faces.dedup();
                if self.edges_at[vertex as usize].len() != 4 || faces.len() != 4 {
                    return None;
                }
                let shares = |other: &u32| {
                    self.faces_of[*other as usize]
                        .iter()
                        .any(|face| self.faces_of[edge as usize].contains(face))
                };
                others.filter(|other| !shares(other)).collect()
            }
        };
        if let [next] = others[..] { Some(next) } else { None }
    }

    /// The edges across quads from an edge, and those quads.
    pub(super) fn ring(&self, start: u32) -> (BTreeSet<u32>, BTreeSet<u32>) {
        let (mut edges, mut faces) = (BTreeSet::from([start]), BTreeSet::new());
        let mut waiting = vec![start];
        while let Some(edge) = waiting.pop() {
            // Where three faces meet there is no other side.
            let sides = &self.faces_of[edge as usize];
            for &face in sides.iter().filter(|_| sides.len() <= 2) {
                let around = &self.around[face as usize];
                if around.len() != 4 || !faces.insert(face) {
                    continue;
                }
                let place = around.iter().position(|side| *side == edge).expect("it is one of them");
                let opposite = around[(place + 2) % 4];
                if edges.insert(opposite) {
                    waiting.push(opposite);
                }
            }
        }
        (edges, faces)
    }

    /// The elements next to one.
    fn beside(&self, kind: Kind, element: u32) -> Vec<u32> {
        match kind {
            Kind::Vertex => {
                let other = |edge: &u32| self.ends(*edge).into_iter().find(|end| *end != element);
                self.edges_at[element as usize].iter().filter_map(other).collect()
            }
            Kind::Edge => {
                self.ends(element).iter().flat_map(|end| self.edges_at[*end as usize].clone()).collect()
            }
            Kind::Face => {
                let around = self.around[element as usize].iter();
                around.flat_map(|edge| self.faces_of[*edge as usize].clone()).collect()
            }
        }
    }

    fn middle(&self, kind: Kind, element: u32) -> DVec3 {
        let mean = |vertices: &[u32]| {
            let places = vertices.iter().map(|vertex| self.mesh.positions()[*vertex as usize].as_dvec3());
            places.sum::<DVec3>() / vertices.len() as f64
        };
        match kind {
            Kind::Vertex => mean(&[element]),
            Kind::Edge => mean(&self.ends(element)),
            Kind::Face => mean(self.mesh.face_vertices(element as usize)),
        }
    }

    /// How far all elements are from one, over those that may be passed.
    fn distances(&self, kind: Kind, from: u32, passes: impl Fn(u32) -> bool) -> BTreeMap<u32, f64> {
        let mut known = BTreeMap::from([(from, 0.0)]);
        let mut waiting = VecDeque::from([from]);
        while let Some(here) = waiting.pop_front() {
            let length = known[&here];
            for next in self.beside(kind, here).into_iter().filter(|next| passes(*next)) {
                let sum = length + self.middle(kind, here).distance(self.middle(kind, next));
                if known.get(&next).is_none_or(|old| sum < *old) {
                    known.insert(next, sum);
                    waiting.push_back(next);
                }
            }
        }
        known
    }

    /// Whether elements are a shortest path between two; of those that are not joined, whether they are the last.
    pub(super) fn is_shortest(&self, kind: Kind, [from, to]: [u32; 2], path: &BTreeSet<u32>) -> bool {
        let (ahead, back) = (self.distances(kind, from, |_| true), self.distances(kind, to, |_| true));
        let Some(&shortest) = ahead.get(&to) else { return *path == BTreeSet::from([from, to]) };
        // Sums of some hundred lengths in another order.
        let is_equal = |a: f64| (a - shortest).abs() <= 1e-9 * shortest.max(1.0);
        let within = self.distances(kind, from, |element| path.contains(&element));
        let on_way =
            |element: &u32| ahead.get(element).zip(back.get(element)).is_some_and(|(a, b)| is_equal(a + b));
        within.get(&to).is_some_and(|length| is_equal(*length)) && path.iter().all(on_way)
    }
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}
