//! An orbiting camera: it rotates about a target, zooms, and moves the target along when panned.

use trigon_math::{Bounds3, DMat3, DQuat, DVec3, elementary};

use super::angle::Angle;
use crate::fit::{Extent, Shot, finite_bounds, fit_distance, sight};
use crate::{AxisView, Camera, Projection, UpAxis};

/// How dragging rotates the camera.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum OrbitStyle {
    /// About the up axis and up to the poles; the horizon stays level. The default of most model
    /// viewers.
    #[default]
    Turntable,
    /// Freely, as if the model were held in a ball; no up axis, no poles.
    Trackball,
}

/// The orientation of the camera.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Attitude {
    /// Angles in fixed point: nothing to renormalize, no drift. Roll is about the line of sight.
    Turntable { azimuth: Angle, elevation: Angle, roll: Angle },
    /// Camera to world.
    Trackball(DQuat),
}

/// The smallest and largest distance from the target; beyond these, squares of lengths would leave
/// the range of f64.
const DISTANCES: (f64, f64) = (1e-140, 1e140);

/// A camera that orbits a target, as a plain state machine.
///
/// The turntable stops at the poles, where the camera looks straight down or up: it never flips
/// over, and rotating about the up axis still works there. All angles are in fixed point, so there
/// is no drift: any number of small steps adds up exactly, and undoing them restores the same bits.
///
/// ```
/// use trigon_camera::{AxisView, Camera, Orbit};
/// use trigon_math::{Bounds3, DVec3};
///
/// let bounds = Bounds3 { min: DVec3::splat(-1.0), max: DVec3::splat(1.0) };
/// let mut orbit = Orbit::new(DVec3::Y);
/// orbit.fit(&bounds, 4.0 / 3.0, 0.1);
/// orbit.set_view(AxisView::Right);
/// orbit.orbit(0.0, 10.0); // up to the pole and no further
/// let camera: Camera = orbit.camera(&bounds);
/// assert!(camera.forward().distance(DVec3::NEG_Y) < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orbit {
    target: DVec3,
    distance: f64,
    attitude: Attitude,
    up: UpAxis,
    /// Never orthographic.
    perspective: Projection,
    parallel: Lines,
}

/// Lines of sight.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Lines {
    Converging,
    Parallel,
}

impl Orbit {
    /// In front of the target (the origin) at distance 5, with the default projection and `up` as
    /// the up axis.
    #[must_use]
    pub fn new(up: DVec3) -> Self {
        Self {
            target: DVec3::ZERO,
            distance: 5.0,
            attitude: turntable(0.0, 0.0, 0.0),
            up: UpAxis::new(up),
            perspective: Projection::default(),
            parallel: Lines::Converging,
        }
    }

    /// Takes over from a camera, orbiting about the point at the centre of its image at `distance` along its
    /// line of sight. Its roll is kept. A parallel camera keeps its window; its eye moves along the line of
    /// sight instead.
    #[must_use]
    pub fn from_camera(camera: &Camera, distance: f64, up: DVec3) -> Self {
        let target = camera.to_world(sight(&camera.projection, distance));
        let mut orbit = Self { target, distance, ..Self::new(up) };
        orbit.attitude = attitude_of(camera.orientation, orbit.up);
        if let Projection::Orthographic { height, .. } = camera.projection {
            orbit.parallel = Lines::Parallel;
            orbit.set_distance(height / orbit.perspective.height_at(1.0));
        } else {
            orbit.perspective = camera.projection;
            orbit.set_distance(distance);
        }
        orbit
    }

    /// The point that the camera orbits, at the centre of the image.
    #[must_use]
    pub fn target(&self) -> DVec3 {
        self.target
    }

    /// Looks at another point from the same side and distance. One that is not
    /// finite is ignored.
    pub fn set_target(&mut self, target: DVec3) {
        if target.is_finite() {
            self.target = target;
        }
    }

    /// Distance of the eye from the target, along the line of sight.
    #[must_use]
    pub fn distance(&self) -> f64 {
        self.distance
    }

    /// Sets the distance; clamped to 10⁻¹⁴⁰ … 10¹⁴⁰, and ignored if it is not a positive number.
    pub fn set_distance(&mut self, distance: f64) {
        if distance > 0.0 {
            self.distance = distance.clamp(DISTANCES.0, DISTANCES.1);
        }
    }

    /// The up axis, unit length.
    #[must_use]
    pub fn up(&self) -> DVec3 {
        self.up.direction()
    }

