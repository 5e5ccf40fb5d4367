//! The triangles of a tile, listed by kind of surface.

use crate::BlendMode;
use crate::bin::TriangleRef;
use crate::view::FrameView;
use std::ops::Range;

/// The tile's triangles by kind of surface: ranges of its list.
pub(crate) struct Surfaces {
    pub(crate) opaque: Range<usize>,
    pub(crate) masked: Range<usize>,
    pub(crate) overlay: Range<usize>,
    pub(crate) translucent: Range<usize>,
}

impl Surfaces {
    /// Lists the triangles of a tile in `triangles`.
    pub(crate) fn list(frame: &FrameView<'_>, tile: u32, triangles: &mut Vec<TriangleRef>) -> Self {
        triangles.clear();
        let mut ends = [0; 4];
        for chunk in frame.chunks.iter().filter(|chunk| !chunk.is_empty()) {
            chunk.collect(&frame.grid, tile, triangles);
            let first = match chunk.blend_mode {
                BlendMode::Opaque => 0,
                BlendMode::Masked | BlendMode::MaskedPerSample => 1,
                BlendMode::Overlay => 2,
                BlendMode::Translucent => 3,
            };
            ends[first..].fill(triangles.len());
        }
        let [opaque, masked, overlay, translucent] = ends;
        Surfaces {
            opaque: 0..opaque,
            masked: opaque..masked,
            overlay: masked..overlay,
            translucent: overlay..translucent,
        }
    }
}
