//! Places the camera: combines the camera flags and the model's bounds.
//!
//! Rotations (`azimuth`, `elevation`) come before fitting, so that the model is in view whatever
//! the angles are.

use std::str::FromStr;

use trigon_camera::{AxisView, Camera, Extent, Orbit, Projection, UpAxis};
use trigon_math::{Bounds3, DQuat, DVec3};
use trigon_scene::{OVERVIEW_DIRECTION, Scene};

use crate::exact_camera::ExactCamera;
use crate::failure::Failure;

/// The camera flags.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Framing {
    pub(crate) eye: Eye,
    /// Up in the image, if it is not the model's up axis.
    pub(crate) view_up: Option<DVec3>,
    /// What the camera looks at, if it is not the model's middle.
    pub(crate) focal_point: Option<DVec3>,
    /// Radians from the lower to the upper edge of the image.
    pub(crate) view_angle: f64,
    /// What part of the image the model fills.
    pub(crate) zoom: f64,
    /// Radians to the right around what the camera looks at.
    pub(crate) azimuth: f64,
    /// Radians up over it.
    pub(crate) elevation: f64,
    pub(crate) orthographic: bool,
    /// Then these, one after the other.
    pub(crate) turns: Vec<Turn>,
}

/// A turn of the camera around what it looks at, in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Turn {
    /// To the right.
    Azimuth(f64),
    /// Up.
    Elevation(f64),
    /// About the line of sight, clockwise as the image shows it turning the other way.
    Roll(f64),
    /// Back to before all turns.
    Reset,
}

impl FromStr for Turn {
    type Err = String;

    /// `azimuth:30`, in degrees.
    fn from_str(text: &str) -> Result<Self, String> {
        let (kind, degrees) = text.split_once(':').unwrap_or((text, "0"));
        let angle = degrees.trim().parse::<f64>().ok().filter(|angle| angle.is_finite());
        let angle = angle.ok_or("write an angle in degrees, such as 45")?.to_radians();
        Ok(match kind {
            "azimuth" => Self::Azimuth(angle),
            "elevation" => Self::Elevation(angle),
            "roll" => Self::Roll(angle),
            "reset" => Self::Reset,
            _ => return Err("write azimuth, elevation, roll or reset".to_owned()),
        })
    }
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
    /// This camera, whatever else is said.
    Exact(ExactCamera),
}

/// A camera, and what it looks at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shot {
    pub(crate) camera: Camera,
    /// From the eye to what the camera looks at, along the line of sight.
    pub(crate) distance: f64,
}

impl Shot {
    /// What positions are relative to: the world's origin; or, where that is so far away that f32 would round
    /// positions visibly, a point near what the camera looks at.
    pub(crate) fn positions_origin(&self) -> DVec3 {
        /// As many heights of the image away from the origin, f32 rounds by 1/16 of a pixel where an image has
        /// a thousand rows.
        const FAR: f64 = 1024.0;
        let target = self.camera.position + self.camera.forward() * self.distance;
        let height = self.camera.projection.height_at(self.distance);
        // The power of two up to it: a multiple is a number that is exact and short.
        let step = f64::from_bits(height.to_bits() & f64::INFINITY.to_bits());
        let origin = (target / step).round() * step;
        let is_far = target.abs().max_element() > FAR * height;
        if is_far && origin.is_finite() { origin } else { DVec3::ZERO }
    }
}

impl Framing {
    /// The camera for a scene.
    pub(crate) fn shot(&self, scene: &Scene, aspect: f64) -> Result<Shot, Failure> {
        if let Eye::Exact(ExactCamera { camera, distance }) = self.eye {
            return Ok(Shot { camera, distance });
        }
        let bounds = scene.tight_bounds();
        let center = self.focal_point.unwrap_or_else(|| Extent::new(&bounds).center());
        let shot = match self.eye {
            Eye::Position(position) => self.standing(position, center, scene.up)?,
            Eye::SceneCamera(index) => self.borrowed(scene, index, center)?,
            Eye::Default | Eye::Direction(_) | Eye::Side(_) | Eye::Exact(_) => {
                let orientation = self.turn(self.orientation(scene.up));
                self.fitted(scene.visible_points().collect(), center, orientation, aspect)?
            }
        };
        let shot = self.scripted(shot);
        Ok(Shot { camera: shot.camera.with_clip_planes(&bounds), ..shot })
    }

    /// A camera of these flags, with planes that cut nothing of a scene that shows more than the one it was placed
    /// for. One that is given exactly stays as it is.
    pub(crate) fn with_wider_clip_planes(&self, camera: &Camera, scene: &Scene) -> Camera {
        match self.eye {
            Eye::Exact(_) => *camera,
            _ => camera.with_wider_clip_planes(&scene.bounds()),
        }
    }

