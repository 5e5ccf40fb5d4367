//! B. T. Phong, "Illumination for computer generated pictures", CACM 18(6), 1975: normals are interpolated,
//! and light is computed in each pixel.

use super::ball::{BallImage, Facet};
use super::light_of;
use trigon_classic::weighted;
use trigon_math::DVec3;

pub(super) fn draw(face: &Facet, image: &mut BallImage) {
    let normals = [0, 1, 2].map(|axis| face.shares(face.normals.map(|normal| normal[axis])));
    face.paint(image, |weights| {
        let normal = DVec3::from(normals.map(|shares| weighted(&shares, weights)));
        light_of(normal.normalize())
    });
}
