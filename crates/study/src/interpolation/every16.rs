//! Divided at every 16th pixel of a row and at its end, and linear between (M. Abrash,
//! "Graphics Programming Black Book", 1997, chapter 70, on Quake).

use super::wall::{Facet, Picture, paint};
use std::ops::RangeInclusive;

const STEP: i32 = 16;

pub(super) fn row(triangle: &Facet, y: i32, columns: RangeInclusive<i32>, picture: &mut Picture) {
    let (mut start, end) = (*columns.start(), *columns.end());
    let mut here = triangle.perspective([start, y]);
    paint(picture, [start, y], here);
    while start < end {
        let stop = end.min(start + STEP);
        let there = triangle.perspective([stop, y]);
        for x in start + 1..=stop {
            let share = (x - start) as f32 / (stop - start) as f32;
            paint(picture, [x, y], [0, 1].map(|axis| here[axis] + (there[axis] - here[axis]) * share));
        }
        (start, here) = (stop, there);
    }
}
