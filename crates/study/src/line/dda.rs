//! The incremental form (the last one of source row B1): the slope is added at each step along the longer
//! side. There are no gaps, but rounding errors accumulate.

use super::segment::{Segment, paint};
use crate::fill::interpolate;
use trigon_classic::Field;

pub(super) fn draw(segment: Segment, coverage: &mut Field<f32>) {
    for pixel in pixels(segment) {
        paint(coverage, pixel, 1.0);
    }
}

/// The pixels from the lower end to the upper one along the longer side.
pub(super) fn pixels([from, to]: Segment) -> Vec<[i32; 2]> {
    let along = usize::from((to[0] - from[0]).abs() <= (to[1] - from[1]).abs());
    let (first, last) = if from[along] < to[along] { (from, to) } else { (to, from) };
    let across = interpolate(first[along], first[1 - along] as f32, last[along], last[1 - along] as f32);
    let pixel = |(step, across): (i32, f32)| {
        let across = (across + 0.5).floor() as i32;
        if along == 0 { [step, across] } else { [across, step] }
    };
    (first[along]..).zip(across).map(pixel).collect()
}
