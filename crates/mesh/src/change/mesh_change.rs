//! New values for some elements of a mesh.

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
