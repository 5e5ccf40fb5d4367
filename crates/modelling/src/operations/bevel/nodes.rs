//! Collects the nodes of a bevel, fan by fan: the points that replace a vertex, each of which moves
//! away from it in proportion to the width.

use smallvec::{SmallVec, smallvec};
use trigon_math::DVec3;

use super::fans::Fan;
use super::frames::Frames;
use super::laid::{Arc, End, Insertion, Laid, Move, Node, Round, Stop, WeightTerm};
use super::rims::Rims;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, NONE, VertexId};

/// All nodes, as they are collected fan by fan.
pub(super) struct Nodes<'m> {
    pub(super) mesh: &'m EditMesh,
    pub(super) frames: Frames,
    pub(super) rims: Rims,
    parts: Vec<WeightTerm>,
    sums: Vec<u32>,
    pub(super) nodes: Vec<Node>,
    pub(super) arcs: Vec<Arc>,
    stops: Vec<Stop>,
    rounds: Vec<Round>,
    pub(super) moves: Vec<Move>,
    pub(super) insertions: Vec<Insertion>,
    pub(super) ends: Vec<[Option<End>; 2]>,
    /// For each edge: 0, or 1 + the number of a beveled edge, or `SLID` + the number of another in
    /// `slides`.
    marks: Vec<u32>,
    /// Edges on which nodes are, and how far from its ends together for a width of 1.
    slides: Vec<(EdgeId, f64)>,
    /// How far nodes are along beveled edges from their ends together, on each side.
    pub(super) along: Vec<[f64; 2]>,
}

const SLID: u32 = 1 << 31;

/// A fan while its nodes are laid out.
pub(super) struct Layout {
    pub(super) vertex: VertexId,
    /// Its corners; those of a closed fan begin with a beveled edge.
    pub(super) corners: SmallVec<[CornerId; 8]>,
    /// The edges along which they leave, and that by which the last is entered.
    pub(super) stops: SmallVec<[Stop; 8]>,
    /// For each corner the sum that it gets on the edge along which it is left, and on that by which it is
    /// entered: they differ at a miter.
    pub(super) sums: SmallVec<[u32; 8]>,
    pub(super) entered_sums: SmallVec<[u32; 8]>,
    /// The curves of miters, and after which stop each comes, in ascending order.
    pub(super) miters: SmallVec<[(usize, Stop); 4]>,
}

impl<'m> Nodes<'m> {
    /// For so many fans.
    pub(super) fn new(mesh: &'m EditMesh, marks: Vec<u32>, fans: usize, rims: Rims) -> Self {
        /// Most vertices have four edges; more takes more memory.
        const USUAL: usize = 4;
        let beveled = rims.count();
        Self {
            mesh,
            frames: Frames::default(),
            rims,
            parts: Vec::with_capacity(4 * USUAL * fans),
            sums: Vec::with_capacity(2 * USUAL * fans),
            nodes: Vec::with_capacity(USUAL * fans),
            arcs: Vec::new(),
            stops: Vec::with_capacity(USUAL * fans),
            rounds: Vec::new(),
            moves: Vec::with_capacity(USUAL * fans),
            insertions: Vec::new(),
            ends: vec![[None; 2]; beveled],
            marks,
            slides: Vec::new(),
            along: vec![[0.0; 2]; beveled],
        }
    }

    /// What was laid out, and the width at which nodes meet on some edge.
    pub(super) fn finish(self, beveled: &[EdgeId]) -> Laid {
        let length = |edge: EdgeId| {
            let [a, b] = self.mesh.edge_vertices(edge);
            self.mesh.point(a).distance(self.mesh.point(b))
        };
        let mut limit = f64::INFINITY;
        let mut lessen = |edge: EdgeId, distance: f64| {
            let width = length(edge) / distance;
            // An edge without length would stop everything.
            if width > 0.0 {
                limit = limit.min(width);
            }
        };
        for &(edge, distance) in &self.slides {
            lessen(edge, distance);
        }
        for (&edge, along) in beveled.iter().zip(&self.along) {
            along.iter().for_each(|&distance| lessen(edge, distance));
        }
        let both = |ends: [Option<End>; 2]| ends.map(|end| end.expect("both of its fans were added"));
        Laid {
            parts: self.parts,
            sums: self.sums,
            nodes: self.nodes,
            arcs: self.arcs,
            stops: self.stops,
            rounds: self.rounds,
            moves: self.moves,
            insertions: self.insertions,
            ends: self.ends.into_iter().map(both).collect(),
            limit,
        }
    }

