//! Paints edges of faces over the colours of eight pixels. Before that, tints the colours of marked faces.

use super::columns::Columns;
use super::context::{ShadeContext, ShadePoint};
use super::layout::{lined, outlined};
use super::records::Records;
use super::triangle_lanes::TriangleLanes;
use crate::draw::Overlap;
use crate::ink::Ink;
use crate::simd::{F32, I32, InlineMap, LANES, Row, Simd, U32, greater, inlined, lesser, prelude::*};

/// The inputs. Nothing that shading has computed is among them: its results stay in registers, and
/// what is needed here is computed again.
pub(crate) struct LinesOver<'a> {
    pub(crate) ink: &'a Ink,
    pub(crate) context: &'a ShadeContext<'a>,
    pub(crate) records: &'a Records,
    pub(crate) columns: &'a Columns,
}

/// [`Overlap`]s of eight pixels.
struct Overlaps<S: Simd> {
    shares: F32<S>,
    marks: U32<S>,
}

impl LinesOver<'_> {
    /// The colours with what is painted over them.
    #[inline(always)]
    pub(crate) fn lay<S: Simd>(&self, simd: S, spots: U32<S>, color: [F32<S>; 4]) -> [F32<S>; 4] {
        if self.ink.has_outlines() {
            return simd.vectorize(
                #[inline(always)]
                || self.lay_outlined(simd, spots, color),
            );
        }
        if self.ink.has_marks() {
            // A separate function, so that edges without marks spend no registers on it.
            return simd.vectorize(
                #[inline(always)]
                || self.lay_marked(simd, spots, color),
            );
        }
        let lines = self.columns.lines(self.records.shape());
        let share = match (lines, self.context.outer) {
            (None, None) => return color,
            (Some(lines), None) => self.own(simd, lines),
            (None, Some(outer)) => beside(simd, spots, outer),
            (Some(lines), Some(outer)) => greater(self.own(simd, lines), beside(simd, spots, outer)),
        };
        self.ink.over_lanes(color, share)
    }

    /// [`lay`](Self::lay) with marks.
    #[inline(always)]
    fn lay_marked<S: Simd>(&self, simd: S, spots: U32<S>, color: [F32<S>; 4]) -> [F32<S>; 4] {
        let shape = self.records.shape();
        let marks = self.columns.marks(shape).map(|marks| I32::simd_from(simd, *marks).bitcast::<U32<S>>());
        let marks = marks.unwrap_or_else(|| U32::splat(simd, 0));
        let color = self.ink.tinted(color, marks >> 24);
        let own = self.columns.lines(shape).map(|lines| self.own_marked(simd, lines, marks));
        let beside = self.context.outer.map(|outer| beside_marked(simd, spots, outer));
        let overlaps = match (own, beside) {
            (None, None) => return color,
            (Some(alone), None) | (None, Some(alone)) => alone,
            (Some(own), Some(beside)) => own.or(beside),
        };
        self.ink.over_marked(color, overlaps.shares, overlaps.marks)
    }

    /// [`lay_marked`](Self::lay_marked) where some edges have outlines.
    #[inline(always)]
    fn lay_outlined<S: Simd>(&self, simd: S, spots: U32<S>, color: [F32<S>; 4]) -> [F32<S>; 4] {
        let shape = self.records.shape();
        let marks = self.columns.marks(shape).map(|marks| I32::simd_from(simd, *marks).bitcast::<U32<S>>());
        let marks = marks.unwrap_or_else(|| U32::splat(simd, 0));
        let color = self.ink.tinted(color, marks >> 24);
        let own = self.columns.lines(shape).map(|lines| match self.columns.outlined(shape) {
            Some(wide) => self.own_outlined(simd, lines, wide, marks),
            None => Strokes::plain(self.own_marked(simd, lines, marks)),
        });
        let beside = self.context.outer.map(|outer| Strokes::beside(simd, spots, outer));
        let Strokes { cores, overlaps } = match (own, beside) {
            (None, None) => return color,
            (Some(alone), None) | (None, Some(alone)) => alone,
            (Some(own), Some(beside)) => own.or(beside),
        };
        self.ink.over_outlined(color, [overlaps.shares, cores], overlaps.marks)
    }

    /// [`own_marked`](Self::own_marked) where some edges have outlines.
    #[inline(always)]
    fn own_outlined<S: Simd>(
        &self,
        simd: S,
        lines: &[Row; lined::COUNT],
        wide: &[Row; outlined::COUNT],
        packed: U32<S>,
    ) -> Strokes<S> {
        let weights = self.raw_weights(simd);
        let column = |index: usize| I32::simd_from(simd, lines[index]).bitcast::<F32<S>>();
        let [whole, core, weight] = [outlined::WHOLE, outlined::CORE, outlined::WEIGHT].each(
            #[inline(always)]
            |index| I32::simd_from(simd, wide[index]).bitcast::<F32<S>>(),
        );
        let (zero, none) = (F32::splat(simd, 0.0), U32::splat(simd, 0));
        let covered = inlined(
            #[inline(always)]
            |(reach, most, distance): (F32<S>, F32<S>, F32<S>)| greater(lesser(reach - distance, most), zero),
        );
        // Twice half of the width, and no more than the pixel.
        let most = inlined(
            #[inline(always)]
            |reach: F32<S>| lesser(reach * 2.0 - weight, weight),
        );
        let (mut most_covered, mut greatest) = (Strokes::none(simd), none);
        for (corner, raw) in weights.into_iter().enumerate() {
            let inverse = column(lined::INVERSE + corner);
            let is_edge = inverse.simd_ge(zero);
            let distance = raw * inverse;
            let marks = is_edge.select((packed >> (8 * corner as u32)) & 0xff, none);
            let plain = covered((column(lined::REACH), column(lined::MOST), distance));
            let is_wide = self.ink.outlined_lanes(marks);
            let shares = is_wide.select(covered((whole, most(whole), distance)), plain);
            let cores = is_wide.select(covered((core, most(core), distance)), plain);
            greatest = greatest.max(marks);
            let overlaps = Overlaps { shares: is_edge.select(shares, zero), marks };
            most_covered = most_covered.or(Strokes { cores: is_edge.select(cores, zero), overlaps });
        }
        let (floor, Strokes { cores, overlaps }) = (column(lined::FLOOR), most_covered);
        // Where single edges cannot be distinguished, the face shows its greatest mark.
        let marks = floor.simd_gt(overlaps.shares).select(greatest, overlaps.marks);
        Strokes { cores: cores + floor, overlaps: Overlaps { shares: overlaps.shares + floor, marks } }
    }

    /// What edges of the triangles themselves cover.
    #[inline(always)]
    fn own<S: Simd>(&self, simd: S, lines: &[Row; lined::COUNT]) -> F32<S> {
        let shares = self.raw_weights(simd);
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

    /// The same, edge by edge: the coverages have the same bits.
    #[inline(always)]
    fn own_marked<S: Simd>(&self, simd: S, lines: &[Row; lined::COUNT], packed: U32<S>) -> Overlaps<S> {
        let shares = self.raw_weights(simd);
        let column = |index: usize| I32::simd_from(simd, lines[index]).bitcast::<F32<S>>();
        let (zero, none) = (F32::splat(simd, 0.0), U32::splat(simd, 0));
        let (mut most, mut greatest) = (Overlaps { shares: zero, marks: none }, none);
        for (corner, share) in shares.into_iter().enumerate() {
            let inverse = column(lined::INVERSE + corner);
            let is_edge = inverse.simd_ge(zero);
            let overlap = greater(lesser(column(lined::REACH) - share * inverse, column(lined::MOST)), zero);
            let mark = (packed >> (8 * corner as u32)) & 0xff;
            let marks = is_edge.select(mark, none);
            greatest = greatest.max(marks);
            most = most.or(Overlaps { shares: is_edge.select(overlap, zero), marks });
        }
        let floor = column(lined::FLOOR);
        // Where single edges cannot be distinguished, the face shows its greatest mark.
        let marks = floor.simd_gt(most.shares).select(greatest, most.marks);
        Overlaps { shares: most.shares + floor, marks }
    }

    /// The raw weights of the corners at the pixels.
    #[inline(always)]
    fn raw_weights<S: Simd>(&self, simd: S) -> [F32<S>; 3] {
        let triangle = TriangleLanes::load(simd, self.columns);
        let (edges, _) = triangle.edges(simd, self.columns.placed.point(simd));
        triangle.raw_weights(edges)
    }
}

