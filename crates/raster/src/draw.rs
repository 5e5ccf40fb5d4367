//! What a pass records: triangles, lines and points, each with its pipeline.
//!
//! [`Marks`] are edges and faces that are painted in colours of their own, such as selected elements.

use crate::EdgeFlags;
use fixedbitset::FixedBitSet;
use std::cmp::Ordering;
use trigon_math::Vec4;

/// Which triangles are culled by their facing.
///
/// A triangle is front-facing if its corners wind counter-clockwise on the screen.
/// Triangles without area on the screen are always culled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Culling {
    /// Both sides are drawn.
    None,
    /// Only fronts are drawn.
    #[default]
    Back,
    /// Only backs are drawn.
    Front,
}

/// How a draw's fragments are combined with what lies behind them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum BlendMode {
    /// Hides what is behind. The pipeline's alpha is written to the output unchanged.
    #[default]
    Opaque,
    /// Hides what is behind wherever [`Pipeline::mask`](crate::Pipeline::mask)
    /// returns true. The mask is evaluated once per triangle and pixel: at the
    /// centre if the triangle covers it, otherwise at the lowest-numbered sample
    /// that it covers.
    Masked,
    /// Like [`Masked`](Self::Masked), but the mask is evaluated at every sample.
    /// With several samples
    /// ([`Target::with_samples`](crate::Target::with_samples)) the mask's outline
    /// is then as smooth as a triangle's, at the cost of one evaluation per
    /// sample. The colour is still computed once per pixel.
    MaskedPerSample,
    /// Opaque in the colours only. Depth and ids are not written: they stay those of the
    /// opaque and masked draws below. For marks on a surface that must not get in the way of
    /// picking it.
    Overlay,
    /// Blended over what is behind by alpha. Fragments of all translucent draws are sorted by depth at each
    /// sample, whatever order they were recorded in. Translucent fragments write no depth and no ids.
    Translucent,
}

/// Indexed triangles.
pub struct Draw<'a, P> {
    /// Vertices and colours.
    pub pipeline: &'a P,
    /// Indices into the pipeline's vertices.
    pub triangles: &'a [[u32; 3]],
    /// For each triangle the id of its face, which is written to the output and
    /// decides between equal depths. Without it (or beyond its end) each triangle
    /// is its own face, numbered by its index.
    pub faces: Option<&'a [u32]>,
    /// For each triangle which of its edges are edges of the face. Without it
    /// (or beyond its end) all are; but a pass that paints edges
    /// ([`Pass::edges`](crate::Pass::edges)) paints only those of draws that list them.
    pub edge_flags: Option<&'a [EdgeFlags]>,
    /// Edges and faces with their own colours, which [`Pass::marks`](crate::Pass::marks)
    /// defines. Marked edges show only if the pass paints edges.
    pub marks: Option<Marks<'a>>,
    /// The object id; `u32::MAX` means background and should not be used.
    pub object: u32,
    /// Which facing is culled.
    pub culling: Culling,
    /// Opaque, masked, overlay or translucent.
    pub blend_mode: BlendMode,
}

impl<'a, P> Draw<'a, P> {
    /// Opaque triangles of object 0, back faces dropped, each triangle a face.
    pub fn new(pipeline: &'a P, triangles: &'a [[u32; 3]]) -> Self {
        Self {
            pipeline,
            triangles,
            faces: None,
            edge_flags: None,
            marks: None,
            object: 0,
            culling: Culling::default(),
            blend_mode: BlendMode::default(),
        }
    }
}

/// Where the vertices of a draw lie: see [`Pass::bounds`](crate::Pass::bounds). In clip coordinates divided by w, as pipelines
/// return them; every w must be greater than 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawBounds {
    /// The least x / w and y / w.
    pub least: [f64; 2],
    /// The greatest x / w and y / w.
    pub greatest: [f64; 2],
    /// The greatest z / w, the depth of the nearest vertex.
    pub nearest: f64,
}

/// Whether a line or a point is anti-aliased.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Smoothing {
    /// Each sample is covered or not.
    #[default]
    Sharp,
    /// Each sample gets a coverage between 0 and 1, computed for a pixel-sized square around it. The
    /// pipeline's colour times the coverage is blended over what is behind, as with
    /// [`BlendMode::Translucent`], whatever the draw's own mode. No depth and no ids are written, and no mask
    /// is evaluated.
    ///
    /// A line is everything within half its width of the segment, so its ends are
    /// round. At a distance of d pixels from the segment its coverage is
    /// `min(width, 1, width/2 + 1/2 - d)`, at least 0. That is exact for a line
    /// along an axis, and has the same total in any direction except for sampling.
    /// Lines narrower than a pixel fade, and vanish at width 0. Where segments that
    /// share a vertex overlap, the one with the greatest coverage paints the sample,
    /// so a polyline is one shape with round joints.
    ///
    /// A round point is covered like a line without length; below one pixel the
    /// coverage is also multiplied by its size. A square point has its exact area.
    ///
    /// With supersampling, a pixel here is one of the finer grid.
    AntiAliased,
}

