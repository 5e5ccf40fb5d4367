//! Lights: their kinds, colours and intensities.
//!
//! A light's `intensity` is the brightness of a perfectly white, perfectly diffuse surface that it
//! hits head-on (for a point or spot light: from one metre away). 1 is the white of the display.
//! Photometric units differ by the factor π of a Lambertian surface: `io` divides glTF's lux and
//! candela by π.
//!
//! The falloff with distance and towards the edge of a cone follows the glTF extension
//! KHR_lights_punctual, sections "Range Property" and "Inner and Outer Cone Angles".
//!
//! [`LightReading`] is what a light meter reads; a scene keeps the reading. [`light_meter`](crate::light_meter) measures
//! it.

use std::f32::consts::FRAC_PI_4;
use std::sync::OnceLock;

use trigon_math::{Vec3, elementary};

/// The kinds of light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// Ambient light: the same from all directions, without position or direction.
    Ambient,
    /// Parallel light along the −Z axis of its node, like sunlight.
    Directional,
    /// From the origin of its node in all directions.
    Point,
    /// From the origin of its node in a cone around its −Z axis.
    Spot {
        /// The angle from the axis at which the light begins to fade, in radians: 0 to `outer`.
        inner: f32,
        /// The angle from the axis beyond which there is no light, in radians: up to π/2.
        outer: f32,
    },
}

/// A light. Its position and direction come from the node that holds it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// How the light spreads.
    pub kind: LightKind,
    /// Linear RGB, usually within 0…1.
    pub color: Vec3,
    /// The brightness of a white surface, as defined at the top of this file.
    pub intensity: f32,
    /// The distance in metres beyond which a point or spot light does not shine; infinite by
    /// default. See [`Light::falloff`].
    pub range: f32,
    /// How large the lamp is for its shadows, whose edges are soft above 0, the default. A point or spot light is a
    /// sphere of this radius in metres. A directional light is a disc with this radius at a distance of one metre: the
    /// tangent of half the angle that it spans, 0.00465 for the sun. The light itself comes from the middle.
    pub radius: f32,
}

impl Light {
    /// White ambient light.
    #[must_use]
    pub fn ambient(intensity: f32) -> Self {
        Self { kind: LightKind::Ambient, color: Vec3::ONE, intensity, range: f32::INFINITY, radius: 0.0 }
    }

    /// White parallel light along the node's −Z axis.
    #[must_use]
    pub fn directional(intensity: f32) -> Self {
        Self { kind: LightKind::Directional, ..Self::ambient(intensity) }
    }

    /// White light from the node's origin.
    #[must_use]
    pub fn point(intensity: f32) -> Self {
        Self { kind: LightKind::Point, ..Self::ambient(intensity) }
    }

    /// White light in a cone around the node's −Z axis, brightest in its middle and fading to
    /// nothing at π/4 from the axis.
    #[must_use]
    pub fn spot(intensity: f32) -> Self {
        Self { kind: LightKind::Spot { inner: 0.0, outer: FRAC_PI_4 }, ..Self::ambient(intensity) }
    }

    /// The same light in another colour (linear RGB).
    #[must_use]
    pub fn with_color(self, color: Vec3) -> Self {
        Self { color, ..self }
    }

    /// The same light with another range in metres.
    #[must_use]
    pub fn with_range(self, range: f32) -> Self {
        Self { range, ..self }
    }

    /// The same light with another [radius](Self::radius).
    #[must_use]
    pub fn with_radius(self, radius: f32) -> Self {
        Self { radius, ..self }
    }

    /// The fraction of a point or spot light that arrives at a distance, given squared, in square
    /// metres: `clamp(1 − (d / range)⁴, 0, 1) / d²`. 0 if that is not a number: at the light
    /// itself, and at infinity.
    #[must_use]
    pub fn falloff(&self, distance_squared: f32) -> f32 {
        let inverse = 1.0 / distance_squared;
        if !(distance_squared > 0.0 && inverse.is_finite()) {
            return 0.0;
        }
        // A range that is infinite or not a positive number is no limit.
        let relative = if self.range > 0.0 { distance_squared / (self.range * self.range) } else { 0.0 };
        let window = 1.0 - relative * relative;
        if window > 0.0 { window * inverse } else { 0.0 }
    }