/// [`Overlap`]s of eight pixels with their cores.
struct Strokes<S: Simd> {
    cores: F32<S>,
    overlaps: Overlaps<S>,
}

impl<S: Simd> Strokes<S> {
    #[inline(always)]
    fn none(simd: S) -> Self {
        Self::plain(Overlaps { shares: F32::splat(simd, 0.0), marks: U32::splat(simd, 0) })
    }

    /// Of lines without outlines.
    #[inline(always)]
    fn plain(overlaps: Overlaps<S>) -> Self {
        Self { cores: overlaps.shares, overlaps }
    }

    /// What edges of others cover.
    #[inline(always)]
    fn beside(simd: S, spots: U32<S>, outer: &[Overlap]) -> Self {
        let lanes: [u32; LANES] = spots.into();
        let cores = lanes.each(
            #[inline(always)]
            |spot| outer[ShadePoint::pixel_of(spot)].core,
        );
        Self { cores: F32::simd_from(simd, cores), overlaps: beside_marked(simd, spots, outer) }
    }

    /// See [`Overlap::or`].
    #[inline(always)]
    fn or(self, other: Self) -> Self {
        let (own, others) = (self.overlaps.shares + self.cores, other.overlaps.shares + other.cores);
        let equal = others.simd_eq(own) & other.overlaps.marks.simd_gt(self.overlaps.marks);
        let above = others.simd_gt(own) | equal;
        let shares = above.select(other.overlaps.shares, self.overlaps.shares);
        let marks = above.select(other.overlaps.marks, self.overlaps.marks);
        Self { cores: above.select(other.cores, self.cores), overlaps: Overlaps { shares, marks } }
    }
}

impl<S: Simd> Overlaps<S> {
    /// See [`Overlap::or`].
    #[inline(always)]
    fn or(self, other: Self) -> Self {
        let equal = other.shares.simd_eq(self.shares) & other.marks.simd_gt(self.marks);
        let above = other.shares.simd_gt(self.shares) | equal;
        Self { shares: above.select(other.shares, self.shares), marks: above.select(other.marks, self.marks) }
    }
}

/// What edges of others cover.
#[inline(always)]
fn beside<S: Simd>(simd: S, spots: U32<S>, outer: &[Overlap]) -> F32<S> {
    let spots: [u32; LANES] = spots.into();
    let shares = spots.each(
        #[inline(always)]
        |spot| outer[ShadePoint::pixel_of(spot)].share,
    );
    F32::simd_from(simd, shares)
}

/// The same with their marks.
#[inline(always)]
fn beside_marked<S: Simd>(simd: S, spots: U32<S>, outer: &[Overlap]) -> Overlaps<S> {
    let lanes: [u32; LANES] = spots.into();
    let marks = lanes.each(
        #[inline(always)]
        |spot| u32::from(outer[ShadePoint::pixel_of(spot)].mark),
    );
    Overlaps { shares: beside(simd, spots, outer), marks: U32::simd_from(simd, marks) }
}