impl Smoothing {
    /// The blend mode of a draw with this outline.
    pub(crate) fn blend_mode(self, blend_mode: BlendMode) -> BlendMode {
        match self {
            Self::Sharp => blend_mode,
            Self::AntiAliased => BlendMode::Translucent,
        }
    }
}

/// Straight segments.
///
/// A segment is x-major if it is at least as wide as high on the screen, else
/// y-major. It covers the parallelogram that its width spans across the minor
/// direction, extended at both ends by half the width. That is exact, and
/// independent of the segment's direction. ([`Smoothing::AntiAliased`] describes
/// anti-aliased lines.) Without supersampling, a width of 1 pixel or less draws
/// exactly one pixel per step of the major direction, both ends included.
/// Where segments that share a vertex overlap, only one of them paints a
/// sample: the nearer one, or for translucent lines the later one. A polyline
/// therefore draws each joint once. Varyings vary along the segment, and depth is
/// constant across it.
pub struct Lines<'a, P> {
    /// Vertices and colours.
    pub pipeline: &'a P,
    /// Pairs of indices into the pipeline's vertices.
    pub segments: &'a [[u32; 2]],
    /// For each segment its id, which is written as the face id. Without it (or
    /// beyond its end) [`common_id`](Self::common_id).
    pub ids: Option<&'a [u32]>,
    /// The id of all segments without one of their own; without it, the segment's index.
    pub common_id: Option<u32>,
    /// The object id.
    pub object: u32,
    /// Width in output pixels, whatever the supersampling; below 1 counts as 1
    /// unless it is anti-aliased, above 4096 as 4096.
    pub width: f32,
    /// Sharp or anti-aliased.
    pub smoothing: Smoothing,
    /// How much nearer to the eye the line is drawn, as a fraction of its distance,
    /// so that it is visible on a surface that it lies in. 0 tests the line at its
    /// own depth. The depth is multiplied by one plus this and clamped to 1: with
    /// a perspective, 0.001 moves the line by a thousandth of its distance. Clamped
    /// to `0..=1`.
    pub depth_bias: f32,
    /// Opaque, masked, overlay or translucent.
    pub blend_mode: BlendMode,
}

impl<'a, P> Lines<'a, P> {
    /// Opaque lines of object 0, one pixel wide, tested at their own depth.
    pub fn new(pipeline: &'a P, segments: &'a [[u32; 2]]) -> Self {
        Self {
            pipeline,
            segments,
            ids: None,
            common_id: None,
            object: 0,
            width: 1.0,
            smoothing: Smoothing::default(),
            depth_bias: 0.0,
            blend_mode: BlendMode::default(),
        }
    }
}

/// The outline of a point on the screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PointShape {
    /// A disc.
    #[default]
    Round,
    /// An axis-aligned square.
    Square,
}

/// The points of a [`Points`] draw that have another size than the rest.
#[derive(Clone, Copy, Debug)]
pub struct MarkedPoints<'a> {
    /// Their indices among the draw's [`points`](Points::points); those beyond the set's length
    /// are not marked.
    pub set: &'a FixedBitSet,
    /// Their diameter or edge, as [`Points::size`].
    pub size: f32,
}

/// Points with a size in pixels.
///
/// A point nearer than the near plane, or outside the guard band by more than its
/// size, draws nothing. Depth is constant over a point.
pub struct Points<'a, P> {
    /// Vertices and colours.
    pub pipeline: &'a P,
    /// Indices into the pipeline's vertices.
    pub points: &'a [u32],
    /// For each point its id, which is written as the face id. Without it (or
    /// beyond its end) [`common_id`](Self::common_id).
    pub ids: Option<&'a [u32]>,
    /// The id of all points without one of their own; without it, the point's index.
    pub common_id: Option<u32>,
    /// The object id.
    pub object: u32,
    /// Diameter or edge in output pixels; below 1 counts as 1 unless it is
    /// anti-aliased, above 4096 as 4096.
    pub size: f32,
    /// Points with another size, such as selected ones. (For another colour, the pipeline
    /// can look up the same set by the point's index,
    /// [`Fragment::triangle`](crate::Fragment::triangle).)
    pub marked: Option<MarkedPoints<'a>>,
    /// Sharp or anti-aliased.
    pub smoothing: Smoothing,
    /// Round or square.
    pub shape: PointShape,
    /// See [`Lines::depth_bias`].
    pub depth_bias: f32,
    /// Opaque, masked, overlay or translucent.
    pub blend_mode: BlendMode,
}

impl<'a, P> Points<'a, P> {
    /// Opaque round points of object 0, tested at their own depth.
    pub fn new(pipeline: &'a P, points: &'a [u32], size: f32) -> Self {
        Self {
            pipeline,
            points,
            ids: None,
            common_id: None,
            object: 0,
            size,
            marked: None,
            smoothing: Smoothing::default(),
            shape: PointShape::default(),
            depth_bias: 0.0,
            blend_mode: BlendMode::default(),
        }
    }
}

