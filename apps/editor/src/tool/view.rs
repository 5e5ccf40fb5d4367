//! From the pointer to the world: the meaning of a drag for a point, along an axis and in a plane.

use trigon_document::mesh::math::{DVec2, DVec3};
use trigon_document::scene::camera::{Camera, Projector, Viewport};

use crate::up::Up;

/// How a tool sees the world while it runs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ToolView {
    /// The camera of the view in which the pointer is.
    pub(crate) camera: Camera,
    /// The size of the image, in physical pixels.
    pub(crate) viewport: Viewport,
    /// Physical pixels per logical one.
    pub(crate) scale: f64,
    /// In which axes positions and directions are shown.
    pub(crate) up: Up,
}

/// A ray and an axis, or a ray and a plane, that enclose a smaller angle than this are too nearly
/// parallel for their meeting point to follow the pointer: its sine, about 3°.
const NEARLY_PARALLEL: f64 = 0.05;

/// What is nearer to the eye of a perspective is moved as if it were a metre away, in metres.
const AT_EYE: f64 = 1e-6;

impl ToolView {
    pub(crate) fn projector(&self) -> Projector {
        Projector::new(&self.camera, self.viewport)
    }

    /// Where a point is drawn; `None` behind the eye.
    pub(crate) fn screen(&self, point: DVec3) -> Option<DVec2> {
        self.projector().to_screen(point)
    }

    /// Towards the viewer, unit length.
    pub(crate) fn towards_viewer(&self) -> DVec3 {
        -self.camera.forward()
    }

    /// The distance of a point along the line of sight; 1 m where it is at or behind the eye of a
    /// perspective, so that it can be dragged all the same.
    fn distance(&self, point: DVec3) -> f64 {
        let distance = -self.camera.to_camera(point).z;
        // The camera that is looked through is at the eye itself.
        let is_at_eye = !self.camera.projection.is_orthographic() && distance <= AT_EYE;
        if self.screen(point).is_some() && !is_at_eye { distance } else { 1.0 }
    }

    /// Where a point goes that is dragged by some pixels parallel to the image: it stays under the
    /// pointer.
    pub(crate) fn dragged(&self, point: DVec3, pixels: DVec2) -> DVec3 {
        let (projector, distance) = (self.projector(), self.distance(point));
        let start = self.screen(point).unwrap_or(self.viewport.size() * 0.5);
        let ends = (projector.at_distance(start, distance), projector.at_distance(start + pixels, distance));
        match ends {
            (Some(from), Some(to)) if (to - from).is_finite() => to - from,
            _ => DVec3::ZERO,
        }
    }

    /// How many metres a pixel is wide at a point.
    pub(crate) fn metres_per_pixel(&self, point: DVec3) -> f64 {
        self.dragged(point, DVec2::X).length()
    }

    /// How far a point moves along an axis of unit length when it is dragged by some pixels: to the point of
    /// the axis that is nearest to the pointer's ray.
    pub(crate) fn dragged_along(&self, point: DVec3, axis: DVec3, pixels: DVec2) -> f64 {
        if pixels == DVec2::ZERO {
            return 0.0;
        }
        self.meet_axis(point, axis, pixels).unwrap_or_else(|| self.along_parallel_axis(point, axis, pixels))
    }

    fn meet_axis(&self, point: DVec3, axis: DVec3, pixels: DVec2) -> Option<f64> {
        let ray = self.projector().ray(self.screen(point)? + pixels)?;
        let across = ray.direction.dot(axis);
        let sine_squared = 1.0 - across * across;
        if sine_squared < NEARLY_PARALLEL * NEARLY_PARALLEL {
            return None;
        }
        let from_point = ray.origin - point;
        let (along_ray, along_axis) = (from_point.dot(ray.direction), from_point.dot(axis));
        // The nearest point of the ray has to be in front of the eye; beyond the axis' vanishing point it is
        // not.
        let on_ray = (across * along_axis - along_ray) / sine_squared;
        (on_ray > 0.0).then_some((along_axis - across * along_ray) / sine_squared)
    }

    /// An axis that points at the viewer cannot be followed; the pointer goes along it as it would across
    /// the image, upwards and rightwards away from the viewer.
    fn along_parallel_axis(&self, point: DVec3, axis: DVec3, pixels: DVec2) -> f64 {
        let away = self.camera.forward().dot(axis);
        let direction = if away < 0.0 { -1.0 } else { 1.0 };
        (pixels.x - pixels.y) * self.metres_per_pixel(point) * direction
    }

    /// Where a point goes that is dragged by some pixels within a plane through it: to where the pointer's
    /// ray meets the plane; where it hardly does, parallel to the image as far as the plane allows.
    pub(crate) fn dragged_within(&self, point: DVec3, normal: DVec3, pixels: DVec2) -> DVec3 {
        if pixels == DVec2::ZERO {
            return DVec3::ZERO;
        }
        self.meet_plane(point, normal, pixels).unwrap_or_else(|| {
            let drag = self.dragged(point, pixels);
            drag - normal * drag.dot(normal)
        })
    }

