//! Screen positions of objects' points, in f64.
//!
//! Objects are placed as the renderer places objects: transforms are made relative to the camera before anything is
//! multiplied. Depth is that of the depth buffer, which is linear across the screen: 1 on the near plane, 0 on the far
//! plane or at infinity.

use fearless_simd::f64x8;
use trigon_camera::{Camera, Viewport};
use trigon_math::{DAffine3, DMat4, DVec2, DVec3, DVec4};
use trigon_raster::simd::{InlineMap, LANES, Simd, inlined, lanes_of, prelude::*};

use crate::render::placement::Eye;

/// How much nearer a face must be to hide a point, in pixel widths at the point's distance.
/// Anything closer touches it: positions are rounded to f32, so a vertex on another face would be
/// in front or behind at random.
const TOUCHING: f64 = 1e-3;

/// A camera and an image's size.
pub(super) struct Screen {
    pub(super) eye: Eye,
    projection: DMat4,
    half_size: DVec2,
    /// A pixel's width, times [`TOUCHING`]: at a distance of one metre in a perspective,
    /// at any distance in a parallel projection.
    touching: f64,
    is_parallel: bool,
}

/// A point on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Spot {
    /// Pixels.
    pub(super) at: DVec2,
    /// Larger is nearer.
    pub(super) depth: f64,
}

/// Eight points on the screen: x, y and depth.
pub(super) struct Spots<S: Simd>(pub(super) [f64x8<S>; 3]);

impl<S: Simd> Spots<S> {
    #[inline(always)]
    pub(super) fn of(simd: S, spots: &[Spot; LANES]) -> Self {
        let x = lanes_of(|lane| spots[lane].at.x);
        let y = lanes_of(|lane| spots[lane].at.y);
        let depth = lanes_of(|lane| spots[lane].depth);
        Self([x, y, depth].each(
            #[inline(always)]
            |values| f64x8::simd_from(simd, values),
        ))
    }

    #[inline(always)]
    pub(super) fn each(&self) -> [Spot; LANES] {
        let [x, y, depth]: [[f64; LANES]; 3] = self.0.each(
            #[inline(always)]
            |values| values.into(),
        );
        lanes_of(
            #[inline(always)]
            |lane| Spot { at: DVec2::new(x[lane], y[lane]), depth: depth[lane] },
        )
    }
}

/// What the near plane leaves of a triangle on the screen.
pub(super) struct ClippedTriangle {
    corners: [Spot; 4],
    count: usize,
}

impl Spot {
    /// A point that is not on the screen.
    const NOWHERE: Self = Self { at: DVec2::NAN, depth: f64::NAN };

    /// Whether it lies beyond the near plane.
    pub(super) fn is_somewhere(&self) -> bool {
        !self.depth.is_nan()
    }

    /// Whether it lies between the near and the far plane.
    pub(super) fn is_in_range(&self) -> bool {
        self.depth >= 0.0
    }

    /// The point at a share of the way to another one.
    pub(super) fn towards(&self, other: &Self, share: f64) -> Self {
        Self {
            at: self.at + (other.at - self.at) * share,
            depth: self.depth + (other.depth - self.depth) * share,
        }
    }
}

impl Screen {
    pub(super) fn new(camera: &Camera, viewport: Viewport) -> Self {
        let aspect = viewport.aspect();
        let pixel = camera.projection.height_at(1.0) / f64::from(viewport.height.max(1));
        Self {
            eye: Eye::new(camera, aspect),
            projection: camera.projection.matrix(aspect),
            half_size: viewport.size() * 0.5,
            touching: TOUCHING * pixel,
            is_parallel: camera.projection.is_orthographic(),
        }
    }

    /// How many pixels the image has.
    pub(super) fn pixel_count(&self) -> usize {
        let size = self.half_size * 2.0;
        size.x as usize * size.y as usize
    }

    /// Half of the image's size, in pixels.
    pub(super) fn half_size(&self) -> DVec2 {
        self.half_size
    }

    /// The map of an object's points to clip space.
    pub(super) fn map(&self, world: &DAffine3) -> DMat4 {
        self.projection * DMat4::from(self.eye.to_camera(world))
    }