    /// Sets the up axis. Azimuth and elevation are kept, so the named views show the same sides
    /// relative to the new up axis.
    pub fn set_up(&mut self, up: DVec3) {
        self.up = UpAxis::new(up);
    }

    /// How dragging rotates the camera.
    #[must_use]
    pub fn style(&self) -> OrbitStyle {
        match self.attitude {
            Attitude::Turntable { .. } => OrbitStyle::Turntable,
            Attitude::Trackball(_) => OrbitStyle::Trackball,
        }
    }

    /// Changes how dragging rotates the camera; the view is kept.
    pub fn set_style(&mut self, style: OrbitStyle) {
        self.attitude = match style {
            OrbitStyle::Turntable => attitude_of(self.orientation(), self.up),
            OrbitStyle::Trackball => Attitude::Trackball(self.orientation()),
        };
    }

    /// The camera's orientation (camera to world), unit length.
    #[must_use]
    pub fn orientation(&self) -> DQuat {
        match self.attitude {
            Attitude::Trackball(orientation) => orientation,
            Attitude::Turntable { azimuth, elevation, roll } => {
                let frame = DQuat::from_mat3(&self.up.frame());
                let turn =
                    about(1, azimuth.radians()) * about(0, -elevation.radians()) * about(2, roll.radians());
                (frame * turn).normalize()
            }
        }
    }

    /// Orbits the target, in radians: positive `right` moves the eye to its right (the model seems
    /// to rotate left), positive `up` moves it up.
    pub fn orbit(&mut self, right: f64, up: f64) {
        match &mut self.attitude {
            Attitude::Turntable { azimuth, elevation, .. } => {
                *azimuth = azimuth.plus(Angle::from_radians(right));
                *elevation = elevation.plus_up_to_quarter(up);
            }
            Attitude::Trackball(orientation) => {
                let turned = *orientation * about(1, finite(right)) * about(0, -finite(up));
                *orientation = turned.normalize();
            }
        }
    }

    /// Rolls the camera about its line of sight; positive is counter-clockwise for the camera, so
    /// the image rotates clockwise.
    pub fn roll(&mut self, angle: f64) {
        match &mut self.attitude {
            Attitude::Turntable { roll, .. } => *roll = roll.plus(Angle::from_radians(angle)),
            Attitude::Trackball(orientation) => {
                *orientation = (*orientation * about(2, finite(angle))).normalize();
            }
        }
    }

    /// Moves camera and target together: `right` and `up` in world units at
    /// the target. See [`Orbit::height_at_target`] for pixels.
    pub fn pan(&mut self, right: f64, up: f64) {
        self.set_target(self.target + self.orientation() * DVec3::new(right, up, 0.0));
    }

    /// Height of the visible window at the target, in world units.
    #[must_use]
    pub fn height_at_target(&self) -> f64 {
        self.perspective.height_at(self.distance)
    }

    /// Makes the target look `factor` times as large; factors that are not positive numbers are
    /// ignored. Pass `base^movement` to make it exponential in the movement.
    pub fn zoom(&mut self, factor: f64) {
        self.set_distance(self.distance / factor);
    }

    /// Zooms about a world point, which keeps its position in the image: "zoom to cursor" with the
    /// point under the cursor.
    pub fn zoom_about(&mut self, point: DVec3, factor: f64) {
        let before = self.distance;
        self.zoom(factor);
        // The factor after clamping, so that the point stays in place even then.
        self.set_target(point + (self.target - point) * (self.distance / before));
    }

    /// Shows a named side, upright, at the same distance.
    pub fn set_view(&mut self, view: AxisView) {
        let (azimuth, elevation) = view.azimuth_and_elevation();
        self.set_angles(azimuth, elevation, 0.0);
    }

    /// Moves to this azimuth (from the front to the right), elevation (clamped to the poles) and
    /// roll, in radians, at the same distance.
    pub fn set_angles(&mut self, azimuth: f64, elevation: f64, roll: f64) {
        let style = self.style();
        self.attitude = turntable(azimuth, elevation, roll);
        self.set_style(style);
    }

    /// Looks along `direction`, with this roll, at the same distance; a
    /// direction without length is ignored.
    pub fn look_along(&mut self, direction: DVec3) {
        if direction.is_finite() && direction != DVec3::ZERO {
            let style = self.style();
            self.attitude = attitude_of(crate::orientation_looking(direction, self.up()), self.up);
            self.set_style(style);
        }
    }

