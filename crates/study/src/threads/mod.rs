//! How many threads does an image need? The measurement of source D (row D12, its table 4.1) by its method
//! and by the engine's: a square of two faces.

mod engine;
mod source;

#[cfg(test)]
mod tests;

pub use engine::Shared;

use trigon_classic::Field;

/// Numbers of threads in the source's table; 0 is to draw without any.
pub const THREADS: [usize; 9] = [0, 1, 2, 4, 8, 16, 32, 64, 128];

/// The source's frame times for [`THREADS`] in microseconds, on four cores with eight
/// logical ones, without optimization by the compiler.
pub const TIMES_OF_THE_SOURCE: [f64; 9] =
    [254_569.0, 293_457.0, 207_791.0, 128_807.0, 84_151.0, 66_569.0, 61_264.0, 65_488.0, 75_354.0];

/// A corner on the image: right, down and away from the eye.
pub type Corner = [f64; 3];

/// The two faces of a square that fills most of an image, a little tilted.
#[must_use]
pub fn square([width, height]: [usize; 2]) -> [[Corner; 3]; 2] {
    let corner = |x: f64, y: f64| [x * width as f64 + 0.25, y * height as f64 + 0.25, 2.0 + x + y];
    let [a, b, c, d] = [corner(0.05, 0.1), corner(0.9, 0.05), corner(0.95, 0.9), corner(0.1, 0.95)];
    [[a, b, c], [a, c, d]]
}

/// Draws faces as the source does: new threads for each face, which share the rows of
/// its bounding box. Returns the number of the face in each pixel, `u32::MAX` for none.
#[must_use]
pub fn draw_by_face(faces: &[[Corner; 3]], size: [usize; 2], threads: usize) -> Field<u32> {
    source::draw(faces, size, threads)
}
