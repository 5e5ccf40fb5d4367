//! What set-up reads of a vertex: 16 bytes that one load fetches.

use crate::clip::Outcode;
use trigon_math::{Fixed, FixedPoint};

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
