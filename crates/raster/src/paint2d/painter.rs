//! Paints meshes on a canvas in the given order.

use super::corner::{SnappedVertex, snap, triangles};
use super::coverage::Triangle;
use super::gradient::Gradient;
use super::rectangle::Rectangle;
use super::source::{MeshTexels, Source};
use super::{Canvas, Mesh, Rect, blit::blit};
use crate::simd::prelude::*;
use crate::simd::{SimdLevel, SimdLevelError, Token, at_level};
use trigon_math::FixedPoint;

/// Paints meshes; keeps its buffers, so that painting again needs no memory.
#[derive(Clone, Debug)]
pub struct Painter {
    token: Token,
    points: Vec<Option<FixedPoint>>,
}

/// What became of the triangles of the meshes that are not wholly out of sight.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Painted {
    /// All of them, the refused ones included.
    pub triangles: usize,
    /// Triangles of which nothing was painted. They have an index that no vertex has or none at all, a
    /// position that is no number or beyond ±2²² pixels, or texels that are no numbers or beyond ±2¹⁸.
    pub refused: usize,
    /// Triangles that were painted as halves of upright rectangles.
    pub in_rectangles: usize,
}

impl Default for Painter {
    fn default() -> Self {
        // Every processor has the level that `best` says.
        Self::with_simd(SimdLevel::best()).expect("the best level is supported")
    }
}

impl Painter {
    /// With the best instructions that the processor has.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// With these instructions; the images are the same.
    ///
    /// # Errors
    /// If the processor does not have them.
    pub fn with_simd(level: SimdLevel) -> Result<Self, SimdLevelError> {
        let token = level.token().ok_or(SimdLevelError::Unsupported(level))?;
        Ok(Self { token, points: Vec::new() })
    }

    /// Paints the meshes one after the other, and each one's triangles in the
    /// order of its indices.
    pub fn paint(&mut self, canvas: &mut Canvas<'_>, meshes: &[Mesh<'_>]) -> Painted {
        let mut painted = Painted::default();
        for mesh in meshes {
            let clip = mesh.scissor.intersection(canvas.bounds());
            if clip.is_empty() {
                continue;
            }
            let points = &mut self.points;
            points.clear();
            at_level!(self.token, simd => {
                points.extend(mesh.vertices.iter().map(snap));
                paint_mesh(simd, canvas, mesh, points, clip, &mut painted);
            });
        }
        painted
    }
}

/// Paints one mesh inside `clip`, which is inside the canvas.
#[inline(always)]
fn paint_mesh<S: Simd>(
    simd: S,
    canvas: &mut Canvas<'_>,
    mesh: &Mesh<'_>,
    points: &[Option<FixedPoint>],
    clip: Rect,
    painted: &mut Painted,
) {
    let mut texels = MeshTexels::new(mesh.image);
    let mut triangles = triangles(mesh, points).peekable();
    while let Some(corners) = triangles.next() {
        painted.triangles += 1;
        let Some(corners) = corners else {
            painted.refused += 1;
            continue;
        };
        if let Some(Some(next)) = triangles.peek()
            && paint_rectangle(simd, canvas, [&corners, next], &mut texels, clip)
        {
            triangles.next();
            painted.triangles += 1;
            painted.in_rectangles += 2;
            continue;
        }
        let corners = sorted(corners);
        match texels.source(simd, &corners) {
            Some(source) => paint_triangle(simd, canvas, &corners, &source, clip),
            None => painted.refused += 1,
        }
    }
}

/// Paints two triangles at once; false if they are not halves of a rectangle
/// with one colour, or with texels one to one.
#[inline(always)]
fn paint_rectangle<S: Simd>(
    simd: S,
    canvas: &mut Canvas<'_>,
    halves: [&[SnappedVertex; 3]; 2],
    texels: &mut MeshTexels<'_>,
    clip: Rect,
) -> bool {
    let Some(rectangle) = Rectangle::from_halves(halves) else { return false };
    let pixels = rectangle.pixels().intersection(clip);
    if let Some(flat) = texels.flat(simd, halves[0])
        && texels.flat(simd, halves[1]) == Some(flat)
    {
        if !pixels.is_empty() {
            for y in pixels.min[1]..pixels.max[1] {
                flat.paint(simd, canvas.span(y, pixels.min[0]..pixels.max[0]));
            }
        }
        return true;
    }
    let Some(image) = texels.image() else { return false };
    let Some(offset) = rectangle.texel_offset(halves, image, pixels) else { return false };
    blit(simd, canvas, pixels, image, offset, rectangle.color);
    true
}

/// Paints a triangle's pixels inside `clip`.
#[inline(always)]
fn paint_triangle<S: Simd>(
    simd: S,
    canvas: &mut Canvas<'_>,
    corners: &[SnappedVertex; 3],
    source: &Source<'_>,
    clip: Rect,
) {
    let Some(triangle) = Triangle::new(corners.map(|corner| corner.point)) else { return };
    match *source {
        Source::Flat(flat) => triangle.spans(
            clip,
            #[inline(always)]
            |y, span| {
                let [start, end] = [span.start.max(clip.min[0]), span.end.min(clip.max[0])];
                if start < end {
                    flat.paint(simd, canvas.span(y, start..end));
                }
            },
        ),
        Source::Gradient(colors, texture) => {
            let gradient = Gradient::new(&triangle, colors, texture);
            triangle.spans(
                clip,
                #[inline(always)]
                |y, span| gradient.paint(simd, canvas, clip, y, span),
            );
        }
    }
}

/// By y, then by x: no image depends on which vertex is the first.
#[inline(always)]
fn sorted([a, b, c]: [SnappedVertex; 3]) -> [SnappedVertex; 3] {
    let key = |corner: &SnappedVertex| (corner.point.y, corner.point.x);
    let pair = |a: SnappedVertex, b: SnappedVertex| if key(&b) < key(&a) { (b, a) } else { (a, b) };
    let (a, b) = pair(a, b);
    let (b, c) = pair(b, c);
    let (a, b) = pair(a, b);
    [a, b, c]
}
