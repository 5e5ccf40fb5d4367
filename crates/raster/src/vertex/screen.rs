//! Vertices on the screen: what set-up reads of a vertex, 16 bytes that one load fetches; snapping to the sub-pixel grid,
//! eight vertices at a time or a single one, with the same bits; and the range of depths.

use crate::clip::{COORDINATE_MAX, Outcode, W_MIN};
use crate::simd::{F32, InlineMap, LANES, Mask, Simd, prelude::*};
use crate::viewport::Viewport;
use trigon_math::{Band, Fixed, FixedPoint, Vec4};

/// A vertex on the sub-pixel grid: x, y in 1/256 pixel, reversed depth and 1/w
/// as bits. A vertex that is not snapped, because it must be cut or dropped, holds
/// its outcode instead.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ScreenVertex(pub(crate) [i32; 4]);

impl ScreenVertex {
    /// A vertex that does not exist.
    pub(crate) const MISSING: Self = Self([Self::NOWHERE, Outcode::INVALID.bits() as i32, 0, 0]);

    /// Instead of x: no vertex on the grid has it.
    pub(crate) const NOWHERE: i32 = i32::MIN;

    #[inline(always)]
    pub(crate) fn new(point: FixedPoint, depth: f32, inverse_w: f32) -> Self {
        Self([point.x.raw(), point.y.raw(), depth.to_bits() as i32, inverse_w.to_bits() as i32])
    }

    /// A vertex that is not snapped.
    #[inline(always)]
    pub(crate) fn nowhere(outcode: Outcode) -> Self {
        Self([Self::NOWHERE, i32::from(outcode.bits()), 0, 0])
    }

    #[inline(always)]
    pub(crate) fn is_snapped(self) -> bool {
        self.0[0] != Self::NOWHERE
    }

    /// The outcode of a vertex that is not snapped; for all others that of a vertex in full view.
    #[inline]
    pub(crate) fn outcode(self) -> Outcode {
        if self.is_snapped() { Outcode::from_bits(0) } else { Outcode::from_bits(self.0[1] as u16) }
    }

    /// Coordinates in 1/256 pixel.
    #[inline(always)]
    pub(crate) fn raw(self) -> [i32; 2] {
        [self.0[0], self.0[1]]
    }

    #[inline(always)]
    pub(crate) fn point(self) -> FixedPoint {
        FixedPoint::new(Fixed::from_raw(self.0[0]), Fixed::from_raw(self.0[1]))
    }

    /// Reversed depth.
    #[inline(always)]
    pub(crate) fn depth(self) -> f32 {
        f32::from_bits(self.0[2] as u32)
    }

    /// 1/w.
    #[inline(always)]
    pub(crate) fn inverse_w(self) -> f32 {
        f32::from_bits(self.0[3] as u32)
    }

    #[inline]
    pub(crate) fn with_depth(self, depth: f32) -> Self {
        let Self([x, y, _, q]) = self;
        Self([x, y, depth.to_bits() as i32, q])
    }

    #[inline]
    pub(crate) fn at(self, point: FixedPoint) -> Self {
        let Self([_, _, z, q]) = self;
        Self([point.x.raw(), point.y.raw(), z, q])
    }
}

/// Snaps up to eight vertices to the sub-pixel grid, one in each lane.
///
/// Each vertex becomes a [`ScreenVertex`] of four numbers: x and y in 1/256 pixel, depth and
/// 1/w. A vertex that must be cut or dropped is not snapped and holds its outcode instead. Set-up
/// snaps it with [`ScreenVertex::of`] if its triangle is cut.
#[inline(always)]
pub(crate) fn to_screen<S: Simd>(
    simd: S,
    position: [F32<S>; 4],
    viewport: Viewport,
    guard: [Band; 2],
    vertices: &mut [ScreenVertex],
) {
    let [x, y, z, w] = position;
    let whole = is_whole(simd, position, guard).to_bitmask();
    let one = F32::splat(simd, 1.0);
    // Clamped to the range from DEPTH_LEAST to 1, with the same comparisons as for single vertices.
    // Adding 0 turns -0 into 0. Lanes that are not snapped may hold NaN here; it is not used.
    let depth = z / w;
    let depth = depth.simd_gt(one).select(one, depth + F32::splat(simd, 0.0));
    let least = F32::splat(simd, DEPTH_LEAST);
    let depth: [f32; LANES] = depth.simd_gt(least).select(depth, least).into();
    let inverse_w: [f32; LANES] = (one / w).into();
    let [x, y, z, w]: [[f32; LANES]; 4] = [x.into(), y.into(), z.into(), w.into()];
    let [column, row] = snap(viewport, x, y, w);
    for (lane, vertex) in vertices.iter_mut().enumerate() {
        *vertex = if whole >> lane & 1 != 0 {
            ScreenVertex([
                column[lane],
                row[lane],
                depth[lane].to_bits() as i32,
                inverse_w[lane].to_bits() as i32,
            ])
        } else {
            ScreenVertex::nowhere(Outcode::new(Vec4::new(x[lane], y[lane], z[lane], w[lane]), guard))
        };
    }
}

