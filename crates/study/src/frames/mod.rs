//! What does a whole picture's accuracy cost? Scenes of three kinds at all qualities that
//! a time budget chooses from, against the reference; and such a budget on a flight.

mod cases;
mod certified;
mod flight;
mod truth;

#[cfg(test)]
mod tests;

pub use cases::Case;
pub use certified::{Certified, Prover};
pub use flight::{Kept, Step, fly};
pub use truth::Truth;

use trigon_scene::quality::{Preset, Quality, candidates};
use trigon_scene::{Frame, RenderError, Renderer, Scene, ShadingModel, SimdLevel};

/// What is compared: the budget's candidates, and the draft with light at fewer places.
pub fn variants() -> Vec<Quality> {
    let draft = Preset::Draft.quality();
    let coarse = [ShadingModel::Flat, ShadingModel::Gouraud].map(|shading| Quality { shading, ..draft });
    coarse.into_iter().chain(candidates()).collect()
}

/// The name of a variant in tables and plots: its samples, and the preset if it is one.
pub fn name(quality: Quality) -> String {
    let Quality { samples_per_axis: axis, samples, .. } = quality;
    let places = match quality.shading {
        ShadingModel::Flat => ", flat",
        ShadingModel::Gouraud => ", Gouraud",
        ShadingModel::Phong => "",
    };
    let preset = Preset::ALL.into_iter().find(|preset| preset.quality() == quality);
    let preset = preset.map_or_else(String::new, |preset| format!(" ({preset})"));
    format!("{axis}×{axis}×{samples}{places}{preset}")
}

/// A case at a quality, drawn as often as asked for.
pub struct Repeated {
    case: Case,
    scene: Scene,
    renderer: Renderer,
    frame: Frame,
}

impl Repeated {
    /// Nothing is drawn yet.
    pub fn new(case: Case, size: [u32; 2], quality: Quality) -> Self {
        let mut settings = case.settings(size);
        quality.apply(&mut settings);
        Self { case, scene: case.scene(), renderer: Renderer::new(settings), frame: Frame::default() }
    }

    /// With these vector instructions.
    #[must_use]
    pub fn at_level(mut self, level: SimdLevel) -> Self {
        self.renderer.settings_mut().simd = Some(level);
        self
    }

    /// Where the flight is in a part of it, from 0 to 1.
    ///
    /// # Errors
    /// A size that cannot be drawn.
    pub fn draw(&mut self, part: f64) -> Result<&Frame, RenderError> {
        let camera = self.case.camera(&self.scene, self.renderer.settings().aspect(), part);
        self.renderer.render_into(&self.scene, &camera, &mut self.frame)?;
        Ok(&self.frame)
    }
}

/// How far each of some qualities is from the [`Truth`] at the start of a case's flight.
///
/// # Errors
/// A size that cannot be drawn.
pub fn errors(case: Case, size: [u32; 2], qualities: &[Quality]) -> Result<Vec<f64>, RenderError> {
    let truth = Truth::new(case, size)?;
    let error = |&quality: &Quality| Ok(truth.error(Repeated::new(case, size, quality).draw(0.0)?));
    qualities.iter().map(error).collect()
}
