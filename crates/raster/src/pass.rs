//! A recorded pass: the draws of one frame.

use crate::draw::DrawBounds;
use crate::geometry::{Geometry, PointSizes, Shape};
use crate::paint2d::Rect;
use crate::pipeline::AnyPipeline;
use crate::{Draw, FaceEdges, LanePipeline, Lines, MarkColors, Points, Target};
use trigon_math::{UVec2, Vec4};

/// The background that a pass is drawn over.
#[derive(Clone, Copy)]
pub enum Background<'a> {
    /// One colour, linear light, premultiplied.
    Color(Vec4),
    /// A colour for each row of the target, linear light, premultiplied. Called once for
    /// each row of a frame.
    PerRow(&'a (dyn Fn(u32) -> Vec4 + Sync)),
    /// A colour for each pixel, linear light, premultiplied. Called on any
    /// thread, for those pixels that show it.
    PerPixel(&'a (dyn Fn(UVec2) -> Vec4 + Sync)),
}

/// One draw as the pass keeps it.
pub(crate) struct RecordedDraw<'a> {
    pub(crate) geometry: Geometry<'a>,
    pub(crate) pipeline: &'a dyn AnyPipeline,
}

/// Where a draw of the pass lies.
#[derive(Clone, Copy)]
pub(crate) struct BoundedDraw {
    /// Its index in the pass.
    pub(crate) draw: u32,
    pub(crate) bounds: DrawBounds,
}

/// A recorded frame: draws, each with its own pipeline, in any order.
///
/// The order in which draws of different objects are recorded does not matter: the nearest sample is visible, and
/// of equally near ones that with the smaller (object, face). Where these are equal, too, the smaller index in its
/// draw is visible, then the earlier draw.
pub struct Pass<'a> {
    pub(crate) background: Background<'a>,
    pub(crate) draws: Vec<RecordedDraw<'a>>,
    /// Of some draws, in their order.
    pub(crate) bounds: Vec<BoundedDraw>,
    pub(crate) scissor: Option<Rect>,
    pub(crate) edges: Option<FaceEdges>,
    pub(crate) marks: Option<MarkColors>,
}

impl Default for Pass<'_> {
    fn default() -> Self {
        Self::new()
    }
}

impl<'a> Pass<'a> {
    /// An empty pass on transparent black.
    #[must_use]
    pub fn new() -> Self {
        Self {
            background: Background::Color(Vec4::ZERO),
            draws: Vec::new(),
            bounds: Vec::new(),
            scissor: None,
            edges: None,
            marks: None,
        }
    }

    /// Draws on `background` instead.
    pub fn background(&mut self, background: Background<'a>) -> &mut Self {
        self.background = background;
        self
    }

    /// Restricts drawing, the background included, to a rectangle of the target. All
    /// other pixels keep what the target holds. Inside, every byte is the same as
    /// without a scissor.
    ///
    /// An empty rectangle draws nothing, and parts outside the target are ignored.
    /// Tiles outside the rectangle cost nothing.
    pub fn scissor(&mut self, rect: Rect) -> &mut Self {
        self.scissor = Some(rect);
        self
    }

    /// Paints the edges of faces of all draws with
    /// [`edge_flags`](crate::Draw::edge_flags), over their own colours and over whatever is
    /// visible next to them, the background included. Edges are visible where their faces are.
    /// Translucent faces show only the part of an edge that lies on the face itself.
    ///
    /// This needs no vertices and no lines. [`FaceEdges`] defines what is painted. With several
    /// samples ([`Target::with_samples`](crate::Target::with_samples)) the part of an edge
    /// beyond its face is computed once per pixel, at the centre, against the farthest visible
    /// triangle, and painted over all samples. Faces outside the image contribute nothing.
    pub fn edges(&mut self, edges: FaceEdges) -> &mut Self {
        self.edges = Some(edges);
        self
    }

    /// Sets the colours of marks ([`Draw::marks`](crate::Draw::marks)). Face colours are mixed
    /// into what the pipeline returns. Edge colours replace the colour and opacity of
    /// [`edges`](Self::edges), which must set a width.
    ///
    /// Where several edges meet in a pixel, the one with the greatest coverage gives the colour,
    /// and of equal ones the one with the greater mark. Where a face is too small for single
    /// edges, its triangle's greatest mark gives the colour.
    /// [`Rasterizer::certify`](crate::Rasterizer::certify) does not consider which of two marks
    /// covers more.
    pub fn marks(&mut self, marks: MarkColors) -> &mut Self {
        self.marks = Some(marks);
        self
    }