    /// Where a point of an object is.
    pub(super) fn spot(&self, map: &DMat4, point: DVec3) -> Spot {
        self.project(*map * point.extend(1.0))
    }

    /// The same of several points, given by their x, y and z: all at once, with the same bits.
    #[inline(always)]
    pub(super) fn spots<S: Simd>(&self, simd: S, map: &DMat4, points: [[f32; LANES]; 3]) -> Spots<S> {
        let splat = inlined(
            #[inline(always)]
            |value: f64| f64x8::splat(simd, value),
        );
        let [x, y, z] = points.each(
            #[inline(always)]
            |values| f64x8::simd_from(simd, lanes_of(|lane| f64::from(values[lane]))),
        );
        let columns = map.to_cols_array_2d();
        let [x, y, z, w] = [0, 1, 2, 3].each(
            #[inline(always)]
            |row: usize| {
                x * splat(columns[0][row])
                    + y * splat(columns[1][row])
                    + z * splat(columns[2][row])
                    + splat(columns[3][row])
            },
        );
        let (zero, one, most) = (splat(0.0), splat(1.0), splat(f64::INFINITY));
        let is_finite =
            x.abs().simd_lt(most) & y.abs().simd_lt(most) & z.abs().simd_lt(most) & w.abs().simd_lt(most);
        let is_somewhere = is_finite & (w - z).simd_ge(zero);
        let values =
            [(one + x / w) * splat(self.half_size.x), (one - y / w) * splat(self.half_size.y), z / w];
        Spots(values.each(
            #[inline(always)]
            |value| is_somewhere.select(value, splat(f64::NAN)),
        ))
    }

    /// From clip space; nowhere before the near plane.
    fn project(&self, clip: DVec4) -> Spot {
        let is_somewhere = clip.is_finite() && beyond_near(clip) >= 0.0;
        if !is_somewhere {
            return Spot::NOWHERE;
        }
        let x = (1.0 + clip.x / clip.w) * self.half_size.x;
        let y = (1.0 - clip.y / clip.w) * self.half_size.y;
        Spot { at: DVec2::new(x, y), depth: clip.z / clip.w }
    }

    /// The depth that hides a point of this depth.
    pub(super) fn hiding_depth(&self, depth: f64) -> f64 {
        let scale = self.projection.z_axis.z;
        if self.is_parallel {
            return depth + scale * self.touching;
        }
        // depth = offset / distance - scale, and the distance becomes smaller by a factor.
        let factor = 1.0 - self.touching;
        if factor > 0.0 { (depth + scale) / factor - scale } else { f64::INFINITY }
    }

    /// Where a line passes through the near plane. From inside to outside, so that neighbours find the same
    /// point.
    fn cut(&self, inside: DVec4, outside: DVec4) -> DVec4 {
        let [near, far] = [inside, outside].map(beyond_near);
        let cut = inside + (outside - inside) * (near / (near - far));
        // On the plane, whatever was rounded: z and w are the same there. In a perspective w is what is left of
        // large numbers, and z is nearly constant; in a parallel projection w is 1.
        let plane = if self.is_parallel { cut.w } else { cut.z };
        DVec4 { z: plane, w: plane, ..cut }
    }

    /// What is beyond the near plane of the line between two points.
    pub(super) fn cut_line(&self, map: &DMat4, ends: [DVec3; 2]) -> Option<[Spot; 2]> {
        let clip = ends.map(|end| *map * end.extend(1.0));
        let spots = match clip.map(|end| beyond_near(end) >= 0.0) {
            [true, true] => clip.map(|end| self.project(end)),
            [true, false] => [clip[0], self.cut(clip[0], clip[1])].map(|end| self.project(end)),
            [false, true] => [self.cut(clip[1], clip[0]), clip[1]].map(|end| self.project(end)),
            [false, false] => return None,
        };
        spots.iter().all(Spot::is_somewhere).then_some(spots)
    }

