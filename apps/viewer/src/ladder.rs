//! The ladder of qualities that a user chooses from: the presets, and what is drawn without any.

use std::str::FromStr;

#[cfg(any(test, feature = "window"))]
use trigon_scene::RenderSettings;
use trigon_scene::quality::{Preset, Quality, UnknownPreset};
use trigon_scene::{RaySampling, ShadingModel, Shadows};

/// A step of the ladder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum QualityStep {
    /// A preset of the renderer's.
    Preset(Preset),
    /// What is drawn where no preset is named: 3×3 samples.
    Default,
}

impl QualityStep {
    /// From the quickest to the most accurate.
    pub(crate) const ALL: [Self; 5] = [
        Self::Preset(Preset::Draft),
        Self::Preset(Preset::Standard),
        Self::Default,
        Self::Preset(Preset::High),
        Self::Preset(Preset::Reference),
    ];

    /// The name in commands and in the window.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Preset(preset) => preset.name(),
            Self::Default => "default",
        }
    }

    /// What it stands for.
    pub(crate) fn quality(self) -> Quality {
        match self {
            Self::Preset(preset) => preset.quality(),
            Self::Default => Quality {
                samples_per_axis: 3,
                samples: 1,
                shading: ShadingModel::Phong,
                shadows: Shadows::Maps { resolution: 2048 },
                occlusion_rays: 16,
                occlusion_sampling: RaySampling::Full,
                shadow_rays: 0,
                shadow_sampling: RaySampling::Full,
                glass_bounces: 8,
            },
        }
    }

    /// Whether settings are those of this step.
    #[cfg(any(test, feature = "window"))]
    pub(crate) fn is_current(self, settings: &RenderSettings) -> bool {
        Quality::of(settings) == self.quality().within(settings)
    }
}

impl FromStr for QualityStep {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let named = |step: &Self| step.name().eq_ignore_ascii_case(text);
        let unknown =
            || UnknownPreset(text.to_owned()).to_string().replace("standard,", "standard, default,");
        Self::ALL.into_iter().find(named).ok_or_else(unknown)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_is_a_step_and_every_step_is_finer_than_the_one_before() {
        let settings = RenderSettings::new(8, 8);
        let current: Vec<QualityStep> =
            QualityStep::ALL.into_iter().filter(|step| step.is_current(&settings)).collect();
        assert_eq!(current, [QualityStep::Default], "what is drawn without a preset");
        let finer =
            QualityStep::ALL.windows(2).all(|pair| pair[1].quality().is_finer_than(&pair[0].quality()));
        assert!(finer, "from the quickest to the most accurate");
    }

    #[test]
    fn names_are_read_as_they_are_written() {
        for step in QualityStep::ALL {
            assert_eq!(step.name().to_uppercase().parse(), Ok(step), "{}", step.name());
        }
        let error = "ultra".parse::<QualityStep>().expect_err("there is none");
        let names = QualityStep::ALL.map(QualityStep::name);
        assert!(names.iter().all(|name| error.contains(name)), "{error}");
    }
}
