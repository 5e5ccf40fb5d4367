//! A list whose items keep their index for as long as they live.
//!
//! The scene refers to its parts by [`Id`]: an index, which id buffers also hold, and a generation, so that an old
//! id finds nothing instead of the item that reused the index.

use std::fmt;
use std::hash::{Hash, Hasher};
use std::marker::PhantomData;
use std::num::NonZeroU32;

/// Identifies an item of an [`Arena`]. Copyable, and a different type for each kind of item.
pub struct Id<T> {
    index: u32,
    /// From 1 on, so that no optional id takes more memory than an id.
    generation: NonZeroU32,
    kind: PhantomData<fn() -> T>,
}

impl<T> Id<T> {
    /// The item's index in its arena, as id buffers hold it.
    #[must_use]
    pub fn index(self) -> usize {
        self.index as usize
    }
}

impl<T> Clone for Id<T> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<T> Copy for Id<T> {}
impl<T> PartialEq for Id<T> {
    fn eq(&self, other: &Self) -> bool {
        (self.index, self.generation) == (other.index, other.generation)
    }
}
impl<T> Eq for Id<T> {}
impl<T> Hash for Id<T> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        (self.index, self.generation).hash(state);
    }
}
impl<T> PartialOrd for Id<T> {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl<T> Ord for Id<T> {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        (self.index, self.generation).cmp(&(other.index, other.generation))
    }
}
impl<T> fmt::Debug for Id<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{}", self.index)?;
        match self.generation.get() - 1 {
            0 => Ok(()),
            removed => write!(f, "v{removed}"),
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
struct Slot<T> {
    generation: NonZeroU32,
    item: Option<T>,
}

/// Items with stable indices. The index of a removed item is reused by a later one, with a new
/// generation.
#[derive(Clone, Debug, PartialEq)]
pub struct Arena<T> {
    slots: Vec<Slot<T>>,
    free: Vec<u32>,
}

impl<T> Default for Arena<T> {
    fn default() -> Self {
        Self { slots: Vec::new(), free: Vec::new() }
    }
}

impl<T> Arena<T> {
    /// Adds an item.
    ///
    /// # Panics
    /// There are more than `u32::MAX - 1` items: the last value marks background in id buffers.
    pub fn insert(&mut self, item: T) -> Id<T> {
        if let Some(index) = self.free.pop() {
            let slot = &mut self.slots[index as usize];
            slot.item = Some(item);
            return Id { index, generation: slot.generation, kind: PhantomData };
        }
        let index = u32::try_from(self.slots.len()).ok().filter(|&index| index < u32::MAX);
        let index = index.expect("an arena holds fewer than u32::MAX items");
        self.slots.push(Slot { generation: NonZeroU32::MIN, item: Some(item) });
        Id { index, generation: NonZeroU32::MIN, kind: PhantomData }
    }

    /// Removes an item and returns it; `None` if it was already removed.
    pub fn remove(&mut self, id: Id<T>) -> Option<T> {
        let slot = self.slots.get_mut(id.index()).filter(|slot| slot.generation == id.generation)?;
        let item = slot.item.take()?;
        slot.generation = slot.generation.checked_add(1).unwrap_or(NonZeroU32::MIN);
        self.free.push(id.index);
        Some(item)
    }

    /// The item, or `None` if it was removed.
    #[must_use]
    pub fn get(&self, id: Id<T>) -> Option<&T> {
        let slot = self.slots.get(id.index())?;
        slot.item.as_ref().filter(|_| slot.generation == id.generation)
    }

    /// The item, mutable, or `None` if it was removed.
    pub fn get_mut(&mut self, id: Id<T>) -> Option<&mut T> {
        let slot = self.slots.get_mut(id.index())?;
        let generation = slot.generation;
        slot.item.as_mut().filter(|_| generation == id.generation)
    }

    /// The id of the existing item at an index, as in an id buffer.
    #[must_use]
    pub fn id_at(&self, index: usize) -> Option<Id<T>> {
        let slot = self.slots.get(index).filter(|slot| slot.item.is_some())?;
        Some(Id { index: u32::try_from(index).ok()?, generation: slot.generation, kind: PhantomData })
    }

    /// All items in the order of their indices.
    pub fn iter(&self) -> impl Iterator<Item = (Id<T>, &T)> {
        self.slots.iter().zip(0u32..).filter_map(|(slot, index)| {
            let id = Id { index, generation: slot.generation, kind: PhantomData };
            slot.item.as_ref().map(|item| (id, item))
        })
    }

    /// All items, mutable, in the order of their indices.
    pub fn iter_mut(&mut self) -> impl Iterator<Item = (Id<T>, &mut T)> {
        self.slots.iter_mut().zip(0u32..).filter_map(|(slot, index)| {
            let id = Id { index, generation: slot.generation, kind: PhantomData };
            slot.item.as_mut().map(|item| (id, item))
        })
    }

    /// The number of items.
    #[must_use]
    pub fn len(&self) -> usize {
        self.slots.len() - self.free.len()
    }

    /// Whether there are no items.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// One more than the largest index in use: the length of a table by index.
    #[must_use]
    pub fn index_bound(&self) -> usize {
        self.slots.len()
    }
}

#[cfg(test)]
mod tests {
    use super::Arena;

    #[test]
    fn an_id_outlives_its_item_without_finding_a_stranger() {
        let mut arena = Arena::default();
        let first = arena.insert("first");
        assert_eq!(arena.remove(first), Some("first"), "it was there");
        let second = arena.insert("second");
        assert_eq!(second.index(), first.index(), "the place is used again");
        assert_eq!(arena.get(first), None, "the old id is dead");
        assert_eq!(arena.remove(first), None, "and stays dead");
        assert_eq!(arena.get(second), Some(&"second"), "the new id lives");
        assert_eq!(arena.len(), 1, "one item");
    }

    #[test]
    fn items_are_listed_by_their_indices() {
        let mut arena = Arena::default();
        assert!(arena.is_empty() && arena.index_bound() == 0 && arena.id_at(0).is_none());
        let ids = [10, 11, 12].map(|item| arena.insert(item));
        assert_eq!(ids.map(|id| id.index()), [0, 1, 2]);
        assert!(ids.is_sorted() && ids[0] < ids[1] && ids[0] != ids[1]);
        arena.remove(ids[1]);
        let items: Vec<_> = arena.iter().map(|(id, &item)| (id, item)).collect();
        assert_eq!(items, [(ids[0], 10), (ids[2], 12)]);
        assert_eq!((arena.len(), arena.index_bound(), arena.is_empty()), (2, 3, false));
        assert_eq!([0, 1, 2, 3].map(|index| arena.id_at(index)), [Some(ids[0]), None, Some(ids[2]), None]);
        arena.iter_mut().for_each(|(id, item)| *item += id.index());
        *arena.get_mut(ids[0]).expect("it is there") += 5;
        assert_eq!([0, 1, 2].map(|place| arena.get(ids[place]).copied()), [Some(15), None, Some(14)]);
        assert_eq!(arena.get_mut(ids[1]), None);
        let again = arena.insert(20);
        assert!(
            again.index() == 1 && again != ids[1] && ids[1] < again && again < ids[2],
            "by index, then age"
        );
        assert_eq!(format!("{:?} {again:?}", ids[1]), "#1 #1v1");
        arena.remove(again);
        arena.remove(ids[0]);
        arena.remove(ids[2]);
        assert!(arena.is_empty());
        assert_eq!(arena.len(), 0);
    }
}