    /// What is beyond the near plane of a triangle.
    pub(super) fn cut_triangle(&self, map: &DMat4, corners: [DVec3; 3]) -> ClippedTriangle {
        let mut piece = ClippedTriangle { corners: [Spot::NOWHERE; 4], count: 0 };
        let clip = corners.map(|corner| *map * corner.extend(1.0));
        for (from, to) in [(clip[2], clip[0]), (clip[0], clip[1]), (clip[1], clip[2])] {
            match [from, to].map(|corner| beyond_near(corner) >= 0.0) {
                [true, true] => piece.push(self.project(to)),
                [true, false] => piece.push(self.project(self.cut(from, to))),
                [false, true] => {
                    piece.push(self.project(self.cut(to, from)));
                    piece.push(self.project(to));
                }
                [false, false] => {}
            }
        }
        // A corner that is no number spoils all of it.
        if !piece.corners().iter().all(Spot::is_somewhere) {
            piece.count = 0;
        }
        piece
    }
}

/// The ends of a line, that first which is nearer to the image's corner. Where the near plane cuts a line, its other
/// end is 10³⁰ pixels away: a share of the way counts from the first, of which nothing is lost beside the other.
pub(super) fn nearer_first<T>(ends: [T; 2], at: impl Fn(&T) -> DVec2) -> [T; 2] {
    let [from, to] = [&ends[0], &ends[1]].map(|end| at(end).abs().max_element());
    let [start, end] = ends;
    if from > to { [end, start] } else { [start, end] }
}

/// How far a point of clip space is beyond the near plane; negative before it.
fn beyond_near(clip: DVec4) -> f64 {
    clip.w - clip.z
}

/// Twice the area of a triangle on the screen, with the sign of its winding. Counted from a corner that is not far
/// outside the image: beside 10²⁵ pixels nothing is left of the others.
#[inline]
pub(super) fn doubled_area([a, b, c]: [DVec2; 3]) -> f64 {
    /// In pixels.
    const FAR: f64 = 1e6;
    let is_near = |corner: DVec2| corner.abs().max_element() < FAR;
    if is_near(a) || !(is_near(b) || is_near(c)) {
        (b - a).perp_dot(c - a)
    } else if is_near(b) {
        (c - b).perp_dot(a - b)
    } else {
        (a - c).perp_dot(b - c)
    }
}

impl ClippedTriangle {
    fn push(&mut self, spot: Spot) {
        if let Some(slot) = self.corners.get_mut(self.count) {
            *slot = spot;
            self.count += 1;
        }
    }

    pub(super) fn corners(&self) -> &[Spot] {
        &self.corners[..self.count]
    }

    /// It as triangles.
    pub(super) fn triangles(&self) -> impl Iterator<Item = [Spot; 3]> + '_ {
        let [first, ..] = self.corners;
        let sides = self.corners().windows(2).skip(1);
        sides.map(move |side| [first, side[0], side[1]])
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::Vec3;
    use trigon_math::at_level;
    use trigon_math::simd::Token;

    use super::*;

    proptest! {
        #[test]
        fn points_that_are_placed_together_are_where_each_is_alone(
            points in prop::array::uniform8(prop::array::uniform3(prop_oneof![
                8 => -9.0..9.0_f32, 1 => -1e30..1e30_f32, 1 => Just(f32::NAN), 1 => Just(f32::INFINITY)
            ])),
            eye in -5.0..5.0_f64,
        ) {
            let camera = Camera::look_at(DVec3::new(eye, 0.5, 3.0), DVec3::ZERO, DVec3::Y);
            let screen = Screen::new(&camera, Viewport { width: 200, height: 100 });
            let map = screen.map(&DAffine3::from_scale(DVec3::new(1.0, -0.7, 2.0)));
            let columns = [0, 1, 2].map(|axis| points.map(|point| point[axis]));
            let together = at_level!(Token::best(), simd => screen.spots(simd, &map, columns).each());
            for (point, spot) in points.iter().zip(together) {
                let alone = screen.spot(&map, Vec3::from_array(*point).as_dvec3());
                let bits = |spot: Spot| [spot.at.x, spot.at.y, spot.depth].map(f64::to_bits);
                prop_assert!(
                    bits(alone) == bits(spot) || !(alone.is_somewhere() || spot.is_somewhere()),
                    "{point:?}: {alone:?} and {spot:?}"
                );
            }
        }
    }
}
