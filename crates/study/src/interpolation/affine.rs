//! Linear on the screen (source row B4): correct for surfaces that face the camera, wrong for surfaces that
//! recede.

use super::Texel;
use super::wall::Row;

#[inline]
pub(super) fn row(row: &Row, pixels: &mut [Option<Texel>]) {
    for (x, pixel) in pixels.iter_mut().enumerate() {
        *pixel = Some(row.texel.map(|part| part.at(x)));
    }
}
