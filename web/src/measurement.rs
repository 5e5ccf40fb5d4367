//! What the image of a model costs at many settings, and how wrong it then is.

use std::time::Duration;

use serde::Serialize;
use trigon_scene::Cancel;
use trigon_scene::quality::{FrontierDot, Sweep, SweepOptions};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::model::{Model, json};
use crate::refusal::Refusal;

#[wasm_bindgen]
extern "C" {
    /// Milliseconds since the page or the worker began.
    #[wasm_bindgen(js_namespace = performance)]
    fn now() -> f64;
}

/// A measurement that is done an image at a time.
#[wasm_bindgen]
pub struct Measurement {
    sweep: Sweep,
    subject: String,
}

#[wasm_bindgen]
impl Measurement {
    /// Of the image that a model shows now. Its plot calls it `subject`.
    #[wasm_bindgen(constructor)]
    #[must_use]
    pub fn new(model: &Model, subject: String) -> Self {
        let (scene, settings) = (model.scene().clone(), model.image_settings());
        let mut options = SweepOptions::default();
        // Pages have no setting for light per vertex.
        options.qualities.retain(|quality| quality.shading == settings.shading);
        Self { sweep: Sweep::new(scene, model.camera(), &settings, options), subject }
    }

    /// Draws the next image. Returns which part of all is drawn: 1 at the end.
    ///
    /// # Errors
    /// A JSON text: the size or a setting is out of range.
    pub fn step(&mut self) -> Result<f64, String> {
        let progress = self.sweep.step(&mut clock, &Cancel::default()).map_err(Refusal::of_image)?;
        Ok(progress.done as f64 / progress.of as f64)
    }

    /// What was measured, as JSON: the plot as SVG, whose first circles are the dots in their order, and the dots.
    #[must_use]
    pub fn result(&self) -> String {
        let frontier = self.sweep.frontier();
        let svg = frontier.plot(&self.subject, None).to_svg();
        json(&Measured { svg, dots: frontier.dots.iter().map(DotFacts::new).collect() })
    }
}

fn clock() -> Duration {
    Duration::try_from_secs_f64(now() / 1e3).unwrap_or_default()
}

#[derive(Serialize)]
struct Measured {
    svg: String,
    dots: Vec<DotFacts>,
}

/// A setting with its time and error.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct DotFacts {
    name: String,
    /// As [`Model::set_samples`] takes it, and as the other two do.
    samples: u32,
    edge_samples: u32,
    glass_bounces: u32,
    /// The lower quartile, the median and the upper quartile.
    milliseconds: [f64; 3],
    error: f64,
    standing: &'static str,
}

impl DotFacts {
    fn new(dot: &FrontierDot) -> Self {
        let time = dot.time;
        Self {
            name: dot.name(),
            samples: dot.quality.samples_per_axis,
            edge_samples: dot.quality.samples,
            glass_bounces: dot.quality.glass_bounces,
            milliseconds: [time.low, time.median, time.high].map(|time| time.as_secs_f64() * 1e3),
            error: dot.error,
            standing: dot.standing.name(),
        }
    }
}
