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

/// Which of a tile's triangles.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Listing {
    All,
    /// Those of primitives that are not listed apart.
    Still,
    /// Those of primitives that are listed apart: [`MovingChunk`](crate::bin::MovingChunk).
    Moving,
}

impl Surfaces {
    /// Appends triangles of a tile to `triangles`.
    pub(crate) fn list(
        frame: &FrameView<'_>,
        tile: u32,
        listing: Listing,
        triangles: &mut Vec<TriangleRef>,
    ) -> Self {
        let start = triangles.len();
        let mut ends = [start; 4];
        for (number, chunk) in frame.chunks.iter().enumerate() {
            let first = triangles.len();
            if listing != Listing::Moving && !chunk.is_empty() {
                chunk.collect(&frame.grid, tile, triangles);
            }
            let moving = frame.moving.get(number).filter(|_| listing != Listing::Still);
            if let Some(moving) = moving.filter(|moving| !moving.listed.is_empty()) {
                let still = triangles.len();
                moving.listed.collect(&frame.grid, tile, triangles);
                if first < still && still < triangles.len() {
                    triangles[first..].sort_unstable_by_key(|triangle| triangle.order());
                }
            }
            let kind = match chunk.blend_mode {
                BlendMode::Opaque => 0,
                BlendMode::Masked | BlendMode::MaskedPerSample => 1,
                BlendMode::Overlay => 2,
                BlendMode::Translucent => 3,
            };
            ends[kind..].fill(triangles.len());
        }
        let [opaque, masked, overlay, translucent] = ends;
        Surfaces {
            opaque: start..opaque,
            masked: opaque..masked,
            overlay: masked..overlay,
            translucent: overlay..translucent,
        }
    }
}
