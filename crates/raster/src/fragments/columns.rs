//! The records of eight pixels' triangles, transposed into columns: lane `i` of every column
//! belongs to the triangle that pixel `i` shows.
//!
//! Neighbouring pixels mostly show one to four triangles. Then the columns are made by selecting
//! between broadcast numbers of these few records instead of gathering eight.

use super::context::ShadeContext;
use super::layout::{CutColumns, RecordShape, cold, hot, lined, outlined};
use super::perspective::WeightedPoints;
use super::records::Records;
use super::surface_point::SurfacePoint;
use super::task::FragmentBatch;
use crate::MAX_VARYINGS;
use crate::simd::{I32, InlineMap, LANES, Mask, Row, Simd, U32, inlined, lanes_of, prelude::*, transpose};

/// The records of the triangles of eight pixels, and the lanes of all but the first.
enum TrianglesOfLanes<S: Simd> {
    One([u32; 1]),
    Two([u32; 2], [Mask<S>; 1]),
    Three([u32; 3], [Mask<S>; 2]),
    Four([u32; 4], [Mask<S>; 3]),
    /// Any number.
    Many([u32; LANES]),
}

impl<S: Simd> TrianglesOfLanes<S> {
    /// Finds the different triangles that the eight lanes show. The processor cannot predict their
    /// count, so it should be known early: the first and the last of the lanes that differ from
    /// lane 0 are compared at the same time, not one after the other. If these two show one
    /// triangle and another lane a third, that one triangle is counted twice.
    #[inline(always)]
    fn find(simd: S, vector: &FragmentBatch<'_, S>) -> Self {
        let lanes = vector.names;
        let names: [u32; LANES] = lanes.into();
        let of = inlined(
            #[inline(always)]
            |name: u32| lanes.simd_eq(U32::splat(simd, name)),
        );
        let slot = inlined(
            #[inline(always)]
            |name: u32| vector.slot(name),
        );
        let first = names[0];
        let others = !of(first).to_bitmask() as u32 & 0xff;
        if others == 0 {
            return Self::One([slot(first)]);
        }
        let second = names[others.trailing_zeros() as usize % LANES];
        let last = names[others.ilog2() as usize % LANES];
        let masks = [of(second), of(last)];
        let rest = others & !(masks[0] | masks[1]).to_bitmask() as u32;
        if rest == 0 {
            return match second == last {
                true => Self::Two([slot(first), slot(second)], [masks[0]]),
                false => Self::Three([slot(first), slot(second), slot(last)], masks),
            };
        }
        let third = names[rest.trailing_zeros() as usize % LANES];
        let mask = of(third);
        if rest & !mask.to_bitmask() as u32 == 0 {
            let slots = [slot(first), slot(second), slot(last), slot(third)];
            return Self::Four(slots, [masks[0], masks[1], mask]);
        }
        Self::Many(vector.slots())
    }
}

/// Rows for the longest record, in whole records' rows.
const ROWS: usize =
    (hot::COUNT + 3 * MAX_VARYINGS + lined::COUNT + 1 + outlined::COUNT).next_multiple_of(LANES);

/// Aligned so that no row crosses the end of a cache line.
#[repr(align(64))]
struct AlignedRows([Row; ROWS]);

/// A row of eight numbers for each column of a record, the triangles of eight
/// pixels side by side.
pub(crate) struct Columns {
    rows: Box<AlignedRows>,
    /// Whether a triangle is wide or cut, or weights were given.
    is_special: bool,
    /// Filled only then.
    special: SpecialColumns,
    /// The one triangle that all lanes hold.
    uniform: Option<u32>,
    /// Where the pixels lie in their triangles.
    pub(crate) placed: WeightedPoints,
}

