//! The triangles of a tile, listed by kind of surface.

use crate::Surface;
use crate::bin::Place;
use crate::frame::FrameView;
use std::ops::Range;

/// The tile's triangles by kind of surface: ranges of its places.
pub(crate) struct Surfaces {
    pub(crate) opaque: Range<usize>,
    pub(crate) masked: Range<usize>,
    pub(crate) overlay: Range<usize>,
    pub(crate) translucent: Range<usize>,
}

impl Surfaces {
    /// Lists the triangles of a tile in `places`.
    pub(crate) fn list(frame: &FrameView<'_>, tile: u32, places: &mut Vec<Place>) -> Self {
        places.clear();
        let mut ends = [0; 4];
        for chunk in frame.chunks.iter().filter(|chunk| !chunk.is_empty()) {
            chunk.collect(&frame.grid, tile, places);
            let first = match chunk.surface {
                Surface::Opaque => 0,
                Surface::Masked | Surface::MaskedPerSample => 1,
                Surface::Overlay => 2,
                Surface::Translucent => 3,
            };
            ends[first..].fill(places.len());
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
