//! The equation y = a x + b, evaluated for each column (the first form of source row B1): steep lines have
//! gaps, and vertical ones are not drawn.

use super::segment::{Segment, paint};
use trigon_classic::Field;

pub(super) fn draw([from, to]: Segment, coverage: &mut Field<f32>) {
    let ([x0, y0], [x1, y1]) = if from[0] < to[0] { (from, to) } else { (to, from) };
    if x0 == x1 {
        return;
    }
    let slope = (y1 - y0) as f32 / (x1 - x0) as f32;
    let offset = y0 as f32 - slope * x0 as f32;
    for x in x0..=x1 {
        let y = slope * x as f32 + offset;
        paint(coverage, [x, (y + 0.5).floor() as i32], 1.0);
    }
}
