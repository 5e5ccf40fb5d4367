//! A division at every 16th pixel of a row and at its end, and linear steps in between (M. Abrash, "Graphics
//! Programming Black Book", 1997, chapter 70, on Quake).

use super::Texel;
use super::wall::Row;

const STEP: usize = 16;

#[inline]
pub(super) fn row(row: &Row, pixels: &mut [Option<Texel>]) {
    let last = pixels.len() - 1;
    let mut here = row.perspective(0);
    for (start, span) in (0..).step_by(STEP).zip(pixels.chunks_mut(STEP)) {
        // To the first pixel of the next span, or to the last one of the row.
        let stop = (start + STEP).min(last);
        let there = row.perspective(stop);
        // A power of two but in the last span.
        let share = 1.0 / (stop - start).max(1) as f32;
        let steps = [0, 1].map(|axis| (there[axis] - here[axis]) * share);
        let mut texel = here;
        for pixel in span {
            *pixel = Some(texel);
            texel = [texel[0] + steps[0], texel[1] + steps[1]];
        }
        here = there;
    }
}
