//! The background as rays through glass see it: the one behind the image, even where an environment lights the scene
//! without being shown. A clear pane must not be visible.

use trigon_math::{DMat4, Mat4, Vec3, Vec4};

use crate::background::Background;
use crate::settings::RenderSettings;

/// The background as rays through glass see it: what it shows in the direction of a ray, or at the
/// place of a ray if the camera's own are parallel. Beyond the edges of the image its edges go on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VisibleBackdrop {
    top: Vec3,
    bottom: Vec3,
    /// From camera space to the height on the screen, and the divisor of it.
    rows: [Vec4; 2],
}

impl VisibleBackdrop {
    /// `None` if the environment is what is seen. A transparent background counts as the default one:
    /// colours, unlike alpha, cannot be multiplied.
    pub(crate) fn new(settings: &RenderSettings, projection: &DMat4) -> Option<Self> {
        let [top, bottom] = match settings.background {
            Background::Environment if settings.effects.environment.is_none() => [Vec3::ZERO; 2],
            Background::Environment => return None,
            Background::Transparent if settings.effects.environment.is_some() => return None,
            Background::Transparent => Background::default().edges(),
            shown @ (Background::Color(_) | Background::Gradient { .. }) => shown.edges(),
        };
        // Surfaces are exposed, the background is not.
        let scale = 1.0 / settings.effects.exposure_factor();
        let scale = if scale.is_finite() { scale } else { 1.0 };
        let rows = projection.as_mat4().transpose();
        Some(Self { top: top * scale, bottom: bottom * scale, rows: [rows.y_axis, rows.w_axis] })
    }

    /// Its light where a ray runs to, in the space of the rays.
    pub(super) fn light(&self, to_camera: &Mat4, origin: Vec3, direction: Vec3) -> Vec3 {
        if self.top == self.bottom {
            return self.top;
        }
        // The divisor of an orthographic camera does not depend on the place.
        let at = match self.rows[1].w != 0.0 {
            true => to_camera.transform_point3(origin).extend(1.0),
            false => to_camera.transform_vector3(direction).extend(0.0),
        };
        let [height, divisor] = self.rows.map(|row| row.dot(at));
        let down = match divisor > 0.0 {
            true => 0.5 - 0.5 * (height / divisor),
            // Behind the eye.
            false if height > 0.0 => 0.0,
            false => 1.0,
        };
        let down = if down > 0.0 { down.min(1.0) } else { 0.0 };
        self.top + (self.bottom - self.top) * down
    }
}
