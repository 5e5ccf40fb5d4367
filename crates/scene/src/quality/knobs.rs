//! The settings that trade accuracy for time, and no others; and named choices of them all.

use std::fmt;
use std::str::FromStr;

use crate::effect_settings::{MOST_RAYS, RaySampling, Shadows, SightRays};
use crate::settings::{RenderSettings, ShadingModel};

/// The settings that trade accuracy for time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quality {
    /// As [`RenderSettings::samples_per_axis`], 1 to 4.
    pub samples_per_axis: u32,
    /// As [`RenderSettings::samples`]: 1, 2, 4, 8 or 16.
    pub samples: u32,
    /// Where lighting is computed.
    pub shading: ShadingModel,
    /// How shadows are computed in frames that have them; [`Shadows::Off`] leaves that unchanged.
    pub shadows: Shadows,
    /// As [`AmbientOcclusion::rays`](crate::AmbientOcclusion::rays) in frames with ambient occlusion, 1 to 256; 0 leaves
    /// them and where they start unchanged.
    pub occlusion_rays: u32,
    /// Where they start.
    pub occlusion_sampling: RaySampling,
    /// As [`SoftShadows::rays`](crate::SoftShadows::rays) in frames with shadows by rays, 1 to 256; 0 leaves them and where
    /// they start unchanged. (Its `Display` leaves them out: most scenes have no lamps with an extent.)
    pub shadow_rays: u32,
    /// Where they start.
    pub shadow_sampling: RaySampling,
    /// The maximum number of surfaces that a ray through glass meets in frames that trace glass
    /// alone, 1 to 16; 0 leaves it unchanged. (Its `Display` leaves it out: most scenes have no
    /// glass.)
    pub glass_bounces: u32,
}

impl Quality {
    /// The quality of these settings. What they do not request is off or 0.
    #[must_use]
    pub fn of(settings: &RenderSettings) -> Self {
        let RenderSettings { samples_per_axis, samples, shading, effects, .. } = settings;
        Self {
            samples_per_axis: *samples_per_axis,
            samples: *samples,
            shading: *shading,
            shadows: effects.shadows,
            occlusion_rays: effects.ambient_occlusion.map_or(0, |occlusion| occlusion.rays),
            occlusion_sampling: effects
                .ambient_occlusion
                .map_or(RaySampling::Full, |occlusion| occlusion.sampling),
            shadow_rays: if effects.shadows == Shadows::Rays { effects.soft_shadows.rays } else { 0 },
            shadow_sampling: match effects.shadows {
                Shadows::Rays => effects.soft_shadows.sampling,
                Shadows::Off | Shadows::Maps { .. } => RaySampling::Full,
            },
            glass_bounces: match effects.sight {
                SightRays::Glass { bounces } => bounces,
                SightRays::Off | SightRays::All { .. } => 0,
            },
        }
    }

    /// Applies it to settings. It does not add shadows or ambient occlusion that those do not
    /// request.
    pub fn apply(&self, settings: &mut RenderSettings) {
        settings.samples_per_axis = self.samples_per_axis;
        settings.samples = self.samples;
        settings.shading = self.shading;
        let effects = &mut settings.effects;
        if effects.shadows != Shadows::Off && self.shadows != Shadows::Off {
            effects.shadows = self.shadows;
        }
        if let Some(occlusion) = &mut effects.ambient_occlusion
            && self.occlusion_rays > 0
        {
            (occlusion.rays, occlusion.sampling) = (self.occlusion_rays, self.occlusion_sampling);
        }
        if effects.shadows == Shadows::Rays && self.shadow_rays > 0 {
            let soft = &mut effects.soft_shadows;
            (soft.rays, soft.sampling) = (self.shadow_rays, self.shadow_sampling);
        }
        if let SightRays::Glass { bounces } = &mut effects.sight
            && self.glass_bounces > 0
        {
            *bounces = self.glass_bounces;
        }
    }

