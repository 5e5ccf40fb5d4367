//! Fitting a camera to a model so that it fills the image, and placing the near and far planes
//! around it.
//!
//! Points are fitted as they are projected (all vertices of a model, or the eight corners of a
//! box), not a bounding sphere: a tall tower fills the height of the image. The target stays the
//! centre of the box around them, so that an orbiting camera does not wobble. Everything scales
//! with the box: a model of 10⁻⁶ and one of 10²⁰ give the same image.

use trigon_math::{Bounds3, DQuat, DVec2, DVec3};

use crate::clip_map::Kind;
use crate::{Camera, Projection, orientation_looking};

/// The default fraction of the image that stays empty around a fitted model: 10 %.
pub const DEFAULT_MARGIN: f64 = 0.1;

/// Larger margins are clamped to this, since nothing would be left of the model.
const LARGEST_MARGIN: f64 = 0.95;

/// Half the size used for an empty box.
const UNIT_RADIUS: f64 = 0.5;

/// A box smaller than this fraction of its distance from the origin is treated as this large: below
/// it, f64 could not move an eye around it smoothly.
const SMALLEST_RELATIVE_RADIUS: f64 = 1e-12;

/// Larger boxes count as unusable: squares of lengths would overflow.
const LARGEST_COORDINATE: f64 = 1e150;

/// The eye keeps at least this fraction of the radius away from the box.
const CLEARANCE: f64 = 0.05;

/// An eye within the box has its near plane at this fraction of the farthest distance, 2⁻⁹⁰ or
/// 8·10⁻²⁸: right before itself. Reversed depth keeps its relative precision at any distance, so a near
/// plane costs nothing for being near; depths only have to stay normal numbers of f32. They do up to
/// 2³⁶ times as far as the box.
const NEAREST: f64 = 1.0 / (1_u128 << 90) as f64;

/// The least near plane, in metres, 2⁻⁸⁰: the rasterizer draws nothing that is nearer to the eye.
const LEAST_NEAR: f64 = 1.0 / (1_u128 << 80) as f64;

/// Planes keep this fraction of the depth range away from the box.
const SLACK: f64 = 0.01;

/// A bounding box for fitting: always usable, whatever the bounds were.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    center: DVec3,
    half: DVec3,
    radius: f64,
}

impl Extent {
    /// The extent of these bounds. Empty or unusable bounds (not finite, or
    /// beyond 10¹⁵⁰) count as a box of size 1 about the origin, and a single
    /// point as a small neighbourhood of it.
    #[must_use]
    pub fn new(bounds: &Bounds3) -> Self {
        let usable = |v: DVec3| v.is_finite() && v.abs().max_element() < LARGEST_COORDINATE;
        let ordered = bounds.min.cmple(bounds.max).all();
        if !ordered || !usable(bounds.min) || !usable(bounds.max) {
            return Self { center: DVec3::ZERO, half: DVec3::splat(UNIT_RADIUS), radius: UNIT_RADIUS };
        }
        let center = bounds.min * 0.5 + bounds.max * 0.5;
        let half = (bounds.max - bounds.min) * 0.5;
        let smallest = center.abs().max_element() * SMALLEST_RELATIVE_RADIUS;
        let radius = match half.length() {
            radius if radius > smallest && radius > f64::MIN_POSITIVE => radius,
            _ if smallest > f64::MIN_POSITIVE => smallest,
            _ => UNIT_RADIUS,
        };
        Self { center, half, radius }
    }

    /// The centre of the box.
    #[must_use]
    pub fn center(&self) -> DVec3 {
        self.center
    }

    /// Half of the diagonal; always greater than 0.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The eight corners, relative to the centre.
    pub(crate) fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|i| {
            let sign = |bit: usize| if i >> bit & 1 == 0 { -1.0 } else { 1.0 };
            self.half * DVec3::new(sign(0), sign(1), sign(2))
        })
    }

    /// The finite points, relative to the centre.
    pub(crate) fn offsets<'a>(&'a self, points: &'a [DVec3]) -> impl Iterator<Item = DVec3> + 'a {
        points.iter().filter(|point| point.is_finite()).map(|&point| point - self.center)
    }

    /// The extent of the box in front of and behind the plane through the eye, along `forward`:
    /// (nearest, farthest).
    fn depth_range(&self, eye: DVec3, forward: DVec3) -> (f64, f64) {
        let middle = (self.center - eye).dot(forward);
        let reach = forward.abs().dot(self.half);
        (middle - reach, middle + reach)
    }
}

impl Camera {
    /// A camera with this one's projection that looks along `direction` at the centre of `bounds`. At its
    /// distance the whole box is in the image, and `margin` of the image's width or height stays empty (0.1
    /// is a tenth; clamped to 0 … 0.95). A parallel projection gets the corresponding height. The near and
    /// far planes are set around the box.
    ///
    /// Degenerate input also gives a valid camera: see [`Extent::new`] for bounds and
    /// [`orientation_looking`] for `direction` and `up`.
    #[must_use]
    pub fn fit(&self, bounds: &Bounds3, direction: DVec3, up: DVec3, aspect: f64, margin: f64) -> Self {
        let extent = Extent::new(bounds);
        let shot = Shot { projection: &self.projection, orientation: orientation_looking(direction, up) };
        let fitted = fit_distance(shot, &extent, extent.corners().into_iter(), aspect, margin);
        self.fitted(shot.orientation, &extent, fitted).with_clip_planes(bounds)
    }

