//! What a picture holds of its surfaces beside their colours: all of it follows from
//! which triangle each pixel sees, and is found after the pass in one visit of the
//! pixels, in rows.
//!
//! Rays through the pixels are met with the triangles in f64, with no step from
//! pixel to pixel: every pixel is a function of its own triangle and place. So the
//! bytes do not depend on threads, and positions are as exact as their f32.

mod facet;
mod fill;
mod seen;
mod source;
#[cfg(test)]
mod tests;

pub(crate) use fill::fill;
pub(crate) use seen::{Needed, Seen};