/// What only vectors with a wide or cut triangle need, or with given weights.
pub(crate) struct SpecialColumns {
    pub(crate) cold: [Row; cold::COUNT],
    /// Twice the areas.
    pub(crate) areas: [f64; LANES],
    cut: CutColumns,
    /// Whether one of them is cut.
    is_cut: bool,
    /// The derivatives of the given weights of corners 1 and 2, to the right and downwards, as bits of f32.
    slopes: Option<[[Row; 2]; 2]>,
}

impl SpecialColumns {
    /// The corners' weights at the vertices, if a triangle is cut.
    #[inline(always)]
    pub(crate) fn cut(&self) -> Option<&CutColumns> {
        self.is_cut.then_some(&self.cut)
    }

    /// The derivatives of weights that were given.
    #[inline(always)]
    pub(crate) fn slopes(&self) -> Option<&[[Row; 2]; 2]> {
        self.slopes.as_ref()
    }
}

impl Columns {
    pub(crate) fn new() -> Self {
        let (cold, cut) = ([[0; LANES]; cold::COUNT], [[[0.0; LANES]; 3]; 3]);
        Self {
            rows: Box::new(AlignedRows([[0; LANES]; ROWS])),
            is_special: false,
            special: SpecialColumns { cold, areas: [0.0; LANES], cut, is_cut: false, slopes: None },
            uniform: None,
            placed: WeightedPoints::default(),
        }
    }

    /// Forgets what it held: records have changed.
    pub(crate) fn reset(&mut self) {
        self.uniform = None;
    }

    /// The columns of the hot row.
    #[inline(always)]
    pub(crate) fn hot(&self) -> &[Row; hot::COUNT] {
        self.rows.0.first_chunk().expect("there is room for the longest record")
    }

    /// The `count` varyings of each vertex.
    #[inline(always)]
    pub(crate) fn varyings(&self, count: usize) -> [&[Row]; 3] {
        let (first, others) = self.rows.0[hot::COUNT..].split_at(count);
        let (second, others) = others.split_at(count);
        [first, second, &others[..count]]
    }

    /// The columns of lines, of a draw whose edges are painted.
    #[inline(always)]
    pub(crate) fn lines(&self, shape: RecordShape) -> Option<&[Row; lined::COUNT]> {
        self.rows.0[shape.lines?..].first_chunk()
    }

    /// The column of marks, of a draw that has any.
    #[inline(always)]
    pub(crate) fn marks(&self, shape: RecordShape) -> Option<&Row> {
        Some(&self.rows.0[shape.marks?])
    }

    /// The columns of outlined edges, of a frame that has any.
    #[inline(always)]
    pub(crate) fn outlined(&self, shape: RecordShape) -> Option<&[Row; outlined::COUNT]> {
        self.rows.0[shape.outlined?..].first_chunk()
    }

    /// What is special, if a triangle is wide or cut, or weights were given.
    #[inline(always)]
    pub(crate) fn special(&self) -> Option<&SpecialColumns> {
        self.is_special.then_some(&self.special)
    }

    /// Loads the records of eight pixels.
    #[inline(always)]
    pub(crate) fn load<S: Simd>(
        &mut self,
        simd: S,
        context: &ShadeContext<'_>,
        records: &Records,
        vector: &FragmentBatch<'_, S>,
    ) {
        let (before, rows) = (self.uniform.take(), records.selected());
        let of = inlined(
            #[inline(always)]
            |slot: u32| rows.of(slot),
        );
        match TrianglesOfLanes::find(simd, vector) {
            TrianglesOfLanes::One(slots) => {
                self.uniform = Some(slots[0]);
                if self.uniform == before {
                    return;
                }
                self.mix(simd, slots.each(of), []);
            }
            TrianglesOfLanes::Two(slots, masks) => self.mix(simd, slots.each(of), masks),
            TrianglesOfLanes::Three(slots, masks) => self.mix(simd, slots.each(of), masks),
            TrianglesOfLanes::Four(slots, masks) => self.mix(simd, slots.each(of), masks),
            TrianglesOfLanes::Many(slots) => self.gather_apart(simd, records, slots),
        }
        self.is_special = self.any_special(simd);
        if self.is_special {
            self.special.cold = records.cold(simd, context, vector.slots());
            self.special.load(context);
        }
    }

