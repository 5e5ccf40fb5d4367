//! Depths of vertices on the screen.

use super::ScreenVertex;
use crate::viewport::Viewport;
use trigon_math::Vec4;

impl ScreenVertex {
    /// Where a position with w >= [`W_MIN`](crate::clip::W_MIN) lies; `None` if
    /// it has no place on the grid.
    #[inline]
    pub(crate) fn of(position: Vec4, viewport: Viewport) -> Option<Self> {
        let point = viewport.snap(position)?;
        Some(Self::new(point, depth(position), 1.0 / position.w))
    }
}

/// Depths behind the far plane are not told apart further than this, so that
/// arithmetic with them cannot overflow.
pub(super) const DEPTH_LEAST: f32 = -1e30;

/// z / w, at most 1 (cutting rounds) and at least [`DEPTH_LEAST`]. Zero is
/// positive.
#[inline]
fn depth(position: Vec4) -> f32 {
    let depth = position.z / position.w;
    if depth > 1.0 {
        1.0
    } else if depth > DEPTH_LEAST {
        depth + 0.0
    } else {
        DEPTH_LEAST
    }
}

/// A depth moved towards the eye by a share of its distance, at most to the near
/// plane. A share that is not a number moves nothing.
#[inline]
pub(crate) fn nearer(depth: f32, share: f32) -> f32 {
    if share > 0.0 {
        let moved = depth * (1.0 + if share < 1.0 { share } else { 1.0 });
        if moved < 1.0 { moved } else { 1.0 }
    } else {
        depth
    }
}
