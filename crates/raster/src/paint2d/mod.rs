//! Painting in two dimensions, for user interfaces: coloured and textured triangles
//! with a scissor, one over the other in the given order.
//!
//! A [`Painter`] paints [`Mesh`]es on a [`Canvas`], which borrows the caller's
//! pixels. It knows no depth, no perspective and no linear light: colours are
//! multiplied and blended as they are stored, in gamma space, premultiplied by
//! alpha, as user interfaces such as egui define it.
//!
//! ```
//! use trigon_raster::paint2d::*;
//!
//! let vertex = |x, y| Vertex { position: [x, y], uv: [0.0; 2], color: [0, 0, 100, 128] };
//! let vertices = [vertex(1.0, 0.0), vertex(6.0, 0.0), vertex(6.0, 3.0), vertex(1.0, 3.0)];
//! // Any winding will do, and no diagonal shows.
//! let indices = [0, 1, 2, 0, 3, 2];
//! let scissor = Rect::new([0, 0], [4, 4]);
//!
//! let mut pixels = [[200, 0, 0, 255]; 8 * 4];
//! let mut canvas = Canvas::new(8, 4, &mut pixels)?;
//! Painter::new().paint(&mut canvas, &[Mesh { scissor, vertices: &vertices, indices: &indices, image: None }]);
//!
//! let rows = pixels.chunks(8).map(|row| row.iter().map(|pixel| if pixel[2] > 0 { '#' } else { '.' }).collect());
//! assert_eq!(rows.collect::<Vec<String>>(), [
//!     ".###....",
//!     ".###....",
//!     ".###....",
//!     "........",
//! ]);
//! assert_eq!(pixels[1], [100, 0, 100, 255], "half the red, and the blue");
//! # Ok::<(), SizeError>(())
//! ```
//!
//! # Guarantees
//! - Positions are rounded to 1/256 pixel, to the nearest, ties to even. Which
//!   pixels a triangle covers is then decided in integers, without error. A
//!   pixel centre on an edge belongs to the triangle to the right of the edge, or
//!   below it if the edge is horizontal. Neighbours therefore paint each pixel
//!   once, and translucent surfaces show no seam.
//! - A pixel becomes vertex colour × texel + pixel · (1 − alpha), at most 255,
//!   rounded to the nearest for each triangle. Before rounding, it differs from
//!   the exact value by less than 1/1000 level, and by less than 1/8 level more
//!   where an image is filtered linearly. After rounding it is therefore at most
//!   one level off the exact result over the same pixel.
//! - Colours and image coordinates are linear across a triangle, and exactly
//!   constant if those of its corners are equal.
//! - Pixels outside the scissor are not touched, and the scissor does not change
//!   pixels inside. The order of a triangle's vertices and the SIMD level do not
//!   change a byte.
//! - Any vertex and any index is safe: what cannot be painted is left out and
//!   counted, see [`Painted`].
//!
//! # What is fast
//! If two consecutive triangles are the halves of an upright rectangle, they are
//! painted at once, provided that they have one colour, or one colour and one
//! texel per pixel, as glyphs have. Runs of one colour are painted in integers, and
//! opaque ones are simply filled. A triangle costs a few divisions, its rows none.
//! These paths give the same bytes as the general one.

mod blend;
mod canvas;
mod image;
mod painter;
mod source;
mod triangle;

pub use canvas::{Canvas, MAX_SIZE, Rect, SizeError};
pub use image::Image;
pub use painter::{Painted, Painter};
pub use source::{Mesh, Vertex};