    /// Loads the first eight points; lanes to spare repeat the first.
    #[cold]
    pub(crate) fn load_points(&mut self, context: &ShadeContext<'_>, points: &[SurfacePoint]) {
        let points = lanes_of(|lane| *points.get(lane).unwrap_or(&points[0]));
        let count = context.varying_count;
        for (lane, point) in points.iter().enumerate() {
            let columns = self.rows.0[hot::COUNT..].chunks_exact_mut(count.max(1));
            for (columns, corner) in columns.zip(context.geometry().corners(point.triangle)) {
                for (column, value) in columns.iter_mut().zip(context.varyings.of(corner)) {
                    column[lane] = value.to_bits().cast_signed();
                }
            }
        }
        let row = |of: &dyn Fn(&SurfacePoint) -> f32| {
            points.each_ref().map(|point| of(point).to_bits().cast_signed())
        };
        self.placed = WeightedPoints {
            point: [0, 1].map(|axis| points.each_ref().map(|point| point.sample[axis] as i32 * 256 + 128)),
            weights: [0, 1, 2].map(|corner| row(&|point| point.weights[corner])),
            ..WeightedPoints::default()
        };
        let slopes = [0, 1].map(|corner| [0, 1].map(|axis| row(&|point| point.slopes[axis][corner])));
        self.special.slopes = Some(slopes);
        self.is_special = true;
    }

    /// Whether a triangle is wide or cut: no other has steps of 0.
    #[inline(always)]
    fn any_special<S: Simd>(&self, simd: S) -> bool {
        let hot = self.hot();
        let steps = I32::simd_from(simd, hot[hot::STEPS]) | I32::simd_from(simd, hot[hot::STEPS + 1]);
        steps.simd_eq(I32::splat(simd, 0)).any_true()
    }

    /// Columns from the first record in all lanes, replaced by each other record in the lanes of
    /// its mask.
    #[inline(always)]
    fn mix<S: Simd, const COUNT: usize, const OTHERS: usize>(
        &mut self,
        simd: S,
        records: [&[Row]; COUNT],
        masks: [Mask<S>; OTHERS],
    ) {
        let columns = self.rows.0.as_chunks_mut::<LANES>().0.iter_mut();
        for (number, columns) in columns.take(records[0].len()).enumerate() {
            let mut rows = [&records[0][number]; COUNT];
            for (row, record) in rows.iter_mut().zip(records) {
                *row = &record[number];
            }
            for (index, column) in columns.iter_mut().enumerate() {
                let mut values = I32::splat(simd, rows[0][index]);
                for (row, mask) in rows[1..].iter().zip(masks) {
                    values = mask.select(I32::splat(simd, row[index]), values);
                }
                *column = values.into();
            }
        }
    }

    /// A separate function, so that it takes no registers elsewhere.
    #[inline(always)]
    fn gather_apart<S: Simd>(&mut self, simd: S, records: &Records, slots: [u32; LANES]) {
        simd.vectorize(
            #[inline(always)]
            || self.gather(simd, records, slots),
        );
    }

    /// The records of any triangles.
    #[inline(always)]
    fn gather<S: Simd>(&mut self, simd: S, records: &Records, slots: [u32; LANES]) {
        let sources = slots.each(
            #[inline(always)]
            |slot| records.of(slot),
        );
        let columns = self.rows.0.as_chunks_mut::<LANES>().0.iter_mut().take(records.shape().loaded);
        for (number, columns) in columns.enumerate() {
            let rows = sources.each(
                #[inline(always)]
                |source| &source[number],
            );
            transpose(simd, rows, columns);
        }
    }
}

