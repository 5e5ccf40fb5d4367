//! The pipelines that draw edges, loose lines and points, and the faces that
//! do nothing but hide what is behind them.

use trigon_math::{Mat4, Vec3, Vec4};
use trigon_raster::{Fragment, Pipeline, VertexOutput};

use super::surface::EdgeOverlay;
use crate::background::Background;

/// Vertices of a mesh in one colour, unlit.
pub(super) struct Wire<'a> {
    pub(super) positions: &'a [Vec3],
    pub(super) to_clip: Mat4,
    /// Linear RGB.
    pub(super) color: Vec3,
}

impl Pipeline for Wire<'_> {
    type Varyings = ();

    fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<()> {
        VertexOutput { position: self.to_clip * self.positions[index].extend(1.0), varyings: () }
    }

    fn fragment(&self, _: &Fragment<()>) -> Vec4 {
        self.color.extend(1.0)
    }
}

/// Faces painted like the background, with their edges on them: a drawing
/// without its hidden lines.
pub(super) struct HiddenLine<'a> {
    pub(super) positions: &'a [Vec3],
    pub(super) to_clip: Mat4,
    pub(super) background: Background,
    /// Of the picture, in pixels.
    pub(super) height: u32,
    pub(super) edges: EdgeOverlay,
}

impl Pipeline for HiddenLine<'_> {
    type Varyings = ();

    fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<()> {
        VertexOutput { position: self.to_clip * self.positions[index].extend(1.0), varyings: () }
    }

    fn fragment(&self, fragment: &Fragment<()>) -> Vec4 {
        let paper = self.background.row(fragment.pixel.y, self.height);
        self.edges.over(paper, fragment.nearest_edge())
    }
}
