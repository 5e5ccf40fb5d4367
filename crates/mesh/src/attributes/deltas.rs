//! What a morph target adds, stored only for the vertices that it moves. The smile of a face moves few of
//! its vertices.

use std::collections::HashMap;

use trigon_math::Vec3;

/// Vectors to be added to some elements of a list.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Deltas {
    indices: Vec<u32>,
    values: Vec<Vec3>,
}

impl Deltas {
    /// From one vector for each element. Vectors that are zero or not finite add nothing.
    pub fn from_dense(values: impl IntoIterator<Item = Vec3>) -> Self {
        Self::from_pairs((0u32..).zip(values))
    }

    /// From elements and what each gets; of several for one element the last.
    /// Vectors that are zero or not finite add nothing.
    #[must_use]
    pub fn new(mut pairs: Vec<(u32, Vec3)>) -> Self {
        pairs.reverse();
        pairs.sort_by_key(|&(index, _)| index);
        pairs.dedup_by_key(|&mut (index, _)| index);
        Self::from_pairs(pairs.into_iter())
    }

    /// The elements increase.
    fn from_pairs(pairs: impl Iterator<Item = (u32, Vec3)>) -> Self {
        let (indices, values) = pairs.filter(|(_, value)| value.is_finite() && *value != Vec3::ZERO).unzip();
        Self { indices, values }
    }

    /// The elements that get something, and what; the elements increase.
    #[must_use]
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (u32, Vec3)> + '_ {
        self.indices.iter().copied().zip(self.values.iter().copied())
    }

    /// How many elements get something.
    #[must_use]
    pub fn len(&self) -> usize {
        self.indices.len()
    }

    /// Whether nothing is added anywhere.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.indices.is_empty()
    }

    /// One more than the last element that gets something.
    pub(crate) fn bound(&self) -> usize {
        self.indices.last().map_or(0, |&last| last as usize + 1)
    }

    /// The same for other elements: new element `i` is as `order[i]` was, one
    /// of `count` old ones.
    pub(crate) fn reordered(&self, count: usize, order: impl Iterator<Item = u32>) -> Self {
        if self.is_empty() {
            return Self::default();
        }
        let mut dense = vec![Vec3::ZERO; count];
        for (index, value) in self.iter() {
            dense[index as usize] = value;
        }
        Self::from_dense(order.map(|from| dense[from as usize]))
    }

    /// Changes each value by its element.
    pub(crate) fn map(&mut self, change: impl Fn(u32, Vec3) -> Vec3) {
        for (&index, value) in self.indices.iter().zip(&mut self.values) {
            *value = change(index, *value);
        }
    }
}

/// A shape that a mesh can move towards, as differences from its own.
///
/// In a [`Mesh`](crate::Mesh), `positions` counts vertices, `normals` and
/// `tangents` count corners; in a [`RenderMesh`](crate::RenderMesh) all count
/// its vertices.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MorphTarget {
    /// For people; need not be unique.
    pub name: String,
    /// Metres.
    pub positions: Deltas,
    /// To unit normals; the sum is made a unit vector again.
    pub normals: Deltas,
    /// To the x, y and z of unit tangents, likewise.
    pub tangents: Deltas,
}

/// For each corner a number that corners share exactly when all targets add
/// the same to their normals and tangents.
pub(crate) fn classes(targets: &[MorphTarget], corners: usize) -> Vec<u32> {
    let mut classes = vec![0; corners];
    let mut known = HashMap::new();
    for (number, deltas) in targets.iter().flat_map(|target| [&target.normals, &target.tangents]).enumerate()
    {
        for (corner, value) in deltas.iter() {
            let class = &mut classes[corner as usize];
            let next = known.len() as u32 + 1;
            let key = (*class, number, value.to_array().map(|channel| (channel + 0.0).to_bits()));
            *class = *known.entry(key).or_insert(next);
        }
    }
    classes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_moves_is_kept() {
        let deltas = Deltas::from_dense([Vec3::ZERO, Vec3::X, Vec3::splat(f32::NAN), Vec3::Y, -Vec3::ZERO]);
        assert_eq!(deltas.iter().collect::<Vec<_>>(), [(1, Vec3::X), (3, Vec3::Y)], "two of five");
        assert_eq!(deltas.bound(), 4, "one more than the last");
        assert_eq!(Deltas::new(vec![(3, Vec3::X), (1, Vec3::X), (3, Vec3::Y)]), deltas, "the last counts");
        let turned = deltas.reordered(5, [3, 3, 0, 1].into_iter());
        assert_eq!(
            turned.iter().collect::<Vec<_>>(),
            [(0, Vec3::Y), (1, Vec3::Y), (3, Vec3::X)],
            "by the old elements"
        );
    }

    #[test]
    fn corners_with_the_same_deltas_are_in_one_class() {
        let target = |normals: [Vec3; 4]| MorphTarget {
            normals: Deltas::from_dense(normals),
            ..MorphTarget::default()
        };
        let targets = [
            target([Vec3::X, Vec3::X, Vec3::ZERO, Vec3::X]),
            target([Vec3::Y, Vec3::ZERO, Vec3::ZERO, Vec3::Y]),
        ];
        let classes = classes(&targets, 4);
        assert_eq!(classes[0], classes[3], "the same from both");
        assert!(classes[0] != classes[1] && classes[1] != classes[2], "others differ: {classes:?}");
        assert_eq!(classes[2], 0, "moved by none");
    }
}
