//! Stitching: islands of texture coordinates are brought together along edges.

#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, VecDeque};

use trigon_math::{DVec2, DisjointSets};

use super::factor::{conjugate, times};
use super::islands::uv_charts;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId};
use crate::numbering::sorted_once;
use crate::refusal::Refusal;

const OPERATION: &str = "stitching";

/// Parameters of [`EditMesh::stitch_uvs`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StitchSettings {
    /// The set of texture coordinates, from 0.
    pub uv_set: usize,
    /// The face whose island stays where it is, if it is one of those; otherwise the island with most faces does.
    pub active: Option<FaceId>,
    /// Whether both sides meet in the middle, and not at that of the island that was there first.
    pub at_midpoints: bool,
    /// Whether edges are no seams afterwards.
    pub clear_seams: bool,
}

impl Default for StitchSettings {
    /// The first set; without midpoints, and seams are cleared.
    fn default() -> Self {
        Self { uv_set: 0, active: None, at_midpoints: false, clear_seams: true }
    }
}

/// What was stitched.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Stitched {
    /// How many edges have the same coordinates on both sides now.
    pub edges: usize,
    /// How many islands were moved.
    pub islands: usize,
}

impl EditMesh {
    /// Brings the islands on both sides of edges together: each is turned and moved to one that was there before it, as
    /// closely as possible in the sense of least squares, and then both sides get the same coordinates. Islands that hang
    /// together through edges come to one that stays ([`StitchSettings::active`]), those beside it first. Two sides of one
    /// island meet in the middle. Sizes do not change, and pins hold nothing. Edges without two faces that wind alike, and
    /// those with the same coordinates on both sides, are left out.
    ///
    /// # Errors
    /// No edge is given, one does not exist, or all are left out; there is no such set; or coordinates are not finite.
    pub fn stitch_uvs(&mut self, edges: &[EdgeId], settings: &StitchSettings) -> Result<Stitched, Refusal> {
        let not_possible = |reason| Err(Refusal::NotPossible { operation: OPERATION, reason });
        self.check_edges(edges, OPERATION)?;
        if settings.uv_set >= self.uv_set_count() {
            return not_possible("there are no such texture coordinates; unwrap the faces first");
        }
        let mut layout = IslandLayout::new(self, settings.uv_set);
        let edges = sorted_once(edges.to_vec());
        let cuts: Vec<Cut> = edges.iter().filter_map(|&edge| layout.cut(self, edge)).collect();
        if cuts.is_empty() {
            return not_possible(
                "no edge has different texture coordinates on its two sides; select one that has",
            );
        }
        let active = settings.active.filter(|&face| self.has_face(face));
        let order = Order::new(&layout, &cuts, active.and_then(|face| layout.island_of_face(self, face)));
        order.moves.iter().for_each(|moved| layout.bring(moved));
        let joined = layout.joined(&cuts, &order, settings.at_midpoints);
        for (&vertex, &point) in &joined {
            layout.points[vertex as usize] = point;
        }
        if !layout.points.iter().all(|point| point.as_vec2().is_finite()) {
            return not_possible("a texture coordinate is not finite; unwrap the faces first");
        }
        layout.write(self, settings.uv_set, |vertex, island| {
            joined.contains_key(&vertex) || order.rank[island as usize].is_some_and(|rank| rank > 0)
        });
        if settings.clear_seams {
            for cut in &cuts {
                self.change_seam(cut.edge, false);
            }
        }
        Ok(Stitched { edges: cuts.len(), islands: order.moves.len() })
    }
}

/// The texture coordinates of all corners, by island.
struct IslandLayout {
    corners: Vec<LaidCorner>,
    /// By corner of the mesh: the position in `corners`.
    of_corner: Vec<u32>,
    /// By vertex of the layout: corners at one vertex of the mesh that hang together.
    points: Vec<DVec2>,
    /// By island: its first vertex, and how many faces it has.
    islands: Vec<LaidIsland>,
}

