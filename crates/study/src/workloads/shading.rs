//! The light, and the two formulas by which surfaces answer it.

use trigon_math::Vec3;

/// Red, green and blue of lit surfaces.
pub(super) const BASE_COLOR: Vec3 = Vec3::new(0.85, 0.65, 0.40);

/// The share of light that comes from everywhere.
pub(super) const AMBIENT: f32 = 0.1;

/// The strength of highlights. Their exponent is 32: five squares.
const SPECULAR: f32 = 0.4;

/// The direction towards the light.
pub(super) fn light() -> Vec3 {
    Vec3::new(0.4, 0.7, 0.6).normalize()
}

/// Lambert's law with some light from everywhere: between `ambient` and 1.
pub(super) fn lambert(normal: Vec3, ambient: f32) -> f32 {
    ambient + (1.0 - ambient) * positive(normal.dot(light()))
}

/// J. F. Blinn, "Models of light reflection for computer synthesized pictures",
/// SIGGRAPH 1977: the highlight by the angle between the normal and the middle
/// of light and eye.
pub(super) fn blinn_phong(position: Vec3, normal: Vec3, eye: Vec3) -> Vec3 {
    let normal = normal.normalize_or_zero();
    let to_eye = (eye - position).normalize_or_zero();
    let half = (light() + to_eye).normalize_or_zero();
    let mut highlight = positive(normal.dot(half));
    for _ in 0..5 {
        highlight *= highlight;
    }
    BASE_COLOR * lambert(normal, AMBIENT) + Vec3::splat(SPECULAR * highlight)
}

fn positive(value: f32) -> f32 {
    if value > 0.0 { value } else { 0.0 }
}
