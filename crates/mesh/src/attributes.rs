//! Attributes: the data of a mesh besides its shape.
//!
//! Values that may be discontinuous across an edge (normals, texture coordinates, colours) are
//! stored on corners, so that the shape itself never has to be cut along a seam. Everything is
//! optional: what a mesh does not have costs nothing.

mod deltas;
mod skin_weights;

use trigon_math::{Vec2, Vec3, Vec4};

use crate::MeshError;

pub(crate) use deltas::classes;
pub use deltas::{Deltas, MorphTarget};
pub use skin_weights::SkinWeights;

/// Optional values on the corners, faces and vertices of a [`Mesh`](crate::Mesh).
///
/// Corners are numbered through all faces, see
/// [`Mesh::face_corners`](crate::Mesh::face_corners).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Attributes {
    /// Shading normals per corner. Normals need not be of unit length; one that is zero or not finite counts
    /// as "not given here".
    pub corner_normals: Option<Vec<Vec3>>,
    /// Tangents per corner, for normal maps: a unit vector along increasing u, and in `w` the
    /// handedness, 1 or −1, so that the bitangent `normal × tangent · w` points up in the image,
    /// against v. Zero counts as "not given here". See
    /// [`Mesh::generate_tangents`](crate::Mesh::generate_tangents).
    pub corner_tangents: Option<Vec<Vec4>>,
    /// Texture coordinates per corner, in any number of sets. (0, 0) is the upper left corner of
    /// the image and v points down, as in glTF.
    pub uv_sets: Vec<Vec<Vec2>>,
    /// Colours per corner: linear light, straight (not premultiplied) alpha.
    pub corner_colors: Option<Vec<Vec4>>,
    /// Colours per vertex, as loose edges and points show them: linear light, straight alpha. Faces
    /// show those of their corners.
    pub vertex_colors: Option<Vec<Vec4>>,
    /// The material slot of each face. The scene defines what a slot means.
    pub face_materials: Option<Vec<u32>>,
    /// Which faces are shaded smoothly if no corner normal is given. Absent: all are flat.
    pub face_smooth: Option<Vec<bool>>,
    /// The joints that each vertex follows.
    pub skin: Option<SkinWeights>,
    /// Morph targets.
    pub morph_targets: Vec<MorphTarget>,
}

impl Attributes {
    /// Whether anything has colours: corners or vertices.
    #[must_use]
    pub fn has_colors(&self) -> bool {
        self.corner_colors.is_some() || self.vertex_colors.is_some()
    }

    /// Checks that every list has one value per corner, face or vertex.
    pub(crate) fn check(&self, vertices: usize, corners: usize, faces: usize) -> Result<(), MeshError> {
        let check = |attribute, element, expected, found: Option<usize>| match found {
            Some(found) if found != expected => {
                Err(MeshError::AttributeLength { attribute, element, expected, found })
            }
            _ => Ok(()),
        };
        let normals = self.corner_normals.as_ref().map(Vec::len);
        check("corner_normals", "corners", corners, normals)?;
        let tangents = self.corner_tangents.as_ref().map(Vec::len);
        check("corner_tangents", "corners", corners, tangents)?;
        for set in &self.uv_sets {
            check("uv_sets", "corners", corners, Some(set.len()))?;
        }
        let colors = self.corner_colors.as_ref().map(Vec::len);
        check("corner_colors", "corners", corners, colors)?;
        let colors = self.vertex_colors.as_ref().map(Vec::len);
        check("vertex_colors", "vertices", vertices, colors)?;
        let materials = self.face_materials.as_ref().map(Vec::len);
        check("face_materials", "faces", faces, materials)?;
        let smooth = self.face_smooth.as_ref().map(Vec::len);
        check("face_smooth", "faces", faces, smooth)?;
        check("skin", "vertices", vertices, self.skin.as_ref().map(SkinWeights::vertex_count))?;
        for target in &self.morph_targets {
            // Deltas name only the elements that they move, so they may be shorter.
            let beyond = |bound: usize, count: usize| Some(if bound > count { bound } else { count });
            check("morph_targets", "vertices", vertices, beyond(target.positions.bound(), vertices))?;
            for deltas in [&target.normals, &target.tangents] {
                check("morph_targets", "corners", corners, beyond(deltas.bound(), corners))?;
            }
        }
        Ok(())
    }

    /// Reorders every corner value: the new corner `i` gets the value of the old corner `order[i]`.
    pub(crate) fn reorder_corners(&mut self, order: &[u32]) {
        fn reordered<T: Copy>(values: &[T], order: &[u32]) -> Vec<T> {
            order.iter().map(|&from| values[from as usize]).collect()
        }
        if let Some(normals) = &mut self.corner_normals {
            *normals = reordered(normals, order);
        }
        if let Some(tangents) = &mut self.corner_tangents {
            *tangents = reordered(tangents, order);
        }
        for set in &mut self.uv_sets {
            *set = reordered(set, order);
        }
        for target in &mut self.morph_targets {
            for deltas in [&mut target.normals, &mut target.tangents] {
                *deltas = deltas.reordered(order.len(), order.iter().copied());
            }
        }
        if let Some(colors) = &mut self.corner_colors {
            *colors = reordered(colors, order);
        }
    }
}