    /// Records triangles.
    pub fn triangles<P: LanePipeline>(&mut self, draw: Draw<'a, P>) -> &mut Self {
        let Draw { pipeline, triangles, faces, edge_flags, marks, object, culling, blend_mode } = draw;
        let shape = Shape::Triangles { triangles, edge_flags, marks: marks.map(Box::new), culling };
        self.record(pipeline, Geometry { shape, faces, common_face: None, object, blend_mode })
    }

    /// Says where the vertices of the last draw lie, which must be triangles. In frames of many large draws,
    /// [`Rasterizer::draw`](crate::Rasterizer::draw) can then leave out those that are hidden as a whole: none of their
    /// vertices run, and [`Stats`](crate::Stats) do not count them.
    ///
    /// No byte depends on it. If a vertex lies elsewhere, its draw may be missing where it should be visible; nothing worse
    /// happens.
    pub fn bounds(&mut self, bounds: DrawBounds) -> &mut Self {
        if let Some(last) = self.draws.len().checked_sub(1) {
            self.bounds.push(BoundedDraw { draw: last as u32, bounds });
        }
        self
    }

    /// Records lines.
    pub fn lines<P: LanePipeline>(&mut self, lines: Lines<'a, P>) -> &mut Self {
        let Lines { pipeline, segments, ids, common_id, object, width, smoothing, depth_bias, blend_mode } =
            lines;
        let shape = Shape::Lines { segments, width, smoothing, depth_bias };
        let blend_mode = smoothing.blend_mode(blend_mode);
        self.record(pipeline, Geometry { shape, faces: ids, common_face: common_id, object, blend_mode })
    }

    /// Records points.
    pub fn points<P: LanePipeline>(&mut self, draw: Points<'a, P>) -> &mut Self {
        let Points { pipeline, points, ids, common_id, object, size, marked, .. } = draw;
        let Points { shape, smoothing, depth_bias, blend_mode, .. } = draw;
        let sizes = PointSizes { size, marked };
        let shape = Shape::Points { points, sizes, shape, smoothing, depth_bias };
        let blend_mode = smoothing.blend_mode(blend_mode);
        self.record(pipeline, Geometry { shape, faces: ids, common_face: common_id, object, blend_mode })
    }

    fn record<P: LanePipeline>(&mut self, pipeline: &'a P, geometry: Geometry<'a>) -> &mut Self {
        self.draws.push(RecordedDraw { geometry, pipeline });
        self
    }

    /// The pixels of the target that are drawn.
    pub(crate) fn drawn_pixels(&self, target: &Target<'_>) -> Rect {
        let whole = Rect::new([0, 0], [target.width() as i32, target.height() as i32]);
        self.scissor.map_or(whole, |rect| rect.intersection(whole))
    }

    /// Whether a frame is large enough to be shared among threads: waking
    /// others costs a fraction of a millisecond.
    pub(crate) fn is_worth_sharing(&self, target: &Target<'_>) -> bool {
        // Measured roughly: nanoseconds for a sample, for one that is shaded, if little is done for it, and for a
        // primitive.
        const SAMPLE: u64 = 1;
        const SHADED_SAMPLE: u64 = 6;
        const PRIMITIVE: u64 = 30;
        const WORTH_SHARING: u64 = 200_000;
        let axis = u64::from(target.samples_per_axis());
        let samples = axis * axis * u64::from(target.samples());
        let Rect { min, max } = self.drawn_pixels(target);
        let [width, height] = [0, 1].map(|axis| max[axis].saturating_sub(min[axis]).max(0) as u64);
        let samples = width * height * samples;
        let primitives: usize = self.draws.iter().map(|draw| draw.geometry.len()).sum();
        let sample = if target.has_colors() { SHADED_SAMPLE } else { SAMPLE };
        samples * sample + primitives as u64 * PRIMITIVE >= WORTH_SHARING
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Output;

    #[test]
    fn shading_was_taken_to_be_as_quick_as_depth_and_left_to_one_thread() {
        let is_shared = |output| {
            let target = Target::new(480, 288, &[output]).expect("a sound size");
            Pass::new().is_worth_sharing(&target)
        };
        assert!(is_shared(Output::Srgb8), "it takes milliseconds");
        assert!(!is_shared(Output::Depth), "it takes a seventh of a millisecond");
    }
}
