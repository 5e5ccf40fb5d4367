//! Flat shading (W. J. Bouknight, "A procedure for generation of three-dimensional
//! half-toned computer graphics presentations", 1970): light once for each face.

use super::ball::{Facet, Picture};
use super::light_of;

pub(super) fn draw(face: &Facet, picture: &mut Picture) {
    let [a, b, c] = face.normals;
    let light = light_of((b - a).cross(c - a).normalize());
    face.paint(picture, |_| light);
}
