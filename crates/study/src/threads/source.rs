//! The source's method: a bounding box, barycentric coordinates from areas, perspective depth (formulas 2.8
//! to 2.12), buffers for colour, depth, face and model. For each face it starts as many new threads as
//! requested, each with some rows of the box.

use super::Corner;
use std::thread;
use trigon_classic::Field;

/// What the source keeps of a pixel.
#[derive(Clone, Copy)]
struct Pixel {
    color: [u8; 4],
    depth: f64,
    face: u32,
    model: u32,
}

pub(super) fn draw(faces: &[[Corner; 3]], size: [usize; 2], threads: usize) -> Field<u32> {
    let empty = Pixel { color: [0; 4], depth: f64::INFINITY, face: u32::MAX, model: u32::MAX };
    let mut buffers = Field::new(size, empty);
    for (number, face) in (0..).zip(faces) {
        let [[left, right], [top, bottom]] = bounding_box(face, size);
        let mut rows: Vec<(usize, &mut [Pixel])> =
            buffers.rows_mut().enumerate().skip(top).take((bottom + 1).saturating_sub(top)).collect();
        let fill = |rows: &mut [(usize, &mut [Pixel])]| {
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
    let is_painted = |pixel: &Pixel| pixel.color[3] > 0 && pixel.model != u32::MAX;
    buffers.map(|pixel| if is_painted(pixel) { pixel.face } else { u32::MAX })
}

/// The first and last column and row of the image that a face can reach.
fn bounding_box(face: &[Corner; 3], size: [usize; 2]) -> [[usize; 2]; 2] {
    [0, 1].map(|axis| {
        let [low, high] = crate::fill::range(face.map(|corner| corner[axis]));
        [low.max(0.0) as usize, (high.max(0.0) as usize).min(size[axis] - 1)]
    })
}

fn fill_row(face: &[Corner; 3], number: u32, [left, right]: [usize; 2], y: usize, row: &mut [Pixel]) {
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
                *pixel = Pixel { color: [200, 200, 200, 255], depth, face: number, model: 0 };
            }
        }
    }
}

fn doubled_area(a: Corner, b: Corner, c: Corner) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}
