//! The difference between an image of a tiling and the exact one.

use super::{Canvas, Painted, Triangle, edges::bounding_box};
use crate::oracle::coverage::covers;
use std::ops::AddAssign;
use trigon_classic::Field;

/// What is wrong with an image of a tiling, in pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FillErrors {
    /// Pixels whose right or lower neighbour belongs to another triangle: only there can errors occur.
    pub edge_pixels: usize,
    /// Pixels that were not painted exactly once, by the right triangle.
    pub wrong: usize,
    /// Pixels that were not painted.
    pub gaps: usize,
    /// Pixels that were painted several times.
    pub doubles: usize,
}

impl FillErrors {
    /// Of an image, where `owners` has the exact owner of each pixel.
    #[must_use]
    pub fn of(canvas: &Canvas, owners: &Field<u32>) -> Self {
        let mut errors = Self { edge_pixels: edge_pixels(owners), ..Self::default() };
        for (place, &owner) in owners.pixels() {
            let Painted { count, last } = canvas.pixels()[place];
            errors.wrong += usize::from(count != 1 || last != owner);
            errors.gaps += usize::from(count == 0);
            errors.doubles += usize::from(count > 1);
        }
        errors
    }

    /// Wrong pixels for a thousand edge pixels.
    #[must_use]
    pub fn wrong_per_mille(&self) -> f64 {
        1e3 * self.wrong as f64 / self.edge_pixels as f64
    }
}

impl AddAssign for FillErrors {
    fn add_assign(&mut self, other: Self) {
        self.edge_pixels += other.edge_pixels;
        self.wrong += other.wrong;
        self.gaps += other.gaps;
        self.doubles += other.doubles;
    }
}

/// The triangle that covers each pixel's centre, exactly, of triangles that tile the image.
#[must_use]
pub fn owners(triangles: &[Triangle], size: [usize; 2]) -> Field<u32> {
    // Corners are multiples of this; see `Case`.
    const UNIT: f32 = 1.0 / 16384.0;
    const ONE: i32 = 16384;
    let mut owners = Field::new(size, u32::MAX);
    let canvas = Canvas::new(size);
    for (number, triangle) in (0..).zip(triangles) {
        let exact = triangle.map(|corner| [corner.x, corner.y].map(|part| (part / UNIT) as i32));
        let [columns, rows] = bounding_box(triangle, &canvas);
        for y in rows[0]..=rows[1] {
            for x in columns[0]..=columns[1] {
                if covers(exact, [x, y].map(|place| place * ONE + ONE / 2)) {
                    owners[[x as usize, y as usize]] = number;
                }
            }
        }
    }
    owners
}

fn edge_pixels(owners: &Field<u32>) -> usize {
    let is_edge = |([x, y], owner): &([usize; 2], &u32)| {
        let neighbours = [[*x as i32 + 1, *y as i32], [*x as i32, *y as i32 + 1]];
        neighbours.iter().any(|&place| owners.get(place).is_some_and(|other| other != *owner))
    };
    owners.pixels().filter(is_edge).count()
}
