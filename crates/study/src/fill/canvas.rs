//! The image into which triangles are painted: it counts how often each pixel is painted, and says how it
//! differs from the exact image of a tiling.

use std::ops::AddAssign;

use trigon_classic::Field;
use trigon_math::Vec2;

use super::edges::bounding_box;
use crate::oracle::coverage::covers;

/// The history of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Painted {
    /// How often it was painted.
    pub count: u32,
    /// The number of the triangle that painted it last, `u32::MAX` if none did.
    pub last: u32,
}

impl Painted {
    /// Not painted.
    pub const NEVER: Self = Self { count: 0, last: u32::MAX };
}

/// An image that counts how often each pixel is painted.
#[derive(Clone, Debug, PartialEq)]
pub struct FillCanvas {
    pub(super) pixels: Field<Painted>,
    brush: u32,
}

impl FillCanvas {
    /// An empty image.
    #[must_use]
    pub fn new(size: [usize; 2]) -> Self {
        Self { pixels: Field::new(size, Painted::NEVER), brush: 0 }
    }

    /// What was painted.
    #[must_use]
    pub fn pixels(&self) -> &Field<Painted> {
        &self.pixels
    }

    /// Width and height, in the type of coordinates.
    pub(crate) fn limits(&self) -> [i32; 2] {
        self.pixels.size().map(|side| side as i32)
    }

    /// Paints a pixel, if it is in the image.
    #[inline]
    pub(crate) fn paint(&mut self, x: i32, y: i32) {
        if let Some(pixel) = self.pixels.get_mut([x, y]) {
            *pixel = Painted { count: pixel.count + 1, last: self.brush };
        }
    }

    /// Fills triangles, each with its own brush.
    #[inline(always)]
    pub(super) fn each(&mut self, triangles: &[Triangle], fill: impl Fn(&Triangle, &mut Self)) {
        for (brush, triangle) in (0..).zip(triangles) {
            self.brush = brush;
            fill(triangle, self);
        }
    }
}

/// A triangle in pixels from the top left, y down, in either winding.
pub type Triangle = [Vec2; 3];

/// The smallest and the largest of three.
pub(crate) fn range<T: PartialOrd + Copy>([a, b, c]: [T; 3]) -> [T; 2] {
    let least = |a, b| if b < a { b } else { a };
    let most = |a, b| if b > a { b } else { a };
    [least(least(a, b), c), most(most(a, b), c)]
}

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
    pub fn of(canvas: &FillCanvas, owners: &Field<u32>) -> Self {
        let mut errors = Self { edge_pixels: edge_pixels(owners), ..Self::default() };
        for (pixel, &owner) in owners.pixels() {
            let Painted { count, last } = canvas.pixels()[pixel];
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
    // Corners are multiples of this; see `Tiling`.
    const UNIT: f32 = 1.0 / 16384.0;
    const ONE: i32 = 16384;
    let mut owners = Field::new(size, u32::MAX);
    let canvas = FillCanvas::new(size);
    for (number, triangle) in (0..).zip(triangles) {
        let exact = triangle.map(|corner| [corner.x, corner.y].map(|part| (part / UNIT) as i32));
        let [columns, rows] = bounding_box(triangle, &canvas);
        for y in rows[0]..=rows[1] {
            for x in columns[0]..=columns[1] {
                if covers(exact, [x, y].map(|pixel| pixel * ONE + ONE / 2)) {
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
        neighbours.iter().any(|&pixel| owners.get(pixel).is_some_and(|other| other != *owner))
    };
    owners.pixels().filter(is_edge).count()
}