/// The marks of a draw's edges and faces; [`Pass::marks`](crate::Pass::marks) sets their
/// colours.
///
/// A mark is a number from 1 to 15. 0, greater numbers and places beyond the end of a list mean
/// no mark. Marks are looked up for visible elements only, so marking other elements takes
/// nothing but another list.
#[derive(Clone, Copy, Debug, Default)]
pub struct Marks<'a> {
    /// For each triangle the numbers of the edges that its sides are: side `i` runs from
    /// corner `i` to corner `i + 1 (mod 3)`. `u32::MAX` for diagonals.
    pub sides: &'a [[u32; 3]],
    /// The marks of edges, by their numbers.
    pub edges: &'a [u8],
    /// The marks of faces, by their ids.
    pub faces: &'a [u8],
}

/// The colours of marks, by their numbers. Of two marked edges with equal coverage of a pixel,
/// the one with the greater mark gives the colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarkColors {
    /// Linear RGB and opacity of edges: these take the place of
    /// [`FaceEdges`](crate::FaceEdges)' own. The first is not used.
    pub edges: [Vec4; Self::COUNT],
    /// Linear RGB of what is mixed into the colours of faces, and its share. The first is not
    /// used.
    pub faces: [Vec4; Self::COUNT],
    /// Edges that are seen on any surface: twice as wide as others and with a black outline, as far as their faces have
    /// room for that. [`FaceEdges`](crate::FaceEdges) defines how much. The first is not used.
    pub outlined: [bool; Self::COUNT],
}

impl MarkColors {
    /// The number of marks, including the one for "no mark".
    pub const COUNT: usize = 16;

    /// Marks that are invisible.
    pub const NONE: Self = Self {
        edges: [Vec4::ZERO; Self::COUNT],
        faces: [Vec4::ZERO; Self::COUNT],
        outlined: [false; Self::COUNT],
    };
}

impl Marks<'_> {
    /// Those of a triangle's sides.
    pub(crate) fn of_sides(&self, triangle: u32) -> [u8; 3] {
        let sides = self.sides.get(triangle as usize).unwrap_or(&[u32::MAX; 3]);
        sides.map(|edge| mark(self.edges, edge))
    }

    /// That of a face.
    pub(crate) fn of_face(&self, face: u32) -> u8 {
        mark(self.faces, face)
    }
}

fn mark(marks: &[u8], element: u32) -> u8 {
    let mark = marks.get(element as usize).copied().unwrap_or(0);
    if usize::from(mark) < MarkColors::COUNT { mark } else { 0 }
}

/// What the lines on a pixel cover of it, and the mark of the one that gives them their
/// colour.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Overlap {
    pub(crate) share: f32,
    /// The part of the share that has the line's colour. The rest of it is the outline.
    pub(crate) core: f32,
    pub(crate) mark: u8,
}

impl Overlap {
    /// Of a line without an outline.
    pub(crate) fn plain(share: f32, mark: u8) -> Self {
        Self { share, core: share, mark }
    }

    /// The one that covers more, its core counted twice; of equal ones that with the greater mark.
    pub(crate) fn or(self, other: Self) -> Self {
        if other.is_above(self) { other } else { self }
    }

    /// Whether it is drawn above the other where the two overlap.
    pub(crate) fn is_above(self, other: Self) -> bool {
        let [own, others] = [self, other].map(|overlap| overlap.share + overlap.core);
        match own.partial_cmp(&others) {
            Some(Ordering::Greater) => true,
            Some(Ordering::Equal) => self.mark > other.mark,
            Some(Ordering::Less) | None => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_beyond_a_list_has_no_mark() {
        let marks = Marks { sides: &[[0, 2, u32::MAX]], edges: &[3, 200], faces: &[15] };
        assert_eq!(marks.of_sides(0), [3, 0, 0], "the second edge is beyond the list, the third is none");
        assert_eq!(marks.of_sides(1), [0; 3], "no such triangle");
        assert_eq!([marks.of_face(0), marks.of_face(1)], [15, 0], "the last mark, and none");
        assert_eq!(mark(marks.edges, 1), 0, "no such mark");
    }

    #[test]
    fn the_greater_mark_decides_between_equal_shares_only() {
        let [thin, low, high] =
            [(0.5, 9), (1.0, 1), (1.0, 2)].map(|(share, mark)| Overlap::plain(share, mark));
        assert_eq!(thin.or(low), low, "more is covered");
        assert_eq!(low.or(high), high, "equally much");
        assert_eq!(high.or(low), high, "in any order");
        let outline = Overlap { share: 1.0, core: 0.0, mark: 9 };
        assert_eq!([outline.or(low), low.or(outline)], [low; 2], "an outline is below every line");
    }
}
