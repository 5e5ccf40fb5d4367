//! Lights: what they send out, in which unit.
//!
//! A light's `intensity` is what a perfectly white, perfectly diffuse surface
//! shows when the light meets it head-on (a point light: from one metre away).
//! 1 is the white of the display. Photometric units differ by the factor π of
//! a Lambertian surface: `io` divides glTF's lux and candela by π.

use trigon_math::Vec3;

/// The kinds of light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// The same from everywhere; has neither place nor direction.
    Ambient,
    /// Parallel light along the −Z axis of its node, like the sun's.
    Directional,
    /// From the origin of its node in all directions, falling off with the
    /// square of the distance.
    Point,
}

/// A light. Its place and direction come from the node that holds it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// How the light spreads.
    pub kind: LightKind,
    /// Linear RGB, usually within 0…1.
    pub color: Vec3,
    /// What a white surface shows; see the head of this file.
    pub intensity: f32,
}

impl Light {
    /// White light from everywhere.
    pub fn ambient(intensity: f32) -> Self {
        Self { kind: LightKind::Ambient, color: Vec3::ONE, intensity }
    }

    /// White parallel light along the node's −Z axis.
    pub fn directional(intensity: f32) -> Self {
        Self { kind: LightKind::Directional, color: Vec3::ONE, intensity }
    }

    /// White light from the node's origin.
    pub fn point(intensity: f32) -> Self {
        Self { kind: LightKind::Point, color: Vec3::ONE, intensity }
    }

    /// The same light in another colour (linear RGB).
    pub fn with_color(self, color: Vec3) -> Self {
        Self { color, ..self }
    }

    /// Linear RGB that a white surface shows; never negative, never NaN.
    pub(crate) fn radiance(&self) -> Vec3 {
        let value = self.color * self.intensity;
        let clean = |channel: f32| if channel > 0.0 && channel.is_finite() { channel } else { 0.0 };
        Vec3::new(clean(value.x), clean(value.y), clean(value.z))
    }
}
