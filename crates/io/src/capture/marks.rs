//! Marks: elements in their own colours, and sets of elements.

use trigon_scene::{ElementSet, FixedBitSet, Mark, Marks, NodeId, VertexPoints};

use super::stored::{Stored, record};
use super::stream::{Damage, Reader, Writer};

/// Elements in a word of a set.
const BITS: usize = u32::BITS as usize;

record!(Marks { edges, faces, vertices });
record!(Mark { elements, color, opacity });
record!(VertexPoints { size, marked_size, color });

/// For each node its number of elements, and a bit for each, from the lowest of a word on.
impl Stored for ElementSet {
    fn write(&self, to: &mut Writer<'_>) {
        let of_nodes = self.nodes().map(|(node, bits)| (node, (bits.len() as u32, words(bits))));
        of_nodes.collect::<Vec<_>>().write(to);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Damage> {
        let mut set = Self::default();
        for (node, (count, words)) in Vec::<(NodeId, (u32, Vec<u32>))>::read(from)? {
            set.add(node, bits(count as usize, &words)?);
        }
        Ok(set)
    }
}

fn words(bits: &FixedBitSet) -> Vec<u32> {
    let mut words = vec![0; bits.len().div_ceil(BITS)];
    bits.ones().for_each(|element| words[element / BITS] |= 1 << (element % BITS));
    words
}

/// They take no more memory than was read.
fn bits(count: usize, words: &[u32]) -> Result<FixedBitSet, Damage> {
    let mut bits = FixedBitSet::with_capacity(words.len() * BITS);
    let elements = words.iter().enumerate().flat_map(|(index, word)| {
        (0..BITS).filter(move |bit| word >> bit & 1 != 0).map(move |bit| index * BITS + bit)
    });
    bits.extend(elements);
    let is_whole = words.len() == count.div_ceil(BITS) && bits.maximum().is_none_or(|last| last < count);
    if !is_whole {
        return Err(Damage::malformed("a set of elements has another length than it says"));
    }
    let mut exact = FixedBitSet::with_capacity(count);
    exact.extend(bits.ones());
    Ok(exact)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_of_any_length_come_back() {
        for count in [0, 1, 31, 32, 33, 100] {
            let mut set = FixedBitSet::with_capacity(count);
            set.extend((0..count).filter(|element| element % 3 == 0));
            assert_eq!(bits(count, &words(&set)), Ok(set), "{count} elements");
        }
    }

    #[test]
    fn elements_beyond_the_end_are_refused() {
        for (count, words) in [(3, &[0b1000][..]), (33, &[0]), (1_000_000_000, &[1]), (0, &[0])] {
            assert!(bits(count, words).is_err(), "{words:?} for {count} elements");
        }
    }
}
