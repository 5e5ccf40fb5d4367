//! Where the rims of a bevel are: the places that take a vertex's place, each of which moves
//! away from it in proportion to the width.

use smallvec::{SmallVec, smallvec};
use trigon_math::DVec3;

use super::super::super::edit_mesh::EditMesh;
use super::super::super::ids::{CornerId, EdgeId, VertexId};
use super::fans::Fan;
use super::frames::Frames;

/// Stands for "no node", "no arc", "not beveled".
pub(super) const NONE: u32 = u32::MAX;

/// The sine of an angle below which two edges count as one line. An edge beside a beveled one then
/// leads almost along it, and would reach the distance of the rim far away or never.
const STRAIGHT: f64 = 0.05;

/// A part of a sum: the weight of a corner's value is `base + slope * width`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Part {
    pub(super) corner: CornerId,
    pub(super) base: f64,
    pub(super) slope: f64,
}

/// A vertex of a rim.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    /// The vertex whose place it takes.
    pub(super) vertex: VertexId,
    /// From there to it, for a width of 1.
    pub(super) offset: DVec3,
    /// Its values, as a sum of parts.
    pub(super) sum: u32,
    /// One of the vertex's corners in a face that has the node.
    pub(super) home: CornerId,
}

/// The curve between two nodes: the cross-section of a bevel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Arc {
    pub(super) first: u32,
    pub(super) last: u32,
    /// Where the tangents at its ends meet: on the old edge. For a width of 1.
    pub(super) control: DVec3,
    pub(super) control_sum: u32,
}

/// Where an edge leaves a fan.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stop {
    pub(super) edge: EdgeId,
    /// The number of a beveled edge, or `NONE`.
    pub(super) beveled: u32,
    /// The nodes on its right and left as seen from the vertex; the same where it is not beveled.
    pub(super) right: u32,
    pub(super) left: u32,
    /// If it is beveled, or (of bevels of vertices) for the curve to the next edge: which one, and
    /// whether it runs from the node on the right to that on the left.
    pub(super) arc: u32,
    pub(super) is_reversed: bool,
}

/// A fan whose vertex is replaced.
#[derive(Debug, Clone, Copy)]
pub(super) struct Round {
    pub(super) fan: Fan,
    /// Ranges of what belongs to it.
    pub(super) stops: [usize; 2],
    pub(super) nodes: [usize; 2],
    /// Whether all its corners have the same texture coordinates.
    pub(super) is_continuous: bool,
    /// Whether each of its edges is beveled or lies between two that are, without another end: so that
    /// curves lie all round the face that fills the middle.
    pub(super) is_round: bool,
}

/// An old corner that moves to a node.
#[derive(Debug, Clone, Copy)]
pub(super) struct Move {
    pub(super) corner: CornerId,
    pub(super) node: u32,
    pub(super) sum: u32,
}

/// A node that comes before an old corner in its face.
#[derive(Debug, Clone, Copy)]
pub(super) struct Insertion {
    pub(super) before: CornerId,
    pub(super) node: u32,
    pub(super) sum: u32,
    /// The curve from there to the corner, and whether it runs that way backwards.
    pub(super) arc: u32,
    pub(super) is_reversed: bool,
    pub(super) is_continuous: bool,
}

/// One end of a beveled edge, as seen from its vertex.
#[derive(Debug, Clone, Copy)]
pub(super) struct End {
    pub(super) vertex: VertexId,
    pub(super) left: u32,
    pub(super) right: u32,
    pub(super) arc: u32,
    pub(super) is_reversed: bool,
    /// The old corners at the vertex on both sides, and their new values.
    pub(super) left_corner: CornerId,
    pub(super) right_corner: CornerId,
    pub(super) left_sum: u32,
    pub(super) right_sum: u32,
    /// The control point as the face on the left knows it.
    pub(super) control_sum: u32,
    pub(super) is_continuous: bool,
}

