//! Images of which most would be white or black.

use std::fmt;

use super::lit_parts;
use crate::effect_settings::Exposure;
use crate::light_reading::{LEAST_LIGHT, MOST_LIGHT, short};
use crate::lighting::ADDED_AMBIENT;
use crate::scene::Scene;
use crate::settings::{Lighting, RenderSettings};

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
            scene.nodes().iter().any(|(_, node)| node.light.is_some_and(|light| light.is_ambient()));
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