    /// Whether the distance follows from the size of the model.
    #[cfg(feature = "window")]
    pub(crate) fn is_fitted(&self) -> bool {
        matches!(self.eye, Eye::Default | Eye::Direction(_) | Eye::Side(_))
    }

    /// After all turns of scripts.
    fn scripted(&self, shot: Shot) -> Shot {
        let pivot = shot.camera.position + shot.camera.forward() * shot.distance;
        let mut orientation = shot.camera.orientation;
        for &turn in &self.turns {
            orientation = match turn {
                Turn::Reset => shot.camera.orientation,
                Turn::Azimuth(angle) => orientation * DQuat::from_axis_angle(DVec3::Y, angle),
                Turn::Elevation(angle) => orientation * DQuat::from_axis_angle(DVec3::NEG_X, angle),
                Turn::Roll(angle) => orientation * DQuat::from_axis_angle(DVec3::Z, angle),
            };
        }
        let orientation = orientation.normalize();
        if self.turns.is_empty() || orientation == shot.camera.orientation {
            return shot;
        }
        let position = pivot - orientation * DVec3::NEG_Z * shot.distance;
        Shot { camera: Camera { position, orientation, ..shot.camera }, ..shot }
    }

    /// Views once around the model, all from the same distance: the camera of `shot`, turned
    /// about the model's up axis through its middle.
    pub(crate) fn turntable(&self, scene: &Scene, aspect: f64, views: u32) -> Result<Vec<Shot>, Failure> {
        let points: Vec<DVec3> = scene.visible_points().filter(|point| point.is_finite()).collect();
        let bounds = Bounds3::from_points(points.iter().copied());
        let center = self.focal_point.unwrap_or_else(|| Extent::new(&bounds).center());
        let first = self.shot(scene, aspect)?.camera;
        // Around the axis nothing comes nearer than it is on one of the views; a ball holds all.
        let reach = points.iter().map(|point| point.distance(center));
        let radius = reach.fold(0.0, |farthest, reach| if reach > farthest { reach } else { farthest });
        let keeps_position = matches!(self.eye, Eye::Position(_) | Eye::SceneCamera(_));
        let first = if keeps_position { first } else { self.around_ball(first, center, radius, aspect) };
        let axis = scene.up.direction();
        let shot = |view: u32| {
            let angle = std::f64::consts::TAU * f64::from(view) / f64::from(views);
            let turn = DQuat::from_axis_angle(axis, angle);
            let position = center + turn * (first.position - center);
            let orientation = (turn * first.orientation).normalize();
            let camera = Camera { position, orientation, ..first }.with_clip_planes(&bounds);
            Shot { camera, distance: position.distance(center) }
        };
        Ok((0..views).map(shot).collect())
    }

    /// The camera, moved along its line of sight, or zoomed, until it shows a ball.
    fn around_ball(&self, camera: Camera, center: DVec3, radius: f64, aspect: f64) -> Camera {
        let radius = if radius > 0.0 { radius } else { 1.0 };
        let narrow = if aspect < 1.0 { aspect } else { 1.0 };
        let back = camera.orientation * DVec3::Z;
        if camera.projection.is_orthographic() {
            let height = 2.0 * radius / (narrow * self.zoom);
            let projection = Projection::orthographic(height, radius * 1e-3, radius * 10.0);
            let projection = projection.unwrap_or(camera.projection);
            return Camera { position: center + back * radius * 4.0, projection, ..camera };
        }
        let slope = camera.projection.height_at(1.0) * 0.5 * narrow * self.zoom;
        let distance = radius * (1.0 + 1.0 / (slope * slope)).sqrt();
        Camera { position: center + back * distance, ..camera }
    }

    /// A camera of an orientation that shows the whole model.
    fn fitted(
        &self,
        mut points: Vec<DVec3>,
        center: DVec3,
        orientation: DQuat,
        aspect: f64,
    ) -> Result<Shot, Failure> {
        /// The emptiest image that fitting itself can do.
        const LARGEST_MARGIN: f64 = 0.95;
        let (direction, up) = (orientation * DVec3::NEG_Z, orientation * DVec3::Y);
        let margin = (1.0 - self.zoom).clamp(0.0, LARGEST_MARGIN);
        let base = Camera::default().with_projection(self.projection(1.0)?);
        if self.focal_point.is_some() {
            // Around the focal point everything is as far on the other side.
            let mirrored: Vec<DVec3> = points.iter().map(|&point| 2.0 * center - point).collect();
            points.extend(mirrored);
        }
        let camera = base.fit_points(&points, direction, up, aspect, margin);
        // What a margin cannot express: larger than the image, or tiny in it.
        Ok(zoomed(camera, center, self.zoom / (1.0 - margin)))
    }

