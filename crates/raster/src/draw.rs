//! What a pass records: triangles, lines and points, each with its pipeline.

use crate::{EdgeFlags, Marks};
use fixedbitset::FixedBitSet;

/// Which triangles are dropped by the side that they show.
///
/// The front is the side from which the corners wind counter-clockwise. A
/// triangle without area on the screen is always dropped.
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

/// How a draw meets what lies behind it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum BlendMode {
    /// Hides what is behind; the pipeline's alpha goes to the output as it is.
    #[default]
    Opaque,
    /// Hides what is behind, wherever [`Pipeline::mask`](crate::Pipeline::mask)
    /// says that there is something. It is asked once for each triangle and
    /// pixel: at the centre if the triangle covers it, else at the
    /// lowest-numbered sample that it covers.
    Masked,
    /// As [`Masked`](Self::Masked), with the mask asked at every sample instead
    /// of once for each pixel: with several samples
    /// ([`Target::with_samples`](crate::Target::with_samples)) the outline that
    /// the mask draws is as smooth as a triangle's, for as many questions as
    /// there are samples. The colour is still found once for each pixel.
    MaskedPerSample,
    /// Opaque to the eye alone: hides what is behind in the colours, and writes no depth and no
    /// ids, which stay those of the opaque and masked surfaces below. For marks that are shown
    /// on a surface and must not be in the way of picking it.
    Overlay,
    /// Laid over what is behind, by alpha. Fragments of all translucent draws
    /// are ordered per sample, whatever order they were recorded in. They write
    /// no depth and no ids.
    Translucent,
}

/// Indexed triangles.
pub struct Draw<'a, P> {
    /// Vertices and colours.
    pub pipeline: &'a P,
    /// Indices into the pipeline's vertices.
    pub triangles: &'a [[u32; 3]],
    /// For each triangle the face that it belongs to, for ids and for the
    /// order of equal depths. Without it (or beyond its end) a triangle is a
    /// face of its own, numbered by its index.
    pub faces: Option<&'a [u32]>,
    /// For each triangle which of its edges are edges of the face. Without it
    /// (or beyond its end) all are; but a pass that paints edges
    /// ([`Pass::edges`](crate::Pass::edges)) paints only those of draws that list them.
    pub edge_flags: Option<&'a [EdgeFlags]>,
    /// Edges and faces in colours of their own, as [`Pass::marks`](crate::Pass::marks) tells
    /// them. Edges have to be painted at all for that.
    pub marks: Option<Marks<'a>>,
    /// The object id; `u32::MAX` means background and should not be used.
    pub object: u32,
    /// Which sides are dropped.
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

/// How the outline of a line or a point meets the pixels that it crosses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Outline {
    /// Each sample is covered or not.
    #[default]
    Sharp,
    /// Each sample is covered by the share of a pixel around it, and the
    /// pipeline's colour times that share is laid over what is behind, as by
    /// [`BlendMode::Translucent`] whatever the draw's surface: no depth and no ids
    /// are written, and no mask is asked.
    ///
    /// A line is all that lies within half its width of the segment, so its ends
    /// are round, and covers at a distance of d pixels from the segment
    /// `min(width, 1, width/2 + 1/2 - d)`, at least 0: exact for a line along an axis,
    /// and the same total in any direction but for the sampling. Widths below
    /// one pixel fade, down to nothing at 0. Of segments that share a vertex the
    /// one that covers most of a sample paints it, so that a polyline is one
    /// shape, its joints round.
    ///
    /// A round point covers as a line without length, times its size below one
    /// pixel; a square one by its exact area.
    ///
    /// With supersampling a pixel is one of the finer grid.
    AntiAliased,
}

impl Outline {
    /// The surface of a draw that has one.
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
/// direction, prolonged at both ends by half the width: exact, and the same
/// from either end. (Anti-aliased lines are told of at
/// [`Outline::AntiAliased`].) Without supersampling, a width of 1 pixel or less draws
/// exactly one pixel per step of the major direction, both ends included.
/// Where segments that share a vertex overlap, only one of them paints a
/// sample: the nearer one, or for translucent lines the later one; so a
/// polyline draws each joint once. Varyings run along the segment, and depth is
/// constant across it.
pub struct Lines<'a, P> {
    /// Vertices and colours.
    pub pipeline: &'a P,
    /// Pairs of indices into the pipeline's vertices.
    pub segments: &'a [[u32; 2]],
    /// For each segment its id, given out as the face id. Without it (or beyond
    /// its end) the segment's index.
    pub ids: Option<&'a [u32]>,
    /// The object id.
    pub object: u32,
    /// Width in output pixels, whatever the supersampling; below 1 counts as 1
    /// unless it is anti-aliased, above 4096 as 4096.
    pub width: f32,
    /// Sharp or anti-aliased.
    pub outline: Outline,
    /// A share of the distance by which the line is drawn nearer to the eye
    /// than it is, so that it shows on the surface that it lies in; 0 for a
    /// line that is tested as it is. The depth is multiplied by one plus this
    /// and held to 1: with a perspective, 0.001 moves the line by a thousandth
    /// of its distance. Clamped to `0..=1`.
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
            object: 0,
            width: 1.0,
            outline: Outline::default(),
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

/// Points of a [`Points`] draw that have a size of their own.
#[derive(Clone, Copy, Debug)]
pub struct MarkedPoints<'a> {
    /// Their indices among the draw's [`points`](Points::points); those beyond the set's length
    /// are not marked.
    pub set: &'a FixedBitSet,
    /// Their diameter or edge, as [`Points::size`].
    pub size: f32,
}

/// Points of a size in pixels.
///
/// A point that lies behind the near plane, or further than its size outside
/// the guard band, draws nothing. Its depth is the same all over it.
pub struct Points<'a, P> {
    /// Vertices and colours.
    pub pipeline: &'a P,
    /// Indices into the pipeline's vertices.
    pub points: &'a [u32],
    /// For each point its id, given out as the face id. Without it (or beyond
    /// its end) the point's index.
    pub ids: Option<&'a [u32]>,
    /// The object id.
    pub object: u32,
    /// Diameter or edge in output pixels; below 1 counts as 1 unless it is
    /// anti-aliased, above 4096 as 4096.
    pub size: f32,
    /// Those points that have another size, such as the selected ones. (For another colour
    /// the pipeline can ask the same set: it is told the point's index, see
    /// [`Fragment::triangle`](crate::Fragment::triangle).)
    pub marked: Option<MarkedPoints<'a>>,
    /// Sharp or anti-aliased.
    pub outline: Outline,
    /// Round or square.
    pub shape: PointShape,
    /// As [`Lines::depth_bias`].
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
            object: 0,
            size,
            marked: None,
            outline: Outline::default(),
            shape: PointShape::default(),
            depth_bias: 0.0,
            blend_mode: BlendMode::default(),
        }
    }
}