    fn meet_plane(&self, point: DVec3, normal: DVec3, pixels: DVec2) -> Option<DVec3> {
        let ray = self.projector().ray(self.screen(point)? + pixels)?;
        let fall = ray.direction.dot(normal);
        let distance = (point - ray.origin).dot(normal) / fall;
        let offset = ray.at(distance) - point;
        (fall.abs() > NEARLY_PARALLEL && distance > 0.0 && offset.is_finite()).then_some(offset)
    }
}

#[cfg(test)]
pub(in crate::tool) mod tests {
    use proptest::prelude::*;
    use trigon_document::scene::camera::Projection;

    use super::*;

    /// From (0, 0, 10) along −Z, so that a pixel at the origin is 1 cm wide.
    pub(in crate::tool) fn front() -> ToolView {
        let camera = Camera::look_at(DVec3::Z * 10.0, DVec3::ZERO, DVec3::Y);
        let projection = Projection::orthographic(6.0, 0.1, 100.0).expect("valid");
        let viewport = Viewport { width: 800, height: 600 };
        ToolView { camera: camera.with_projection(projection), viewport, scale: 1.0, up: Up::Y }
    }

    fn vector(range: f64) -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-range..range).prop_map(DVec3::from)
    }

    /// Cameras that see the origin from all sides, in both projections.
    pub(in crate::tool) fn views() -> impl Strategy<Value = ToolView> {
        let position = vector(1.0).prop_filter("a direction", |position| position.length() > 0.1);
        (position, 5.0f64..50.0, 0.2f64..2.0, any::<bool>()).prop_map(
            |(position, distance, fov, parallel)| {
                let camera = Camera::look_at(position.normalize() * distance, DVec3::ZERO, DVec3::Y);
                let projection = match parallel {
                    true => Projection::orthographic(distance, 0.01, 1000.0),
                    false => Projection::perspective(fov, 0.01, None),
                };
                let camera = camera.with_projection(projection.expect("valid"));
                ToolView { camera, viewport: Viewport { width: 1280, height: 720 }, scale: 1.0, up: Up::Y }
            },
        )
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(500))]

        #[test]
        fn a_dragged_point_stays_under_the_pointer(
            view in views(), point in vector(1.0), pixels in prop::array::uniform2(-400.0f64..400.0)
        ) {
            let pixels = DVec2::from(pixels);
            let start = view.screen(point).expect("in front");
            let end = view.screen(point + view.dragged(point, pixels)).expect("in front");
            prop_assert!(end.distance(start + pixels) < 0.5, "{} instead of {}", end, start + pixels);
        }

        /// Points on the axis are drawn on a line; the pointer beside it is nearest to one of them.
        #[test]
        fn a_pointer_on_the_image_of_an_axis_finds_its_place(
            view in views(), point in vector(1.0), axis in vector(1.0), along in -2.0f64..2.0
        ) {
            prop_assume!(axis.length() > 0.1);
            let axis = axis.normalize();
            let sight = (point - view.camera.position).normalize();
            prop_assume!(axis.cross(sight).length() > 0.2 && axis.cross(view.camera.forward()).length() > 0.2);
            let (start, end) = (view.screen(point), view.screen(point + axis * along));
            let pixels = end.expect("in front") - start.expect("in front");
            let found = view.dragged_along(point, axis, pixels);
            prop_assert!((found - along).abs() < 1e-6, "{found} instead of {along}");
        }

        #[test]
        fn a_pointer_on_the_image_of_a_plane_finds_its_place(
            view in views(), point in vector(1.0), normal in vector(1.0), along in vector(1.5)
        ) {
            prop_assume!(normal.length() > 0.1);
            let normal = normal.normalize();
            let along = along - normal * along.dot(normal);
            let end = point + along;
            prop_assume!((end - view.camera.position).normalize().dot(normal).abs() > 0.1);
            prop_assume!(view.camera.forward().dot(normal).abs() > 0.1);
            let pixels = view.screen(end).expect("in front") - view.screen(point).expect("in front");
            let found = view.dragged_within(point, normal, pixels);
            prop_assert!(found.distance(along) < 1e-6, "{found} instead of {along}");
        }

        #[test]
        fn any_drag_is_finite(
            view in views(), point in vector(100.0), axis in vector(1.0), pixels in prop::array::uniform2(-1e5f64..1e5)
        ) {
            let (axis, pixels) = (axis.normalize_or(DVec3::X), DVec2::from(pixels));
            prop_assert!(view.dragged(point, pixels).is_finite());
            prop_assert!(view.dragged_along(point, axis, pixels).is_finite());
            prop_assert!(view.dragged_within(point, axis, pixels).is_finite());
        }
    }

    #[test]
    fn an_axis_towards_the_viewer_follows_the_pointer_upwards() {
        let view = front();
        let away = view.dragged_along(DVec3::ZERO, DVec3::NEG_Z, DVec2::new(0.0, -100.0));
        assert!((away - 1.0).abs() < 1e-9, "100 pixels of 1 cm: {away}");
    }
}
