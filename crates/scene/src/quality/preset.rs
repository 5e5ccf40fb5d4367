//! Named qualities.

use std::fmt;
use std::str::FromStr;

use super::Quality;
use crate::effect_settings::Shadows;
use crate::settings::{RenderSettings, ShadingModel};

/// A named quality. Each takes two to five times as long as the one before it.
/// [`Standard`](Self::Standard) and [`High`](Self::High) have about four tenths of the error of the
/// one before, [`Reference`](Self::Reference) about eight tenths: `docs/accuracy.md` compares whole
/// images with sample positions that none of them uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Preset {
    /// One sample per pixel: for finding a view, and for images that only programs see.
    Draft,
    /// 2×2 samples: for moving images.
    Standard,
    /// 4×4 samples and exact shadows: for still images.
    High,
    /// The best that the engine does: the others are measured against it.
    Reference,
}

impl Preset {
    /// From the fastest to the most accurate.
    pub const ALL: [Self; 4] = [Self::Draft, Self::Standard, Self::High, Self::Reference];

    /// Its quality.
    ///
    /// All of them compute lighting per pixel: per-vertex lighting is less accurate, and hardly
    /// faster.
    #[must_use]
    pub const fn quality(self) -> Quality {
        let shading = ShadingModel::Phong;
        let maps = Shadows::Maps { resolution: 2048 };
        match self {
            Self::Draft => Quality {
                samples_per_axis: 1,
                samples: 1,
                shading,
                shadows: maps,
                occlusion_rays: 8,
                glass_bounces: 4,
            },
            Self::Standard => {
                Quality { samples_per_axis: 2, occlusion_rays: 16, glass_bounces: 8, ..Self::Draft.quality() }
            }
            Self::High => Quality { samples_per_axis: 4, shadows: Shadows::Rays, ..Self::Standard.quality() },
            Self::Reference => Quality { samples: 16, occlusion_rays: 64, ..Self::High.quality() },
        }
    }

    /// Applies its quality to settings, and leaves everything else in them unchanged.
    pub fn apply(self, settings: &mut RenderSettings) {
        self.quality().apply(settings);
    }

    /// The name in commands and interfaces.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Draft => "draft",
            Self::Standard => "standard",
            Self::High => "high",
            Self::Reference => "reference",
        }
    }
}

impl fmt::Display for Preset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Preset {
    type Err = UnknownPreset;

    fn from_str(text: &str) -> Result<Self, UnknownPreset> {
        let named = |preset: &Self| preset.name().eq_ignore_ascii_case(text);
        Self::ALL.into_iter().find(named).ok_or_else(|| UnknownPreset(text.to_owned()))
    }
}

/// No preset has this name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no preset {0:?}; write draft, standard, high or reference")]
pub struct UnknownPreset(pub String);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_as_they_are_written() {
        for preset in Preset::ALL {
            assert_eq!(preset.to_string().parse(), Ok(preset), "{preset}");
        }
        assert_eq!("HIGH".parse(), Ok(Preset::High), "in any case");
        let error = "ultra".parse::<Preset>().expect_err("there is none");
        assert!(error.to_string().contains("\"ultra\"") && error.to_string().contains("standard"), "{error}");
    }

    #[test]
    fn each_decides_more_than_the_one_before() {
        let samples = Preset::ALL.map(|preset| {
            let quality = preset.quality();
            (quality.shaded_samples(), quality.covered_samples(), quality.occlusion_rays)
        });
        assert!(samples.is_sorted() && samples.windows(2).all(|pair| pair[0].1 < pair[1].1), "{samples:?}");
    }
}
