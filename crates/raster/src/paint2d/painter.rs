//! Paints meshes on a canvas in the given order. Two triangles that form an upright rectangle of one colour are painted
//! at once ([`Rectangle`]): panels, and the quads of glyphs and images.

use super::blend::blit;
use super::source::{MeshTexels, SnappedVertex, Source, snap, triangles};
use super::triangle::{Gradient, Triangle, first_center};
use super::{Canvas, Image, Mesh, Rect};
use crate::simd::{SimdLevel, SimdLevelError, Token, at_level, prelude::*};
use trigon_math::{Fixed, FixedPoint};

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

/// An upright rectangle of one colour.
#[derive(Clone, Copy, Debug)]
struct Rectangle {
    min: FixedPoint,
    max: FixedPoint,
    color: [u8; 4],
}

/// Which corner of a rectangle: bit 0 for the right side, bit 1 for the bottom.
type Code = usize;

impl Rectangle {
    /// The rectangle that two triangles are halves of.
    #[inline(always)]
    fn from_halves([a, b]: [&[SnappedVertex; 3]; 2]) -> Option<Self> {
        let [x, y] = [a.map(|corner| corner.point.x), a.map(|corner| corner.point.y)];
        let least = |[a, b, c]: [Fixed; 3]| a.min(b).min(c);
        let most = |[a, b, c]: [Fixed; 3]| a.max(b).max(c);
        let min = FixedPoint::new(least(x), least(y));
        let max = FixedPoint::new(most(x), most(y));
        let rectangle = Self { min, max, color: a[0].color };
        // Opposite corners are missing: 0 and 3, or 1 and 2.
        let halves = rectangle.missing_corner(a)? + rectangle.missing_corner(b)? == 3;
        let same_color = a.iter().chain(b).all(|corner| corner.color == rectangle.color);
        (halves && same_color).then_some(rectangle)
    }

    /// The one corner that is none of three different ones.
    #[inline(always)]
    fn missing_corner(&self, corners: &[SnappedVertex; 3]) -> Option<Code> {
        let [a, b, c] =
            [self.code(corners[0].point)?, self.code(corners[1].point)?, self.code(corners[2].point)?];
        (a != b && b != c && c != a).then(|| 6 - a - b - c)
    }

    #[inline(always)]
    fn code(&self, point: FixedPoint) -> Option<Code> {
        let side = |v: Fixed, min: Fixed, max: Fixed| {
            if v == min { Some(0) } else { (v == max).then_some(1) }
        };
        Some(side(point.x, self.min.x, self.max.x)? + 2 * side(point.y, self.min.y, self.max.y)?)
    }

    /// The pixels whose centres are inside, or on the left or the upper side.
    fn pixels(&self) -> Rect {
        let corner = |point: FixedPoint| [first_center(point.x), first_center(point.y)];
        Rect::new(corner(self.min), corner(self.max))
    }

    /// How far the texel of each pixel is from the pixel, if the centres of all
    /// `pixels` are at centres of texels of the image: as it is for glyphs.
    #[inline(always)]
    fn texel_offset(
        &self,
        halves: [&[SnappedVertex; 3]; 2],
        image: &Image,
        pixels: Rect,
    ) -> Option<[i32; 2]> {
        let size = image.bounds().max;
        let offset = [whole_offset(halves, 0, size[0])?, whole_offset(halves, 1, size[1])?];
        let moved =
            |pixel: [i32; 2]| Some([pixel[0].checked_add(offset[0])?, pixel[1].checked_add(offset[1])?]);
        let texels = Rect::new(moved(pixels.min)?, moved(pixels.max)?);
        image.bounds().contains(texels).then_some(offset)
    }
}

/// How many texels all corners' texel positions are ahead of their positions in pixels on an axis,
/// if it is the same whole number for all.
#[inline(always)]
fn whole_offset(halves: [&[SnappedVertex; 3]; 2], axis: usize, size: i32) -> Option<i32> {
    /// In texels: half of the distance that the painter of triangles rounds to the centre of a texel, so that
    /// both find the same texel.
    const NEAR: f64 = 1.0 / 16384.0;
    let offset = |corner: &SnappedVertex| {
        let position = if axis == 0 { corner.point.x } else { corner.point.y };
        f64::from(corner.uv[axis]) * f64::from(size) - position.to_f64()
    };
    // NaN becomes 0, and is not near it.
    let whole = offset(&halves[0][0]).round_ties_even() as i32;
    let near = |corner: &SnappedVertex| (offset(corner) - f64::from(whole)).abs() <= NEAR;
    (halves[0].iter().all(near) && halves[1].iter().all(near)).then_some(whole)
}
