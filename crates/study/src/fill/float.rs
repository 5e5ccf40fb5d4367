//! Edge functions in `f32` with the top-left rule, evaluated at pixel centres, as in many software renderers
//! (J. Pineda, "A parallel algorithm for polygon rasterization", SIGGRAPH 1988).
//!
//! Corners are not snapped, so they are closer to the input than on a grid. If each triangle evaluates a
//! shared edge from its own corners, the two rounded values can have signs that do not match, and a pixel is
//! painted twice or not at all. In the form `a x + b y + c`, where the two triangles compute `c` from the
//! same products with opposite signs, the values match exactly; but `c` is large, and its rounding moves the
//! edge.

use super::edges::{clockwise, edge};
use super::{FillCanvas, Triangle, range};
use std::ops::RangeInclusive;
use trigon_math::Vec2;

/// Each edge from its two corners in each pixel.
pub(super) fn fill_from_corners(triangle: &Triangle, canvas: &mut FillCanvas) {
    let [a, b, c] = clockwise(*triangle);
    let [columns, rows] = bounding_box(triangle, canvas.limits());
    for y in rows {
        for x in columns.clone() {
            let point = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
            if inside(a, b, point) && inside(b, c, point) && inside(c, a, point) {
                canvas.paint(x, y);
            }
        }
    }
}

fn inside(from: Vec2, to: Vec2, point: Vec2) -> bool {
    let value = edge(from, to, point);
    value > 0.0 || (value == 0.0 && has_border(from, to))
}

/// Whether what lies on an edge belongs to the triangle: clockwise with y down, a left edge
/// rises, and a top edge runs to the right.
fn has_border(from: Vec2, to: Vec2) -> bool {
    let along = to - from;
    along.y < 0.0 || (along.y == 0.0 && along.x > 0.0)
}

/// Each edge as a function of the pixel, made once for a triangle.
pub(super) fn fill_hoisted(triangle: &Triangle, canvas: &mut FillCanvas) {
    let edges = Edges::new(*triangle);
    let [columns, rows] = bounding_box(triangle, canvas.limits());
    for y in rows {
        for x in columns.clone() {
            if edges.covers([x, y]) {
                canvas.paint(x, y);
            }
        }
    }
}

/// The three edges of a triangle as functions of the pixel.
pub(super) struct Edges {
    /// The value at the first pixel's centre, and its steps from column to column and from
    /// row to row.
    pub(super) values: [[f32; 3]; 3],
    /// The smallest value that is inside: 0, or for an edge that does not own its samples the smallest number
    /// above.
    pub(super) least: [f32; 3],
}

impl Edges {
    pub(super) fn new(triangle: Triangle) -> Self {
        let [a, b, c] = clockwise(triangle);
        let sides = [[a, b], [b, c], [c, a]];
        let values = sides.map(|[from, to]| {
            let along = to - from;
            let [across, down] = [-along.y, along.x];
            [from.perp_dot(to) + 0.5 * across + 0.5 * down, across, down]
        });
        let least = sides.map(|[from, to]| if has_border(from, to) { 0.0 } else { f32::MIN_POSITIVE });
        Self { values, least }
    }

    fn covers(&self, [x, y]: [i32; 2]) -> bool {
        (0..3).all(|i| {
            let [start, across, down] = self.values[i];
            start + across * x as f32 + down * y as f32 >= self.least[i]
        })
    }
}

/// The columns and rows that a triangle can reach in an image: those of the pixels that hold
/// its corners, and between.
pub(super) fn bounding_box(triangle: &Triangle, [width, height]: [i32; 2]) -> [RangeInclusive<i32>; 2] {
    let within = |values: [f32; 3], side: i32| {
        let [low, high] = range(values).map(|value| value.floor() as i32);
        low.clamp(0, side)..=high.clamp(-1, side - 1)
    };
    [within(triangle.map(|corner| corner.x), width), within(triangle.map(|corner| corner.y), height)]
}
