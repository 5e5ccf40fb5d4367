//! One triangle prepared for one tile.

use super::TileTriangle;
use crate::bin::TriangleRef;
use crate::primitive::SetupTriangle;
use crate::tile_buffer::TileArea;
use crate::view::FrameView;

/// One triangle of the tile.
pub(crate) fn single(frame: &FrameView<'_>, area: &TileArea, triangle: TriangleRef) -> Option<TileTriangle> {
    covering_apart(frame, area, &frame.triangle(triangle))
}

/// Not inlined, so that it is compiled once.
#[inline(never)]
pub(super) fn covering_apart(
    frame: &FrameView<'_>,
    area: &TileArea,
    triangle: &SetupTriangle,
) -> Option<TileTriangle> {
    TileTriangle::new(triangle, &frame.grid, area)
}
