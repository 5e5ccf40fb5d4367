//! A set of changed elements. Their new values are in the mesh itself.

use super::MeshChange;
use crate::Mesh;

/// The vertices and corners of a mesh that one or several changes gave other values.
/// It takes no more memory than a few numbers for each element, however many changes are
/// added.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ChangedElements {
    vertices: Elements,
    corners: Elements,
}

#[derive(Debug, Clone, Default, PartialEq, Eq)]
struct Elements {
    /// Some more than once.
    list: Vec<u32>,
    /// How many there were when each was last there once.
    distinct: usize,
}

impl ChangedElements {
    /// Adds those of a change.
    pub fn add(&mut self, change: &MeshChange) {
        self.vertices.extend(change.positions.iter().map(|&(vertex, _)| vertex));
        self.corners.extend(change.corners());
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.vertices.list.is_empty() && self.corners.list.is_empty()
    }

    /// A change that gives each of them the values that it has in a mesh.
    ///
    /// # Panics
    ///
    /// When the mesh has fewer elements than the one that was changed.
    pub fn values_in(&self, mesh: &Mesh) -> MeshChange {
        let (attributes, corners) = (mesh.attributes(), self.corners());
        MeshChange {
            positions: values(&self.vertices(), mesh.positions()),
            corner_normals: values(&corners, attributes.corner_normals.as_deref().unwrap_or_default()),
            uv_sets: attributes.uv_sets.iter().map(|set| values(&corners, set)).collect(),
            corner_colors: values(&corners, attributes.corner_colors.as_deref().unwrap_or_default()),
        }
    }

    /// The vertices, increasing.
    #[must_use]
    pub fn vertices(&self) -> Vec<u32> {
        self.vertices.sorted()
    }

    /// The corners, increasing.
    pub(super) fn corners(&self) -> Vec<u32> {
        self.corners.sorted()
    }
}

/// None of an attribute that the mesh does not have.
fn values<T: Copy>(elements: &[u32], list: &[T]) -> Vec<(u32, T)> {
    if list.is_empty() {
        return Vec::new();
    }
    elements.iter().map(|&element| (element, list[element as usize])).collect()
}

impl Elements {
    fn extend(&mut self, elements: impl Iterator<Item = u32>) {
        /// Below this number nothing is gained by looking for what is there twice.
        const FEW: usize = 4096;
        self.list.extend(elements);
        if self.list.len() > 2 * self.distinct + FEW {
            self.list = self.sorted();
            self.distinct = self.list.len();
        }
    }

    fn sorted(&self) -> Vec<u32> {
        let mut sorted = self.list.clone();
        if !sorted.is_sorted() {
            // Each change brings sorted elements as a rule, and a stable sort merges such runs: a
            // quarter of the instructions for three changes of the same 10,000 elements.
            sorted.sort();
        }
        sorted.dedup();
        sorted
    }
}

#[cfg(test)]
mod tests {
    use trigon_math::Vec3;

    use super::*;
    use crate::primitives;

    fn moves(vertices: impl IntoIterator<Item = u32>) -> MeshChange {
        let positions = vertices.into_iter().map(|vertex| (vertex, Vec3::ZERO)).collect();
        MeshChange { positions, ..MeshChange::default() }
    }

    #[test]
    fn the_same_elements_again_and_again_take_no_more_memory() {
        let mut changed = ChangedElements::default();
        for _ in 0..100 {
            changed.add(&moves((0..1000).rev()));
        }
        assert!(changed.vertices.list.len() < 10_000, "{} numbers", changed.vertices.list.len());
        assert_eq!(changed.vertices(), (0..1000).collect::<Vec<_>>(), "each is known once, in order");
    }

    #[test]
    fn values_are_those_of_the_mesh() {
        let cube = primitives::cube(1.0);
        let mut changed = ChangedElements::default();
        assert!(changed.is_empty(), "nothing yet");
        changed.add(&moves([7, 2, 7]));
        changed.add(&MeshChange { corner_normals: vec![(3, Vec3::X)], ..MeshChange::default() });
        let values = changed.values_in(&cube);
        let at = |vertex: u32| (vertex, cube.positions()[vertex as usize]);
        assert_eq!(values.positions, [at(2), at(7)], "not those of the changes");
        assert_eq!(
            values.corner_normals.len(),
            cube.attributes().corner_normals.iter().len(),
            "if it has any"
        );
        assert_eq!(values.uv_sets.len(), cube.attributes().uv_sets.len(), "all that a corner has");
    }
}
