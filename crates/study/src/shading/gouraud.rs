//! H. Gouraud, "Continuous shading of curved surfaces", IEEE Transactions on Computers,
//! 1971: light at the corners, interpolated.

use super::ball::{Facet, Picture};
use super::light_of;
use crate::fill::fixed::weighted;

pub(super) fn draw(face: &Facet, picture: &mut Picture) {
    let lights = face.shares(face.normals.map(light_of));
    face.paint(picture, |weights| weighted(&lights, weights));
}
