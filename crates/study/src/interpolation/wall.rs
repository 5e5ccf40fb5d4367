//! A wall of two triangles that leads away, seen in perspective.

use super::Texel;
use crate::field::Field;
use crate::fill::fixed::Edges;
use std::ops::RangeInclusive;

/// The texel in each pixel; none where the wall is not.
pub(super) type Picture = Field<Option<Texel>>;

/// Sets the texel of a pixel of the picture.
pub(super) fn paint(picture: &mut Picture, [x, y]: [i32; 2], texel: Texel) {
    picture[[x as usize, y as usize]] = Some(texel);
}

/// A wall with a texture, beside an eye one metre from it.
pub struct Wall {
    pub(super) size: [usize; 2],
    pub(super) corners: [Corner; 4],
    triangles: [Facet; 2],
}

/// A corner on the picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// In 1/256 pixel.
    pub(super) place: [i64; 2],
    /// How far from the eye.
    pub(super) distance: f64,
    /// In texels.
    pub(super) texel: [f64; 2],
}

/// The corners of the two triangles.
pub(super) const TRIANGLES: [[usize; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

/// A triangle with what is linear on the screen over it.
pub(super) struct Facet {
    edges: Edges,
    texel: [[f64; 3]; 2],
    texel_over_distance: [[f64; 3]; 2],
    inverse_distance: [f64; 3],
}

impl Facet {
    fn new(corners: [Corner; 3]) -> Self {
        let edges = Edges::new(corners.map(|corner| corner.place), 256).expect("the wall has an area");
        let texel = [0, 1].map(|axis| edges.shares(corners.map(|corner| corner.texel[axis])));
        let texel_over_distance =
            [0, 1].map(|axis| edges.shares(corners.map(|corner| corner.texel[axis] / corner.distance)));
        let inverse_distance = edges.shares(corners.map(|corner| 1.0 / corner.distance));
        Self { edges, texel, texel_over_distance, inverse_distance }
    }

    /// Linear on the screen.
    pub(super) fn affine(&self, pixel: [i32; 2]) -> Texel {
        self.texel.map(|shares| self.edges.interpolated(&shares, pixel) as f32)
    }

    /// Linear on the wall, computed in `f32`.
    pub(super) fn perspective(&self, pixel: [i32; 2]) -> Texel {
        let inverse = self.edges.interpolated(&self.inverse_distance, pixel) as f32;
        self.texel_over_distance.map(|shares| self.edges.interpolated(&shares, pixel) as f32 / inverse)
    }

    /// The same in `f64`: what is right.
    fn exact(&self, pixel: [i32; 2]) -> [f64; 2] {
        let inverse = self.edges.interpolated(&self.inverse_distance, pixel);
        self.texel_over_distance.map(|shares| self.edges.interpolated(&shares, pixel) / inverse)
    }

    /// The columns that are covered in a row: one range, as a triangle has no holes.
    fn columns(&self, y: i32, limits: [i32; 2]) -> Option<RangeInclusive<i32>> {
        let [columns, _] = self.edges.bounding_box(limits);
        let mut covered = columns.filter(|&x| self.edges.covers([x, y]));
        let first = covered.next()?;
        Some(first..=covered.next_back().unwrap_or(first))
    }
}

impl Wall {
    /// From 1.5 to 6 metres away, 1.8 metres high, 256 texels to the metre, in a picture
    /// of `width` pixels and three quarters of that in height.
    pub fn new(width: usize) -> Self {
        const TEXELS: f64 = 256.0;
        let scale = width as f64 / 2.0;
        let corner = |[up, distance]: [f64; 2]| {
            let place =
                [width as f64 * 0.95 - scale / distance, width as f64 * 0.375 - scale * up / distance];
            Corner {
                place: place.map(|part| (part * 256.0).round() as i64),
                distance,
                texel: [distance * TEXELS, up * TEXELS],
            }
        };
        let corners = [[-0.9, 1.5], [-0.9, 6.0], [0.9, 6.0], [0.9, 1.5]].map(corner);
        let triangles = TRIANGLES.map(|triangle| Facet::new(triangle.map(|index| corners[index])));
        Self { size: [width, width * 3 / 4], corners, triangles }
    }

    /// A picture that `row` draws what each triangle covers of each row into.
    pub(super) fn draw(&self, row: impl Fn(&Facet, i32, RangeInclusive<i32>, &mut Picture)) -> Picture {
        let mut picture = Field::new(self.size, None);
        let limits = self.size.map(|side| side as i32);
        for triangle in &self.triangles {
            for y in 0..limits[1] {
                if let Some(columns) = triangle.columns(y, limits) {
                    row(triangle, y, columns, &mut picture);
                }
            }
        }
        picture
    }

    /// The right texel at the centre of a pixel.
    pub(super) fn texel(&self, place: [usize; 2]) -> Option<[f64; 2]> {
        let pixel = place.map(|part| part as i32);
        let covering = self.triangles.iter().find(|triangle| triangle.edges.covers(pixel));
        covering.map(|triangle| triangle.exact(pixel))
    }
}
