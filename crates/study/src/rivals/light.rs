//! The workloads' lighting and colours, implemented from their definition.

use trigon_math::{DVec3, elementary};

/// Red, green and blue of lit surfaces.
const BASE: DVec3 = DVec3::new(0.85, 0.65, 0.40);

/// Lambert's law with a tenth of the light from everywhere.
pub(super) fn lambert(normal: DVec3) -> f64 {
    0.1 + 0.9 * normal.dot(to_light()).max(0.0)
}

/// A colour in so much light.
pub(super) fn lit(light: f64) -> DVec3 {
    BASE * light
}

/// Blinn's highlight with an exponent of 32 over Lambert's law.
pub(super) fn blinn_phong(position: DVec3, normal: DVec3, eye: DVec3) -> DVec3 {
    let normal = normal.normalize();
    let half = (to_light() + (eye - position).normalize()).normalize();
    lit(lambert(normal)) + DVec3::splat(0.4 * elementary::pow(normal.dot(half).max(0.0), 32.0))
}

fn to_light() -> DVec3 {
    DVec3::new(0.4, 0.7, 0.6).normalize()
}
