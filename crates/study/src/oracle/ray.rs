//! Visibility by rays and brute force: corners are not projected, snapped or clipped, and there are no edge
//! functions.
//!
//! The ray through the image at (X, Y) hits a triangle where (X, Y, 1) is a weighted sum of its corners' (x,
//! y, w). The weights decide whether the hit is inside, and give the depth. All of them are linear in X and Y
//! (M. Olano and T. Greer, *Triangle scan conversion using 2D homogeneous coordinates*, Graphics Hardware
//! 1997), so corners at the eye or behind it are not special cases. The arithmetic has 106 bits, because
//! `f64` leaves too few for corners a million pixels away.

use super::DoubleDouble;
use trigon_math::{DVec2, UVec2, Vec4};

/// A linear function on the image: `x`, `y` and 1 in pixels times these.
type Linear = [DoubleDouble; 3];

/// A triangle in clip space, seen on an image.
#[derive(Clone, Debug)]
pub struct Facet {
    /// The weights of the corners along a ray, not negative inside. Zero on the edges, and also if the eye
    /// lies in the triangle's plane and so sees nothing of it.
    shares: [Linear; 3],
    /// The depth z/w of the hit.
    depth: Linear,
    is_cut: bool,
    is_visible: bool,
}

impl Facet {
    /// A triangle in reversed-Z clip space on an image of `size` pixels. Its corners
    /// are finite and have z ≥ 0, so that what lies behind the eye lies before the
    /// near plane, z = w, too.
    #[must_use]
    pub fn new(corners: [Vec4; 3], size: UVec2) -> Self {
        let [a, b, c] = corners.map(|v| [v.x, v.y, v.w].map(DoubleDouble::from));
        let volume = dot(a, cross(b, c));
        let is_visible = volume != DoubleDouble::ZERO;
        let share = |u, v| cross(u, v).map(|term| if is_visible { term / volume } else { term });
        let shares = [share(b, c), share(c, a), share(a, b)].map(|share| in_pixels(share, size));
        let of_axis = |axis: usize| {
            let terms = (0..3).map(|i| shares[i][axis] * corners[i].z.into());
            terms.fold(DoubleDouble::ZERO, |sum, term| sum + term)
        };
        let is_cut = is_visible && corners.iter().any(|corner| corner.z > corner.w);
        Self { shares, depth: [0, 1, 2].map(of_axis), is_cut, is_visible }
    }

    /// The depth z/w where the ray through a point in pixels hits the triangle, between the near plane and
    /// infinity.
    #[must_use]
    pub fn meets(&self, point: DVec2) -> Option<f64> {
        let depth = at(self.depth, point);
        let inside = self.shares.iter().all(|&share| at(share, point) >= DoubleDouble::ZERO);
        (self.is_visible && inside && depth <= DoubleDouble::from(1.0_f64)).then(|| depth.to_f64())
    }

    /// The distance of a point from the lines through the triangle's edges and from the line where the near
    /// plane cuts it, in pixels: never more than to its outline.
    #[must_use]
    pub fn distance_to_outline(&self, point: DVec2) -> f64 {
        let [x, y, one] = self.depth;
        let before_near = [x, y, one - DoubleDouble::from(1.0_f64)];
        let cut = self.is_cut.then_some(before_near);
        let lines = self.shares.into_iter().chain(cut);
        lines.map(|line| distance(line, point)).fold(f64::INFINITY, f64::min)
    }

    /// By how much the depth changes along a pixel's width and height together.
    #[must_use]
    pub fn steepness(&self) -> f64 {
        let [x, y, _] = self.depth.map(|slope| slope.to_f64().abs());
        x + y
    }
}

/// The tolerance of a drawn image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Of outlines, in pixels.
    pub outline: f64,
    /// Of depths, in addition to the change that a displacement by `outline` causes.
    pub depth: f64,
}

/// What is visible at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sight {
    /// No triangle.
    Nothing,
    /// The triangle of this number, certainly.
    Triangle(usize),
    /// Ambiguous within the tolerance.
    Unclear,
}

/// The first hit of a ray through a point in pixels.
#[must_use]
pub fn first_met(facets: &[Facet], point: DVec2, tolerance: Tolerance) -> Sight {
    if facets.iter().any(|facet| facet.distance_to_outline(point) <= tolerance.outline) {
        return Sight::Unclear;
    }
    let met =
        || facets.iter().enumerate().filter_map(|(number, facet)| Some((facet.meets(point)?, facet, number)));
    let Some((nearest, first, number)) = met().max_by(|(a, ..), (b, ..)| a.total_cmp(b)) else {
        return Sight::Nothing;
    };
    let slack = |facet: &Facet| facet.steepness() * tolerance.outline + tolerance.depth;
    let is_clear = |(depth, facet, other)| other == number || nearest - depth > slack(first) + slack(facet);
    if met().all(is_clear) { Sight::Triangle(number) } else { Sight::Unclear }
}

/// A linear function of X and Y from -1 to 1, Y up, as one of pixels, y down.
fn in_pixels([x, y, one]: Linear, size: UVec2) -> Linear {
    let pixel = |size: u32| DoubleDouble::from(2.0_f64) / f64::from(size).into();
    [x * pixel(size.x), -(y * pixel(size.y)), one - x + y]
}

fn at([x, y, one]: Linear, point: DVec2) -> DoubleDouble {
    x * point.x.into() + y * point.y.into() + one
}

/// Infinite for a line at infinity; 0 for a degenerate line, such as an edge that is seen as a point.
fn distance(line: Linear, point: DVec2) -> f64 {
    let slope = DVec2::new(line[0].to_f64(), line[1].to_f64());
    let distance = at(line, point).abs().to_f64() / slope.length();
    if distance.is_nan() { 0.0 } else { distance }
}

