//! Fills the parts of a fan between its beveled edges with nodes, and places curves across the
//! edges.

use smallvec::SmallVec;
use trigon_math::DVec3;

use super::laid::{Arc, End, Insertion, Move, Node, Round, Stop};
use super::nodes::{Layout, Nodes};
use crate::ids::{CornerId, NONE};

impl Nodes<'_> {
    /// Between two beveled edges, or an end of the fan and a beveled edge, where each other edge
    /// gets a node of its own.
    pub(super) fn fill_end(&mut self, round: &Round, layout: &mut Layout, from: usize, to: usize) {
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
        self.move_to_own_nodes(round, layout, [from, to], &distances);
    }

    /// Gives the corners between two stops the nodes of the edges beside them.
    fn move_to_own_nodes(
        &mut self,
        round: &Round,
        layout: &mut Layout,
        [from, to]: [usize; 2],
        distances: &[f64],
    ) {
        for i in from..to {
            let corner = layout.corners[i];
            let (here, next) = (layout.stops[i], layout.stops[i + 1]);
            if here.beveled == NONE {
                // The corner that leaves along an edge is its node's home.
                let sum = self.nodes[here.left as usize].sum;
                layout.set_sum(i, sum);
                self.moves.push(Move { corner, node: here.left, sum });
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
                layout.set_sum(i, sum);
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
        let after = (i > from && is_beveled(i - 1)).then(|| self.rim_distance(layout.corners[i - 1], true));
        let before = (i < to && is_beveled(i + 1)).then(|| self.rim_distance(layout.corners[i], false));
        match (after, before) {
            (Some(one), Some(other)) => 0.5 * (one + other),
            (Some(one), None) | (None, Some(one)) => one,
            (None, None) => {
                let (corner, is_out) = layout.corner_at(i);
                self.free_distance(self.way(corner, is_out).1, self.rim_at_end(layout, from, to))
            }
        }
    }

    /// The distance of the rim of the beveled edge at one of two stops.
    fn rim_at_end(&self, layout: &Layout, from: usize, to: usize) -> f64 {
        if layout.stops[from].beveled == NONE {
            self.rim(layout.corners[to - 1], false)
        } else {
            self.rim(layout.corners[from], true)
        }
    }

    /// Between two beveled edges, where all faces get one node.
    pub(super) fn fill_between(&mut self, layout: &mut Layout, from: usize, to: usize) {
        let (offset, sums) = self.offset_between(layout, from, to);
        let node = self.nodes.len() as u32;
        self.nodes.push(Node { vertex: layout.vertex, offset, sum: sums[0], home: layout.corners[from] });
        layout.stops[from].left = node;
        layout.stops[to].right = node;
        for stop in &mut layout.stops[from + 1..to] {
            (stop.left, stop.right) = (node, node);
        }
        for i in from..to {
            let (corner, sum) = (layout.corners[i], sums[usize::from(i > from)]);
            layout.set_sum(i, sum);
            self.moves.push(Move { corner, node, sum });
        }
    }

    /// Where the node between two beveled edges is, and what it is worth in the first face there and in
    /// the others.
    fn offset_between(&mut self, layout: &Layout, from: usize, to: usize) -> (DVec3, [u32; 2]) {
        let (first, last) = (layout.corners[from], layout.corners[to - 1]);
        match to - from {
            1 => {
                let (offset, parts) = self.meeting(first);
                let sum = self.sum(&parts);
                (offset, [sum, sum])
            }
            2 => {
                // On the one edge between them, at the mean of the distances that both ask for.
                let distance = 0.5 * (self.rim_distance(first, true) + self.rim_distance(last, false));
                self.limit(layout.stops[from + 1].edge, distance);
                let sums = [self.sum_on_edge(first, false, distance), self.sum_on_edge(last, true, distance)];
                (self.way(last, true).0 * distance, sums)
            }
            _ => {
                let (offset, parts) = match self.rims.measures_along_edges() {
                    true => self.middle_between(first, last),
                    false => self.meeting_across(&layout.corners[from..to]),
                };
                for i in from + 1..to {
                    let distance = self.way(layout.corners[i], true).0.dot(offset);
                    self.limit(layout.stops[i].edge, distance.max(0.0));
                }
                let sum = self.sum(&parts);
                (offset, [sum, sum])
            }
        }
    }

    /// The curves across the beveled edges of a fan.
    pub(super) fn add_arcs(&mut self, round: &Round, layout: &mut Layout, count: usize) {
        // Where two beveled edges meet, their bevels meet in a plane through the vertex and share
        // a curve, unless a miter parts them.
        let is_miter = count == 2 && round.fan.is_closed && layout.miters.is_empty();
        // One face opposite the only beveled edge: the curve stays in its plane, in which the vertex is, too.
        let ends_in_face = count == 1 && round.fan.is_closed && layout.corners.len() == 3;
        let mut is_second = false;
        for i in 0..layout.stops.len() {
            if layout.stops[i].beveled == NONE {
                continue;
            }
            let (left, stop) = (layout.corners[i], layout.stops[i]);
            let direction = self.way(left, true).0;
            let along = [stop.left, stop.right].map(|node| self.nodes[node as usize].offset.dot(direction));
            let control = if is_miter || ends_in_face { 0.0 } else { 0.5 * (along[0] + along[1]) };
            let control_sum = self.sum_on_edge(left, true, control);
            if !is_second {
                let (control, home) = (direction * control, CornerId(NONE));
                self.arcs.push(Arc { first: stop.left, last: stop.right, control, control_sum, home });
            }
            // Round the vertex an edge's right comes first.
            (layout.stops[i].arc, layout.stops[i].is_reversed) = (self.arcs.len() as u32 - 1, !is_second);
            let end = layout.end(i, round.is_continuous, control_sum);
            self.add_end(&stop, along, end);
            is_second = is_miter;
        }
        if ends_in_face {
            // The face opposite the beveled edge is cut along the curve.
            self.insertions.last_mut().expect("that face has two nodes").arc = self.arcs.len() as u32 - 1;
        }
    }

    /// Notes one end of a beveled edge, and how far its nodes are along it on the left and right.
    fn add_end(&mut self, stop: &Stop, along: [f64; 2], end: End) {
        let which = usize::from(self.mesh.edge_vertices(stop.edge)[0] != end.vertex);
        for (side, value) in along.into_iter().enumerate() {
            // Seen from the edge's other end, left is right.
            self.along[stop.beveled as usize][if which == 0 { side } else { 1 - side }] += value;
        }
        self.ends[stop.beveled as usize][which] = Some(end);
    }
}
