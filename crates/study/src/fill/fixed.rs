//! Corners are snapped to a sub-pixel grid; from there on, exact integers with the top-left rule.

use super::{FillCanvas, Triangle};
use trigon_classic::Edges;

/// With `BITS` fractional bits.
pub(super) fn fill<const BITS: u32>(triangle: &Triangle, canvas: &mut FillCanvas) {
    if let Some(edges) = edges(triangle, BITS) {
        fill_edges(&edges, canvas);
    }
}

/// The edges of a triangle with its corners on a grid; none if it has no area there.
pub(super) fn edges(triangle: &Triangle, bits: u32) -> Option<Edges> {
    let one = f64::from(1 << bits);
    let snapped =
        triangle.map(|corner| corner.as_dvec2().to_array().map(|part| (part * one).round_ties_even() as i64));
    Edges::new(snapped, 1 << bits)
}

/// Pixel by pixel of the bounding box.
pub(super) fn fill_edges(edges: &Edges, canvas: &mut FillCanvas) {
    let [columns, rows] = edges.bounding_box(canvas.limits());
    for y in rows {
        for x in columns.clone() {
            if edges.covers([x, y]) {
                canvas.paint(x, y);
            }
        }
    }
}
