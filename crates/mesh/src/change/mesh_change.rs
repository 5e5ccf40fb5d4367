//! New values for some elements of a mesh, which are in the mesh itself once they are written, and the sets
//! of elements that changed.

use thiserror::Error;
use trigon_math::{Vec2, Vec3, Vec4};

use crate::Mesh;

/// Other values for some elements of a [`Mesh`], which keeps its vertices, edges and
/// faces. What is not listed stays. Of several values for one element the last counts.
///
/// Positions are in metres, and any value is kept, also one that is not finite, as when a
/// mesh is built. Normals that were given for corners do not follow positions; those that
/// were not given do.
///
/// ```
/// use trigon_mesh::math::Vec3;
/// use trigon_mesh::{MeshChange, primitives};
///
/// let mut cube = primitives::cube(2.0);
/// let change = MeshChange { positions: vec![(0, Vec3::splat(-3.0))], ..MeshChange::default() };
/// cube.change(&change)?;
/// assert_eq!(cube.positions()[0], Vec3::splat(-3.0));
///
/// let beyond = MeshChange { positions: vec![(8, Vec3::ZERO)], ..MeshChange::default() };
/// assert!(cube.change(&beyond).is_err(), "a cube has 8 vertices");
/// # Ok::<(), trigon_mesh::ChangeError>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MeshChange {
    /// Vertices and where they go, in metres.
    pub positions: Vec<(u32, Vec3)>,
    /// Corners and their normals; see
    /// [`Attributes::corner_normals`](crate::Attributes::corner_normals).
    pub corner_normals: Vec<(u32, Vec3)>,
    /// For each of the first sets of texture coordinates, corners and their coordinates.
    pub uv_sets: Vec<Vec<(u32, Vec2)>>,
    /// Corners and their colours: linear light, straight alpha.
    pub corner_colors: Vec<(u32, Vec4)>,
}

/// Why a [`MeshChange`] was refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum ChangeError {
    /// A change names an element that the mesh does not have.
    #[error("{attribute} change {element} {index}, but the mesh has {count}, numbered from 0")]
    OutOfRange {
        /// The field of [`MeshChange`].
        attribute: &'static str,
        /// What it counts: "vertex" or "corner".
        element: &'static str,
        /// The number asked for.
        index: u32,
        /// How many the mesh has.
        count: usize,
    },
    /// The mesh has no such attribute.
    #[error("the mesh has no {attribute} to change: give all corners theirs by Mesh::set_attributes first")]
    NoSuchAttribute {
        /// The field of [`Attributes`](crate::Attributes).
        attribute: &'static str,
    },
    /// The mesh has fewer sets of texture coordinates.
    #[error("the change is of uv set {set}, but the mesh has {count}, numbered from 0")]
    NoSuchUvSet {
        /// The number asked for.
        set: usize,
        /// How many the mesh has.
        count: usize,
    },
}

impl MeshChange {
    /// What leads from a mesh to another one with the same vertices, edges, faces and materials; `None` where that is not
    /// possible. In time proportional to the meshes.
    ///
    /// ```
    /// use trigon_mesh::{MeshChange, primitives};
    ///
    /// let (mut small, large) = (primitives::cube(1.0), primitives::cube(2.0));
    /// let change = MeshChange::between(&small, &large).expect("both are cubes");
    /// small.change(&change)?;
    /// assert_eq!(small, large);
    /// assert_eq!(MeshChange::between(&small, &primitives::cone(1.0, 1.0, 6)), None);
    /// # Ok::<(), trigon_mesh::ChangeError>(())
    /// ```
    pub fn between(old: &Mesh, new: &Mesh) -> Option<Self> {
        let (was, is) = (old.attributes(), new.attributes());
        let is_same_kind = old.has_same_elements(new)
            && was.uv_sets.len() == is.uv_sets.len()
            && was.vertex_colors == is.vertex_colors
            && was.face_materials == is.face_materials
            && was.face_smooth == is.face_smooth
            && was.corner_tangents == is.corner_tangents
            && was.skin == is.skin
            && was.morph_targets == is.morph_targets;
        if !is_same_kind {
            return None;
        }
        let sets = was.uv_sets.iter().zip(&is.uv_sets);
        Some(Self {
            positions: differing(old.positions(), new.positions(), |v| v.to_array().map(f32::to_bits)),
            corner_normals: differing_optional(&was.corner_normals, &is.corner_normals, |v| {
                v.to_array().map(f32::to_bits)
            })?,
            uv_sets: sets.map(|(was, is)| differing(was, is, |v| v.to_array().map(f32::to_bits))).collect(),
            corner_colors: differing_optional(&was.corner_colors, &is.corner_colors, |v| {
                v.to_array().map(f32::to_bits)
            })?,
        })
    }

    /// Whether no element is named.
    pub fn is_empty(&self) -> bool {
        let Self { positions, corner_normals, uv_sets, corner_colors } = self;
        positions.is_empty()
            && corner_normals.is_empty()
            && uv_sets.iter().all(Vec::is_empty)
            && corner_colors.is_empty()
    }

