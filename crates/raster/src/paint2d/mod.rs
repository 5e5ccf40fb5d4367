//! Painting in two dimensions: coloured and textured triangles with a scissor,
//! one over the other in the order given. Good enough for a user interface.
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
//! # What holds
//! - Positions are rounded to 1/256 pixel, to the nearest, ties to even. Which
//!   pixels a triangle covers is then decided in integers, without error; a
//!   centre on an edge belongs to the triangle to the right of it, or below it
//!   where it is horizontal. So neighbours paint each pixel once, and no seam
//!   shows in what is translucent.
//! - A pixel becomes vertex colour × texel + pixel · (1 − alpha), at most 255,
//!   rounded to the nearest for each triangle. Before rounding, it is off the
//!   exact value by less than 1/1000 level, and by less than 1/8 level more
//!   where an image is filtered linearly: so it is never more than one level
//!   off what exact arithmetic paints over the same pixel.
//! - Colours and places in images are linear across a triangle, and exactly
//!   constant where its corners' are equal.
//! - Nothing that is out of the scissor is touched, nor does the scissor change
//!   what is inside. The order of a triangle's vertices and the level of
//!   instructions do not change a byte.
//! - Any vertex, any index is safe: what cannot be painted is left out and
//!   counted, see [`Painted`].
//!
//! # What is fast
//! Two triangles in a row that are the halves of an upright rectangle are painted
//! at once, if they have one colour, or one colour and texels one to one, as
//! glyphs have. Runs of one colour are painted in integers, opaque ones just
//! filled. A triangle costs a few divisions, its rows none. All of
//! this gives the bytes of the general way.

mod blend;
mod blit;
mod canvas;
mod corner;
mod coverage;
mod eight;
mod flat;
mod gradient;
mod image;
mod mesh;
mod painter;
mod rect;
mod rectangle;
mod source;
mod texel;

pub use canvas::{Canvas, MAX_SIZE, SizeError};
pub use image::Image;
pub use mesh::{Mesh, Vertex};
pub use painter::{Painted, Painter};
pub use rect::Rect;
