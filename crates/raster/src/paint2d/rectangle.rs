//! Two triangles that form an upright rectangle of one colour: panels, and the quads of glyphs and images.

use super::corner::SnappedVertex;
use super::coverage::first_center;
use super::{Image, Rect};
use trigon_math::{Fixed, FixedPoint};

/// An upright rectangle of one colour.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rectangle {
    min: FixedPoint,
    max: FixedPoint,
    pub(super) color: [u8; 4],
}

/// Which corner of a rectangle: bit 0 for the right side, bit 1 for the bottom.
type Code = usize;

impl Rectangle {
    /// The rectangle that two triangles are halves of.
    #[inline(always)]
    pub(super) fn from_halves([a, b]: [&[SnappedVertex; 3]; 2]) -> Option<Self> {
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
    pub(super) fn pixels(&self) -> Rect {
        let corner = |point: FixedPoint| [first_center(point.x), first_center(point.y)];
        Rect::new(corner(self.min), corner(self.max))
    }

    /// How far the texel of each pixel is from the pixel, if the centres of all
    /// `pixels` are at centres of texels of the image: as it is for glyphs.
    #[inline(always)]
    pub(super) fn texel_offset(
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
