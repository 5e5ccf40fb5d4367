//! Meshes to paint, their triangles on the sub-pixel grid, and the source colours of a triangle, divided by what varies
//! across the triangle.

use super::blend::Flat;
use super::image::{FURTHEST, TexelPosition};
use super::triangle::TriangleTexture;
use super::{Image, Rect};
use crate::simd::prelude::*;
use trigon_math::{Fixed, FixedPoint};

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

/// A vertex whose position is on the grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct SnappedVertex {
    pub(super) point: FixedPoint,
    pub(super) uv: [f32; 2],
    pub(super) color: [u8; 4],
}

/// The vertex's point; `None` if it has none: not a number, or out of range.
#[inline(always)]
pub(super) fn snap(vertex: &Vertex) -> Option<FixedPoint> {
    let [x, y] = vertex.position;
    Some(FixedPoint::new(Fixed::from_f32(x)?, Fixed::from_f32(y)?))
}

/// All triangles of a mesh whose vertices are snapped to `points`; `None` for
/// those with an index or a point missing.
#[inline(always)]
pub(super) fn triangles<'a>(
    mesh: &'a Mesh<'a>,
    points: &'a [Option<FixedPoint>],
) -> impl Iterator<Item = Option<[SnappedVertex; 3]>> {
    let corner = |index: u32| {
        let vertex = mesh.vertices.get(index as usize)?;
        let point = (*points.get(index as usize)?)?;
        Some(SnappedVertex { point, uv: vertex.uv, color: vertex.color })
    };
    mesh.indices.chunks(3).map(move |indices| {
        let &[a, b, c] = indices.first_chunk::<3>()?;
        Some([corner(a)?, corner(b)?, corner(c)?])
    })
}

/// A corner of triangles.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vertex {
    /// In pixels from the top left, y down; the middle of the first pixel is at
    /// (0.5, 0.5).
    pub position: [f32; 2],
    /// The position in the image: (0, 0) is its top left corner, (1, 1) its bottom
    /// right one. Without an image it does not matter.
    pub uv: [f32; 2],
    /// Gamma space, premultiplied by alpha, which comes last. Channels above
    /// alpha add light; with alpha 0 they do nothing else.
    pub color: [u8; 4],
}

/// Triangles that share an image and a scissor; neither their winding nor the
/// order of a triangle's vertices matters.
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'a> {
    /// Only these pixels are touched.
    pub scissor: Rect,
    /// The corners.
    pub vertices: &'a [Vertex],
    /// Three indices of `vertices` for each triangle, painted in this order.
    pub indices: &'a [u32],
    /// What the vertices' colours are multiplied with; `None` for white.
    pub image: Option<&'a Image>,
}
