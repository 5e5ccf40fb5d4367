//! Linear on the screen (source row B4): right for what faces the eye, and wrong for
//! what leads away.

use super::Texel;
use super::wall::Row;

#[inline]
pub(super) fn row(row: &Row, pixels: &mut [Option<Texel>]) {
    for (x, pixel) in pixels.iter_mut().enumerate() {
        *pixel = Some(row.texel.map(|part| part.at(x)));
    }
}
