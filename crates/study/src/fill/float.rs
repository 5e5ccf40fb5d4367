//! Edge functions in `f32` with the top-left rule, at the middle of the pixel, as many
//! software renderers have them (J. Pineda, "A parallel algorithm for polygon
//! rasterization", SIGGRAPH 1988).
//!
//! Corners stay where they are, so this is nearer to the input than a grid. But two
//! neighbours come to the value of their shared edge in different ways, and where it
//! rounds to different signs a pixel is painted twice or not at all.

use super::edges::{bounding_box, clockwise, edge};
use super::{Canvas, Triangle};
use trigon_math::Vec2;

pub(super) fn fill(triangle: &Triangle, canvas: &mut Canvas) {
    let [a, b, c] = clockwise(*triangle);
    let [columns, rows] = bounding_box(triangle, canvas);
    for y in rows[0]..=rows[1] {
        for x in columns[0]..=columns[1] {
            let point = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
            if inside(a, b, point) && inside(b, c, point) && inside(c, a, point) {
                canvas.paint(x, y);
            }
        }
    }
}

fn inside(from: Vec2, to: Vec2, point: Vec2) -> bool {
    let value = edge(from, to, point);
    let along = to - from;
    value > 0.0 || (value == 0.0 && (along.y < 0.0 || (along.y == 0.0 && along.x > 0.0)))
}
