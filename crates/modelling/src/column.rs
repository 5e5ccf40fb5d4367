//! One value for each element, with a record of what a change replaced.
//!
//! A [`Column`] is a plain list while nothing is recorded. During a transaction, the first write to an element
//! keeps its old value. Once the kept values take more memory than the old list, the whole old list is kept, and
//! writes cost no more than without a record.

use std::ops::Index;

/// A list with a record of what was replaced since [`Column::begin`].
#[derive(Debug, Clone)]
pub(super) struct Column<T> {
    values: Vec<T>,
    record: Record<T>,
    /// Writes below this index are recorded: 0 unless [`Record::Elements`] is active, so that one comparison
    /// suffices.
    recorded: u32,
    /// One bit for each element of the old list whose old value is in the record. All zero while
    /// nothing is recorded; kept to reuse its memory.
    noted: Vec<u64>,
}

#[derive(Debug, Clone)]
enum Record<T> {
    Off,
    /// The old values of changed elements, and the old length.
    Elements {
        old: Vec<(u32, T)>,
        length: usize,
    },
    Whole(Vec<T>),
}

/// The difference between two states of a column.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum ColumnDifference<T> {
    /// Values for some elements, and then those from `kept` on.
    Elements {
        values: Vec<(u32, T)>,
        /// The length without `tail`.
        common_length: usize,
        tail: Vec<T>,
    },
    Whole(Vec<T>),
}

impl<T: Copy> Column<T> {
    pub(super) fn new(values: Vec<T>) -> Self {
        Self { values, record: Record::Off, recorded: 0, noted: Vec::new() }
    }

    /// A list with an eighth of spare capacity: otherwise the first added elements would move all others,
    /// which takes 30 ms for a million quads. Unused memory costs nothing.
    pub(super) fn with_spare_capacity(values: impl ExactSizeIterator<Item = T>) -> Self {
        let mut list = Vec::with_capacity(values.len() + values.len() / 8);
        list.extend(values);
        Self::new(list)
    }

    pub(super) fn values(&self) -> &[T] {
        &self.values
    }

    pub(super) fn len(&self) -> u32 {
        self.values.len() as u32
    }

    /// The memory of the list, in bytes.
    pub(super) fn bytes(&self) -> usize {
        self.values.capacity() * size_of::<T>()
    }

    /// The memory of one value, in bytes.
    #[expect(clippy::unused_self, reason = "layers ask the column that they have")]
    pub(super) fn bytes_of_one(&self) -> u64 {
        size_of::<T>() as u64
    }

    pub(super) fn push(&mut self, value: T) {
        self.values.push(value);
    }

    /// Removes elements at the end, none of which existed when recording began.
    pub(super) fn truncate(&mut self, length: u32) {
        self.values.truncate(length as usize);
    }

    /// An element, mutable.
    #[inline]
    pub(super) fn write(&mut self, index: u32) -> &mut T {
        if index < self.recorded && self.noted[index as usize / 64] >> (index % 64) & 1 == 0 {
            self.note(index);
        }
        &mut self.values[index as usize]
    }

    /// Keeps the old value of an element before its first change.
    fn note(&mut self, index: u32) {
        let Record::Elements { old, length } = &mut self.record else { return };
        self.noted[index as usize / 64] |= 1u64 << (index % 64);
        old.push((index, self.values[index as usize]));
        if old.len() * size_of::<(u32, T)>() > *length * size_of::<T>() {
            self.keep_whole();
        }
    }

    /// Turns a record of elements into one of the whole list.
    #[cold]
    fn keep_whole(&mut self) {
        let Record::Elements { old, length } = &self.record else { return };
        let mut whole = self.values[..*length].to_vec();
        for &(index, value) in old {
            whole[index as usize] = value;
        }
        self.noted.fill(0);
        self.recorded = 0;
        self.record = Record::Whole(whole);
    }

    /// All elements, mutable: the whole old list is kept.
    pub(super) fn write_all(&mut self) -> &mut [T] {
        self.keep_whole();
        &mut self.values
    }

