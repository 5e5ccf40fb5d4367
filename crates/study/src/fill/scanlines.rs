//! Horizontal lines between interpolated sides (source row B2). As in the source, corners are rounded to
//! pixels. The long side runs from the topmost to the lowest corner, with the two short ones opposite.

use super::{FillCanvas, Triangle};

pub(super) fn fill(triangle: &Triangle, canvas: &mut FillCanvas) {
    let mut corners = triangle.map(|corner| [corner.x, corner.y].map(|part| part.floor() as i32));
    corners.sort_by_key(|corner| corner[1]);
    let [[x0, y0], [x1, y1], [x2, y2]] = corners;
    let long = interpolate(y0, x0 as f32, y2, x2 as f32);
    let mut short = interpolate(y0, x0 as f32, y1, x1 as f32);
    short.pop();
    short.extend(interpolate(y1, x1 as f32, y2, x2 as f32));
    let middle = short.len() / 2;
    let (left, right) = if long[middle] < short[middle] { (long, short) } else { (short, long) };
    for y in y0.max(0)..(y2 + 1).min(canvas.limits()[1]) {
        let row = (y - y0) as usize;
        line(left[row], right[row], y, canvas);
    }
}

/// Values of a linear function for `from..=to`, each the one before plus the slope; the
/// source builds everything on this function.
pub(crate) fn interpolate(from: i32, first: f32, to: i32, last: f32) -> Vec<f32> {
    if from == to {
        return vec![first];
    }
    let slope = (last - first) / (to - from) as f32;
    let mut value = first;
    let mut values = Vec::with_capacity((to - from) as usize + 1);
    for _ in from..=to {
        values.push(value);
        value += slope;
    }
    values
}

/// Whole steps from the left side to the right side. Pixels outside the image are skipped.
fn line(left: f32, right: f32, y: i32, canvas: &mut FillCanvas) {
    let width = canvas.limits()[0] as f32;
    let mut x = if left < -1.0 { left + (-1.0 - left).floor() } else { left };
    while x <= right && x < width {
        // Halves are rounded in one direction, or every other pixel would be left out.
        canvas.paint((x + 0.5).floor() as i32, y);
        x += 1.0;
    }
}