/// All nodes, as they were laid out.
pub(super) struct Laid {
    pub(super) parts: Vec<Part>,
    /// Where the parts of each sum end.
    pub(super) sums: Vec<u32>,
    pub(super) nodes: Vec<Node>,
    pub(super) arcs: Vec<Arc>,
    pub(super) stops: Vec<Stop>,
    pub(super) rounds: Vec<Round>,
    pub(super) moves: Vec<Move>,
    pub(super) insertions: Vec<Insertion>,
    /// Both ends of each beveled edge, its first vertex first.
    pub(super) ends: Vec<[End; 2]>,
    /// The width at which the first nodes meet.
    pub(super) limit: f64,
}

/// All nodes, as they are collected fan by fan.
pub(super) struct Nodes<'m> {
    mesh: &'m EditMesh,
    frames: Frames,
    parts: Vec<Part>,
    sums: Vec<u32>,
    nodes: Vec<Node>,
    arcs: Vec<Arc>,
    stops: Vec<Stop>,
    rounds: Vec<Round>,
    moves: Vec<Move>,
    insertions: Vec<Insertion>,
    ends: Vec<[Option<End>; 2]>,
    /// For each edge: 0, or 1 + the number of a beveled edge, or `SLID` + the number of another in
    /// `slides`.
    marks: Vec<u32>,
    /// Edges on which nodes are, and how far from its ends together for a width of 1.
    slides: Vec<(EdgeId, f64)>,
    /// How far nodes are along beveled edges from their ends together, on each side.
    along: Vec<[f64; 2]>,
}

const SLID: u32 = 1 << 31;

/// A fan while its nodes are laid out.
struct Layout {
    vertex: VertexId,
    /// Its corners; those of a closed fan begin with a beveled edge.
    corners: SmallVec<[CornerId; 8]>,
    /// The edges along which they leave, and that by which the last is entered.
    stops: SmallVec<[Stop; 8]>,
    /// For each corner the sum that it gets.
    sums: SmallVec<[u32; 8]>,
}

