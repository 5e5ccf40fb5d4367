//! How many pixels show the wrong face, in exact integers.

use super::Scene;
use super::scene::Face;
use crate::field::Field;
use crate::oracle::coverage::{centre, covers, doubled_area};

/// What is wrong with a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OrderErrors {
    /// Pixels that show anything, as they should.
    pub seen: usize,
    /// Pixels that show a face which is not there, or not the nearest (or one of the
    /// nearest) there, or the background where there is a face.
    pub misordered: usize,
}

impl OrderErrors {
    /// Of a picture of a scene.
    pub fn of(scene: &Scene, shown: &Field<u32>) -> Self {
        let nearest = nearest(scene);
        let mut errors = Self::default();
        for (place, depth) in nearest.pixels() {
            let pixel = place.map(|part| part as i32);
            let face = (shown[place] != u32::MAX).then(|| scene.face(shown[place]));
            let found = face.and_then(|face| Depth::of(face, pixel));
            let is_right = face.is_some() == depth.is_some()
                && found.is_none() == depth.is_none()
                && found.zip(*depth).is_none_or(|(found, nearest)| !found.is_behind(nearest));
            errors.seen += usize::from(depth.is_some());
            errors.misordered += usize::from(!is_right);
        }
        errors
    }

    /// Misordered pixels for a thousand that show anything.
    pub fn per_mille(&self) -> f64 {
        1e3 * self.misordered as f64 / self.seen as f64
    }
}

/// How near a face is: a fraction with a positive denominator.
#[derive(Clone, Copy, Debug)]
struct Depth {
    numerator: i128,
    denominator: i128,
}

impl Depth {
    /// At the centre of a pixel, if the face covers it.
    fn of(face: &Face, pixel: [i32; 2]) -> Option<Self> {
        let [a, b, c] = face.corners.map(|[x, y, _]| [x, y]);
        let point = centre(pixel);
        if !covers([a, b, c], point) {
            return None;
        }
        let shares = [[point, b, c], [a, point, c], [a, b, point]].map(doubled_area);
        let depths = face.corners.map(|corner| i128::from(corner[2]));
        let sum: i128 = shares.into_iter().zip(depths).map(|(share, depth)| share * depth).sum();
        let area = doubled_area([a, b, c]);
        Some(Self { numerator: sum * area.signum(), denominator: area.abs() })
    }

    fn is_behind(self, other: Self) -> bool {
        self.numerator * other.denominator < other.numerator * self.denominator
    }
}

/// The nearest depth in each pixel.
fn nearest(scene: &Scene) -> Field<Option<Depth>> {
    let mut nearest: Field<Option<Depth>> = Field::new(scene.size(), None);
    for (_, face) in scene.faces() {
        let Some(surface) = super::Surface::new(face) else { continue };
        let [columns, rows] = surface.bounding_box(scene.limits());
        for pixel in rows.flat_map(|y| columns.clone().map(move |x| [x, y])) {
            let Some(depth) = Depth::of(face, pixel) else { continue };
            let best = &mut nearest[pixel.map(|part| part as usize)];
            if best.is_none_or(|best| best.is_behind(depth)) {
                *best = Some(depth);
            }
        }
    }
    nearest
}
