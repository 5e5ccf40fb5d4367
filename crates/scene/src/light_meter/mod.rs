//! A light meter for scenes whose lamps shine far brighter, or fainter, than a display can show: lamps in lux
//! and candela, as modelling programs export them.
//!
//! It reads the light that arrives at the model, whatever its materials are, as a photographer holds a meter
//! beside the subject: neither the camera nor the image matters. So all images of a model have the same
//! exposure. The reading belongs to the scene and is kept there. Of a scene with animations it is that of their
//! beginning, whatever the pose.
//!
//! - Every object counts the same, however large it is: a wide floor does not outweigh what stands on it.
//!   Within an object, every area counts the same.
//! - What no lamp reaches does not count, nor do the brightest tenth of the rest, such as a wall right behind
//!   a lamp. The brightest light that is left is the key light.
//! - Shadows and reflections are not part of it.
//!
//! The scene's lamps are exposed only if a display could not show a surface in the key light: if even middle
//! grey would be clipped, or white darker than a tenth of middle grey. Then they are dimmed or brightened so
//! that white is about as bright as in the studio light. Everything else stays: ambient light that is added to the
//! scene, an environment, unlit surfaces, and light that surfaces emit. glTF defines emission in nits, but programs
//! that export lamps in candela write emission beside them as a plain factor: dimmed with such lamps, glowing surfaces
//! would be black.

mod lamps;
mod surface;
mod warning;

pub use warning::{ExposureFault, ExposureWarning};

use trigon_math::elementary;

use crate::effect_settings::Exposure;
use crate::light_reading::LightReading;
use crate::scene::Scene;
use crate::settings::RenderSettings;
use surface::{LitPart, lit_parts};

/// The value of a white surface in the key light once it is exposed. With the tenth of ambient light that is
/// added to most scenes it is as bright as in the studio.
const EXPOSED_WHITE: f64 = 0.7;

/// The fraction of what lamps reach that is not brighter than the key light.
const KEY_SHARE: f64 = 0.9;

/// Light brighter than this, or fainter than one over this, is read as this.
const EXTREME: f64 = (1_u128 << 100) as f64;

/// The reading of the parts of a model; `None` if no light reaches any of them.
fn reading_of(parts: &[LitPart]) -> Option<LightReading> {
    let mut lit: Vec<LitPart> = parts.iter().filter(|part| part.white > 0.0).copied().collect();
    lit.sort_by(|a, b| a.white.total_cmp(&b.white));
    let key_share = lit.iter().map(|part| part.share).sum::<f64>() * KEY_SHARE;
    let mut sum = 0.0;
    let key = lit.iter().find(|part| {
        sum += part.share;
        sum >= key_share
    });
    let white = key?.white.clamp(1.0 / EXTREME, EXTREME);
    let stops = (elementary::log2(EXPOSED_WHITE / white) * 100.0).round() / 100.0;
    Some(LightReading { white: white as f32, stops: stops as f32 })
}

impl Scene {
    /// What a light meter reads in the scene; `None` if it has no lamp, or none reaches the model. It depends on
    /// neither the camera nor the pose of animated nodes: see [`Exposure::Metered`] for what it is used for.
    ///
    /// ```
    /// use trigon_scene::math::{DVec3, Vec3};
    /// use trigon_scene::mesh::primitives;
    /// use trigon_scene::{Light, Material, Node, Scene};
    ///
    /// let mut scene = Scene::new();
    /// scene.add_object("chip", primitives::plane(0.01, 0.01), Material::from_color(Vec3::ONE));
    /// // 1000 candela, one metre above: 1000 lux.
    /// let lamp = Light::point(1000.0 / std::f32::consts::PI);
    /// scene.add(Node::from_light(lamp).at(DVec3::Y));
    /// let reading = scene.light_reading().expect("there is light");
    /// assert!((reading.white - 318.3).abs() < 0.1 && !reading.is_in_range());
    /// assert_eq!(reading.stops, -8.83);
    /// ```
    #[must_use]
    pub fn light_reading(&self) -> Option<LightReading> {
        let channels = self.animations.iter().map(|animation| animation.channels.len()).sum();
        self.reading.get(channels, || reading_of(&lit_parts(self)))
    }

    /// The reading by which an image of these settings exposes the scene's lamps; `None` if they stay as they
    /// are.
    pub(crate) fn exposed_by(&self, settings: &RenderSettings) -> Option<LightReading> {
        if settings.effects.exposure != Exposure::Metered {
            return None;
        }
        let reading = self.light_reading().filter(|reading| !reading.is_in_range())?;
        // An environment lights what faint lamps do not.
        (reading.stops < 0.0 || settings.effects.environment.is_none()).then_some(reading)
    }
}

#[cfg(test)]
mod tests;