    /// `(scale, offset)` of a spot light's cone. At an angle θ from its axis the intensity is
    /// multiplied by `clamp(cos θ · scale + offset, 0, 1)²`. Lights of other kinds have (0, 1): the
    /// same everywhere.
    #[must_use]
    pub fn cone(&self) -> (f32, f32) {
        // The specification's bound: below it, a cone has a hard edge.
        const NARROWEST: f32 = 0.001;
        let LightKind::Spot { inner, outer } = self.kind else { return (0.0, 1.0) };
        let (inner, outer) = (elementary::cos_f32(inner), elementary::cos_f32(outer));
        let fading = inner - outer;
        let scale = 1.0 / if fading > NARROWEST { fading } else { NARROWEST };
        (scale, -outer * scale)
    }

    /// Whether it is the same from all directions.
    pub(crate) fn is_ambient(&self) -> bool {
        self.kind == LightKind::Ambient
    }

    /// The radius that counts for shadows; 0 for a sharp one.
    pub(crate) fn extent(&self) -> f32 {
        if self.is_ambient() { 0.0 } else { sound_radius(self.radius) }
    }

    /// The linear RGB of a white surface; never negative, never NaN.
    pub(crate) fn radiance(&self) -> Vec3 {
        let value = self.color * self.intensity;
        let clean = |channel: f32| if channel > 0.0 && channel.is_finite() { channel } else { 0.0 };
        Vec3::new(clean(value.x), clean(value.y), clean(value.z))
    }
}

/// A radius within the range in which its square is a number; 0 for what is none.
pub(crate) fn sound_radius(radius: f32) -> f32 {
    /// A lamp of this radius covers half of the sky.
    const LARGEST: f32 = (1_u64 << 60) as f32;
    match radius > 0.0 {
        true if radius < LARGEST => radius,
        true => LARGEST,
        false => 0.0,
    }
}

/// What a surface of middle grey reflects.
const MIDDLE_GREY: f64 = 0.18;

/// In brighter light even middle grey would be clipped.
pub(crate) const MOST_LIGHT: f64 = 1.0 / MIDDLE_GREY;

/// In fainter light even white would be darker than a tenth of middle grey, which shows as 36 of 255.
pub(crate) const LEAST_LIGHT: f64 = MIDDLE_GREY / 10.0;

/// What a light meter reads in a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightReading {
    /// The value of a white diffuse surface in the key light; 1 is the white of the display.
    pub white: f32,
    /// The exposure that shows such a surface well, in stops; a multiple of a hundredth.
    pub stops: f32,
}

/// Neither number is ever NaN.
impl Eq for LightReading {}

impl LightReading {
    /// Whether a display can show surfaces in the key light as it is.
    #[must_use]
    pub fn is_in_range(&self) -> bool {
        (LEAST_LIGHT..=MOST_LIGHT).contains(&f64::from(self.white))
    }

    /// How bright white is, in at least three digits.
    pub(crate) fn white_text(&self) -> String {
        short(f64::from(self.white))
    }

    /// The factor for the lamps that the exposure stands for.
    #[must_use]
    pub fn factor(&self) -> f32 {
        elementary::exp2_f32(self.stops)
    }
}

/// A brightness in at least three digits.
pub(crate) fn short(value: f64) -> String {
    match value {
        0.0 => "0".to_owned(),
        100.0..1e7 => format!("{value:.0}"),
        0.01..100.0 => format!("{value:.3}"),
        _ => format!("{value:.2e}"),
    }
}

