//! The planned bevel, once its rims are laid out, as plain records.

use trigon_math::DVec3;

use super::fans::Fan;
use crate::ids::{CornerId, EdgeId, VertexId};

/// A part of a sum: the weight of a corner's value is `base + slope * width`.
#[derive(Debug, Clone, Copy)]
pub(super) struct WeightTerm {
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
    /// The corner of the face in which the curve lies; `NONE` where it crosses a bevel.
    pub(super) home: CornerId,
}

/// Where an edge leaves a fan, or a miter's curve lies beside it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stop {
    /// `NONE` for the curve of a miter.
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
    pub(super) parts: Vec<WeightTerm>,
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
