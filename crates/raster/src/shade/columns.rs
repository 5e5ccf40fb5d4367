//! The columns of eight pixels' triangles, from their records.

use super::records::{Records, cold, hot};
use super::task::Vector;
use super::weights::CutColumns;
use super::{MAX_VARYINGS, ShadeContext};
use crate::setup::Corners;
use crate::simd::{Each, I32, LANES, Mask, Row, Simd, U32, inlined, prelude::*, transpose};

/// Up to so many triangles are loaded side by side.
const TRIANGLES: usize = 4;

/// The triangles of eight pixels, if they are few.
struct Few<S: Simd> {
    count: usize,
    /// The numbers of their records; the first stands in for those that are not.
    slots: [u32; TRIANGLES],
    /// The lanes of all but the first.
    masks: [Mask<S>; TRIANGLES - 1],
}

impl<S: Simd> Few<S> {
    #[inline(always)]
    fn find(simd: S, vector: &Vector<'_, S>) -> Option<Self> {
        let lanes = vector.names;
        let names: [u32; LANES] = lanes.into();
        let first = names[0];
        let mut others = !lanes.simd_eq(U32::splat(simd, first)).to_bitmask() & 0xff;
        let slot = vector.slot(first);
        let masks = [Mask::splat(simd, false); TRIANGLES - 1];
        let mut few = Self { count: 1, slots: [slot; TRIANGLES], masks };
        for (slot, mask) in few.slots[1..].iter_mut().zip(&mut few.masks) {
            if others == 0 {
                return Some(few);
            }
            let name = names[others.trailing_zeros() as usize % LANES];
            *mask = lanes.simd_eq(U32::splat(simd, name));
            *slot = vector.slot(name);
            few.count += 1;
            others &= !mask.to_bitmask();
        }
        (others == 0).then_some(few)
    }
}

/// Rows for the longest record, in whole records' rows.
const ROWS: usize = (hot::COUNT + 3 * MAX_VARYINGS).next_multiple_of(LANES);

/// A row of eight numbers for each column of a record, the triangles of eight
/// pixels side by side.
pub(crate) struct Columns {
    rows: Box<[Row; ROWS]>,
    /// Whether a triangle is wide or cut.
    is_special: bool,
    /// Filled only then.
    special: Special,
    /// The one triangle that all lanes hold.
    uniform: Option<u32>,
}

/// What only vectors with a wide or cut triangle need.
pub(super) struct Special {
    pub(super) cold: [Row; cold::COUNT],
    /// Twice the areas.
    pub(super) areas: [f64; LANES],
    cut: CutColumns,
    /// Whether one of them is cut.
    is_cut: bool,
}

impl Special {
    /// The corners' weights at the vertices, if a triangle is cut.
    #[inline(always)]
    pub(super) fn cut(&self) -> Option<&CutColumns> {
        self.is_cut.then_some(&self.cut)
    }
}

impl Columns {
    pub(crate) fn new() -> Self {
        let (cold, cut) = ([[0; LANES]; cold::COUNT], [[[0.0; LANES]; 3]; 3]);
        Self {
            rows: Box::new([[0; LANES]; ROWS]),
            is_special: false,
            special: Special { cold, areas: [0.0; LANES], cut, is_cut: false },
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

    /// The `count` varyings of each vertex.
    #[inline(always)]
    pub(super) fn varyings(&self, count: usize) -> [&[Row]; 3] {
        let (first, others) = self.rows[hot::COUNT..].split_at(count);
        let (second, others) = others.split_at(count);
        [first, second, &others[..count]]
    }

    /// What is special, if a triangle is wide or cut.
    #[inline(always)]
    pub(super) fn special(&self) -> Option<&Special> {
        self.is_special.then_some(&self.special)
    }

    /// Loads the records of eight pixels.
    #[inline(always)]
    pub(super) fn load<S: Simd>(
        &mut self,
        simd: S,
        context: &ShadeContext<'_>,
        records: &Records,
        vector: &Vector<'_, S>,
    ) {
        match Few::find(simd, vector) {
            Some(Few { count: 1, slots: [slot, ..], .. }) => {
                if self.uniform == Some(slot) {
                    return;
                }
                self.uniform = Some(slot);
                self.mix(simd, [records.of(slot)], []);
            }
            few => {
                self.uniform = None;
                let of = inlined(
                    #[inline(always)]
                    |slot: u32| records.of(slot),
                );
                match few {
                    Some(Few { count: 2, slots: [a, b, ..], masks: [mask, ..] }) => {
                        self.mix(simd, [of(a), of(b)], [mask]);
                    }
                    Some(Few { count: 3, slots: [a, b, c, _], masks: [second, third, _] }) => {
                        self.mix(simd, [of(a), of(b), of(c)], [second, third]);
                    }
                    Some(Few { slots: [a, b, c, d], masks, .. }) => {
                        self.mix(simd, [of(a), of(b), of(c), of(d)], masks);
                    }
                    None => self.gather_apart(simd, records, vector),
                }
            }
        }
        self.is_special = self.any_special(simd);
        if self.is_special {
            self.special.cold = records.cold(simd, context, vector.slots());
            self.special.load(context);
        }
    }

    /// Whether a triangle is wide or cut: no other has steps of 0.
    #[inline(always)]
    fn any_special<S: Simd>(&self, simd: S) -> bool {
        let hot = self.hot();
        let steps = I32::simd_from(simd, hot[hot::STEPS]) | I32::simd_from(simd, hot[hot::STEPS + 1]);
        steps.simd_eq(I32::splat(simd, 0)).any_true()
    }

    /// The first record, and the others in the lanes of their masks.
    #[inline(always)]
    fn mix<S: Simd, const COUNT: usize, const OTHERS: usize>(
        &mut self,
        simd: S,
        records: [&[Row]; COUNT],
        masks: [Mask<S>; OTHERS],
    ) {
        let columns = self.rows.as_chunks_mut::<LANES>().0.iter_mut();
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

    /// Apart, so that it takes no registers where it is not needed.
    #[inline(always)]
    fn gather_apart<S: Simd>(&mut self, simd: S, records: &Records, vector: &Vector<'_, S>) {
        simd.vectorize(
            #[inline(always)]
            || self.gather(simd, records, vector.slots()),
        );
    }

    /// The records of any triangles.
    #[inline(always)]
    fn gather<S: Simd>(&mut self, simd: S, records: &Records, slots: [u32; LANES]) {
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
}

impl Special {
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
        self.is_cut = false;
        for lane in 0..LANES {
            let place = context.places[self.cold[cold::PLACE][lane] as usize];
            let cut = place.extra().and_then(|extra| {
                let chunk = context.frame.chunk_of(place);
                match chunk.extras[extra].corners {
                    Corners::Cut { weights, .. } => Some(chunk.weights[weights as usize]),
                    Corners::Whole(_) => None,
                }
            });
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
