//! Makes the context for shading a draw.

use crate::bin::TriangleRef;
use crate::fragments::{DrawVaryings, ShadeContext};
use crate::tile_buffer::TileArea;
use crate::view::FrameView;

impl<'f> FrameView<'f> {
    /// The context for shading one of the frame's draws in a tile, without edges of other faces.
    pub(super) fn shade_context<'c>(
        &'c self,
        area: &TileArea,
        triangles: &'c [TriangleRef],
        draw: usize,
    ) -> ShadeContext<'c> {
        let (plan, pipeline) = (&self.plan.draws[draw], self.pipeline(draw));
        let stride = pipeline.stride();
        let values = &self.varyings[plan.varyings..plan.varyings + plan.used.len() * stride];
        ShadeContext {
            draw: self.draw_view(draw),
            varyings: DrawVaryings { slots: self.plan.slots(plan), values, stride },
            varying_count: pipeline.varyings(),
            is_flat: pipeline.is_flat(),
            reads_all: pipeline.reads_all(),
            frame_ink: self.ink.as_ref(),
            pattern: self.grid.pattern,
            supersampling: self.supersampling,
            area: *area,
            triangles,
            outer: None,
        }
    }
}
