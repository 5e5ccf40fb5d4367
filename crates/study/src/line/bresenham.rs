//! J. E. Bresenham, "Algorithm for computer control of a digital plotter", IBM Systems Journal 4(1), 1965,
//! for all eight directions: integers only, so no error accumulates.

use super::segment::{Segment, paint};
use trigon_classic::Field;

pub(super) fn draw([from, to]: Segment, coverage: &mut Field<f32>) {
    let distance = [0, 1].map(|axis| (to[axis] - from[axis]).abs());
    let step = [0, 1].map(|axis| (to[axis] - from[axis]).signum());
    let mut pixel = from;
    let mut error = distance[0] - distance[1];
    paint(coverage, pixel, 1.0);
    while pixel != to {
        let doubled = 2 * error;
        if doubled > -distance[1] {
            error -= distance[1];
            pixel[0] += step[0];
        }
        if doubled < distance[0] {
            error += distance[0];
            pixel[1] += step[1];
        }
        paint(coverage, pixel, 1.0);
    }
}