    /// What it means for such a frame: without what the frame does not request.
    #[must_use]
    pub fn within(&self, settings: &RenderSettings) -> Self {
        let mut settings = settings.clone();
        self.apply(&mut settings);
        Self::of(&settings)
    }

    /// Whether nothing in it is coarser, and something is finer.
    #[must_use]
    pub fn is_finer_than(&self, other: &Self) -> bool {
        let (own, others) = (self.fineness(), other.fineness());
        own != others && own.iter().zip(others).all(|(own, other)| *own >= other)
    }

    /// More is finer.
    fn fineness(&self) -> [u32; 7] {
        let shading = match self.shading {
            ShadingModel::Flat => 0,
            ShadingModel::Gouraud => 1,
            ShadingModel::Phong => 2,
        };
        let shadows = match self.shadows {
            Shadows::Off => 0,
            Shadows::Maps { resolution } => resolution,
            Shadows::Rays => u32::MAX,
        };
        // Few rays at every sample show more than many that pixels share.
        let rays = |rays: u32, sampling| match sampling {
            RaySampling::Shared => rays.min(MOST_RAYS),
            RaySampling::Full if rays == 0 => 0,
            RaySampling::Full => MOST_RAYS + rays,
        };
        let occlusion = rays(self.occlusion_rays, self.occlusion_sampling);
        let soft = rays(self.shadow_rays, self.shadow_sampling);
        [self.shaded_samples(), self.covered_samples(), shading, shadows, occlusion, soft, self.glass_bounces]
    }

    /// Lighting evaluations per pixel.
    #[must_use]
    pub fn shaded_samples(&self) -> u32 {
        self.samples_per_axis * self.samples_per_axis
    }

    /// Visibility samples per pixel.
    #[must_use]
    pub fn covered_samples(&self) -> u32 {
        self.shaded_samples() * self.samples
    }
}

impl fmt::Display for Quality {
    /// `3×3 samples of 2, lighting per pixel, shadows by rays, 16 occlusion rays`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.samples_per_axis, self.samples) {
            (1, 1) => write!(f, "1 sample")?,
            (1, samples) => write!(f, "{samples} samples")?,
            (axis, 1) => write!(f, "{axis}×{axis} samples")?,
            (axis, samples) => write!(f, "{axis}×{axis} samples of {samples}")?,
        }
        f.write_str(match self.shading {
            ShadingModel::Flat => ", lighting per triangle",
            ShadingModel::Gouraud => ", lighting per vertex",
            ShadingModel::Phong => ", lighting per pixel",
        })?;
        match self.shadows {
            Shadows::Off => {}
            Shadows::Maps { resolution } => write!(f, ", shadow maps of {resolution} texels")?,
            Shadows::Rays => write!(f, ", shadows by rays")?,
        }
        match (self.occlusion_rays, self.occlusion_sampling) {
            (0, _) => Ok(()),
            (1, RaySampling::Full) => write!(f, ", 1 occlusion ray"),
            (rays, RaySampling::Full) => write!(f, ", {rays} occlusion rays"),
            (rays, RaySampling::Shared) => write!(f, ", {rays} shared occlusion rays"),
        }
    }
}

