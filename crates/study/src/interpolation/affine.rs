//! Linear on the screen (source row B4): right for what faces the eye, and wrong for
//! what leads away.

use super::wall::{Facet, Picture, paint};
use std::ops::RangeInclusive;

pub(super) fn row(triangle: &Facet, y: i32, columns: RangeInclusive<i32>, picture: &mut Picture) {
    columns.for_each(|x| paint(picture, [x, y], triangle.affine([x, y])));
}