    /// Adds a fan at a vertex of beveled edges.
    pub(super) fn add_edge_fan(&mut self, fan: Fan, corners: &[CornerId]) {
        let mut corners: SmallVec<[CornerId; 8]> = corners.into();
        let is_beveled = |&corner: &CornerId| self.number(self.mesh.corner_edge(corner)) != NONE;
        if fan.is_closed {
            let Some(first) = corners.iter().position(is_beveled) else { return };
            corners.rotate_left(first);
        }
        let mut layout = self.layout(fan.vertex, corners);
        let beveled: SmallVec<[usize; 8]> =
            (0..layout.stops.len()).filter(|&stop| layout.stops[stop].beveled != NONE).collect();
        // Of a closed fan the first edge comes again at the end.
        let count = if fan.is_closed { beveled.len() - 1 } else { beveled.len() };
        if count == 0 {
            return;
        }
        let round = self.begin_round(fan, &layout.corners, count > 1);
        if !fan.is_closed {
            self.fill_end(&round, &mut layout, 0, beveled[0]);
        }
        for pair in beveled.windows(2) {
            if count == 1 {
                self.fill_end(&round, &mut layout, pair[0], pair[1]);
            } else if pair[1] - pair[0] > 1 || !self.fill_with_miter(&round, &mut layout, pair[0]) {
                self.fill_between(&mut layout, pair[0], pair[1]);
            }
        }
        if fan.is_closed {
            let last = layout.stops.pop().expect("one more than corners");
            layout.stops[0].right = last.right;
        } else {
            let last = layout.corners.len();
            self.fill_end(&round, &mut layout, beveled[beveled.len() - 1], last);
        }
        self.add_arcs(&round, &mut layout, count);
        self.end_round(round, &layout);
    }

    /// Adds a fan at a vertex that is beveled itself.
    pub(super) fn add_vertex_fan(&mut self, fan: Fan, corners: &[CornerId]) {
        let mut layout = self.layout(fan.vertex, corners.into());
        let round = self.begin_round(fan, corners, true);
        if fan.is_closed {
            layout.stops.pop();
        }
        let count = layout.stops.len();
        let axis = self.axis(&layout, count);
        let mut distances = SmallVec::<[f64; 8]>::new();
        for i in 0..count {
            let (corner, is_out) = layout.corner_at(i);
            let distance = self.vertex_distance(&layout, i, axis);
            let node = self.node_on_edge(fan.vertex, corner, is_out, distance);
            let stop = &mut layout.stops[i];
            (stop.left, stop.right) = (node, node);
            self.limit(stop.edge, distance);
            distances.push(distance);
        }
        let stops = &mut layout.stops;
        for (i, &corner) in corners.iter().enumerate() {
            let (here, next) = (stops[i].left, stops[(i + 1) % count].left);
            // The corner that leaves along an edge is its node's home.
            let sum = self.nodes[here as usize].sum;
            self.moves.push(Move { corner, node: here, sum });
            // Two faces alone round a vertex share one curve.
            let is_shared = fan.is_closed && count == 2 && i == 1;
            if !is_shared {
                let control_sum = self.sum(&[WeightTerm { corner, base: 1.0, slope: 0.0 }]);
                let (control, home) = (DVec3::ZERO, CornerId(NONE));
                self.arcs.push(Arc { first: here, last: next, control, control_sum, home });
            }
            let (arc, is_reversed) = (self.arcs.len() as u32 - 1, !is_shared);
            (stops[i].arc, stops[i].is_reversed) = (arc, !is_reversed);
            let sum = self.sum_on_edge(corner, false, distances[(i + 1) % count]);
            let (before, node, is_continuous) = (corner, next, round.is_continuous);
            self.insertions.push(Insertion { before, node, sum, arc, is_reversed, is_continuous });
        }
        self.end_round(round, &layout);
    }

