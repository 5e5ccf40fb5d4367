//! Lays edges of faces over the colours of eight pixels.

use super::columns::Columns;
use super::records::{Records, lined};
use super::triangle_lanes::TriangleLanes;
use super::{ShadeContext, Work};
use crate::ink::Ink;
use crate::simd::{Each, F32, I32, LANES, Row, Simd, U32, greater, lesser, prelude::*};

/// What it takes. Nothing that shading computes: what it finds stays in registers, and what
/// is asked for here is found once more.
pub(super) struct LinesOver<'a> {
    pub(super) ink: &'a Ink,
    pub(super) context: &'a ShadeContext<'a>,
    pub(super) records: &'a Records,
    pub(super) columns: &'a Columns,
}

impl LinesOver<'_> {
    /// Apart, so that it takes no registers where no edges are painted.
    #[inline(always)]
    pub(super) fn lay<S: Simd>(self, simd: S, spots: U32<S>, color: [F32<S>; 4]) -> [F32<S>; 4] {
        simd.vectorize(
            #[inline(always)]
            move || {
                let lines = self.columns.lines(self.records.shape());
                let share = match (lines, self.context.outer) {
                    (None, None) => return color,
                    (Some(lines), None) => self.own(simd, lines),
                    (None, Some(outer)) => beside(simd, spots, outer),
                    (Some(lines), Some(outer)) => greater(self.own(simd, lines), beside(simd, spots, outer)),
                };
                self.ink.over_lanes(color, share)
            },
        )
    }

    /// What edges of the triangles themselves cover.
    #[inline(always)]
    fn own<S: Simd>(&self, simd: S, lines: &[Row; lined::COUNT]) -> F32<S> {
        let triangle = TriangleLanes::load(simd, self.columns);
        let (edges, _) = triangle.edges(simd, self.columns.placed.point(simd));
        let shares = triangle.shares(edges);
        let column = |index: usize| I32::simd_from(simd, lines[index]).bitcast::<F32<S>>();
        let zero = F32::splat(simd, 0.0);
        let mut nearest = F32::splat(simd, f32::INFINITY);
        for (corner, share) in shares.into_iter().enumerate() {
            let inverse = column(lined::INVERSE + corner);
            // Diagonals are below 0.
            nearest = inverse.simd_ge(zero).select(lesser(share * inverse, nearest), nearest);
        }
        let overlap = lesser(column(lined::REACH) - nearest, column(lined::MOST));
        greater(overlap, zero) + column(lined::FLOOR)
    }
}

/// What edges of others cover.
#[inline(always)]
fn beside<S: Simd>(simd: S, spots: U32<S>, outer: &[f32]) -> F32<S> {
    let spots: [u32; LANES] = spots.into();
    let shares = spots.each(
        #[inline(always)]
        |spot| outer[Work::pixel_of(spot)],
    );
    F32::simd_from(simd, shares)
}