fn dot(a: Linear, b: Linear) -> DoubleDouble {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Linear, b: Linear) -> Linear {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: UVec2 = UVec2::new(64, 32);

    const EXACT: Tolerance = Tolerance { outline: 1e-9, depth: 0.0 };

    /// In the plane at distance `w`, from the points' places on the image.
    fn facing(points: [[f32; 2]; 3], w: f32) -> [Vec4; 3] {
        points.map(|[x, y]| Vec4::new((x / 32.0 - 1.0) * w, (1.0 - y / 16.0) * w, 0.25, w))
    }

    #[test]
    fn a_facing_triangle_is_where_its_corners_are() {
        let facet = Facet::new(facing([[8.0, 4.0], [40.0, 4.0], [8.0, 28.0]], 0.5), SIZE);
        assert_eq!(facet.meets(DVec2::new(9.0, 5.0)), Some(0.5), "inside, at depth near / w");
        for outside in [DVec2::new(7.0, 5.0), DVec2::new(9.0, 3.0), DVec2::new(30.0, 20.0)] {
            assert_eq!(facet.meets(outside), None, "at {outside}");
        }
        assert_eq!(facet.distance_to_outline(DVec2::new(10.0, 7.0)), 2.0, "from the left edge");
        assert_eq!(facet.distance_to_outline(DVec2::new(10.0, 5.0)), 1.0, "from the upper edge");
        assert_eq!(facet.steepness(), 0.0, "no slope");
    }

    /// The ground one below the eye, from behind it to infinity: below the horizon,
    /// and not nearer than the near plane, 0.25, where y / w = -4.
    #[test]
    fn ground_through_the_eye_lies_below_the_horizon() {
        let far = 1e6;
        let ground = [[-far, -far], [far, -far], [0.0, far]].map(|[x, w]| Vec4::new(x, -1.0, 0.25, w));
        let facet = Facet::new(ground, UVec2::new(64, 640));
        let depth_at = |y| facet.meets(DVec2::new(32.0, y));
        assert_eq!((depth_at(319.9), depth_at(0.0)), (None, None), "the sky");
        let depth = depth_at(480.0).expect("the ground, two ahead, where y / w = -1/2");
        assert!((depth - 0.125).abs() < 1e-15, "{depth} is near / w");
        let few = Facet::new(ground.map(|v| v.with_z(1.0)), UVec2::new(64, 640));
        let [before, behind] = [640.1, 639.9].map(|y| few.meets(DVec2::new(32.0, y)));
        assert!(before.is_none() && behind.is_some(), "cut at the near plane");
        let distance = few.distance_to_outline(DVec2::new(32.0, 600.0));
        assert!((distance - 40.0).abs() < 1e-9, "which is an outline, {distance} away");
    }

    #[test]
    fn a_plane_through_the_eye_is_not_seen() {
        let facet =
            Facet::new([[0.5, 1.0], [0.0, 2.0], [1.0, -1.0]].map(|[x, w]| Vec4::new(x, x, 0.25, w)), SIZE);
        for y in 0..33 {
            let point = DVec2::new(f64::from(2 * y), f64::from(32 - y));
            assert_eq!((facet.meets(point), facet.distance_to_outline(point)), (None, 0.0), "edge on");
        }
        assert!(facet.distance_to_outline(DVec2::new(2.0, 2.0)) > 20.0, "off the line that it is seen as");
    }

    #[test]
    fn the_nearest_is_met_and_doubt_is_told() {
        let full = [[-64.0, -64.0], [256.0, -64.0], [-64.0, 256.0]];
        let [near, far] = [1.0, 2.0].map(|w| Facet::new(facing(full, w), SIZE));
        let small = Facet::new(facing([[8.0, 4.0], [16.0, 4.0], [8.0, 12.0]], 0.5), SIZE);
        let facets = [far, near, small];
        let visible = |x, y, tolerance| first_met(&facets, DVec2::new(x, y), tolerance);
        assert_eq!(visible(20.0, 20.0, EXACT), Sight::Triangle(1), "the nearer of two");
        assert_eq!(visible(9.0, 5.0, EXACT), Sight::Triangle(2), "the nearest of three");
        assert_eq!(
            visible(9.0, 5.0, Tolerance { depth: 0.2, ..EXACT }),
            Sight::Unclear,
            "1/2 and 1/4 are 0.25 apart"
        );
        assert_eq!(visible(8.01, 5.0, Tolerance { outline: 0.02, ..EXACT }), Sight::Unclear, "at an edge");
        assert_eq!(first_met(&[], DVec2::ZERO, EXACT), Sight::Nothing, "no triangles");
    }

    /// In f64 what is left of the edge function here would be rounding alone.
    #[test]
    fn needles_from_far_outside_are_as_sharp_as_any() {
        let needle = [[-1e7, 16.0], [1e7, 16.0], [1e7, 16.5]];
        let facet = Facet::new(needle.map(|[x, y]| Vec4::new(x, y, 0.5, 32.0)), SIZE);
        // y / w from 1/2 to 1/2 + 1/64 at the right end; in the middle half of that.
        let middle = 8.0 - 1.0 / 8.0;
        assert!(facet.meets(DVec2::new(32.0, middle + 1e-6)).is_some(), "just inside");
        assert!(facet.meets(DVec2::new(32.0, middle - 1e-6)).is_none(), "just above it");
        assert!(facet.meets(DVec2::new(32.0, 8.0 + 1e-6)).is_none(), "just below it");
    }
}
