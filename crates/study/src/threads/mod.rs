//! How many threads does an image need? The measurement of source D (row D12, its table 4.1) by its method
//! and by the engine's: a square of two faces.

use std::num::NonZeroUsize;
use std::thread;

use trigon_classic::Field;
use trigon_math::DVec2;
use trigon_raster::{Output, Target};

use super::engine::{Corners, Engine, clip_position, field, target};

/// Numbers of threads in the source's table; 0 is to draw without any.
pub const THREADS: [usize; 9] = [0, 1, 2, 4, 8, 16, 32, 64, 128];

/// The source's frame times for [`THREADS`] in microseconds, on four cores with eight
/// logical ones, without optimization by the compiler.
pub const TIMES_OF_THE_SOURCE: [f64; 9] =
    [254_569.0, 293_457.0, 207_791.0, 128_807.0, 84_151.0, 66_569.0, 61_264.0, 65_488.0, 75_354.0];

/// A corner on the image: right, down and away from the eye.
pub type ScreenCorner = [f64; 3];

/// The two faces of a square that fills most of an image, a little tilted.
#[must_use]
pub fn square([width, height]: [usize; 2]) -> [[ScreenCorner; 3]; 2] {
    let corner = |x: f64, y: f64| [x * width as f64 + 0.25, y * height as f64 + 0.25, 2.0 + x + y];
    let [a, b, c, d] = [corner(0.05, 0.1), corner(0.9, 0.05), corner(0.95, 0.9), corner(0.1, 0.95)];
    [[a, b, c], [a, c, d]]
}

/// Draws faces as the source does: new threads for each face, which share the rows of
/// its bounding box. Returns the number of the face in each pixel, `u32::MAX` for none.
#[must_use]
pub fn draw_by_face(faces: &[[ScreenCorner; 3]], size: [usize; 2], threads: usize) -> Field<u32> {
    draw(faces, size, threads)
}

/// An image that is drawn by several threads again and again.
pub struct Shared {
    engine: Engine,
    target: Target<'static>,
    shape: Corners,
}

impl Shared {
    /// Faces, with a number of threads; 0 counts as 1.
    #[must_use]
    pub fn new(faces: &[[ScreenCorner; 3]], size: [usize; 2], threads: usize) -> Self {
        let position = |&[x, y, distance]: &ScreenCorner| {
            // The source's pixels have their centres at whole numbers.
            clip_position(DVec2::new(x, y) + 0.5, 0.5, size) * distance as f32
        };
        let shape = Corners::new(faces.as_flattened().iter().map(position).collect());
        let threads = NonZeroUsize::new(threads).unwrap_or(NonZeroUsize::MIN);
        let outputs = [Output::Srgb8, Output::Depth, Output::Triangle, Output::Object];
        Self { engine: Engine::with_threads(threads), target: target(size, &outputs), shape }
    }

    /// Draws the image.
    pub fn draw(&mut self) {
        self.engine.draw(&self.shape, &mut self.target);
    }

    /// The number of the face in each pixel, `u32::MAX` for none.
    #[must_use]
    pub fn faces(&self) -> Field<u32> {
        let size = [self.target.width(), self.target.height()].map(|side| side as usize);
        field(size, self.target.triangles())
    }
}

/// What the source keeps of a pixel.
#[derive(Clone, Copy)]
struct SourcePixel {
    color: [u8; 4],
    depth: f64,
    face: u32,
    model: u32,
}

/// The source's method: a bounding box, barycentric coordinates from areas, perspective depth (formulas 2.8
/// to 2.12), buffers for colour, depth, face and model. For each face it starts as many new threads as
/// requested, each with some rows of the box.
fn draw(faces: &[[ScreenCorner; 3]], size: [usize; 2], threads: usize) -> Field<u32> {
    let empty = SourcePixel { color: [0; 4], depth: f64::INFINITY, face: u32::MAX, model: u32::MAX };
    let mut buffers = Field::new(size, empty);
    for (number, face) in (0..).zip(faces) {
        let [[left, right], [top, bottom]] = bounding_box(face, size);
        let mut rows: Vec<(usize, &mut [SourcePixel])> =
            buffers.rows_mut().enumerate().skip(top).take((bottom + 1).saturating_sub(top)).collect();
        let fill = |rows: &mut [(usize, &mut [SourcePixel])]| {
            for (y, row) in rows {
                fill_row(face, number, [left, right], *y, row);
            }
        };
        if threads == 0 {
            fill(&mut rows);
        } else {
            let share = rows.len().div_ceil(threads).max(1);
            thread::scope(|scope| {
                let bands = rows.chunks_mut(share);
                bands.for_each(|band| {
                    scope.spawn(|| fill(band));
                });
            });
        }
    }
    let is_painted = |pixel: &SourcePixel| pixel.color[3] > 0 && pixel.model != u32::MAX;
    buffers.map(|pixel| if is_painted(pixel) { pixel.face } else { u32::MAX })
}

/// The first and last column and row of the image that a face can reach.
fn bounding_box(face: &[ScreenCorner; 3], size: [usize; 2]) -> [[usize; 2]; 2] {
    [0, 1].map(|axis| {
        let [low, high] = crate::fill::range(face.map(|corner| corner[axis]));
        [low.max(0.0) as usize, (high.max(0.0) as usize).min(size[axis] - 1)]
    })
}

fn fill_row(
    face: &[ScreenCorner; 3],
    number: u32,
    [left, right]: [usize; 2],
    y: usize,
    row: &mut [SourcePixel],
) {
    const TOLERANCE: f64 = 1e-9;
    let [a, b, c] = *face;
    let area = doubled_area(a, b, c);
    for (x, pixel) in row.iter_mut().enumerate().take(right + 1).skip(left) {
        let point = [x as f64, y as f64, 0.0];
        let alpha = doubled_area(point, b, c) / area;
        let beta = doubled_area(a, point, c) / area;
        let gamma = 1.0 - alpha - beta;
        if alpha >= -TOLERANCE && beta >= -TOLERANCE && gamma >= -TOLERANCE {
            let depth = 1.0 / (alpha / a[2] + beta / b[2] + gamma / c[2]);
            if depth < pixel.depth {
                *pixel = SourcePixel { color: [200, 200, 200, 255], depth, face: number, model: 0 };
            }
        }
    }
}

fn doubled_area(a: ScreenCorner, b: ScreenCorner, c: ScreenCorner) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

#[cfg(test)]
mod tests;