/// The reading that a scene keeps until its nodes or meshes change. Poses leave it as it is.
#[derive(Clone, Debug, Default)]
pub(crate) struct CachedReading(OnceLock<Measured>);

#[derive(Clone, Debug)]
struct Measured {
    reading: Option<LightReading>,
    /// The number of animated properties: a scene does not notice when they are added.
    channels: usize,
}

impl CachedReading {
    /// The kept reading, or a new one. `channels` is the number of animated properties now.
    pub(crate) fn get(
        &self,
        channels: usize,
        measure: impl Fn() -> Option<LightReading>,
    ) -> Option<LightReading> {
        let cached = self.0.get_or_init(|| Measured { reading: measure(), channels });
        if cached.channels == channels { cached.reading } else { measure() }
    }

    /// Something has changed.
    pub(crate) fn forget(&mut self) {
        self.0.take();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_falls_off_as_the_extension_says() {
        let light = Light::point(1.0).with_range(4.0);
        assert_eq!(light.falloff(4.0), (1.0 - 0.0625) / 4.0, "at 2 m of 4");
        assert_eq!(light.falloff(16.0), 0.0, "at its range");
        assert_eq!(light.falloff(25.0), 0.0, "beyond");
        assert_eq!(Light::point(1.0).falloff(4.0), 0.25, "without a range");
        for distance in [0.0, -1.0, f32::NAN, f32::INFINITY, 1e-45] {
            assert_eq!(light.falloff(distance), 0.0, "no direction at {distance}");
        }
        assert_eq!(Light::point(1.0).with_range(f32::NAN).falloff(4.0), 0.25, "no number limits nothing");
    }

    #[test]
    fn a_light_of_each_kind_is_white_and_unlimited() {
        let lights = [
            (Light::ambient(3.0), LightKind::Ambient),
            (Light::directional(3.0), LightKind::Directional),
            (Light::point(3.0), LightKind::Point),
            (Light::spot(3.0), LightKind::Spot { inner: 0.0, outer: FRAC_PI_4 }),
        ];
        for (light, kind) in lights {
            let plain = Light { kind, color: Vec3::ONE, intensity: 3.0, range: f32::INFINITY, radius: 0.0 };
            assert_eq!(light, plain);
            let color = Vec3::new(0.1, 0.2, 0.3);
            assert_eq!(light.with_color(color), Light { color, ..plain });
            assert_eq!(light.with_range(4.0), Light { range: 4.0, ..plain });
            assert_eq!(light.with_radius(4.0), Light { radius: 4.0, ..plain });
            assert_eq!(light.with_color(color).radiance(), color * 3.0);
        }
        let odd = Light::point(2.0).with_color(Vec3::new(-1.0, f32::NAN, f32::INFINITY));
        assert_eq!(odd.radiance(), Vec3::ZERO, "what is no light does not shine");
    }

    #[test]
    fn a_cone_fades_between_its_angles() {
        let light = Light { kind: LightKind::Spot { inner: 0.3, outer: 0.6 }, ..Light::spot(1.0) };
        let (scale, offset) = light.cone();
        let share = |angle: f32| {
            let linear = (elementary::cos_f32(angle) * scale + offset).clamp(0.0, 1.0);
            linear * linear
        };
        assert_eq!((share(0.0), share(0.25), share(0.65)), (1.0, 1.0, 0.0), "inside, and outside");
        let (inner, outer) = (elementary::cos(0.3), elementary::cos(0.6));
        let exact = (elementary::cos(0.45) - outer) / (inner - outer);
        assert!((f64::from(share(0.45)) - exact * exact).abs() < 1e-6, "half way: {}", share(0.45));
        assert_eq!(Light::point(1.0).cone(), (0.0, 1.0), "a point light has no cone");
        let sharp = Light { kind: LightKind::Spot { inner: 0.6, outer: 0.6 }, ..light };
        assert!(sharp.cone().0.is_finite(), "a hard rim is no division by zero");
    }
}
