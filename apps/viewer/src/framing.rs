//! Where the camera stands: the camera flags and the model's bounds become a
//! camera that shows the model.
//!
//! Turning (`azimuth`, `elevation`) comes before fitting, so that the model
//! is in the picture whatever the angles are.

use trigon_camera::{AxisView, Camera, Extent, Orbit, Projection};
use trigon_math::{Bounds3, DQuat, DVec3};
use trigon_scene::{OVERVIEW_DIRECTION, Scene};

use crate::failure::Failure;

/// The camera flags.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Framing {
    pub(crate) eye: Eye,
    /// The model's up axis.
    pub(crate) up: DVec3,
    /// Up in the picture, if it is not the model's up axis.
    pub(crate) view_up: Option<DVec3>,
    /// What the camera looks at, if it is not the model's middle.
    pub(crate) focal_point: Option<DVec3>,
    /// Radians from the lower to the upper edge of the picture.
    pub(crate) view_angle: f64,
    /// What part of the picture the model fills.
    pub(crate) zoom: f64,
    /// Radians to the right around what the camera looks at.
    pub(crate) azimuth: f64,
    /// Radians up over it.
    pub(crate) elevation: f64,
    pub(crate) orthographic: bool,
}

/// How the camera's place is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Eye {
    /// From the right, above and before the model.
    Default,
    /// Looking this way at the model.
    Direction(DVec3),
    /// From a named side.
    Side(AxisView),
    /// Here.
    Position(DVec3),
    /// Where the file's own camera of this number stands.
    SceneCamera(usize),
}

/// A camera, and what it looks at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shot {
    pub(crate) camera: Camera,
    /// From the eye to what the camera looks at, along the line of sight.
    pub(crate) distance: f64,
}

impl Framing {
    /// The camera for a scene that fills `bounds`.
    pub(crate) fn shot(&self, scene: &Scene, bounds: &Bounds3, aspect: f64) -> Result<Shot, Failure> {
        let center = self.focal_point.unwrap_or_else(|| Extent::new(bounds).center());
        let shot = match self.eye {
            Eye::Position(position) => self.standing(position, center)?,
            Eye::SceneCamera(index) => self.borrowed(scene, index, center)?,
            Eye::Default | Eye::Direction(_) | Eye::Side(_) => self.fitted(scene, bounds, aspect)?,
        };
        Ok(Shot { camera: shot.camera.with_clip_planes(bounds), ..shot })
    }

    /// A camera that shows the whole model from a direction.
    fn fitted(&self, scene: &Scene, bounds: &Bounds3, aspect: f64) -> Result<Shot, Failure> {
        /// The emptiest picture that fitting itself can do.
        const LARGEST_MARGIN: f64 = 0.95;
        let orientation = self.turn(self.orientation());
        let (direction, up) = (orientation * DVec3::NEG_Z, orientation * DVec3::Y);
        let margin = (1.0 - self.zoom).clamp(0.0, LARGEST_MARGIN);
        let base = Camera::default().with_projection(self.projection(1.0)?);
        let camera = match self.focal_point {
            Some(center) => base.fit(&centered(bounds, center), direction, up, aspect, margin),
            None => base.fit_points(&scene.visible_points(), direction, up, aspect, margin),
        };
        let center = self.focal_point.unwrap_or_else(|| Extent::new(bounds).center());
        // What a margin cannot express: larger than the picture, or tiny in it.
        Ok(zoomed(camera, center, self.zoom / (1.0 - margin)))
    }

    /// A camera at a point.
    fn standing(&self, position: DVec3, center: DVec3) -> Result<Shot, Failure> {
        let distance = position.distance(center);
        if !(distance.is_finite() && distance > 0.0) {
            return Err(Failure::Usage(format!(
                "--camera-position is {}, the middle of the model, so the camera looks nowhere; say with --camera-focal-point where it is to look, or move it",
                Coordinates(position)
            )));
        }
        let camera = Camera::look_at(position, center, self.view_up());
        Ok(self.turned(camera.with_projection(self.projection(distance)?), center, distance))
    }

