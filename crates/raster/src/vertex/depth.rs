//! A single vertex: its position and depth on the screen, and the range of depths.
//!
//! `snap` does the same for eight vertices at once, with the same bits.

use super::ScreenVertex;
use crate::simd::{F32, Simd, prelude::*};
use crate::viewport::Viewport;
use trigon_math::Vec4;

impl ScreenVertex {
    /// Snaps a clip-space position with w >= [`W_MIN`](crate::clip::W_MIN); `None` if
    /// it lies outside the grid.
    #[inline]
    pub(crate) fn of(position: Vec4, viewport: Viewport) -> Option<Self> {
        let point = viewport.snap(position)?;
        Some(Self::new(point, depth(position), 1.0 / position.w))
    }
}

/// Depths behind the far plane are clamped to this, so that arithmetic with them cannot
/// overflow.
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

/// A depth moved towards the eye by a fraction of its distance, at most to the near
/// plane. A fraction that is not a number moves nothing.
#[inline]
pub(crate) fn nearer(depth: f32, fraction: f32) -> f32 {
    if fraction > 0.0 {
        let moved = depth * (1.0 + if fraction < 1.0 { fraction } else { 1.0 });
        if moved < 1.0 { moved } else { 1.0 }
    } else {
        depth
    }
}

/// [`nearer`], for lanes.
#[inline(always)]
pub(crate) fn nearer_lanes<S: Simd>(simd: S, depth: F32<S>, fraction: f32) -> F32<S> {
    if fraction > 0.0 {
        let one = F32::splat(simd, 1.0);
        let moved = depth * (1.0 + if fraction < 1.0 { fraction } else { 1.0 });
        moved.simd_lt(one).select(moved, one)
    } else {
        depth
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::{LANES, SimdLevel, at_level};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn lanes_move_as_single_depths_do(
            depths: [f32; 8],
            fraction in prop_oneof![Just(0.0), 0.0_f32..2.0, Just(f32::NAN), Just(-1.0)],
        ) {
            let depths = depths.map(|depth| if depth.is_nan() { 0.5 } else { depth });
            for token in SimdLevel::ALL.into_iter().filter_map(SimdLevel::token) {
                let moved: [f32; LANES] = at_level!(token, simd => {
                    nearer_lanes(simd, F32::simd_from(simd, depths), fraction).into()
                });
                prop_assert_eq!(moved.map(f32::to_bits), depths.map(|depth| nearer(depth, fraction).to_bits()));
            }
        }
    }
}
