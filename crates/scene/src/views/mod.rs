//! Cameras that see the whole scene: one, or many around it.
//!
//! [`turntable`], [`sphere`] and [`hemisphere`] generate the directions from the middle of the scene to each
//! camera; [`Scene::surround`] turns them into cameras, all at the same distance.

mod viewpoints;

use trigon_camera::{Camera, DEFAULT_MARGIN, Extent};
use trigon_math::{Bounds3, DVec3};

pub use viewpoints::{hemisphere, sphere, turntable};

use crate::scene::{PlacedMesh, Scene};

/// Where the overview looks in a world with +Y up: down from the upper right, in front.
pub const OVERVIEW_DIRECTION: DVec3 = DVec3::new(-1.0, -0.5, -1.0);

impl Scene {
    /// A perspective camera that sees everything visible from the upper right
    /// in front, with [`Scene::up`] up and a tenth of the image left free. `aspect`
    /// is width over height.
    #[must_use]
    pub fn overview(&self, aspect: f64) -> Camera {
        let points: Vec<DVec3> = self.visible_points().collect();
        let (direction, up) = (self.up.frame() * OVERVIEW_DIRECTION, self.up.direction());
        Camera::default().fit_points(&points, direction, up, aspect, DEFAULT_MARGIN)
    }

    /// A perspective camera at each of these viewpoints: unit vectors from the middle of
    /// the box around everything visible towards the eye, for a world with +Y up; they are
    /// turned to [`Scene::up`]. `aspect` is width over height.
    ///
    /// All stand equally far away, so that nothing grows or shrinks from one image to the next. They are as
    /// near as a ball about that middle that holds every vertex allows, with a tenth of the image left free.
    /// A camera depends on its own viewpoint only, not on the others.
    ///
    /// ```
    /// use trigon_scene::{showcase, views};
    ///
    /// let cameras: Vec<_> = showcase().surround(views::sphere(100, 42), 1.5).collect();
    /// assert_eq!(cameras.len(), 100);
    /// ```
    pub fn surround<V>(&self, viewpoints: V, aspect: f64) -> impl Iterator<Item = Camera> + use<V>
    where
        V: IntoIterator<Item = DVec3>,
    {
        let points: Vec<DVec3> = self.visible_points().collect();
        let bounds = Bounds3::from_points(points.iter().copied().filter(|point| point.is_finite()));
        let center = Extent::new(&bounds).center();
        let distance = ball_distance(&points, &bounds, aspect);
        let up = self.up;
        viewpoints.into_iter().map(move |viewpoint| {
            let eye = center + up.frame() * viewpoint * distance;
            Camera::look_at(eye, center, up.direction()).with_clip_planes(&bounds)
        })
    }

    /// The vertices of everything visible, in the world and in their poses, without
    /// those that no face, edge or point uses: what a camera is fitted to.
    pub fn visible_points(&self) -> impl Iterator<Item = DVec3> {
        self.placed_meshes().flat_map(PlacedMesh::into_used_points)
    }
}

/// How far from the middle of the box a default camera stands that sees the ball
/// around all points, with the usual margin.
fn ball_distance(points: &[DVec3], bounds: &Bounds3, aspect: f64) -> f64 {
    let extent = Extent::new(bounds);
    let reach = points.iter().map(|point| point.distance(extent.center())).filter(|reach| reach.is_finite());
    let reach = reach.fold(0.0, |farthest, reach| if reach > farthest { reach } else { farthest });
    let radius = if reach > 0.0 { reach } else { extent.radius() };
    let half_height = Camera::default().projection.height_at(1.0) * 0.5;
    let half_width = half_height * aspect;
    // The tangent of the angle between the line of sight and a line that touches the ball.
    let slope = (1.0 - DEFAULT_MARGIN) * if half_width < half_height { half_width } else { half_height };
    radius * (1.0 + 1.0 / (slope * slope)).sqrt()
}

#[cfg(test)]
mod tests {
    use trigon_camera::{Projector, Viewport};
    use trigon_math::DVec2;
    use trigon_mesh::primitives;

