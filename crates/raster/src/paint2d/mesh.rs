//! Meshes to paint: triangles with a colour and image coordinates at each corner.

use super::{Image, Rect};

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