    /// The corners that get other values; some more than once.
    pub(super) fn corners(&self) -> impl Iterator<Item = u32> + '_ {
        let uvs = self.uv_sets.iter().flatten().map(|&(corner, _)| corner);
        let normals = self.corner_normals.iter().map(|&(corner, _)| corner);
        normals.chain(uvs).chain(self.corner_colors.iter().map(|&(corner, _)| corner))
    }

    /// Checks that a mesh has all that is named.
    ///
    /// # Errors
    ///
    /// An element or an attribute that the mesh does not have.
    pub fn check(&self, mesh: &Mesh) -> Result<(), ChangeError> {
        let (attributes, corners) = (mesh.attributes(), mesh.corner_count());
        check_range(&self.positions, "positions", "vertex", mesh.vertex_count())?;
        check_range(&self.corner_normals, "corner_normals", "corner", corners)?;
        check_present(&self.corner_normals, "corner_normals", attributes.corner_normals.is_some())?;
        for (set, values) in self.uv_sets.iter().enumerate().filter(|(_, values)| !values.is_empty()) {
            let count = attributes.uv_sets.len();
            if set >= count {
                return Err(ChangeError::NoSuchUvSet { set, count });
            }
            check_range(values, "uv_sets", "corner", corners)?;
        }
        check_range(&self.corner_colors, "corner_colors", "corner", corners)?;
        check_present(&self.corner_colors, "corner_colors", attributes.corner_colors.is_some())
    }
}

impl Mesh {
    /// Gives some elements other values, in time proportional to their number. Edges that
    /// were found are kept: they do not depend on values.
    ///
    /// # Errors
    ///
    /// As [`MeshChange::check`]. The mesh keeps what it had.
    pub fn change(&mut self, change: &MeshChange) -> Result<(), ChangeError> {
        change.check(self)?;
        assign(self.positions_mut(), &change.positions);
        let attributes = self.attributes_mut();
        assign(attributes.corner_normals.as_deref_mut().unwrap_or_default(), &change.corner_normals);
        for (set, values) in attributes.uv_sets.iter_mut().zip(&change.uv_sets) {
            assign(set, values);
        }
        assign(attributes.corner_colors.as_deref_mut().unwrap_or_default(), &change.corner_colors);
        Ok(())
    }
}

/// The new values that have other bits than the old ones, with their indices.
fn differing<T: Copy, B: PartialEq>(old: &[T], new: &[T], bits: impl Fn(T) -> B) -> Vec<(u32, T)> {
    let pairs = (0u32..).zip(old.iter().zip(new));
    pairs
        .filter(|(_, (old, new))| bits(**old) != bits(**new))
        .map(|(index, (_, new))| (index, *new))
        .collect()
}

/// The same of values that a mesh may not have; `None` where one of the two meshes has them alone.
fn differing_optional<T: Copy, B: PartialEq>(
    old: &Option<Vec<T>>,
    new: &Option<Vec<T>>,
    bits: impl Fn(T) -> B,
) -> Option<Vec<(u32, T)>> {
    match (old, new) {
        (Some(old), Some(new)) => Some(differing(old, new, bits)),
        (None, None) => Some(Vec::new()),
        _ => None,
    }
}

fn assign<T: Copy>(list: &mut [T], values: &[(u32, T)]) {
    for &(index, value) in values {
        list[index as usize] = value;
    }
}

fn check_range<T>(
    values: &[(u32, T)],
    attribute: &'static str,
    element: &'static str,
    count: usize,
) -> Result<(), ChangeError> {
    match values.iter().find(|(index, _)| *index as usize >= count) {
        Some(&(index, _)) => Err(ChangeError::OutOfRange { attribute, element, index, count }),
        None => Ok(()),
    }
}

fn check_present<T>(
    values: &[(u32, T)],
    attribute: &'static str,
    is_present: bool,
) -> Result<(), ChangeError> {
    if values.is_empty() || is_present { Ok(()) } else { Err(ChangeError::NoSuchAttribute { attribute }) }
}

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

/// A bit for each element.
pub(super) struct IndexSet(Vec<u64>);

impl IndexSet {
    pub(super) fn new(elements: usize) -> Self {
        Self(vec![0; elements.div_ceil(64)])
    }

    pub(super) fn insert(&mut self, element: u32) {
        self.0[element as usize / 64] |= 1 << (element % 64);
    }

    /// The elements, increasing: whoever follows them through the lists of a mesh finds them
    /// in the order in which they lie in memory.
    pub(super) fn into_sorted(self) -> Vec<u32> {
        let mut sorted = Vec::with_capacity(self.0.iter().map(|word| word.count_ones() as usize).sum());
        for (mut word, first) in self.0.into_iter().zip((0..).step_by(64)) {
            while word != 0 {
                sorted.push(first + word.trailing_zeros());
                word &= word - 1;
            }
        }
        sorted
    }
}

#[cfg(test)]
mod tests {
    use super::{IndexSet, *};
    use crate::primitives;
    use trigon_math::Vec3;

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

    #[test]
    fn elements_are_listed_once_and_in_order() {
        let mut set = IndexSet::new(130);
        [129, 64, 0, 63, 64].into_iter().for_each(|element| set.insert(element));
        assert_eq!(set.into_sorted(), [0, 63, 64, 129]);
        assert_eq!(IndexSet::new(0).into_sorted(), [0_u32; 0], "of nothing");
    }
}
