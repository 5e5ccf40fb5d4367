//! The box around the vertices that a drag leaves where they are.

use trigon_math::Bounds3;

use super::super::bounds::{box_of_ranges, range};
use super::super::columns::Columns;

/// The vertices that moved last, and the box around all others. That is the same as long as no others move, so a drag
/// finds it once.
#[derive(Clone, Debug, Default)]
pub(crate) struct StillBounds {
    moved: Vec<u32>,
    /// `None` until somebody asks for it.
    others: Option<Bounds3>,
}

impl StillBounds {
    /// Takes the vertices that are about to move; returns whether they are those that moved last.
    pub(crate) fn update(&mut self, moved: impl Iterator<Item = u32> + Clone) -> bool {
        let is_repeated = self.moved.iter().copied().eq(moved.clone());
        if !is_repeated {
            *self = Self { moved: moved.collect(), others: None };
        }
        is_repeated
    }

    /// The box around all vertices but these, of which `find` is given the indices, increasing.
    pub(crate) fn others(&mut self, find: impl FnOnce(&[u32]) -> Bounds3) -> Bounds3 {
        *self.others.get_or_insert_with(|| {
            let mut moved = self.moved.clone();
            moved.sort_unstable();
            find(&moved)
        })
    }
}

/// The box around the vertices of columns without those at some indices, which increase.
pub(super) fn box_without(columns: &Columns, indices: &[u32]) -> Bounds3 {
    box_of_ranges(columns.positions.each_ref().map(|column| range_without(column, indices)))
}

/// The smallest and the largest of some numbers, without those at some indices, which increase.
fn range_without(values: &[f32], indices: &[u32]) -> [f32; 2] {
    let ends = indices.iter().map(|&index| index as usize).chain([values.len()]);
    let mut start = 0;
    ends.fold([f32::INFINITY, f32::NEG_INFINITY], |[least, greatest], end| {
        // New vertices have no number yet.
        let between = values.get(start..end.min(values.len())).unwrap_or_default();
        start = end + 1;
        let [low, high] = range(between);
        [if low < least { low } else { least }, if high > greatest { high } else { greatest }]
    })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn ranges_without_some_are_those_of_the_rest(
            values in prop::collection::vec(prop_oneof![9 => -9.0_f32..9.0, 1 => Just(f32::NAN)], 0..40),
            indices in prop::collection::btree_set(0..45_u32, 0..40),
        ) {
            let indices: Vec<u32> = indices.into_iter().collect();
            let rest: Vec<f32> = (0..).zip(&values)
                .filter(|(index, _)| !indices.contains(index))
                .map(|(_, value)| *value)
                .collect();
            prop_assert_eq!(range_without(&values, &indices), range(&rest));
        }
    }
}
