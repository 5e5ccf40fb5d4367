//! The source colours of a triangle, divided by what varies across it.

use super::Image;
use super::corner::SnappedVertex;
use super::flat::Flat;
use super::gradient::TriangleTexture;
use super::texel::{FURTHEST, TexelPosition};
use crate::simd::prelude::*;

/// What a triangle is painted with.
pub(super) enum Source<'a> {
    /// One colour.
    Flat(Flat),
    /// A colour for each corner in levels, and perhaps texels.
    Gradient([[f64; 4]; 3], Option<TriangleTexture<'a>>),
}

/// A mesh's image, and the colour at the last texture coordinate: in most triangles of an interface, all
/// corners have the same one, which is white.
pub(super) struct MeshTexels<'a> {
    image: Option<&'a Image>,
    uv: [f32; 2],
    color: [f64; 4],
}

/// Levels of white.
const WHITE: [f64; 4] = [255.0; 4];

impl<'a> MeshTexels<'a> {
    pub(super) fn new(image: Option<&'a Image>) -> Self {
        // NaN is no position, so the first one is looked up.
        Self { image, uv: [f32::NAN; 2], color: WHITE }
    }

    pub(super) fn image(&self) -> Option<&'a Image> {
        self.image
    }

    /// What a triangle's corners say; `None` if a position is out of range.
    #[inline(always)]
    pub(super) fn source<S: Simd>(&mut self, simd: S, corners: &[SnappedVertex; 3]) -> Option<Source<'a>> {
        if let Some(flat) = self.flat(simd, corners) {
            return Some(Source::Flat(flat));
        }
        let uvs = corners.map(|corner| corner.uv);
        let (tint, texture) = match self.image {
            Some(image) if uvs != [uvs[0]; 3] => {
                (WHITE, Some(TriangleTexture { image, texel_positions: texel_positions(image, uvs)? }))
            }
            _ => (self.color_at(simd, uvs[0])?, None),
        };
        Some(Source::Gradient(corners.map(|corner| tinted(corner.color, tint)), texture))
    }

    /// The colour of a triangle that has one, and no texture on it.
    #[inline(always)]
    pub(super) fn flat<S: Simd>(&mut self, simd: S, [a, b, c]: &[SnappedVertex; 3]) -> Option<Flat> {
        if a.color != b.color || b.color != c.color {
            return None;
        }
        if a.color == [0; 4] {
            return Some(Flat::NOTHING);
        }
        let textured = self.image.is_some() && (a.uv != b.uv || b.uv != c.uv);
        if textured || self.color_at(simd, a.uv)? != WHITE { None } else { Flat::new(a.color) }
    }

    /// The image's colour at a position.
    #[inline(always)]
    fn color_at<S: Simd>(&mut self, simd: S, uv: [f32; 2]) -> Option<[f64; 4]> {
        let Some(image) = self.image else { return Some(WHITE) };
        if uv != self.uv {
            let [position, ..] = texel_positions(image, [uv; 3])?.map(TexelPosition::new);
            let channels = image.colors(simd, position, TexelPosition([0; 2]), 0..1);
            self.color = channels.map(|channel| f64::from(channel.as_slice()[0]));
            self.uv = uv;
        }
        Some(self.color)
    }
}

/// A colour times a texel's, in levels.
fn tinted(color: [u8; 4], tint: [f64; 4]) -> [f64; 4] {
    std::array::from_fn(|c| f64::from(color[c]) * tint[c] / 255.0)
}

/// Coordinates in texels; `None` if one is out of range or not a number.
fn texel_positions(image: &Image, uvs: [[f32; 2]; 3]) -> Option<[[f64; 2]; 3]> {
    let [width, height] = image.size().map(f64::from);
    let texel_positions = uvs.map(|[u, v]| [f64::from(u) * width, f64::from(v) * height]);
    texel_positions.iter().flatten().all(|position| position.abs() <= FURTHEST).then_some(texel_positions)
}
