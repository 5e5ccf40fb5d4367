//! What does a whole image's accuracy cost? Six scenes with all combinations of samples and shading, compared
//! with a [`Truth`]; and a time budget on flights past them.

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

use trigon_scene::quality::{Preset, Quality};
use trigon_scene::{Frame, RenderError, Renderer, Scene, ShadingModel, Shadows, SimdLevel};

/// The variants of every case: all numbers of samples, with light once per triangle, per vertex and per
/// pixel. The presets are among them.
#[must_use]
pub fn variants() -> Vec<Quality> {
    let models = [ShadingModel::Flat, ShadingModel::Gouraud, ShadingModel::Phong];
    let shaded = |shading| sampled().into_iter().map(move |quality| Quality { shading, ..quality });
    models.into_iter().flat_map(shaded).collect()
}

/// The additional variants for scenes with shadows: those of [`variants`] with maps instead of rays, and the
/// other way round.
#[must_use]
pub fn other_shadows() -> Vec<Quality> {
    let by_maps = Preset::Draft.quality().shadows;
    let other = |quality: Quality| {
        let shadows = if quality.shadows == Shadows::Rays { by_maps } else { Shadows::Rays };
        Quality { shadows, ..quality }
    };
    sampled().into_iter().map(other).collect()
}

/// All numbers of samples, with what the presets choose beside them.
fn sampled() -> Vec<Quality> {
    let of_axis = |axis: u32| {
        let samples = [1, 2, 4, 8, 16].into_iter();
        samples.map(move |samples| {
            let like = match (axis, samples) {
                (1, _) => Preset::Draft,
                (2, _) => Preset::Standard,
                (4, 16) => Preset::Reference,
                _ => Preset::High,
            };
            Quality { samples_per_axis: axis, samples, ..like.quality() }
        })
    };
    (1..=4).flat_map(of_axis).collect()
}

/// The name of a variant in tables and plots: its samples, what is unusual about it, and the preset if it is one.
pub fn name(quality: Quality) -> String {
    let Quality { samples_per_axis: axis, samples, .. } = quality;
    let places = match quality.shading {
        ShadingModel::Flat => ", flat",
        ShadingModel::Gouraud => ", Gouraud",
        ShadingModel::Phong => "",
    };
    let shadows = match quality.shadows {
        Shadows::Rays if axis < 3 => ", shadow rays",
        Shadows::Maps { .. } if axis > 2 => ", shadow maps",
        _ => "",
    };
    let preset = Preset::ALL.into_iter().find(|preset| preset.quality() == quality);
    let preset = preset.map_or_else(String::new, |preset| format!(" ({preset})"));
    format!("{axis}×{axis}×{samples}{places}{shadows}{preset}")
}

/// A case at a quality, drawn repeatedly.
pub struct Repeated {
    case: Case,
    scene: Scene,
    renderer: Renderer,
    frame: Frame,
}

impl Repeated {
    /// Nothing is drawn yet.
    #[must_use]
    pub fn new(case: Case, size: [u32; 2], quality: Quality) -> Self {
        let mut settings = case.settings(size);
        quality.apply(&mut settings);
        Self { case, scene: case.scene(), renderer: Renderer::new(settings), frame: Frame::default() }
    }

    /// With these SIMD instructions.
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

/// The errors of several qualities, relative to the [`Truth`], at the start of a case's flight.
///
/// # Errors
/// A size that cannot be drawn.
pub fn errors(case: Case, size: [u32; 2], qualities: &[Quality]) -> Result<Vec<f64>, RenderError> {
    let truth = Truth::new(case, size)?;
    let error = |&quality: &Quality| Ok(truth.error(Repeated::new(case, size, quality).draw(0.0)?));
    qualities.iter().map(error).collect()
}
