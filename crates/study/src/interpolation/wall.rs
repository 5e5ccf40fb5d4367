//! A receding wall of two triangles.

use crate::oracle::{coverage, perspective};
use std::ops::Range;
use trigon_classic::{Edges, Field};

/// Texture coordinates in texels.
pub type Texel = [f32; 2];

/// The texel in each pixel; none outside the wall.
pub(super) type WallImage = Field<Option<Texel>>;

/// A textured wall, one metre to the side of the eye.
pub struct Wall {
    pub(super) size: [usize; 2],
    pub(super) corners: [Corner; 4],
    triangles: [Facet; 2],
}

/// A corner on the image.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// In 1/256 pixel.
    pub(super) place: [i32; 2],
    /// The distance from the eye.
    pub(super) distance: f64,
    /// In texels.
    pub(super) texel: [f64; 2],
}

/// The corners of the two triangles.
pub(super) const TRIANGLES: [[usize; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

/// A function that is linear on the screen: its value at the first pixel's centre, and its steps
/// from column to column and from row to row.
#[derive(Clone, Copy, Debug)]
struct Plane([f64; 3]);

impl Plane {
    fn new(edges: &Edges, values: [f64; 3]) -> Self {
        let shares = edges.shares(values);
        let [start, right, below] = [[0, 0], [1, 0], [0, 1]].map(|pixel| edges.interpolated(&shares, pixel));
        Self([start, right - start, below - start])
    }

    /// From a pixel on to the right.
    fn along(self, [x, y]: [usize; 2]) -> Linear {
        let Self([start, across, down]) = self;
        Linear { start: (start + across * x as f64 + down * y as f64) as f32, step: across as f32 }
    }
}

/// A linear function along a row, in `f32`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Linear {
    start: f32,
    step: f32,
}

impl Linear {
    /// So many pixels from its start.
    #[inline]
    pub(super) fn at(self, pixels: usize) -> f32 {
        self.start + self.step * pixels as f32
    }
}

/// The values of a triangle at the first pixel of a row, and their steps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    pub(super) texel: [Linear; 2],
    pub(super) texel_over_distance: [Linear; 2],
    pub(super) inverse_distance: Linear,
}

impl Row {
    /// The texel on the wall so many pixels from the first one: a division.
    #[inline]
    pub(super) fn perspective(&self, pixels: usize) -> Texel {
        let distance = 1.0 / self.inverse_distance.at(pixels);
        self.texel_over_distance.map(|part| part.at(pixels) * distance)
    }
}

/// A triangle with its functions that are linear on the screen.
struct Facet {
    /// The columns that each row covers: one range, as a triangle has no holes.
    spans: Vec<Range<usize>>,
    texel: [Plane; 2],
    texel_over_distance: [Plane; 2],
    inverse_distance: Plane,
}

impl Facet {
    fn new(corners: [Corner; 3], size: [usize; 2]) -> Self {
        let places = corners.map(|corner| corner.place.map(i64::from));
        let edges = Edges::new(places, 256).expect("the wall has an area");
        let mut spans = vec![0..0; size[1]];
        edges.each_covered(&edges.bounding_box(size.map(|side| side as i32)), |[x, y], _| {
            let span = &mut spans[y as usize];
            *span = if span.end == 0 { x as usize..x as usize + 1 } else { span.start..x as usize + 1 };
        });
        let plane = |value: &dyn Fn(Corner) -> f64| Plane::new(&edges, corners.map(value));
        Self {
            spans,
            texel: [0, 1].map(|axis| plane(&|corner| corner.texel[axis])),
            texel_over_distance: [0, 1].map(|axis| plane(&|corner| corner.texel[axis] / corner.distance)),
            inverse_distance: plane(&|corner| 1.0 / corner.distance),
        }
    }

    fn row(&self, pixel: [usize; 2]) -> Row {
        Row {
            texel: self.texel.map(|plane| plane.along(pixel)),
            texel_over_distance: self.texel_over_distance.map(|plane| plane.along(pixel)),
            inverse_distance: self.inverse_distance.along(pixel),
        }
    }
}

impl Wall {
    /// From 1.5 to 6 metres away, 1.8 metres high, 256 texels to the metre, in an image
    /// of `width` pixels and three quarters of that in height.
    #[must_use]
    pub fn new(width: usize) -> Self {
        const TEXELS: f64 = 256.0;
        let scale = width as f64 / 2.0;
        let corner = |[up, distance]: [f64; 2]| {
            let place =
                [width as f64 * 0.95 - scale / distance, width as f64 * 0.375 - scale * up / distance];
            Corner {
                place: place.map(|part| (part * 256.0).round() as i32),
                distance,
                texel: [distance * TEXELS, up * TEXELS],
            }
        };
        let size = [width, width * 3 / 4];
        let corners = [[-0.9, 1.5], [-0.9, 6.0], [0.9, 6.0], [0.9, 1.5]].map(corner);
        let triangles = TRIANGLES.map(|triangle| Facet::new(triangle.map(|index| corners[index]), size));
        Self { size, corners, triangles }
    }

    /// Draws each row of each triangle by a function of the row and its pixels.
    #[inline]
    pub(super) fn draw_into(&self, image: &mut WallImage, row: impl Fn(&Row, &mut [Option<Texel>])) {
        for triangle in &self.triangles {
            for (y, span) in triangle.spans.iter().enumerate().filter(|(_, span)| span.end > 0) {
                row(&triangle.row([span.start, y]), &mut image.row_mut(y)[span.clone()]);
            }
        }
    }

    /// The correct texel at the centre of a pixel, by [`perspective::at`].
    pub(super) fn texel(&self, place: [usize; 2]) -> Option<[f64; 2]> {
        let point = coverage::centre(place.map(|part| part as i32));
        let triangles = TRIANGLES.map(|triangle| triangle.map(|index| self.corners[index]));
        let corners =
            triangles.into_iter().find(|corners| coverage::covers(corners.map(|c| c.place), point))?;
        let distances = corners.map(|corner| corner.distance);
        let [u, v] = [0, 1].map(|axis| {
            perspective::at(corners.map(|c| c.place), distances, corners.map(|c| c.texel[axis]), point)
        });
        Some([u?, v?])
    }
}
