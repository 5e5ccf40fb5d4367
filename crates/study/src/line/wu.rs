//! X. Wu, "An efficient antialiasing technique", SIGGRAPH 1991: the two pixels above and below the line share
//! the ink of one pixel, in proportion to their distances.

use super::segment::{Segment, paint};
use trigon_classic::Field;

pub(super) fn draw([from, to]: Segment, coverage: &mut Field<f32>) {
    let along = usize::from((to[0] - from[0]).abs() < (to[1] - from[1]).abs());
    let (first, last) = if from[along] < to[along] { (from, to) } else { (to, from) };
    let steps = last[along] - first[along];
    let slope = (last[1 - along] - first[1 - along]) as f32 / steps.max(1) as f32;
    for step in 0..=steps {
        let across = first[1 - along] as f32 + slope * step as f32;
        let whole = across.floor();
        let pixel = |across: i32| {
            let step = first[along] + step;
            if along == 0 { [step, across] } else { [across, step] }
        };
        paint(coverage, pixel(whole as i32), 1.0 - (across - whole));
        paint(coverage, pixel(whole as i32 + 1), across - whole);
    }
}
