//! A division in each pixel (J. F. Blinn, "Hyperbolic interpolation", IEEE CG&A, 1992; source row D10 does
//! the same for depth).

use super::Texel;
use super::wall::Row;

#[inline]
pub(super) fn row(row: &Row, pixels: &mut [Option<Texel>]) {
    for (x, pixel) in pixels.iter_mut().enumerate() {
        *pixel = Some(row.perspective(x));
    }
}
