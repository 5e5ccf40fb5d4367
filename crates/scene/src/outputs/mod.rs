//! Outputs of visible surfaces other than colour. All of them are derived from the triangle visible
//! in each pixel, and computed after the pass in one visit of the pixels, row by row.
//!
//! Rays through the pixels are intersected with the triangles in f64, with no stepping from pixel
//! to pixel: every pixel depends only on its own triangle and position. So the bytes do not depend
//! on threads, and positions are as exact as f32 allows.

mod facet;
mod fill;
mod source;
#[cfg(test)]
mod tests;
mod visible_ids;

pub(crate) use fill::fill;
pub(crate) use visible_ids::{Needed, VisibleIds};
