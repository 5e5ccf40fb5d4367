//! A triangle by itself, as one tile sees it.

use super::{Covering, TileArea};
use crate::bin::Place;
use crate::frame::FrameView;
use crate::setup::SetupTriangle;

/// One triangle of the tile.
pub(crate) fn single(frame: &FrameView<'_>, area: &TileArea, place: Place) -> Option<Covering> {
    covering_apart(frame, area, &frame.triangle(place))
}

/// Not inlined, so that it is compiled once.
#[inline(never)]
pub(super) fn covering_apart(
    frame: &FrameView<'_>,
    area: &TileArea,
    triangle: &SetupTriangle,
) -> Option<Covering> {
    Covering::new(triangle, &frame.grid, area)
}