#[derive(Clone, Copy)]
struct LaidCorner {
    corner: CornerId,
    vertex: u32,
    island: u32,
}

struct LaidIsland {
    first: u32,
    end: u32,
    faces: usize,
}

/// An edge with different coordinates on its sides.
struct Cut {
    edge: EdgeId,
    islands: [u32; 2],
    /// For each end of the edge, its vertices on both sides.
    ends: [[u32; 2]; 2],
}

impl IslandLayout {
    fn new(mesh: &EditMesh, uv_set: usize) -> Self {
        let faces: Vec<FaceId> = mesh.faces().collect();
        let (mut corners, mut points, mut islands) = (Vec::new(), Vec::new(), Vec::new());
        let mut of_corner = vec![u32::MAX; mesh.corner_capacity()];
        for (island, chart) in (0..).zip(uv_charts(mesh, &faces, uv_set)) {
            let first = points.len() as u32;
            points.resize(points.len() + chart.points.len(), DVec2::ZERO);
            for at in &chart.corners {
                let vertex = first + at.vertex;
                points[vertex as usize] = mesh.uv(uv_set, at.corner).expect("the set exists").as_dvec2();
                of_corner[at.corner.0 as usize] = corners.len() as u32;
                corners.push(LaidCorner { corner: at.corner, vertex, island });
            }
            let faces_of = sorted_once(chart.corners.iter().map(|at| mesh.corner_face(at.corner)).collect());
            islands.push(LaidIsland { first, end: points.len() as u32, faces: faces_of.len() });
        }
        Self { corners, of_corner, points, islands }
    }

    fn at(&self, corner: CornerId) -> LaidCorner {
        self.corners[self.of_corner[corner.0 as usize] as usize]
    }

    fn island_of_face(&self, mesh: &EditMesh, face: FaceId) -> Option<u32> {
        mesh.face_corners(face).next().map(|corner| self.at(corner).island)
    }

    /// An edge, if it has two faces that wind alike, with different coordinates.
    fn cut(&self, mesh: &EditMesh, edge: EdgeId) -> Option<Cut> {
        let [one, two] = mesh.edge_pair(edge)?;
        if mesh.corner_vertex(one) == mesh.corner_vertex(two) {
            return None;
        }
        let [start, end] = [[one, mesh.next_corner(two)], [mesh.next_corner(one), two]];
        let vertices = |corners: [CornerId; 2]| corners.map(|corner| self.at(corner).vertex);
        let ends = [vertices(start), vertices(end)];
        let is_cut = ends.iter().any(|[a, b]| self.points[*a as usize] != self.points[*b as usize]);
        is_cut.then(|| Cut { edge, islands: start.map(|corner| self.at(corner).island), ends })
    }

    /// Turns and moves an island so that pairs of its vertices and others come as close as possible.
    fn bring(&mut self, moved: &IslandMove) {
        let count = moved.pairs.len() as f64;
        let point = |vertex: u32| self.points[vertex as usize];
        let center = |side: usize| moved.pairs.iter().map(|pair| point(pair[side])).sum::<DVec2>() / count;
        let [from, to] = [center(0), center(1)];
        let turn: DVec2 = moved
            .pairs
            .iter()
            .map(|&[own, other]| times(point(other) - to, conjugate(point(own) - from)))
            .sum();
        let turn = turn.normalize_or(DVec2::X);
        let island = &self.islands[moved.island as usize];
        for point in &mut self.points[island.first as usize..island.end as usize] {
            *point = to + times(turn, *point - from);
        }
    }