/// The lanes whose vertices need no cutting: those whose outcode would neither cut nor be
/// invalid. Comparisons with NaN are false, so a coordinate that is not a number is never whole.
#[inline(always)]
fn is_whole<S: Simd>(simd: S, [x, y, z, w]: [F32<S>; 4], guard: [Band; 2]) -> Mask<S> {
    let [guard_x, guard_y] = guard.each(
        #[inline(always)]
        |band| F32::splat(simd, band.factor()) * w,
    );
    let most = F32::splat(simd, COORDINATE_MAX);
    x.abs().simd_le(guard_x)
        & y.abs().simd_le(guard_y)
        & x.abs().simd_le(most)
        & y.abs().simd_le(most)
        & z.simd_le(w)
        & z.simd_ge(-most)
        & w.simd_ge(F32::splat(simd, W_MIN))
        & w.simd_le(most)
}

/// The grid points of eight vertices, in f64 so that the only rounding that matters is the one
/// to the grid. Two triangles that share a vertex get the same grid point, and all decisions
/// about coverage follow from grid points, so no gap can open between them. Lanes that are not
/// whole get arbitrary numbers.
///
/// When a triangle is cut, set-up snaps its corners by `Viewport::snap` instead, also those that the
/// cut has left unchanged. These must get the same grid points as here, because a neighbour that is
/// not cut has the same vertex. They do, bit for bit: both use `Viewport::position` in f64 and
/// round to nearest, ties to even. The test below compares the two.
#[inline(always)]
fn snap(viewport: Viewport, x: [f32; LANES], y: [f32; LANES], w: [f32; LANES]) -> [[i32; LANES]; 2] {
    // Adding this rounds to a whole number, ties to even: in the sum the last bit of the
    // mantissa is worth 1. The number is then in the low bits, also if it is negative. That
    // works up to 2^31. Vertices in the guard band lie within ±2^24: at most 32768 pixels from the
    // middle of a viewport of at most 65536 pixels, so at most 65536 pixels from its corner, in
    // units of 1/256 pixel.
    const ROUND: f64 = 1.5 * (1_u64 << 52) as f64;
    let mut snapped = [[0; LANES]; 2];
    for lane in 0..LANES {
        let inverse_w = 1.0 / f64::from(w[lane]);
        let position = viewport.position([f64::from(x[lane]), f64::from(y[lane])], inverse_w);
        for (axis, pixels) in position.into_iter().enumerate() {
            snapped[axis][lane] = (pixels * 256.0 + ROUND).to_bits() as i32;
        }
    }
    snapped
}

impl ScreenVertex {
    /// Snaps a clip-space position with w >= [`W_MIN`]; `None` if
    /// it lies outside the grid.
    #[inline]
    pub(crate) fn of(position: Vec4, viewport: Viewport) -> Option<Self> {
        let point = viewport.snap(position)?;
        Some(Self::new(point, depth(position), 1.0 / position.w))
    }
}

/// Depths behind the far plane are clamped to this, so that arithmetic with them cannot
/// overflow.
const DEPTH_LEAST: f32 = -1e30;

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

    fn number() -> impl Strategy<Value = f32> {
        prop_oneof![4 => -3.0_f32..3.0, 2 => -1e5_f32..1e5, 1 => any::<f32>()]
    }

    proptest! {
        /// Against the outcode and `ScreenVertex::of`, which snaps one vertex at a time.
        #[test]
        fn lanes_agree_with_single_vertices(positions: [[f32; 4]; 8], near in [number(), number(), number(), number()]) {
            let viewport = Viewport { width: 1920, height: 1080 };
            let mut positions = positions;
            positions[3] = near;
            for level in SimdLevel::ALL.into_iter().filter_map(SimdLevel::token) {
                let mut vertices = [ScreenVertex::default(); 8];
                at_level!(level, simd => {
                    let columns = [0, 1, 2, 3].map(|i| F32::simd_from(simd, positions.map(|p| p[i])));
                    to_screen(simd, columns, viewport, viewport.guard(), &mut vertices);
                });
                for (vertex, position) in vertices.iter().zip(positions) {
                    let position = Vec4::from_array(position);
                    let outcode = Outcode::new(position, viewport.guard());
                    let expected = if outcode.is_invalid() || outcode.cuts() {
                        ScreenVertex::nowhere(outcode)
                    } else {
                        ScreenVertex::of(position, viewport).expect("within the guard band")
                    };
                    prop_assert_eq!(vertex.0, expected.0, "{}", position);
                }
            }
        }
    }

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