    /// Replaces all values with another list. The old list is kept as it is, not copied.
    pub(super) fn replace(&mut self, values: Vec<T>) {
        let mut whole = std::mem::replace(&mut self.values, values);
        let Record::Elements { old, length } = &self.record else { return };
        whole.truncate(*length);
        for &(index, value) in old {
            whole[index as usize] = value;
        }
        self.noted.fill(0);
        self.record = Record::Whole(whole);
    }

    /// Starts recording.
    pub(super) fn begin(&mut self) {
        let length = self.values.len();
        self.record = Record::Elements { old: Vec::new(), length };
        self.recorded = length as u32;
        if self.noted.len() < length.div_ceil(64) {
            self.noted.resize(length.div_ceil(64), 0);
        }
    }

    /// Stops recording. Returns the difference that leads back to the state at [`Self::begin`];
    /// `None` if nothing changed.
    pub(super) fn finish(&mut self) -> Option<ColumnDifference<T>> {
        self.recorded = 0;
        match std::mem::replace(&mut self.record, Record::Off) {
            Record::Off => None,
            Record::Whole(whole) => Some(ColumnDifference::Whole(whole)),
            Record::Elements { old, length } => {
                for &(index, _) in &old {
                    self.noted[index as usize / 64] = 0;
                }
                if old.is_empty() && length == self.values.len() {
                    return None;
                }
                Some(ColumnDifference::Elements { values: old, common_length: length, tail: Vec::new() })
            }
        }
    }

    /// The elements whose values differ between the two states; `None` if their numbers differ.
    /// Takes time proportional to the difference.
    pub(super) fn differing(
        &self,
        difference: &ColumnDifference<T>,
        differs: impl Fn(&T, &T) -> bool,
    ) -> Option<Vec<u32>> {
        match difference {
            ColumnDifference::Whole(other) => {
                let pairs = (0u32..).zip(self.values.iter().zip(other));
                let found = pairs.filter(|(_, (own, other))| differs(own, other)).map(|(index, _)| index);
                (other.len() == self.values.len()).then(|| found.collect())
            }
            ColumnDifference::Elements { values, common_length, tail } => {
                let of_values = values.iter().filter(|(index, other)| {
                    self.values.get(*index as usize).is_some_and(|own| differs(own, other))
                });
                let is_as_long = *common_length == self.values.len() && tail.is_empty();
                is_as_long.then(|| of_values.map(|&(index, _)| index).collect())
            }
        }
    }

    /// The first element with a fault that it did not have in the other state, which came before. In new elements a
    /// fault may be a copy, where others had it before. Takes time proportional to the difference, unless a new one has it.
    pub(super) fn first_new_fault(
        &self,
        before: &ColumnDifference<T>,
        is_fault: impl Fn(&T) -> bool,
    ) -> Option<u32> {
        let faulty = |index: &u32| self.values.get(*index as usize).is_some_and(&is_fault);
        let (changed, common_length) = match before {
            ColumnDifference::Whole(old) => {
                let pairs = (0_u32..).zip(self.values.iter().zip(old));
                let mut found = pairs.filter(|(_, (own, old))| is_fault(own) && !is_fault(old));
                (found.next().map(|(index, _)| index), old.len())
            }
            ColumnDifference::Elements { values, common_length, .. } => {
                let sound = values.iter().filter(|(_, old)| !is_fault(old)).map(|(index, _)| *index);
                (sound.into_iter().find(faulty), *common_length)
            }
        };
        let (old, new) = self.values.split_at(common_length.min(self.values.len()));
        let added = new.iter().position(&is_fault).filter(|_| !old.iter().any(&is_fault));
        changed.or(added.map(|at| (common_length + at) as u32))
    }