    /// The file's own camera.
    fn borrowed(&self, scene: &Scene, index: usize, center: DVec3) -> Result<Shot, Failure> {
        let cameras = scene.cameras();
        let Some((_, camera)) = cameras.get(index) else {
            return Err(Failure::work(match cameras.len() {
                0 => format!(
                    "there is no camera in the file, so --camera-index={index} finds none; leave it out"
                ),
                count => {
                    format!("--camera-index={index} finds no camera; the file has {count}, numbered from 0")
                }
            }));
        };
        let ahead = (center - camera.position).dot(camera.forward());
        // With the model behind the camera any distance will do to turn about.
        let distance = if ahead > 0.0 { ahead } else { 1.0 };
        let projection = match self.orthographic && !camera.projection.is_orthographic() {
            true => camera.projection.to_orthographic(distance).map_err(Failure::work)?,
            false => camera.projection,
        };
        let pivot = camera.position + camera.forward() * distance;
        Ok(self.turned(camera.with_projection(projection), pivot, distance))
    }

    /// Turns a camera about a pivot on its line of sight.
    fn turned(&self, camera: Camera, pivot: DVec3, distance: f64) -> Shot {
        if self.azimuth == 0.0 && self.elevation == 0.0 {
            return Shot { camera, distance };
        }
        let orientation = self.turn(camera.orientation);
        let position = pivot - orientation * DVec3::NEG_Z * distance;
        Shot { camera: Camera { position, orientation, ..camera }, distance }
    }

    /// Azimuth about the camera's up, then elevation about its right.
    fn turn(&self, orientation: DQuat) -> DQuat {
        let azimuth = DQuat::from_axis_angle(DVec3::Y, self.azimuth);
        let elevation = DQuat::from_axis_angle(DVec3::NEG_X, self.elevation);
        (orientation * azimuth * elevation).normalize()
    }

    /// The orientation that the flags name, before turning.
    fn orientation(&self) -> DQuat {
        let mut orbit = Orbit::new(self.up);
        match self.eye {
            Eye::Side(side) => orbit.set_view(side),
            Eye::Direction(direction) => {
                return trigon_camera::orientation_looking(direction, self.view_up());
            }
            Eye::Default | Eye::Position(_) | Eye::SceneCamera(_) => orbit.look_along(upright(self.up)),
        }
        match self.view_up {
            Some(up) => trigon_camera::orientation_looking(orbit.orientation() * DVec3::NEG_Z, up),
            None => orbit.orientation(),
        }
    }

    fn view_up(&self) -> DVec3 {
        self.view_up.unwrap_or(self.up)
    }

    /// The projection that shows things at `distance` as the view angle says.
    fn projection(&self, distance: f64) -> Result<Projection, Failure> {
        // Fitting sets the real near plane.
        let perspective =
            Projection::perspective(self.view_angle, distance * 1e-3, None).map_err(Failure::work)?;
        if self.orthographic {
            perspective.to_orthographic(distance).map_err(Failure::work)
        } else {
            Ok(perspective)
        }
    }
}

/// The direction of the overview, for a model with this up axis.
fn upright(up: DVec3) -> DVec3 {
    let mut front = Orbit::new(up);
    front.set_view(AxisView::Front);
    front.orientation() * OVERVIEW_DIRECTION
}

/// The smallest box about `center` that holds `bounds`.
fn centered(bounds: &Bounds3, center: DVec3) -> Bounds3 {
    let half = (bounds.max - center).abs().max((center - bounds.min).abs());
    Bounds3 { min: center - half, max: center + half }
}

/// The camera that shows `center`, at which it looks, `factor` times as large.
fn zoomed(camera: Camera, center: DVec3, factor: f64) -> Shot {
    let away = camera.position - center;
    match camera.projection {
        Projection::Orthographic { height, near, far, .. } => {
            let projection =
                Projection::orthographic(height / factor, near, far).unwrap_or(camera.projection);
            Shot { camera: camera.with_projection(projection), distance: away.length() }
        }
        _ => Shot {
            camera: Camera { position: center + away / factor, ..camera },
            distance: away.length() / factor,
        },
    }
}

/// A point as the flags spell it.
struct Coordinates(DVec3);

impl std::fmt::Display for Coordinates {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{},{},{}", self.0.x, self.0.y, self.0.z)
    }
}