impl<'m> Nodes<'m> {
    pub(super) fn new(mesh: &'m EditMesh, marks: Vec<u32>, beveled: usize) -> Self {
        Self {
            mesh,
            frames: Frames::default(),
            parts: Vec::new(),
            sums: Vec::new(),
            nodes: Vec::new(),
            arcs: Vec::new(),
            stops: Vec::new(),
            rounds: Vec::new(),
            moves: Vec::new(),
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
            if width > 0.0 && width < limit {
                limit = width;
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
            } else {
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
        self.end_round(round, &layout.stops);
    }

    /// Adds a fan at a vertex that is beveled itself.
    pub(super) fn add_vertex_fan(&mut self, fan: Fan, corners: &[CornerId]) {
        let mut layout = self.layout(fan.vertex, corners.into());
        let round = self.begin_round(fan, corners, true);
        if fan.is_closed {
            layout.stops.pop();
        }
        let count = layout.stops.len();
        for i in 0..count {
            let (corner, is_out) = layout.corner_at(i);
            let node = self.node_on_edge(fan.vertex, corner, is_out, 1.0);
            let stop = &mut layout.stops[i];
            (stop.left, stop.right) = (node, node);
            self.limit(stop.edge, 1.0);
        }
        let stops = &mut layout.stops;
        for (i, &corner) in corners.iter().enumerate() {
            let (here, next) = (stops[i].left, stops[(i + 1) % count].left);
            let sum = self.sum_on_edge(corner, true, 1.0);
            self.moves.push(Move { corner, node: here, sum });
            // Two faces alone round a vertex share one curve.
            let is_shared = fan.is_closed && count == 2 && i == 1;
            if !is_shared {
                let control_sum = self.sum(&[Part { corner, base: 1.0, slope: 0.0 }]);
                self.arcs.push(Arc { first: here, last: next, control: DVec3::ZERO, control_sum });
            }
            let (arc, is_reversed) = (self.arcs.len() as u32 - 1, !is_shared);
            (stops[i].arc, stops[i].is_reversed) = (arc, !is_reversed);
            let sum = self.sum_on_edge(corner, false, 1.0);
            let (before, node, is_continuous) = (corner, next, round.is_continuous);
            self.insertions.push(Insertion { before, node, sum, arc, is_reversed, is_continuous });
        }
        self.end_round(round, &layout.stops);
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

    fn end_round(&mut self, mut round: Round, stops: &[Stop]) {
        self.stops.extend_from_slice(stops);
        round.stops[1] = self.stops.len();
        round.nodes[1] = self.nodes.len();
        self.rounds.push(round);
    }

    /// The number of a beveled edge, or `NONE`.
    fn number(&self, edge: EdgeId) -> u32 {
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
        let sums = smallvec![NONE; corners.len()];
        Layout { vertex, corners, stops, sums }
    }

    /// Between two beveled edges, or an end of the fan and a beveled edge, where each other edge
    /// gets a node of its own.
    fn fill_end(&mut self, round: &Round, layout: &mut Layout, from: usize, to: usize) {
        let mut distances = SmallVec::<[f64; 8]>::new();
        for i in from..=to {
            distances.push(self.end_distance(layout, from, to, i));
            if layout.stops[i].beveled == NONE {
                let distance = distances[i - from];
                let (corner, is_out) = layout.corner_at(i);
                let node = self.node_on_edge(layout.vertex, corner, is_out, distance);
                (layout.stops[i].left, layout.stops[i].right) = (node, node);
                self.limit(layout.stops[i].edge, distance);
            }
        }
        for i in from..to {
            let corner = layout.corners[i];
            let (here, next) = (layout.stops[i], layout.stops[i + 1]);
            if here.beveled == NONE {
                layout.sums[i] = self.sum_on_edge(corner, true, distances[i - from]);
                self.moves.push(Move { corner, node: here.left, sum: layout.sums[i] });
            } else {
                layout.stops[i].left = next.right;
            }
            if next.beveled != NONE {
                layout.stops[i + 1].right = here.left;
                continue;
            }
            let sum = self.sum_on_edge(corner, false, distances[i + 1 - from]);
            if here.beveled == NONE {
                let (before, node) = (corner, next.left);
                let is_continuous = round.is_continuous;
                let (arc, is_reversed) = (NONE, true);
                self.insertions.push(Insertion { before, node, sum, arc, is_reversed, is_continuous });
            } else {
                layout.sums[i] = sum;
                self.moves.push(Move { corner, node: next.left, sum });
            }
        }
    }

    /// How far the node of an edge beside a beveled one is from the vertex, for a width of 1.
    fn end_distance(&self, layout: &Layout, from: usize, to: usize, i: usize) -> f64 {
        let is_beveled = |stop: usize| layout.stops[stop].beveled != NONE;
        if is_beveled(i) {
            return 0.0;
        }
        let after = (i > from && is_beveled(i - 1)).then(|| self.rim_distance(layout.corners[i - 1]));
        let before = (i < to && is_beveled(i + 1)).then(|| self.rim_distance(layout.corners[i]));
        match (after, before) {
            (Some(one), Some(other)) => 0.5 * (one + other),
            (Some(one), None) | (None, Some(one)) => one,
            (None, None) => 1.0,
        }
    }

    /// Between two beveled edges, where all faces get one node.
    fn fill_between(&mut self, layout: &mut Layout, from: usize, to: usize) {
        let (first, last) = (layout.corners[from], layout.corners[to - 1]);
        let (offset, sums) = match to - from {
            1 => {
                let (offset, parts) = self.meeting(first);
                let sum = self.sum(&parts);
                (offset, [sum, sum])
            }
            2 => {
                // On the one edge between them, at the mean of the distances that both ask for.
                let distance = 0.5 * (self.rim_distance(first) + self.rim_distance(last));
                self.limit(layout.stops[from + 1].edge, distance);
                let sums = [self.sum_on_edge(first, false, distance), self.sum_on_edge(last, true, distance)];
                (self.way(last, true).0 * distance, sums)
            }
            _ => {
                // In the middle of the places on the first and the last edge between them.
                let (one, other) = (self.rim_distance(first), self.rim_distance(last));
                self.limit(layout.stops[from + 1].edge, one);
                self.limit(layout.stops[to - 1].edge, other);
                let mut parts = self.parts_on_edge(first, false, one);
                parts.extend(self.parts_on_edge(last, true, other));
                for part in &mut parts {
                    (part.base, part.slope) = (0.5 * part.base, 0.5 * part.slope);
                }
                let sum = self.sum(&parts);
                (0.5 * (self.way(first, false).0 * one + self.way(last, true).0 * other), [sum, sum])
            }
        };
        let node = self.nodes.len() as u32;
        self.nodes.push(Node { vertex: layout.vertex, offset, sum: sums[0], home: first });
        layout.stops[from].left = node;
        layout.stops[to].right = node;
        for stop in &mut layout.stops[from + 1..to] {
            (stop.left, stop.right) = (node, node);
        }
        for i in from..to {
            let (corner, sum) = (layout.corners[i], sums[usize::from(i > from)]);
            layout.sums[i] = sum;
            self.moves.push(Move { corner, node, sum });
        }
    }

    /// The curves across the beveled edges of a fan.
    fn add_arcs(&mut self, round: &Round, layout: &mut Layout, count: usize) {
        // Where two beveled edges meet, their bevels meet in a plane through the vertex and share
        // a curve.
        let is_miter = count == 2 && round.fan.is_closed;
        let mut is_second = false;
        for i in 0..layout.stops.len() {
            let stop = layout.stops[i];
            if stop.beveled == NONE {
                continue;
            }
            let before = if i == 0 { layout.corners.len() - 1 } else { i - 1 };
            let (left_corner, right_corner) = (layout.corners[i], layout.corners[before]);
            let direction = self.way(left_corner, true).0;
            let along = [stop.left, stop.right].map(|node| self.nodes[node as usize].offset.dot(direction));
            let control = if is_miter { 0.0 } else { 0.5 * (along[0] + along[1]) };
            let control_sum = self.sum_on_edge(left_corner, true, control);
            if !is_second {
                let control = direction * control;
                self.arcs.push(Arc { first: stop.left, last: stop.right, control, control_sum });
            }
            let arc = self.arcs.len() as u32 - 1;
            // Round the vertex an edge's right comes first.
            (layout.stops[i].arc, layout.stops[i].is_reversed) = (arc, !is_second);
            let end = usize::from(self.mesh.edge_vertices(stop.edge)[0] != round.fan.vertex);
            for (side, value) in along.into_iter().enumerate() {
                // Seen from the edge's other end, left is right.
                self.along[stop.beveled as usize][if end == 0 { side } else { 1 - side }] += value;
            }
            self.ends[stop.beveled as usize][end] = Some(End {
                vertex: round.fan.vertex,
                left: stop.left,
                right: stop.right,
                arc,
                is_reversed: is_second,
                left_corner,
                right_corner,
                left_sum: layout.sums[i],
                right_sum: layout.sums[before],
                control_sum,
                is_continuous: round.is_continuous,
            });
            is_second = is_miter;
        }
        if count == 1 && round.fan.is_closed && layout.corners.len() == 3 {
            // The face opposite the beveled edge is cut along the curve.
            self.insertions.last_mut().expect("that face has two nodes").arc = self.arcs.len() as u32 - 1;
        }
    }

    fn node_on_edge(&mut self, vertex: VertexId, corner: CornerId, is_out: bool, distance: f64) -> u32 {
        let offset = self.way(corner, is_out).0 * distance;
        let sum = self.sum_on_edge(corner, is_out, distance);
        self.nodes.push(Node { vertex, offset, sum, home: corner });
        self.nodes.len() as u32 - 1
    }

    /// The corner at the other end of one of the two edges of a corner.
    fn far_corner(&self, corner: CornerId, is_out: bool) -> CornerId {
        if is_out { self.mesh.next_corner(corner) } else { self.mesh.previous_corner(corner) }
    }

    /// Direction and length of the edge along which a corner is left, or by which it is entered. Both
    /// are zero where there is no direction.
    fn way(&self, corner: CornerId, is_out: bool) -> (DVec3, f64) {
        let point = |corner| self.mesh.point(self.mesh.corner_vertex(corner));
        let way = point(self.far_corner(corner, is_out)) - point(corner);
        let length = way.length();
        if length > 0.0 && length.is_finite() { (way / length, length) } else { (DVec3::ZERO, 0.0) }
    }

    /// How far a rim has to be along one edge of a corner to have a distance of 1 from the other.
    fn rim_distance(&self, corner: CornerId) -> f64 {
        let sine = self.way(corner, true).0.cross(self.way(corner, false).0).length();
        if sine > STRAIGHT { 1.0 / sine } else { 1.0 }
    }

    /// Where the rims of two beveled edges meet in the one face between them.
    fn meeting(&mut self, corner: CornerId) -> (DVec3, SmallVec<[Part; 4]>) {
        let (out, out_length) = self.way(corner, true);
        let (into, into_length) = self.way(corner, false);
        let cross = out.cross(into);
        let sine = cross.length();
        if sine > STRAIGHT {
            // Both rims have distance 1; in a hollow corner they meet on the other side.
            let is_hollow = self.frames.is_hollow(self.mesh, corner, cross);
            let scale = if is_hollow { -1.0 } else { 1.0 } / sine;
            let parts = smallvec![
                self.toward(corner, true, scale / out_length),
                self.toward(corner, false, scale / into_length),
                Part { corner, base: 1.0, slope: -scale / out_length - scale / into_length },
            ];
            return ((out + into) * scale, parts);
        }
        if out.dot(into) < 0.0 {
            // One straight line: the rim runs beside it, in the plane of the face.
            return self.frames.beside(self.mesh, corner, (out - into).normalize_or_zero());
        }
        (out, self.parts_on_edge(corner, true, 1.0))
    }

    fn toward(&self, corner: CornerId, is_out: bool, slope: f64) -> Part {
        Part { corner: self.far_corner(corner, is_out), base: 0.0, slope }
    }

    /// The parts of a place on an edge of a corner, at a distance times the width.
    fn parts_on_edge(&self, corner: CornerId, is_out: bool, distance: f64) -> SmallVec<[Part; 4]> {
        let length = self.way(corner, is_out).1;
        let slope = if length > 0.0 { distance / length } else { 0.0 };
        smallvec![Part { corner, base: 1.0, slope: -slope }, self.toward(corner, is_out, slope)]
    }

    fn sum_on_edge(&mut self, corner: CornerId, is_out: bool, distance: f64) -> u32 {
        let parts = self.parts_on_edge(corner, is_out, distance);
        self.sum(&parts)
    }

    /// Adds a sum; its number.
    fn sum(&mut self, parts: &[Part]) -> u32 {
        self.parts.extend_from_slice(parts);
        self.sums.push(self.parts.len() as u32);
        self.sums.len() as u32 - 1
    }

    /// Notes that a node moves along an edge.
    fn limit(&mut self, edge: EdgeId, distance: f64) {
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
    /// A corner at an edge, and whether it leaves along it.
    fn corner_at(&self, stop: usize) -> (CornerId, bool) {
        if stop < self.corners.len() { (self.corners[stop], true) } else { (self.corners[stop - 1], false) }
    }
}
