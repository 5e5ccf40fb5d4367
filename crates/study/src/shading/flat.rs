//! Flat shading (W. J. Bouknight, "A procedure for generation of three-dimensional half-toned computer
//! graphics presentations", 1970): one light value per face.

use super::ball::{BallImage, Facet};
use super::light_of;

pub(super) fn draw(face: &Facet, image: &mut BallImage) {
    let [a, b, c] = face.normals;
    let light = light_of((b - a).cross(c - a).normalize());
    face.paint(image, |_| light);
}
