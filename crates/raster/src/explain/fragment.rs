//! How one triangle relates to one sample.

use crate::BlendMode;
use trigon_math::Vec4;

/// What a triangle was made from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PrimitiveKind {
    /// A triangle, or a part of one that was cut.
    Triangle,
    /// One of the two triangles of a line.
    Line,
    /// One of the two triangles of a square point.
    SquarePoint,
    /// One of the two halves of a round point.
    RoundPoint,
}

/// The outcome for a triangle at a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It is visible.
    Visible,
    /// The visible triangle is nearer.
    Hidden,
    /// The visible triangle is as near, and its (object, face) is smaller.
    EqualDepth,
    /// It lies behind the far plane.
    BehindFarPlane,
    /// Its mask is false there.
    MaskedAway,
    /// It is blended over what is visible, as the layer with this number: 0 is the
    /// farthest.
    Layer(usize),
    /// It is a translucent line, and the sample is drawn by a later segment that shares a vertex with it.
    LeftToJoint,
    /// The sample lies outside of this edge, an index into
    /// [`edges`](FragmentExplanation::edges): the one that it is furthest from.
    OutsideEdge(usize),
    /// The sample lies in the square around a round point but not in the disc; or
    /// in the rectangle around something anti-aliased that covers nothing of it.
    OutsideDisc,
}

/// The edge function of one edge at a sample, exactly.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct EdgeExplanation {
    /// Twice the area of the triangle between the edge and the sample, in units
    /// of the grid squared (2^-16 square pixels): positive inside, negative
    /// outside.
    pub value: i64,
    /// Whether samples exactly on the edge belong to the triangle: on left edges
    /// and on horizontal ones at the top.
    pub owns_boundary: bool,
    /// How far the sample lies inside of the edge, in pixels (of the finer grid);
    /// negative outside.
    pub distance: f64,
}

impl EdgeExplanation {
    /// Whether the sample counts as inside.
    #[must_use]
    pub fn is_inside(&self) -> bool {
        self.value > 0 || (self.value == 0 && self.owns_boundary)
    }
}

/// A triangle at a sample.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct FragmentExplanation {
    /// The number of the draw in the pass.
    pub draw: usize,
    /// The object id.
    pub object: u32,
    /// The face id.
    pub face: u32,
    /// The index of the triangle, segment or point in its draw.
    pub primitive: u32,
    /// What it was made from.
    pub kind: PrimitiveKind,
    /// Opaque, masked or translucent.
    pub blend_mode: BlendMode,
    /// Whether a plane has cut the primitive; this is then a part of it.
    pub is_cut: bool,
    /// Whether its corners wind counter-clockwise on the screen.
    pub front_facing: bool,
    /// Its corners on the sub-pixel grid, in 1/256 pixel (of the finer grid): in
    /// the order of the draw's indices for a triangle that was not cut, else by
    /// rows from the top.
    pub vertices: [[i32; 2]; 3],
    /// The edge functions: `[i]` of the edge from vertex `i` to vertex
    /// `i + 1 (mod 3)`.
    pub edges: [EdgeExplanation; 3],
    /// Whether it covers the sample.
    pub is_covered: bool,
    /// Reversed depth there, if it covers the sample.
    pub depth: Option<f32>,
    /// By how many units in the last place of f32 it is nearer than the visible triangle; negative if it is
    /// farther away. For the visible triangle itself: than the one that would be visible without it, if there
    /// is one.
    pub margin: Option<i64>,
    /// Its colour, if it is visible or a layer: linear light, premultiplied.
    pub color: Option<Vec4>,
    /// The outcome.
    pub verdict: Verdict,
}
