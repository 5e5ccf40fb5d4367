//! Edge functions that include samples exactly on an edge (source rows C1 to C3): y down, clockwise, and
//! evaluated at the pixel's upper left corner, as in the source. So the image is off by half a pixel, and
//! pixels on a shared edge are painted twice.

use super::{FillCanvas, Triangle, range};
use trigon_math::Vec2;

/// At every pixel of the screen.
pub(super) fn fill_on_screen(triangle: &Triangle, canvas: &mut FillCanvas) {
    let [width, height] = canvas.limits();
    test([[0, width - 1], [0, height - 1]], Vec2::ZERO, triangle, canvas);
}

/// At every pixel of the bounding box.
pub(super) fn fill_in_box(triangle: &Triangle, canvas: &mut FillCanvas) {
    test(bounding_box(triangle, canvas), Vec2::ZERO, triangle, canvas);
}

/// The same at the middle of each pixel.
pub(super) fn fill_at_centers(triangle: &Triangle, canvas: &mut FillCanvas) {
    test(bounding_box(triangle, canvas), Vec2::splat(0.5), triangle, canvas);
}

/// The first and the last column and row that a triangle can reach in the image.
pub(super) fn bounding_box(triangle: &Triangle, canvas: &FillCanvas) -> [[i32; 2]; 2] {
    let [width, height] = canvas.limits();
    let within = |values: [f32; 3], side: i32| {
        let [low, high] = range(values);
        [(low.floor() as i32).max(0), (high.ceil() as i32).min(side - 1)]
    };
    [within(triangle.map(|corner| corner.x), width), within(triangle.map(|corner| corner.y), height)]
}

fn test([columns, rows]: [[i32; 2]; 2], sample: Vec2, triangle: &Triangle, canvas: &mut FillCanvas) {
    let [a, b, c] = clockwise(*triangle);
    for y in rows[0]..=rows[1] {
        for x in columns[0]..=columns[1] {
            let point = Vec2::new(x as f32, y as f32) + sample;
            if edge(a, b, point) >= 0.0 && edge(b, c, point) >= 0.0 && edge(c, a, point) >= 0.0 {
                canvas.paint(x, y);
            }
        }
    }
}

/// Twice the signed area of an edge and a point: positive to the right of the edge.
pub(super) fn edge(from: Vec2, to: Vec2, point: Vec2) -> f32 {
    (to - from).perp_dot(point - from)
}

/// Clockwise as seen on the screen; the source asks its user for that.
pub(super) fn clockwise([a, b, c]: Triangle) -> Triangle {
    if edge(a, b, c) < 0.0 { [a, c, b] } else { [a, b, c] }
}
