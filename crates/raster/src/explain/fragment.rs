//! How one triangle relates to one sample, what happened at one sample, and both as text.

use super::PixelExplanation;
use crate::BlendMode;
use std::fmt::{Display, Formatter, Result};
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

/// What happened at one sample of a pixel.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SampleExplanation {
    /// The pixel of the finer grid that it belongs to; without supersampling the
    /// pixel itself.
    pub cell: [u32; 2],
    /// Its number in the standard pattern.
    pub number: usize,
    /// Where it lies, in 1/256 pixel of the finer grid from the top left.
    pub position: [i32; 2],
    /// The triangles: the visible one first, then layers from the nearest to the farthest, then hidden
    /// triangles from the nearest on, and then those that miss the sample.
    pub fragments: Vec<FragmentExplanation>,
    /// What the sample shows: linear light, premultiplied.
    pub color: Vec4,
}

impl SampleExplanation {
    /// The triangle whose depth and ids the sample has; `None` for the
    /// background.
    #[must_use]
    pub fn visible(&self) -> Option<&FragmentExplanation> {
        self.fragments.iter().find(|fragment| fragment.verdict == Verdict::Visible)
    }

    /// The translucent layers, the one furthest away first.
    pub fn layers(&self) -> impl Iterator<Item = &FragmentExplanation> {
        self.fragments.iter().rev().filter(|fragment| matches!(fragment.verdict, Verdict::Layer(_)))
    }
}

impl Display for PixelExplanation {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let [x, y] = self.pixel;
        writeln!(f, "pixel ({x}, {y}): linear colour {}", self.color)?;
        for (i, sample) in self.samples.iter().enumerate() {
            write!(f, "{sample}")?;
            if i == self.reported && self.samples.len() > 1 {
                writeln!(f, "  depth and ids of the pixel come from this sample")?;
            }
        }
        Ok(())
    }
}

impl Display for SampleExplanation {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let [x, y] = self.position.map(|v| f64::from(v) / 256.0);
        write!(f, " sample {} at ({x}, {y}): ", self.number)?;
        match self.visible() {
            Some(visible) => write!(f, "object {}, face {}", visible.object, visible.face)?,
            None => write!(f, "the background")?,
        }
        match self.layers().count() {
            0 => writeln!(f)?,
            1 => writeln!(f, " under 1 layer")?,
            layers => writeln!(f, " under {layers} layers")?,
        }
        self.fragments.iter().try_for_each(|fragment| write!(f, "{fragment}"))
    }
}

impl Display for FragmentExplanation {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let kind = match self.kind {
            PrimitiveKind::Triangle => "triangle",
            PrimitiveKind::Line => "line",
            PrimitiveKind::SquarePoint => "square point",
            PrimitiveKind::RoundPoint => "round point",
        };
        let cut = if self.is_cut { ", cut" } else { "" };
        write!(
            f,
            "  {kind} {} of draw {} (object {}, face {}{cut}): ",
            self.primitive, self.draw, self.object, self.face
        )?;
        write_verdict(self, f)?;
        let [a, b, c] = self.edges.map(|edge| (edge.value, if edge.owns_boundary { "≥" } else { ">" }));
        write!(f, "    edges {} ({} 0), {} ({} 0), {} ({} 0)", a.0, a.1, b.0, b.1, c.0, c.1)?;
        if let Some(depth) = self.depth {
            write!(f, "; depth {depth}")?;
        }
        writeln!(f)
    }
}

fn write_verdict(fragment: &FragmentExplanation, f: &mut Formatter<'_>) -> Result {
    let margin = fragment.margin.unwrap_or(0);
    match fragment.verdict {
        Verdict::Visible if fragment.margin.is_none() => writeln!(f, "visible; the only one here"),
        Verdict::Visible if margin == 0 => {
            writeln!(f, "visible; as near as the next, and its (object, face) is smaller")
        }
        Verdict::Visible => writeln!(f, "visible; nearer than the next by {margin} ulp"),
        Verdict::Hidden => writeln!(f, "hidden by {} ulp", -margin),
        Verdict::EqualDepth => {
            writeln!(f, "as near as the visible triangle, whose (object, face) is smaller")
        }
        Verdict::BehindFarPlane => writeln!(f, "behind the far plane"),
        Verdict::MaskedAway => writeln!(f, "masked away"),
        Verdict::Layer(number) => writeln!(f, "layer {number} from the back"),
        Verdict::LeftToJoint => writeln!(f, "left to a later segment of the polyline"),
        Verdict::OutsideEdge(edge) => {
            let distance = -fragment.edges[edge].distance;
            writeln!(f, "misses the sample: outside of edge {edge} by {distance:.4} pixel")
        }
        Verdict::OutsideDisc => writeln!(f, "misses the sample: outside of the disc"),
    }
}