    /// As [`Camera::fit`], but fitted to points instead of the box around them: a ball fills the
    /// image as well as a cube does. The camera still looks at the centre of the box. Points that
    /// are not finite are skipped.
    #[must_use]
    pub fn fit_points(
        &self,
        points: &[DVec3],
        direction: DVec3,
        up: DVec3,
        aspect: f64,
        margin: f64,
    ) -> Self {
        let bounds = finite_bounds(points);
        let extent = Extent::new(&bounds);
        let shot = Shot { projection: &self.projection, orientation: orientation_looking(direction, up) };
        let fitted = fit_distance(shot, &extent, extent.offsets(points), aspect, margin);
        self.fitted(shot.orientation, &extent, fitted).with_clip_planes(&bounds)
    }

    /// The position of the camera for the result of [`fit_distance`].
    fn fitted(&self, orientation: DQuat, extent: &Extent, fitted: f64) -> Self {
        let (projection, away) = match self.projection {
            // Only the height is fitted; the eye is placed clear of the box.
            Projection::Orthographic { near, far, .. } => {
                (Projection::Orthographic { height: fitted, near, far }, 2.0 * extent.radius)
            }
            other => (other, fitted),
        };
        let position = extent.center - orientation * sight(&projection, away);
        Self { position, orientation, projection }
    }

    /// The same camera with its near and far planes just around these bounds, so that nothing in
    /// front of the eye is cut. An infinite far plane stays infinite. In a perspective the near plane
    /// of an eye within the bounds, or beside them, is right before it: at 2⁻⁹⁰ of the distance to the
    /// farthest point, and at least at 2⁻⁸⁰ m.
    #[must_use]
    pub fn with_clip_planes(&self, bounds: &Bounds3) -> Self {
        let extent = Extent::new(bounds);
        let (nearest, farthest) = extent.depth_range(self.position, self.forward());
        let slack = SLACK * (farthest - nearest) + SLACK * extent.radius + 1e-9 * farthest.abs();
        let planes = if self.projection.is_orthographic() {
            self.projection.with_planes(nearest - slack, Some(farthest + slack))
        } else {
            // If everything is behind the eye, any planes will do.
            let far = if farthest > 0.0 { farthest + slack } else { extent.radius };
            let near = larger(nearest - slack, near_of_an_eye_within(far));
            self.projection.with_planes(near, self.projection.far().map(|_| far))
        };
        Self { projection: planes.unwrap_or(self.projection), ..*self }
    }

    /// The same camera with its near and far planes moved away from each other where they would cut something
    /// of these bounds in front of the eye. Give it the bounds of what a fitted camera shows besides.
    #[must_use]
    pub fn with_wider_clip_planes(&self, bounds: &Bounds3) -> Self {
        let (own, wider) = (self.projection, self.with_clip_planes(bounds).projection);
        let near = if wider.near() < own.near() { wider.near() } else { own.near() };
        let far = own.far().zip(wider.far()).map(|(own, wider)| larger(own, wider));
        self.with_projection(own.with_planes(near, far).unwrap_or(own))
    }
}

/// The near plane of an eye within a box whose farthest point is at this distance.
fn near_of_an_eye_within(far: f64) -> f64 {
    let near = larger(far * NEAREST, LEAST_NEAR);
    // Of a box too small to be drawn.
    if near < far { near } else { far * 0.5 }
}

/// The view parameters of a camera that is yet to be placed.
#[derive(Clone, Copy)]
pub(crate) struct Shot<'a> {
    pub(crate) projection: &'a Projection,
    pub(crate) orientation: DQuat,
}

/// The box around those points that are finite.
pub(crate) fn finite_bounds(points: &[DVec3]) -> Bounds3 {
    Bounds3::from_points(points.iter().copied().filter(|point| point.is_finite()))
}

/// The distance from the extent's centre along the line of sight at which the points, given
/// relative to the centre, just fill the image; for a parallel projection, the height of the
/// window.
pub(crate) fn fit_distance(
    shot: Shot<'_>,
    extent: &Extent,
    points: impl Iterator<Item = DVec3>,
    aspect: f64,
    margin: f64,
) -> f64 {
    let fill = 1.0 - if margin.is_nan() { 0.0 } else { margin.clamp(0.0, LARGEST_MARGIN) };
    let map = shot.projection.clip_map(aspect);
    let (half, middle) = (fill / map.scale, map.shift / map.scale);
    let turn = shot.orientation.conjugate();
    let points = points.map(|point| turn * point);
    match map.kind {
        // |x + middle·z| <= half·(distance - z) for every point, per axis.
        Kind::Perspective => points.fold(CLEARANCE * extent.radius, |distance, point| {
            let off = (point.truncate() + middle * point.z).abs() / half;
            let clear = point.z + CLEARANCE * extent.radius;
            larger(distance, larger(clear, point.z + larger(off.x, off.y)))
        }),
        // `half` is half of the window's size at the current height.
        Kind::Parallel => {
            let reach = points.fold(0.0, |reach, point| {
                let off = point.truncate().abs() / half;
                larger(reach, larger(off.x, off.y))
            });
            let height = reach * shot.projection.height_at(1.0);
            if height > 0.0 { height } else { 2.0 * extent.radius / fill }
        }
    }
}

/// The camera-space point at the centre of the image at this distance: straight ahead, except for
/// off-centre windows.
pub(crate) fn sight(projection: &Projection, distance: f64) -> DVec3 {
    // Only projections with their own aspect are off centre.
    const ANY_ASPECT: f64 = 1.0;
    projection.clip_map(ANY_ASPECT).at_distance(DVec2::ZERO, distance)
}

/// The greater one; `b` if they cannot be compared.
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}
