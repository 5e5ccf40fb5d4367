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
//!
//! [`ExposureWarning`] names images of which most would be white or black.

mod surface;

use std::fmt;

use surface::{LitPart, lit_parts};
use trigon_math::elementary;

use crate::effect_settings::Exposure;
use crate::light::{LEAST_LIGHT, LightReading, MOST_LIGHT, short};
use crate::lighting::ADDED_AMBIENT;
use crate::scene::Scene;
use crate::settings::{Lighting, RenderSettings};

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

/// A larger part of the model is worth a warning.
const MOST: f64 = 0.5;

/// What most of a model would show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExposureFault {
    /// White: there even middle grey would be clipped.
    Clipped,
    /// Black: there even white would be darker than a tenth of middle grey.
    Black,
}

/// A warning that most of a model shows nothing but white or black in the light of the scene's lamps. Its
/// `Display` says what to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExposureWarning {
    /// Which of the two.
    pub fault: ExposureFault,
    /// The fraction of the model, more than a half.
    pub share: f32,
    /// The value of a white surface in the middle of that part; 1 is the white of the display.
    pub white: f32,
    /// The exposure by which a light meter would show the model well, in stops.
    pub stops: f32,
    /// Whether the light meter decided the exposure.
    pub is_metered: bool,
}

impl ExposureWarning {
    /// How much of the model is affected, and how badly.
    pub(crate) fn what(&self) -> String {
        let (percent, white) = ((self.share * 100.0).floor(), short(f64::from(self.white)));
        let shown = match self.fault {
            ExposureFault::Clipped => "clipped to white",
            ExposureFault::Black => "black",
        };
        format!(
            "{percent} % of the model is {shown}: a white surface there would have {white} times the display's white"
        )
    }
}

impl fmt::Display for ExposureWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { fault, stops, is_metered, .. } = self;
        write!(f, "{}; ", self.what())?;
        match (fault, is_metered) {
            (ExposureFault::Black, true) => {
                f.write_str("its lamps do not reach it: add an environment, or use the studio lights")
            }
            _ => write!(
                f,
                "an exposure of {stops} stops would show it, and without one the light meter decides"
            ),
        }
    }
}

impl Scene {
    /// Whether most of the model shows nothing but white or black in an image of these settings, in the light of
    /// the scene's lamps. Measures anew each time: for once per model, not per frame.
    #[must_use]
    pub fn exposure_warning(&self, settings: &RenderSettings) -> Option<ExposureWarning> {
        if settings.lighting() == Lighting::Studio || settings.light_factor() == 0.0 {
            return None;
        }
        let parts = lit_parts(self);
        let shown = Shown::new(self, settings);
        let mut values: Vec<(f64, f64)> =
            parts.iter().map(|part| (shown.white(part.white), part.share)).collect();
        values.sort_by(|a, b| a.0.total_cmp(&b.0));
        let warning = |fault, is_affected: &dyn Fn(f64) -> bool| {
            let affected: Vec<(f64, f64)> =
                values.iter().copied().filter(|(white, _)| is_affected(*white)).collect();
            let share: f64 = affected.iter().map(|(_, share)| share).sum();
            (share > MOST).then(|| shown.warning(fault, share, affected[affected.len() / 2].0))
        };
        warning(ExposureFault::Clipped, &|white| white > MOST_LIGHT)
            .or_else(|| warning(ExposureFault::Black, &|white| white < LEAST_LIGHT))
    }
}

/// How the light on a model is shown.
struct Shown {
    /// Factor on the lamps.
    lamps: f64,
    /// Light that is added to them.
    added: f64,
    /// Factor on the image.
    image: f64,
    /// The exposure of the image that would show surfaces in the key light well.
    stops: f32,
    is_metered: bool,
}

impl Shown {
    fn new(scene: &Scene, settings: &RenderSettings) -> Self {
        let effects = &settings.effects;
        let has_ambient =
            scene.nodes().iter().any(|(_, node)| node.light.as_ref().is_some_and(|light| light.is_ambient()));
        let adds = settings.lighting() == Lighting::Automatic && !has_ambient;
        let factor = scene.exposed_by(settings).map_or(1.0, |reading| reading.factor());
        let lights = f64::from(settings.light_factor());
        let added = if effects.environment.is_some() { 1.0 } else { f64::from(ADDED_AMBIENT.x) };
        Self {
            lamps: f64::from(factor) * lights,
            added: if adds || effects.environment.is_some() { added * lights } else { 0.0 },
            image: f64::from(effects.exposure_factor()),
            stops: scene.light_reading().map_or(0.0, |reading| reading.stops),
            is_metered: effects.exposure == Exposure::Metered,
        }
    }

    /// The value of a white surface in some light of the scene.
    fn white(&self, light: f64) -> f64 {
        (light * self.lamps + self.added) * self.image
    }

    fn warning(&self, fault: ExposureFault, share: f64, white: f64) -> ExposureWarning {
        ExposureWarning {
            fault,
            share: share as f32,
            white: white as f32,
            stops: self.stops,
            is_metered: self.is_metered,
        }
    }
}

#[cfg(test)]
mod tests;