/// A named quality. Each takes two to five times as long as the one before it.
/// [`Standard`](Self::Standard) and [`High`](Self::High) have less than half of the error of the
/// one before, [`Reference`](Self::Reference) about three quarters: means over the twelve scenes of
/// `docs/accuracy.md`, against images by rays in `f64`.
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
    /// All of them compute lighting per pixel. Per vertex it takes two thirds of a draft's time and
    /// has twice its error (`docs/accuracy.md`), so only a [`TimeBudget`](crate::quality::TimeBudget) falls back on it.
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
                occlusion_rays: 32,
                occlusion_sampling: RaySampling::Shared,
                shadow_rays: 0,
                shadow_sampling: RaySampling::Full,
                glass_bounces: 4,
            },
            Self::Standard => {
                Quality { samples_per_axis: 2, occlusion_rays: 64, glass_bounces: 8, ..Self::Draft.quality() }
            }
            Self::High => Quality {
                samples_per_axis: 4,
                shadows: Shadows::Rays,
                occlusion_rays: 16,
                occlusion_sampling: RaySampling::Full,
                shadow_rays: 64,
                shadow_sampling: RaySampling::Shared,
                ..Self::Standard.quality()
            },
            Self::Reference => Quality {
                samples: 16,
                occlusion_rays: 64,
                shadow_sampling: RaySampling::Full,
                ..Self::High.quality()
            },
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
    use crate::effect_settings::{AmbientOcclusion, EffectSettings};
    use crate::quality::Preset;

    fn asking_for_all() -> RenderSettings {
        let effects = EffectSettings {
            shadows: Shadows::Maps { resolution: 100 },
            ambient_occlusion: Some(AmbientOcclusion::new(3, 0.7)),
            ..EffectSettings::default()
        };
        RenderSettings { effects, ..RenderSettings::new(30, 20) }
    }

    #[test]
    fn what_was_put_in_comes_out() {
        for preset in Preset::ALL {
            let (quality, mut settings) = (preset.quality(), asking_for_all());
            quality.apply(&mut settings);
            assert_eq!(Quality::of(&settings), quality, "{preset}");
            let occlusion = settings.effects.ambient_occlusion.expect("asked for");
            assert_eq!(occlusion.distance, 0.7, "{preset}: what it looks like is not touched");
        }
        let (mut same, before) = (asking_for_all(), asking_for_all());
        Quality::of(&before).apply(&mut same);
        assert_eq!(same, before, "its own quality changes nothing");
    }

    #[test]
    fn finer_is_finer_in_something_and_coarser_in_nothing() {
        for pair in Preset::ALL.map(Preset::quality).windows(2) {
            assert!(pair[1].is_finer_than(&pair[0]) && !pair[0].is_finer_than(&pair[1]), "{}", pair[1]);
        }
        let high = Preset::High.quality();
        assert!(!high.is_finer_than(&high), "not than itself");
        let other = Quality { samples: 16, occlusion_rays: high.occlusion_rays - 1, ..high };
        assert!(!other.is_finer_than(&high) && !high.is_finer_than(&other), "neither, of two of each kind");
    }

    #[test]
    fn nothing_is_added_to_an_image() {
        let mut settings = RenderSettings::new(30, 20);
        let before = settings.clone();
        Preset::Reference.apply(&mut settings);
        assert_eq!(settings.effects, before.effects, "no shadows, no occlusion");
        let left = Preset::Reference.quality().within(&before);
        assert_eq!((left.shadows, left.occlusion_rays), (Shadows::Off, 0), "and it says so");
    }

    #[test]
    fn it_can_be_read() {
        let mut quality = Preset::Draft.quality().within(&RenderSettings::new(1, 1));
        assert_eq!(quality.to_string(), "1 sample, lighting per pixel", "one");
        (quality.samples, quality.shading, quality.occlusion_rays) = (4, ShadingModel::Flat, 1);
        assert_eq!(quality.to_string(), "4 samples, lighting per triangle, 1 occlusion ray", "four");
        (quality.samples_per_axis, quality.shadows) = (2, Shadows::Maps { resolution: 512 });
        assert!(quality.to_string().starts_with("2×2 samples of 4,"), "{quality}");
        assert!(quality.to_string().contains("shadow maps of 512 texels"), "{quality}");
        assert_eq!((quality.shaded_samples(), quality.covered_samples()), (4, 16), "of a pixel");
        (quality.occlusion_rays, quality.occlusion_sampling) = (32, RaySampling::Shared);
        assert!(quality.to_string().ends_with(", 32 shared occlusion rays"), "{quality}");
    }

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
            (quality.shaded_samples(), quality.covered_samples(), quality.fineness()[4])
        });
        assert!(samples.is_sorted() && samples.windows(2).all(|pair| pair[0].1 < pair[1].1), "{samples:?}");
    }
}