    /// A camera at a point.
    fn standing(&self, position: DVec3, center: DVec3, up: UpAxis) -> Result<Shot, Failure> {
        let distance = position.distance(center);
        if !(distance.is_finite() && distance > 0.0) {
            return Err(Failure::Usage(format!(
                "--camera-position is {}, the middle of the model, so the view direction is undefined; set --camera-focal-point, or move the camera",
                Coordinates(position)
            )));
        }
        let camera = Camera::look_at(position, center, self.view_up(up));
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

    /// The orientation that the flags name in a world with this up axis, before turning.
    fn orientation(&self, up: UpAxis) -> DQuat {
        let mut orbit = Orbit::new(up.direction());
        match self.eye {
            Eye::Side(side) => orbit.set_view(side),
            Eye::Direction(direction) => {
                return trigon_camera::orientation_looking(direction, self.view_up(up));
            }
            Eye::Default | Eye::Position(_) | Eye::SceneCamera(_) | Eye::Exact(_) => {
                orbit.look_along(up.frame() * OVERVIEW_DIRECTION);
            }
        }
        match self.view_up {
            Some(up) => trigon_camera::orientation_looking(orbit.orientation() * DVec3::NEG_Z, up),
            None => orbit.orientation(),
        }
    }

    fn view_up(&self, up: UpAxis) -> DVec3 {
        self.view_up.unwrap_or(up.direction())
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

/// The camera that shows `center`, at which it looks, `factor` times as large.
fn zoomed(camera: Camera, center: DVec3, factor: f64) -> Shot {
    let away = camera.position - center;
    match camera.projection {
        Projection::Orthographic { height, near, far, .. } => {
            let projection =
                Projection::orthographic(height / factor, near, far).unwrap_or(camera.projection);
            Shot { camera: camera.with_projection(projection), distance: away.length() }
        }
        Projection::Perspective { .. } | Projection::Frustum { .. } | Projection::Pinhole { .. } => Shot {
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

#[cfg(test)]
mod tests {
    use trigon_camera::{Projector, Viewport};
    use trigon_math::DAffine3;
    use trigon_mesh::primitives;
    use trigon_scene::{Material, Node, Transform};

    use super::*;

    const IMAGE: Viewport = Viewport { width: 1000, height: 600 };

    fn default() -> Framing {
        Framing {
            eye: Eye::Default,
            view_up: None,
            focal_point: None,
            view_angle: 30f64.to_radians(),
            zoom: 0.9,
            azimuth: 0.0,
            elevation: 0.0,
            orthographic: false,
            turns: Vec::new(),
        }
    }

    /// A long box far from the origin.
    fn scene() -> Scene {
        let mut scene = Scene::new();
        let stretched = DAffine3::from_scale(DVec3::new(4.0, 1.0, 2.0));
        let node =
            scene.add_object("box", primitives::cube(1.0).transformed(&stretched), Material::default());
        scene.node_mut(node).expect("just added").transform =
            Transform::from_translation(DVec3::new(1e6, 5.0, -3.0));
        scene
    }

    fn shot(framing: &Framing) -> Shot {
        framing.shot(&scene(), IMAGE.aspect()).expect("a camera")
    }

    /// How much of the image the model takes, in the direction where it takes more.
    fn filled(camera: &Camera) -> f64 {
        let projector = Projector::new(camera, IMAGE);
        let scene = scene();
        let out = scene.visible_points().map(|point| {
            let at = projector.to_screen(point).expect("before the eye");
            let (x, y) = ((at.x / 500.0 - 1.0).abs(), (at.y / 300.0 - 1.0).abs());
            if x > y { x } else { y }
        });
        out.fold(0.0, f64::max)
    }

    #[test]
    fn whatever_the_angles_the_model_fills_the_image_to_the_margin() {
        for framing in [
            default(),
            Framing { azimuth: 1.0, elevation: 0.7, ..default() },
            Framing { eye: Eye::Side(AxisView::Top), ..default() },
            Framing { eye: Eye::Direction(DVec3::new(0.0, 0.0, 3.0)), orthographic: true, ..default() },
            Framing { view_up: Some(DVec3::Z), view_angle: 1.5, ..default() },
            Framing { view_up: Some(DVec3::X), orthographic: true, ..default() },
        ] {
            let filled = filled(&shot(&framing).camera);
            assert!((filled - 0.9).abs() < 1e-6, "{framing:?} fills {filled}");
        }
    }

    #[test]
    fn zooming_in_scales_what_is_in_the_middle() {
        let (whole, near) =
            (shot(&Framing { zoom: 1.0, ..default() }), shot(&Framing { zoom: 2.0, ..default() }));
        let ratio = whole.distance / near.distance;
        assert!((ratio - 2.0).abs() < 1e-9, "half the distance, not {ratio}");
    }

    #[test]
    fn the_camera_looks_at_the_focal_point() {
        let focal_point = DVec3::new(1e6 + 1.0, 5.0, -3.0);
        for eye in [Eye::Default, Eye::Position(DVec3::new(1e6, 20.0, 30.0))] {
            let shot = shot(&Framing { eye, focal_point: Some(focal_point), azimuth: 0.3, ..default() });
            let seen = shot.camera.position + shot.camera.forward() * shot.distance;
            assert!(seen.distance(focal_point) < 1e-6, "{eye:?} looks at {seen}");
        }
    }

    #[test]
    fn angles_turn_to_the_right_and_up() {
        let front = Framing { eye: Eye::Side(AxisView::Front), ..default() };
        let quarter = std::f64::consts::FRAC_PI_2;
        let right = shot(&Framing { azimuth: quarter, ..front.clone() }).camera;
        assert!(
            right.forward().distance(DVec3::NEG_X) < 1e-9,
            "from the right it looks along −X: {}",
            right.forward()
        );
        let top = shot(&Framing { elevation: quarter, ..front }).camera;
        assert!(top.forward().distance(DVec3::NEG_Y) < 1e-9, "from above it looks down: {}", top.forward());
        assert!(top.up().distance(DVec3::NEG_Z) < 1e-9, "with −Z on top: {}", top.up());
    }

    #[test]
    fn another_up_axis_shows_the_same_sides() {
        let mut scene = scene();
        scene.up = UpAxis::Z;
        let camera = default().shot(&scene, IMAGE.aspect()).expect("a camera").camera;
        // What F3D's configuration has for STL files.
        let expected = DVec3::new(-1.0, 1.0, -0.5).normalize();
        assert!(camera.forward().distance(expected) < 1e-9, "{}", camera.forward());
    }

    #[test]
    fn positions_of_what_is_far_away_are_relative_to_a_point_there() {
        let seen_from = |direction| shot(&Framing { eye: Eye::Direction(direction), ..default() });
        let near = Shot {
            camera: Camera::look_at(DVec3::new(0.0, 0.0, 9.0), DVec3::new(0.0, 0.0, 2.0), DVec3::Y),
            distance: 7.0,
        };
        assert_eq!(near.positions_origin(), DVec3::ZERO, "f32 is precise enough in the world");
        let center = DVec3::new(1e6, 5.0, -3.0);
        let origins = [DVec3::NEG_Z, DVec3::new(-1.0, -0.5, -1.0), DVec3::X]
            .map(|direction| seen_from(direction).positions_origin());
        for origin in origins {
            assert!(
                origin.distance(center) < 20.0 && origin == origin.round(),
                "{origin}: whole metres there"
            );
        }
    }

    /// The box is 4 m to each side of 10⁶ m; what is added 2 m before the eye of a camera made for it alone.
    #[test]
    fn a_camera_gets_room_for_what_is_shown_besides_unless_it_is_exact() {
        let framing = Framing { eye: Eye::Direction(DVec3::NEG_Z), ..default() };
        let camera = shot(&framing).camera;
        let mut more = scene();
        let added = more.add_object("added", primitives::cube(0.5), Material::default());
        more.node_mut(added).expect("just added").transform =
            Transform::from_translation(camera.position + DVec3::NEG_Z * 2.0);
        let wider = framing.with_wider_clip_planes(&camera, &more);
        assert!(camera.projection.near() > 2.0 && wider.projection.near() < 1.75, "{wider:?}");
        let exact = Framing { eye: Eye::Exact(ExactCamera { camera, distance: 9.0 }), ..default() };
        assert_eq!(exact.with_wider_clip_planes(&camera, &more), camera, "it is given");
    }

    #[test]
    fn a_camera_in_the_middle_of_the_model_is_refused() {
        let framing = Framing { eye: Eye::Position(DVec3::new(1e6, 5.0, -3.0)), ..default() };
        let failure = framing.shot(&scene(), 1.0).expect_err("it looks nowhere");
        assert_eq!(failure.exit_code(), 2, "{failure}");
    }

    #[test]
    fn cameras_of_the_file_are_counted() {
        let mut scene = scene();
        let projection = Projection::perspective(1.0, 0.1, None).expect("in range");
        let mut holder = Node::default().at(DVec3::new(1e6, 5.0, 9.0));
        holder.camera = Some(Box::new(projection));
        scene.add(holder);
        let through = |index| Framing { eye: Eye::SceneCamera(index), ..default() }.shot(&scene, 1.0);
        let shot = through(0).expect("it is there");
        assert_eq!(shot.camera.position, DVec3::new(1e6, 5.0, 9.0), "as the file has it");
        assert!((shot.distance - 12.0).abs() < 1e-9, "up to the model's middle, not {}", shot.distance);
        assert!(through(1).expect_err("there is one").to_string().contains("has 1"), "says how many");
    }
}
