//! Cameras that a scene suggests: where to stand to see all of it.

use trigon_camera::{Camera, DEFAULT_MARGIN};
use trigon_math::DVec3;

use crate::scene::Scene;

/// Where the overview looks: down from the upper right, in front.
pub const OVERVIEW_DIRECTION: DVec3 = DVec3::new(-1.0, -0.5, -1.0);

impl Scene {
    /// A perspective camera that sees everything visible from the upper right
    /// in front, with +Y up and a tenth of the picture left free. `aspect` is
    /// width over height.
    pub fn overview(&self, aspect: f64) -> Camera {
        Camera::default().fit(&self.bounds(), OVERVIEW_DIRECTION, DVec3::Y, aspect, DEFAULT_MARGIN)
    }
}
