//! What a mesh carries besides its shape.
//!
//! Values that may jump at an edge (normals, texture coordinates, colours)
//! live on corners, so that the shape itself never has to be cut open for a
//! seam. Everything is optional: what a mesh does not have costs nothing.

use trigon_math::{Vec2, Vec3, Vec4};

use crate::MeshError;

/// Optional values on the corners and faces of a [`Mesh`](crate::Mesh).
///
/// Corners are numbered through all faces, see
/// [`Mesh::face_corners`](crate::Mesh::face_corners).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Attributes {
    /// Shading normals per corner. They need not be of unit length; one that
    /// is zero or not finite counts as "none given here".
    pub corner_normals: Option<Vec<Vec3>>,
    /// Texture coordinates per corner, in any number of sets. (0, 0) is the
    /// upper left corner of the picture and v points down, as in glTF.
    pub uv_sets: Vec<Vec<Vec2>>,
    /// Colours per corner: linear light, straight (not premultiplied) alpha.
    pub corner_colors: Option<Vec<Vec4>>,
    /// The material slot of each face. What a slot means is for the scene to
    /// say.
    pub face_materials: Option<Vec<u32>>,
    /// Which faces are shaded smoothly where no corner normal is given.
    /// Absent: all are flat.
    pub face_smooth: Option<Vec<bool>>,
}

impl Attributes {
    /// Checks that every list has one value per corner or face.
    pub(crate) fn check(&self, corners: usize, faces: usize) -> Result<(), MeshError> {
        let check = |attribute, element, expected, found: Option<usize>| match found {
            Some(found) if found != expected => {
                Err(MeshError::AttributeLength { attribute, element, expected, found })
            }
            _ => Ok(()),
        };
        let normals = self.corner_normals.as_ref().map(Vec::len);
        check("corner_normals", "corners", corners, normals)?;
        for set in &self.uv_sets {
            check("uv_sets", "corners", corners, Some(set.len()))?;
        }
        let colors = self.corner_colors.as_ref().map(Vec::len);
        check("corner_colors", "corners", corners, colors)?;
        let materials = self.face_materials.as_ref().map(Vec::len);
        check("face_materials", "faces", faces, materials)?;
        let smooth = self.face_smooth.as_ref().map(Vec::len);
        check("face_smooth", "faces", faces, smooth)
    }

    /// Moves every corner value: the new corner `i` has what the old corner
    /// `order[i]` had.
    pub(crate) fn reorder_corners(&mut self, order: &[u32]) {
        fn reordered<T: Copy>(values: &[T], order: &[u32]) -> Vec<T> {
            order.iter().map(|&from| values[from as usize]).collect()
        }
        if let Some(normals) = &mut self.corner_normals {
            *normals = reordered(normals, order);
        }
        for set in &mut self.uv_sets {
            *set = reordered(set, order);
        }
        if let Some(colors) = &mut self.corner_colors {
            *colors = reordered(colors, order);
        }
    }
}
