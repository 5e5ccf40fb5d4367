//! Outputs of visible surfaces other than colour. All of them are derived from the triangle visible
//! in each pixel, and computed after the pass in one visit of the pixels, row by row.
//!
//! Rays through the pixels are intersected with the triangles in f64, with no stepping from pixel
//! to pixel: every pixel depends only on its own triangle and position. So the bytes do not depend
//! on threads, and positions are as exact as f32 allows.
//!
//! [`VisibleIds`] holds the triangle visible in each pixel, as the rasterizer stores it.

mod facet;
mod fill;
mod source;

use trigon_raster::{Target, TargetError};

use crate::frame::{Frame, resize};
use crate::settings::Outputs;

pub(crate) use facet::{Beam, Facet};
pub(crate) use fill::fill;

/// Ids of each pixel; unused lists are empty.
#[derive(Debug, Default)]
pub(crate) struct VisibleIds {
    /// Indices of nodes.
    pub(crate) objects: Vec<u32>,
    /// Indices of polygons.
    pub(crate) faces: Vec<u32>,
    /// Indices of triangles in their draws.
    pub(crate) triangles: Vec<u32>,
}

/// Which of the lists are needed.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Needed {
    objects: bool,
    faces: bool,
    triangles: bool,
}

impl Needed {
    /// All of them.
    pub(crate) const ALL: Self = Self { objects: true, faces: true, triangles: true };

    /// Those needed for derived outputs.
    pub(crate) fn of(outputs: &Outputs) -> Self {
        let triangles = outputs.of_triangles();
        let ids = outputs.ids || triangles;
        Self { objects: ids, faces: ids, triangles }
    }

    /// The same with the nodes, if an outline needs them.
    pub(crate) fn with_objects(self, wanted: bool) -> Self {
        Self { objects: self.objects || wanted, ..self }
    }
}

impl VisibleIds {
    /// Allocates the lists for an image; `None` if memory is exhausted.
    pub(crate) fn allocate(&mut self, pixels: usize, needed: Needed) -> Option<()> {
        let length = |needed: bool| if needed { pixels } else { 0 };
        resize(&mut self.objects, length(needed.objects), u32::MAX)?;
        resize(&mut self.faces, length(needed.faces), u32::MAX)?;
        resize(&mut self.triangles, length(needed.triangles), u32::MAX)
    }

    /// A target that writes the ids here, and depths into a list if there is one.
    pub(crate) fn with<'a>(
        &'a mut self,
        mut target: Target<'a>,
        depth: Option<&'a mut Vec<f32>>,
    ) -> Result<Target<'a>, TargetError> {
        if let Some(depth) = depth {
            target = target.with_depth(depth)?;
        }
        if !self.objects.is_empty() {
            target = target.with_objects(&mut self.objects)?;
        }
        if !self.faces.is_empty() {
            target = target.with_faces(&mut self.faces)?;
        }
        if !self.triangles.is_empty() {
            target = target.with_triangles(&mut self.triangles)?;
        }
        Ok(target)
    }

    /// Moves the requested ones to the frame, in exchange for its memory.
    pub(crate) fn hand_over(&mut self, frame: &mut Frame) {
        if let Some(objects) = &mut frame.object_ids {
            std::mem::swap(objects, &mut self.objects);
        }
        if let Some(faces) = &mut frame.face_ids {
            std::mem::swap(faces, &mut self.faces);
        }
    }
}

#[cfg(test)]
mod tests;