    /// The perspective in use, or to be used after parallel projection.
    #[must_use]
    pub fn perspective(&self) -> Projection {
        self.perspective
    }

    /// Sets the projection. A parallel one sets the distance at which the perspective shows the
    /// target in the same size.
    pub fn set_projection(&mut self, projection: Projection) {
        if let Projection::Orthographic { height, .. } = projection {
            self.parallel = Lines::Parallel;
            self.set_distance(height / self.perspective.height_at(1.0));
        } else {
            self.parallel = Lines::Converging;
            self.perspective = projection;
        }
    }

    /// Whether the projection is parallel.
    #[must_use]
    pub fn is_orthographic(&self) -> bool {
        self.parallel == Lines::Parallel
    }

    /// Switches between perspective and parallel projection. The target keeps its size.
    pub fn toggle_orthographic(&mut self) {
        self.parallel = match self.parallel {
            Lines::Converging => Lines::Parallel,
            Lines::Parallel => Lines::Converging,
        };
    }

    /// Targets the centre of the bounds at the distance from which they fill the image; see
    /// [`Camera::fit`].
    pub fn fit(&mut self, bounds: &Bounds3, aspect: f64, margin: f64) {
        let extent = Extent::new(bounds);
        self.fit_extent(&extent, extent.corners().into_iter(), aspect, margin);
    }

    /// As [`Orbit::fit`], but fitted to points instead of the box around them; see
    /// [`Camera::fit_points`].
    pub fn fit_points(&mut self, points: &[DVec3], aspect: f64, margin: f64) {
        let extent = Extent::new(&finite_bounds(points));
        self.fit_extent(&extent, extent.offsets(points), aspect, margin);
    }

    fn fit_extent(&mut self, extent: &Extent, points: impl Iterator<Item = DVec3>, aspect: f64, margin: f64) {
        let shot = Shot { projection: &self.projection(), orientation: self.orientation() };
        let fitted = fit_distance(shot, extent, points, aspect, margin);
        let distance = match self.parallel {
            Lines::Converging => fitted,
            Lines::Parallel => fitted / self.perspective.height_at(1.0),
        };
        self.target = extent.center();
        self.set_distance(distance);
    }

    /// The current camera, with its near and far planes around `bounds`.
    #[must_use]
    pub fn camera(&self, bounds: &Bounds3) -> Camera {
        let orientation = self.orientation();
        let projection = self.projection();
        let position = self.target - orientation * sight(&projection, self.distance);
        Camera { position, orientation, projection }.with_clip_planes(bounds)
    }

    /// The projection in use, with planes yet to be set.
    fn projection(&self) -> Projection {
        match self.parallel {
            Lines::Converging => self.perspective,
            Lines::Parallel => self.perspective.to_orthographic(self.distance).unwrap_or(self.perspective),
        }
    }
}

/// Angles in radians to an attitude.
fn turntable(azimuth: f64, elevation: f64, roll: f64) -> Attitude {
    Attitude::Turntable {
        azimuth: Angle::from_radians(azimuth),
        elevation: Angle::ZERO.plus_up_to_quarter(elevation),
        roll: Angle::from_radians(roll),
    }
}

/// The turntable angles of an orientation. At the poles azimuth and roll are the same rotation;
/// there it counts as azimuth.
fn attitude_of(orientation: DQuat, up: UpAxis) -> Attitude {
    const POLE: f64 = 1e-9;
    let axes = up.frame().transpose() * DMat3::from_quat(orientation);
    let (right, above, back) = (axes.x_axis, axes.y_axis, axes.z_axis);
    let level = elementary::hypot(back.x, back.z);
    let elevation = elementary::atan2(back.y, level);
    if level < POLE {
        return turntable(elementary::atan2(-right.z, right.x), elevation, 0.0);
    }
    let azimuth = elementary::atan2(back.x, back.z);
    turntable(azimuth, elevation, elementary::atan2(right.y, above.y))
}

/// A turn of `angle` about axis 0, 1 or 2.
fn about(axis: usize, angle: f64) -> DQuat {
    let (sin, cos) = elementary::sin_cos(angle * 0.5);
    let axis = DVec3::AXES[axis] * sin;
    DQuat::from_xyzw(axis.x, axis.y, axis.z, cos)
}

/// The number, or 0 if it is not finite.
fn finite(value: f64) -> f64 {
    if value.is_finite() { value } else { 0.0 }
}
