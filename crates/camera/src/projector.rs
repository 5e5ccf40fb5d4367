//! Points to pixels and back: a camera together with the size of its image.

use trigon_math::{DVec2, DVec3};

use crate::clip_map::{ClipMap, Kind};
use crate::{Camera, Ray, Viewport};

/// Projects world points to the screen, and back.
///
/// The screen has its origin in the top-left corner, y down and pixel centres at +0.5; points
/// outside the image get coordinates outside it. Depth is that of the depth buffer: 1 on the near
/// plane, 0 on the far plane or at infinity, more than 1 in front of the near plane.
///
/// In a perspective, points at or behind the eye have no screen position: `None`. In a parallel
/// projection every point has one.
#[derive(Debug, Clone, Copy)]
pub struct Projector {
    camera: Camera,
    viewport: Viewport,
    map: ClipMap,
}

impl Projector {
    /// For an image of this size.
    #[must_use]
    pub fn new(camera: &Camera, viewport: Viewport) -> Self {
        Self { camera: *camera, viewport, map: camera.projection.clip_map(viewport.aspect()) }
    }

    /// The camera.
    #[must_use]
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// The size of the image.
    #[must_use]
    pub fn viewport(&self) -> Viewport {
        self.viewport
    }

    /// The point in camera space.
    #[must_use]
    pub fn to_camera(&self, point: DVec3) -> DVec3 {
        self.camera.to_camera(point)
    }

    /// The screen position of a point, and its depth.
    #[must_use]
    pub fn to_screen_and_depth(&self, point: DVec3) -> Option<(DVec2, f64)> {
        let point = self.to_camera(point);
        let screen = self.viewport.to_screen(self.map.project(point)?);
        Some((screen, self.map.depth(point)?))
    }

    /// The screen position of a point.
    #[must_use]
    pub fn to_screen(&self, point: DVec3) -> Option<DVec2> {
        let ndc = self.map.project(self.to_camera(point))?;
        Some(self.viewport.to_screen(ndc))
    }

    /// The screen positions of the ends of a line from one point to another. Only the part counts that lies
    /// at least `nearest` in front of the eye, along the line of sight; `None` where no part does. An end
    /// right in front of the eye is far outside the image.
    #[must_use]
    pub fn line_to_screen(&self, ends: [DVec3; 2], nearest: f64) -> Option<[DVec2; 2]> {
        let [from, to] = ends.map(|end| self.to_camera(end));
        let [start, end] = [from, to].map(|point| -point.z - nearest);
        let line = match (start >= 0.0, end >= 0.0) {
            (true, true) => [from, to],
            (false, false) => return None,
            (is_start_visible, _) => {
                // At this distance exactly: what rounding leaves of it may lie behind the eye.
                let cut = DVec3 { z: -nearest, ..from + (to - from) * (start / (start - end)) };
                if is_start_visible { [from, cut] } else { [cut, to] }
            }
        };
        let [from, to] = line.map(|point| self.map.project(point).map(|ndc| self.viewport.to_screen(ndc)));
        Some([from?, to?])
    }

    /// The point's depth.
    #[must_use]
    pub fn to_depth(&self, point: DVec3) -> Option<f64> {
        self.map.depth(self.to_camera(point))
    }

    /// The world point at a screen position and depth; `None` for a depth at or beyond infinity (0
    /// without a far plane), and if the image has no area.
    #[must_use]
    pub fn unproject(&self, screen: DVec2, depth: f64) -> Option<DVec3> {
        let point = self.at_distance(screen, self.map.distance(depth)?)?;
        point.is_finite().then_some(point)
    }

    /// The world point at a screen position and a distance along the line of sight (not along the
    /// ray); `None` if the image has no area.
    #[must_use]
    pub fn at_distance(&self, screen: DVec2, distance: f64) -> Option<DVec3> {
        let ndc = self.viewport.to_ndc(screen);
        if !ndc.is_finite() {
            return None;
        }
        Some(self.camera.to_world(self.map.at_distance(ndc, distance)))
    }

    /// The ray of all points at a screen position: from the eye, or in a parallel projection from
    /// the plane through the eye. `None` if the image has no area.
    #[must_use]
    pub fn ray(&self, screen: DVec2) -> Option<Ray> {
        let ndc = self.viewport.to_ndc(screen);
        if !ndc.is_finite() {
            return None;
        }
        Some(match self.map.kind {
            Kind::Perspective => Ray {
                origin: self.camera.position,
                direction: self.camera.orientation * self.map.at_distance(ndc, 1.0).normalize(),
            },
            Kind::Parallel => Ray {
                origin: self.camera.to_world(self.map.at_distance(ndc, 0.0)),
                direction: self.camera.forward(),
            },
        })
    }
}
