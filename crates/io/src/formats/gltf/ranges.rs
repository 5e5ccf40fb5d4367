//! The valid ranges of material factors.

/// A number from 0 to 1.
pub(crate) fn share(value: f32, otherwise: f32) -> f32 {
    if value.is_finite() { value.clamp(0.0, 1.0) } else { otherwise }
}

/// A number from 0.
pub(crate) fn amount(value: f32, otherwise: f32) -> f32 {
    match value.is_finite() {
        true if value > 0.0 => value,
        true => 0.0,
        false => otherwise,
    }
}
