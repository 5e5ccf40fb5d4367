//! Items collected by a small integer key: a counting sort.
//!
//! Finding edges, welding corners and following changes all need "everything at this vertex, in
//! order", in linear time for any input and in an order that does not depend on hashing.

/// Items by key, in their original order within a key.
#[derive(Debug)]
pub(crate) struct Groups<T> {
    /// The start of each key's items, plus one more for the end.
    starts: Vec<u32>,
    items: Vec<T>,
}

impl<T: Copy + Default> Groups<T> {
    /// Sorts pairs of (key, item). Keys are below `keys`; there are at most
    /// `u32::MAX` pairs.
    pub(crate) fn new(keys: usize, pairs: impl Iterator<Item = (u32, T)> + Clone) -> Self {
        // starts[key + 1] is counted, summed up, then used as the cursor of
        // `key`; the shift by one leaves it as the end of `key` afterwards.
        let mut starts = vec![0u32; keys + 2];
        let mut count = 0usize;
        for (key, _) in pairs.clone() {
            starts[key as usize + 2] += 1;
            count += 1;
        }
        for key in 2..starts.len() {
            starts[key] += starts[key - 1];
        }
        let mut items = vec![T::default(); count];
        for (key, item) in pairs {
            let cursor = &mut starts[key as usize + 1];
            items[*cursor as usize] = item;
            *cursor += 1;
        }
        starts.pop();
        Self { starts, items }
    }

    /// The items of a key.
    pub(crate) fn get(&self, key: u32) -> &[T] {
        let key = key as usize;
        &self.items[self.starts[key] as usize..self.starts[key + 1] as usize]
    }

    /// The items of each key, in key order.
    pub(crate) fn iter_mut(&mut self) -> impl Iterator<Item = &mut [T]> {
        let mut rest = self.items.as_mut_slice();
        self.starts.windows(2).map(move |ends| {
            let length = (ends[1] - ends[0]) as usize;
            let (group, tail) = std::mem::take(&mut rest).split_at_mut(length);
            rest = tail;
            group
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Groups;

    #[test]
    fn groups_keep_the_order_of_their_items() {
        let pairs = [(2, 'a'), (0, 'b'), (2, 'c'), (3, 'd'), (0, 'e')];
        let mut groups = Groups::new(5, pairs.into_iter());
        let lists: Vec<String> = groups.iter_mut().map(|g| g.iter().collect()).collect();
        assert_eq!(lists, ["be", "", "ac", "d", ""], "groups by key");
    }

    #[test]
    fn no_keys_no_groups() {
        let mut groups = Groups::<u32>::new(0, std::iter::empty());
        assert_eq!(groups.iter_mut().count(), 0, "there are no keys");
    }
}
