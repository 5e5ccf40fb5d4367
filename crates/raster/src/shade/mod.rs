//! The fragment stage: what is seen at each sample gets its colour.

mod erased;
mod interpolation;
mod span;

pub(crate) use erased::{AnyPipeline, ShadeContext, Shader};
pub(crate) use span::Span;

use crate::frame::Frame;
use crate::tile::{NOBODY, STRIDE, Scratch, TileArea};

/// Shades every visible sample of a tile once, triangle by triangle and so draw
/// by draw.
pub(crate) fn shade_visible(frame: &Frame<'_>, area: TileArea, scratch: &mut Scratch) {
    collect_spans(area, scratch);
    sort_spans(scratch);
    for span in &mut scratch.sorted {
        scratch.stats.samples_shaded += u64::from(span.length);
        span.triangle = scratch.triangles[span.triangle as usize];
    }
    frame.shade(area, &scratch.sorted, &mut scratch.color);
}

fn collect_spans(area: TileArea, scratch: &mut Scratch) {
    let Scratch { spans, winner, counts, triangles, .. } = scratch;
    spans.clear();
    counts.clear();
    counts.resize(triangles.len() + 1, 0);
    for y in 0..area.size[1] {
        let row = &winner[y * STRIDE..y * STRIDE + area.size[0]];
        let mut x = 0;
        while x < row.len() {
            let start = x;
            let place = row[start];
            while x < row.len() && row[x] == place {
                x += 1;
            }
            if place != NOBODY {
                counts[place as usize + 1] += 1;
                let output = (y * STRIDE + start) as u32;
                let length = (x - start) as u16;
                spans.push(Span { triangle: place, output, x: start as u16, y: y as u16, length });
            }
        }
    }
}

/// Sorts the spans by triangle: by counting, as places are small numbers.
fn sort_spans(scratch: &mut Scratch) {
    let Scratch { spans, sorted, counts, .. } = scratch;
    for place in 1..counts.len() {
        counts[place] += counts[place - 1];
    }
    sorted.clear();
    sorted.extend_from_slice(spans);
    for span in spans.iter() {
        let next = &mut counts[span.triangle as usize];
        sorted[*next as usize] = *span;
        *next += 1;
    }
}