    /// Switches to the other state, and reverses the difference.
    pub(super) fn swap(&mut self, difference: &mut ColumnDifference<T>) {
        debug_assert!(matches!(self.record, Record::Off), "nothing is undone within a transaction");
        match difference {
            ColumnDifference::Whole(whole) => std::mem::swap(&mut self.values, whole),
            ColumnDifference::Elements { values, common_length, tail } => {
                for (index, value) in values {
                    std::mem::swap(&mut self.values[*index as usize], value);
                }
                if tail.is_empty() {
                    *tail = self.values.split_off(*common_length);
                } else {
                    self.values.append(tail);
                }
            }
        }
    }
}

impl<T> Index<u32> for Column<T> {
    type Output = T;

    #[inline]
    fn index(&self, index: u32) -> &T {
        &self.values[index as usize]
    }
}

/// Whether the values are equal, ignoring the record.
impl<T: PartialEq> PartialEq for Column<T> {
    fn eq(&self, other: &Self) -> bool {
        self.values == other.values
    }
}

impl<T> ColumnDifference<T> {
    /// Its memory, in bytes.
    pub(super) fn bytes(&self) -> usize {
        match self {
            Self::Whole(whole) => whole.capacity() * size_of::<T>(),
            Self::Elements { values, tail, .. } => {
                values.capacity() * size_of::<(u32, T)>() + tail.capacity() * size_of::<T>()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[derive(Debug, Clone)]
    enum Step {
        Write(u32, u16),
        Push(u16),
        WriteAll(u16),
        Replace(Vec<u16>),
    }

    fn steps() -> impl Strategy<Value = Vec<Step>> {
        let step = prop_oneof![
            30 => (any::<u32>(), any::<u16>()).prop_map(|(index, value)| Step::Write(index, value)),
            10 => any::<u16>().prop_map(Step::Push),
            1 => any::<u16>().prop_map(Step::WriteAll),
            1 => prop::collection::vec(any::<u16>(), 0..90).prop_map(Step::Replace),
        ];
        prop::collection::vec(step, 0..60)
    }

    fn apply(column: &mut Column<u16>, steps: &[Step]) {
        for step in steps {
            match step {
                Step::Write(index, value) if column.len() > 0 => {
                    *column.write(index % column.len()) = *value;
                }
                Step::Write(..) => {}
                Step::Push(value) => column.push(*value),
                Step::WriteAll(value) => column.write_all().fill(*value),
                Step::Replace(values) => column.replace(values.clone()),
            }
        }
    }

    proptest! {
        #[test]
        fn differences_lead_back_and_forth(
            start in prop::collection::vec(any::<u16>(), 0..80),
            transactions in prop::collection::vec(steps(), 1..6),
        ) {
            let mut column = Column::new(start);
            let mut states = vec![column.values().to_vec()];
            let mut differences = Vec::new();
            for steps in &transactions {
                column.begin();
                apply(&mut column, steps);
                differences.push(column.finish());
                states.push(column.values().to_vec());
            }
            for (difference, state) in differences.iter_mut().zip(&states).rev() {
                difference.iter_mut().for_each(|difference| column.swap(difference));
                prop_assert_eq!(column.values(), &state[..]);
            }
            for (difference, state) in differences.iter_mut().zip(&states[1..]) {
                difference.iter_mut().for_each(|difference| column.swap(difference));
                prop_assert_eq!(column.values(), &state[..]);
            }
        }
    }

    /// A whole list in place of the appended values would take more memory, before and after an undo.
    #[test]
    fn appended_values_keep_nothing_of_the_others() {
        let mut column = Column::new(vec![0u32; 1000]);
        column.begin();
        (0..5000).for_each(|value| column.push(value));
        let mut difference = column.finish().expect("it changed");
        assert_eq!(difference.bytes(), 0, "the length is enough");
        column.swap(&mut difference);
        assert_eq!((column.len(), difference.bytes()), (1000, 5000 * 4), "what was appended");
    }

    #[test]
    fn few_changes_keep_few_values() {
        let mut column = Column::new(vec![0u32; 1_000_000]);
        column.begin();
        *column.write(5) = 1;
        *column.write(5) = 2;
        let difference = column.finish().expect("it changed");
        assert!(difference.bytes() <= 64, "{} bytes for one value", difference.bytes());
    }
}