    fn begin_round(&self, fan: Fan, corners: &[CornerId], is_round: bool) -> Round {
        let is_continuous = corners.iter().all(|&corner| self.mesh.have_same_uvs(corners[0], corner));
        Round {
            fan,
            stops: [self.stops.len(); 2],
            nodes: [self.nodes.len(); 2],
            is_continuous,
            is_round: is_round && fan.is_closed,
        }
    }

    fn end_round(&mut self, mut round: Round, layout: &Layout) {
        let mut miters = layout.miters.iter().peekable();
        for (i, stop) in layout.stops.iter().enumerate() {
            self.stops.push(*stop);
            while let Some((_, miter)) = miters.next_if(|(after, _)| *after == i) {
                self.stops.push(*miter);
            }
        }
        round.stops[1] = self.stops.len();
        round.nodes[1] = self.nodes.len();
        self.rounds.push(round);
    }

    /// The number of a beveled edge, or `NONE`.
    pub(super) fn number(&self, edge: EdgeId) -> u32 {
        match self.marks[edge.0 as usize] {
            0 | SLID.. => NONE,
            number => number - 1,
        }
    }

    fn layout(&self, vertex: VertexId, corners: SmallVec<[CornerId; 8]>) -> Layout {
        let last = self.mesh.previous_corner(corners[corners.len() - 1]);
        let edges = corners.iter().chain([&last]).map(|&corner| self.mesh.corner_edge(corner));
        let stop = |edge| {
            let beveled = self.number(edge);
            Stop { edge, beveled, right: NONE, left: NONE, arc: NONE, is_reversed: false }
        };
        let stops = edges.map(stop).collect();
        let sums: SmallVec<[u32; 8]> = smallvec![NONE; corners.len()];
        let (entered_sums, miters) = (sums.clone(), SmallVec::new());
        Layout { vertex, corners, stops, sums, entered_sums, miters }
    }

    /// Adds a sum; its number.
    pub(super) fn sum(&mut self, parts: &[WeightTerm]) -> u32 {
        self.parts.extend_from_slice(parts);
        self.sums.push(self.parts.len() as u32);
        self.sums.len() as u32 - 1
    }

    /// Notes that a node moves along an edge.
    pub(super) fn limit(&mut self, edge: EdgeId, distance: f64) {
        let mark = &mut self.marks[edge.0 as usize];
        if *mark == 0 {
            *mark = SLID + self.slides.len() as u32;
            self.slides.push((edge, 0.0));
        }
        // Beveled edges are limited by what is along them.
        if *mark >= SLID {
            self.slides[(*mark - SLID) as usize].1 += distance;
        }
    }
}

impl Layout {
    /// The end of a beveled edge whose curve is known.
    pub(super) fn end(&self, stop: usize, is_continuous: bool, control_sum: u32) -> End {
        let before = if stop == 0 { self.corners.len() - 1 } else { stop - 1 };
        let here = &self.stops[stop];
        End {
            vertex: self.vertex,
            left: here.left,
            right: here.right,
            arc: here.arc,
            is_reversed: !here.is_reversed,
            left_corner: self.corners[stop],
            right_corner: self.corners[before],
            left_sum: self.sums[stop],
            right_sum: self.entered_sums[before],
            control_sum,
            is_continuous,
        }
    }

    /// Sets the sum that a corner gets, which is the same on both of its edges.
    pub(super) fn set_sum(&mut self, i: usize, sum: u32) {
        (self.sums[i], self.entered_sums[i]) = (sum, sum);
    }

    /// A corner at an edge, and whether it leaves along it.
    pub(super) fn corner_at(&self, stop: usize) -> (CornerId, bool) {
        if stop < self.corners.len() { (self.corners[stop], true) } else { (self.corners[stop - 1], false) }
    }
}