    /// The common points of the vertices on both sides of the cuts.
    fn joined(&self, cuts: &[Cut], order: &Order, at_midpoints: bool) -> BTreeMap<u32, DVec2> {
        let mut sets = DisjointSets::new(self.points.len());
        let mut rank = BTreeMap::new();
        for cut in cuts {
            for [a, b] in cut.ends {
                sets.join(a, b);
                for (vertex, island) in [a, b].into_iter().zip(cut.islands) {
                    let of_island = order.rank[island as usize].expect("islands at cuts are in the order");
                    rank.insert(vertex, if at_midpoints { 0 } else { of_island });
                }
            }
        }
        let mut sums: BTreeMap<u32, Mean> = BTreeMap::new();
        for (&vertex, &rank) in &rank {
            sums.entry(sets.root(vertex)).or_insert_with(Mean::new).add(rank, self.points[vertex as usize]);
        }
        rank.keys().map(|&vertex| (vertex, sums[&sets.root(vertex)].point())).collect()
    }

    /// Gives corners their coordinates, if a function of their vertex and island accepts them.
    fn write(&self, mesh: &mut EditMesh, uv_set: usize, is_changed: impl Fn(u32, u32) -> bool) {
        for &LaidCorner { corner, vertex, island } in &self.corners {
            if is_changed(vertex, island) {
                mesh.set_uv(uv_set, corner, self.points[vertex as usize].as_vec2());
            }
        }
    }
}

/// The mean of the points of least rank.
struct Mean {
    rank: usize,
    sum: DVec2,
    count: u32,
}

impl Mean {
    fn new() -> Self {
        Self { rank: usize::MAX, sum: DVec2::ZERO, count: 0 }
    }

    fn add(&mut self, rank: usize, point: DVec2) {
        if rank < self.rank {
            *self = Self { rank, ..Self::new() };
        }
        if rank == self.rank {
            self.sum += point;
            self.count += 1;
        }
    }

    fn point(&self) -> DVec2 {
        self.sum / f64::from(self.count)
    }
}

/// An island that comes to others.
struct IslandMove {
    island: u32,
    /// Its vertices, and those to which they come.
    pairs: Vec<[u32; 2]>,
}

/// In which order islands come together.
struct Order {
    /// By island: 0 of one that stays, more the later it comes; `None` of one at no cut.
    rank: Vec<Option<usize>>,
    moves: Vec<IslandMove>,
}

impl Order {
    fn new(layout: &IslandLayout, cuts: &[Cut], active: Option<u32>) -> Self {
        let mut at_island: BTreeMap<u32, Vec<&Cut>> = BTreeMap::new();
        for cut in cuts {
            for island in sorted_once(cut.islands.to_vec()) {
                at_island.entry(island).or_default().push(cut);
            }
        }
        let mut staying: Vec<u32> = at_island.keys().copied().collect();
        let faces = |island: u32| layout.islands[island as usize].faces;
        staying.sort_by_key(|&island| (active != Some(island), usize::MAX - faces(island), island));
        let mut order = Self { rank: vec![None; layout.islands.len()], moves: Vec::new() };
        for island in staying {
            if order.rank[island as usize].is_none() {
                order.rank[island as usize] = Some(0);
                order.spread(island, &at_island);
            }
        }
        order
    }

    /// Brings all islands that hang together with one to it, those beside it first.
    fn spread(&mut self, first: u32, at_island: &BTreeMap<u32, Vec<&Cut>>) {
        let mut waiting = VecDeque::from([first]);
        while let Some(island) = waiting.pop_front() {
            for cut in &at_island[&island] {
                let next = if cut.islands[0] == island { cut.islands[1] } else { cut.islands[0] };
                if self.rank[next as usize].is_some() {
                    continue;
                }
                let mut pairs = Vec::new();
                for cut in &at_island[&next] {
                    let own = usize::from(cut.islands[0] != next);
                    if self.rank[cut.islands[1 - own] as usize].is_some() {
                        pairs.extend(cut.ends.map(|end| [end[own], end[1 - own]]));
                    }
                }
                self.moves.push(IslandMove { island: next, pairs });
                self.rank[next as usize] = Some(self.moves.len());
                waiting.push_back(next);
            }
        }
    }
}
