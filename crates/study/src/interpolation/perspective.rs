//! Divided in each pixel (J. F. Blinn, "Hyperbolic interpolation", IEEE CG&A, 1992;
//! source row D10 has it for depth).

use super::wall::{Facet, Picture, paint};
use std::ops::RangeInclusive;

pub(super) fn row(triangle: &Facet, y: i32, columns: RangeInclusive<i32>, picture: &mut Picture) {
    columns.for_each(|x| paint(picture, [x, y], triangle.perspective([x, y])));
}
