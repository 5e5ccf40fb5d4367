//! The columns of eight pixels' triangles, from their records.

use super::records::{Records, cold, flag, hot};
use super::weights::CutColumns;
use super::{MAX_VARYINGS, ShadeContext};
use crate::setup::Corners;
use crate::simd::{Each, I32, LANES, Row, Simd, U32, prelude::*, transpose};

/// A row of eight numbers for each column of a record, the triangles of eight
/// pixels side by side.
pub(crate) struct Columns {
    rows: Vec<Row>,
    /// Filled only for vectors with a wide or cut triangle.
    pub(super) cold: [Row; cold::COUNT],
    pub(super) cut: CutColumns,
    /// The one triangle that all lanes hold.
    uniform: Option<u32>,
}

impl Columns {
    pub(crate) fn new() -> Self {
        Self {
            rows: vec![[0; LANES]; hot::COUNT + (3 * MAX_VARYINGS).next_multiple_of(LANES)],
            cold: [[0; LANES]; cold::COUNT],
            cut: [[[0.0; LANES]; 3]; 3],
            uniform: None,
        }
    }

    /// Forgets what it held: records have changed.
    pub(super) fn reset(&mut self) {
        self.uniform = None;
    }

    /// The columns of the hot row.
    #[inline(always)]
    pub(super) fn hot(&self) -> &[Row; hot::COUNT] {
        self.rows.first_chunk().expect("there is room for the longest record")
    }

    /// The varyings: those of the first vertex, of the second, of the third.
    #[inline(always)]
    pub(super) fn varyings(&self) -> &[Row] {
        &self.rows[hot::COUNT..]
    }

    /// Loads the records of eight pixels.
    #[inline(always)]
    pub(super) fn load<S: Simd>(
        &mut self,
        simd: S,
        context: &ShadeContext<'_>,
        records: &Records,
        slots: [u32; LANES],
    ) {
        let first = slots[0];
        if U32::simd_from(simd, slots).simd_eq(U32::splat(simd, first)).all_true() {
            if self.uniform == Some(first) {
                return;
            }
            self.uniform = Some(first);
            self.spread(records.of(first));
        } else {
            self.uniform = None;
            // The commonest by themselves, so that no row is looked for.
            match records.shape().loaded {
                1 => self.gather::<S, 1>(simd, records, slots),
                2 => self.gather::<S, 2>(simd, records, slots),
                3 => self.gather::<S, 3>(simd, records, slots),
                4 => self.gather::<S, 4>(simd, records, slots),
                _ => self.gather_any(simd, records, slots),
            }
        }
        let special = I32::simd_from(simd, self.hot()[hot::FLAGS]) & (flag::CUT | flag::WIDE);
        if special.simd_gt(I32::splat(simd, 0)).any_true() {
            self.cold = records.cold(simd, context, slots);
            self.load_cuts(context);
        }
    }

    /// One record for all lanes.
    #[inline(always)]
    fn spread(&mut self, record: &[Row]) {
        for (columns, row) in self.rows.as_chunks_mut::<LANES>().0.iter_mut().zip(record) {
            for (column, &value) in columns.iter_mut().zip(row) {
                *column = [value; LANES];
            }
        }
    }

    /// Records of `SIZE` rows.
    #[inline(always)]
    fn gather<S: Simd, const SIZE: usize>(&mut self, simd: S, records: &Records, slots: [u32; LANES]) {
        let sources = slots.each(
            #[inline(always)]
            |slot| records.of(slot).first_chunk::<SIZE>().expect("records have this size"),
        );
        let columns = self.rows.as_chunks_mut::<LANES>().0.iter_mut().take(SIZE);
        for (number, columns) in columns.enumerate() {
            let rows = sources.each(
                #[inline(always)]
                |source| &source[number],
            );
            transpose(simd, rows, columns);
        }
    }

    #[inline(always)]
    fn gather_any<S: Simd>(&mut self, simd: S, records: &Records, slots: [u32; LANES]) {
        let sources = slots.each(
            #[inline(always)]
            |slot| records.of(slot),
        );
        let columns = self.rows.as_chunks_mut::<LANES>().0.iter_mut().take(records.shape().loaded);
        for (number, columns) in columns.enumerate() {
            let rows = sources.each(
                #[inline(always)]
                |source| &source[number],
            );
            transpose(simd, rows, columns);
        }
    }

    /// The corners' weights at the vertices of cut triangles; the vertices are the
    /// corners in all other lanes.
    #[cold]
    fn load_cuts(&mut self, context: &ShadeContext<'_>) {
        for lane in 0..LANES {
            let place = context.places[self.cold[cold::PLACE][lane] as usize];
            let cut = place.extra().and_then(|extra| {
                let chunk = context.frame.chunk_of(place);
                match chunk.extras[extra].corners {
                    Corners::Cut { weights, .. } => Some(chunk.weights[weights as usize]),
                    Corners::Whole(_) => None,
                }
            });
            let weights = cut.unwrap_or([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
            for (columns, weights) in self.cut.iter_mut().zip(weights) {
                for (column, weight) in columns.iter_mut().zip(weights) {
                    column[lane] = weight;
                }
            }
        }
    }
}
