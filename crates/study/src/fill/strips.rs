//! Vertical strips (source row A9). The corners are listed counter-clockwise from the leftmost one, or from
//! the lower of two leftmost ones. Each column of pixels crosses two sides, and the pixels between them are
//! painted, including those that contain the crossings.
//!
//! In the source y points up; its order of the corners is used here unchanged, although y points down.

use super::{FillCanvas, Triangle, range};
use trigon_math::Vec2;

pub(super) fn fill(triangle: &Triangle, canvas: &mut FillCanvas) {
    let [a, b, c] = sorted(*triangle);
    let [left, right] = range([a.x, b.x, c.x]);
    let [width, height] = canvas.limits();
    let first = ((left - 0.5).ceil() as i32).max(0);
    let last = ((right - 0.5).floor() as i32).min(width - 1);
    for x in first..=last {
        let center = x as f32 + 0.5;
        let low = if center < b.x { height_at(a, b, center) } else { height_at(c, b, center) };
        let high = if center < c.x { height_at(a, c, center) } else { height_at(b, c, center) };
        for y in (low.floor() as i32).max(0)..=(high.floor() as i32).min(height - 1) {
            canvas.paint(x, y);
        }
    }
}

/// From the leftmost and lowest corner on, with a cross product that is not negative.
fn sorted([a, b, c]: Triangle) -> Triangle {
    let before = |p: Vec2, q: Vec2| (p.x, p.y) < (q.x, q.y);
    let [first, second, third] = if before(b, a) && before(b, c) {
        [b, c, a]
    } else if before(c, a) && before(c, b) {
        [c, a, b]
    } else {
        [a, b, c]
    };
    let turn = (second - first).perp_dot(third - first);
    if turn < 0.0 { [first, third, second] } else { [first, second, third] }
}

/// The height of a side in a column; of a vertical side, that of its beginning.
fn height_at(from: Vec2, to: Vec2, x: f32) -> f32 {
    if to.x == from.x { from.y } else { from.y + (x - from.x) * (to.y - from.y) / (to.x - from.x) }
}