    use super::*;
    use crate::{Material, Node, Transform};

    /// A slim box far from the origin.
    fn tower() -> Scene {
        let mut scene = Scene::new();
        let id = scene.add_object("tower", primitives::cube(1.0), Material::default());
        let node: &mut Node = scene.node_mut(id).expect("just added");
        node.transform = Transform::from_scale_rotation_translation(
            DVec3::new(1.0, 9.0, 1.0),
            trigon_math::DQuat::IDENTITY,
            DVec3::new(1e6, -300.0, 5.0),
        );
        scene
    }

    #[test]
    fn every_camera_sees_all_from_the_same_distance() {
        let scene = tower();
        for viewport in [Viewport { width: 300, height: 200 }, Viewport { width: 100, height: 400 }] {
            let aspect = viewport.aspect();
            let middle = Extent::new(&scene.bounds()).center();
            let distances = scene.surround(sphere(40, 5), aspect).map(|camera| {
                let projector = Projector::new(&camera, viewport);
                for point in scene.visible_points() {
                    let at = projector.to_screen(point).expect("before the camera") / viewport.size();
                    // Less than the margin: perspective widens what is near, which the ball covers.
                    let free = DEFAULT_MARGIN / 2.0 - 1e-6;
                    assert!(at.cmpge(DVec2::splat(free)).all(), "{at} is in the image, {viewport:?}");
                    assert!(at.cmple(DVec2::splat(1.0 - free)).all(), "{at} is in the image, {viewport:?}");
                }
                camera.position.distance(middle)
            });
            let distances: Vec<f64> = distances.collect();
            let apart = |a: &f64| (a / distances[0] - 1.0).abs();
            assert!(distances.iter().all(|a| apart(a) < 1e-9), "equally far: {distances:?}");
        }
    }

    #[test]
    fn a_ball_fills_the_image_up_to_the_margin() {
        let mut scene = Scene::new();
        scene.add_object("ball", primitives::icosphere(2.0, 4), Material::default());
        let viewport = Viewport { width: 200, height: 200 };
        for camera in scene.surround(hemisphere(5, 1), 1.0) {
            let projector = Projector::new(&camera, viewport);
            let rows = scene.visible_points().filter_map(|point| projector.to_screen(point));
            let lowest = rows.map(|at| at.y).fold(0.0, f64::max);
            assert!((lowest - 190.0).abs() < 1.0, "a twentieth of 200 pixels stays free below: {lowest}");
        }
    }

    /// In an image that is higher than wide its width is what limits.
    #[test]
    fn a_ball_fills_a_narrow_image_from_side_to_side() {
        let mut scene = Scene::new();
        scene.add_object("ball", primitives::icosphere(2.0, 4), Material::default());
        let distance = |aspect: f64| {
            let camera = scene.surround(turntable(1, 0.0), aspect).next().expect("one viewpoint");
            camera.position.length()
        };
        for (width, height) in [(100, 200), (150, 200), (40, 200)] {
            let viewport = Viewport { width, height };
            for camera in scene.surround(turntable(3, 0.3), viewport.aspect()) {
                let projector = Projector::new(&camera, viewport);
                let columns = scene.visible_points().filter_map(|point| projector.to_screen(point));
                let right = columns.map(|at| at.x).fold(0.0, f64::max) / f64::from(width);
                assert!((right - 0.95).abs() < 0.01, "a twentieth stays free: {right} of {width}");
            }
        }
        assert_eq!(distance(1.0), distance(3.0), "in a wide one its height");
        assert!(distance(0.5) > 1.5 * distance(1.0));
    }

    #[test]
    fn a_scene_of_nothing_has_cameras_too() {
        let cameras: Vec<Camera> = Scene::new().surround(turntable(3, 0.2), 1.5).collect();
        assert_eq!(cameras.len(), 3, "one for each viewpoint");
        assert!(cameras.iter().all(|camera| camera.position.is_finite()), "{cameras:?}");
    }
}
