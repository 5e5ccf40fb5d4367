//! H. Gouraud, "Continuous shading of curved surfaces", IEEE Transactions on Computers, 1971: light is
//! computed at the corners and interpolated.

use super::ball::{BallImage, Facet};
use super::light_of;
use trigon_classic::weighted;

pub(super) fn draw(face: &Facet, image: &mut BallImage) {
    let lights = face.shares(face.normals.map(light_of));
    face.paint(image, |weights| weighted(&lights, weights));
}