impl SpecialColumns {
    /// The rest, from the cold columns.
    #[cold]
    fn load(&mut self, context: &ShadeContext<'_>) {
        self.areas = std::array::from_fn(|lane| {
            let side = |column: usize| f64::from(self.cold[column][lane]);
            let [right, down] = [cold::RIGHT, cold::DOWN];
            (side(right) * side(down + 1) - side(right + 1) * side(down)).abs()
        });
        self.load_cuts(context);
    }

    /// The corners' weights at the vertices of cut triangles; the vertices are the
    /// corners in all other lanes.
    fn load_cuts(&mut self, context: &ShadeContext<'_>) {
        let triangles = self.cold[cold::INDEX].map(|index| context.triangles[index as usize]);
        self.is_cut = false;
        if triangles.iter().all(|triangle| triangle.part().is_none()) {
            return;
        }
        for (lane, triangle) in triangles.into_iter().enumerate() {
            let cut = triangle.part().and_then(|_| context.draw.chunk_of(triangle).weights_of(triangle));
            self.is_cut |= cut.is_some();
            let weights = cut.unwrap_or([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
            for (columns, weights) in self.cut.iter_mut().zip(weights) {
                for (column, weight) in columns.iter_mut().zip(weights) {
                    column[lane] = weight;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fragments::task::FragmentSlice;
    use crate::simd::{SimdLevel, at_level};

    /// How many records are told apart, and the record of each lane by the masks.
    fn triangles_of(slots: [u32; LANES]) -> (usize, [u32; LANES]) {
        fn lanes<S: Simd, const COUNT: usize, const OTHERS: usize>(
            slots: [u32; COUNT],
            masks: [Mask<S>; OTHERS],
        ) -> (usize, [u32; LANES]) {
            let bits = masks.map(|mask| mask.to_bitmask());
            let of_lane = |lane: usize| {
                let other = (0..OTHERS).rev().find(|&other| bits[other] >> lane & 1 != 0);
                slots[other.map_or(0, |other| other + 1)]
            };
            (COUNT, std::array::from_fn(of_lane))
        }
        let records = Records::default();
        let fragments = FragmentSlice { slots: &slots, spots: &[0; LANES], outputs: &[0; LANES] };
        let task = crate::fragments::task::Task::of_fragments(&records, 0, fragments);
        let token = SimdLevel::best().token().expect("the best level is there");
        at_level!(token, simd => match TrianglesOfLanes::find(simd, &task.vector(simd, 0)) {
            TrianglesOfLanes::One([slot]) => (1, [slot; LANES]),
            TrianglesOfLanes::Two(slots, masks) => lanes(slots, masks),
            TrianglesOfLanes::Three(slots, masks) => lanes(slots, masks),
            TrianglesOfLanes::Four(slots, masks) => lanes(slots, masks),
            TrianglesOfLanes::Many(slots) => (LANES, slots),
        })
    }

    /// Many of the ways in which eight lanes can show up to four triangles.
    #[test]
    fn up_to_four_triangles_are_told_apart() {
        for number in (0..1 << (2 * LANES)).step_by(5) {
            let slots: [u32; LANES] = std::array::from_fn(|lane| 30 + (number >> (2 * lane) & 3));
            let count = (30..34).filter(|slot| slots.contains(slot)).count();
            let (found, triangles) = triangles_of(slots);
            assert_eq!(triangles, slots, "{slots:?}");
            // The first and the last of the others are compared with them at once. If both are one triangle, more than
            // two are told apart in a longer way.
            let mut others = slots.iter().filter(|&&slot| slot != slots[0]);
            let is_exact = count < 3 || others.next() != others.next_back();
            assert!(if is_exact { found == count } else { found > count }, "{found} of {slots:?}");
        }
        assert_eq!(
            triangles_of([4, 9, 4, 2, 7, 7, 1, 0]).1,
            [4, 9, 4, 2, 7, 7, 1, 0],
            "and more are gathered"
        );
    }
}
