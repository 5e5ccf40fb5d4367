//! Flags that set the whole quality: a preset, or a time budget; and the settings that other flags
//! fix.

use std::time::Duration;

use trigon_scene::quality::{Quality, TimeBudget};
use trigon_scene::{RaySampling, ShadingModel, Shadows};

use super::output::{Template, plot_name};
use super::values;
use crate::ladder::QualityStep;

/// Flags for the quality as a whole.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct QualityArgs {
    /// Set samples, shading, shadows and rays together: draft, standard, default, high or reference
    ///
    /// Other flags, such as --samples, override it. Shadows and ambient occlusion are drawn only on
    /// request; the preset chooses how.
    #[arg(
        long,
        value_name = "NAME",
        conflicts_with_all = ["time_budget", "replay"],
        help_heading = "Look"
    )]
    pub(crate) preset: Option<QualityStep>,

    /// Draw the image as accurately as this time allows, such as 16ms or 0.5s
    ///
    /// Costs and errors are measured first, on parts of the image, and do not count. The choice,
    /// and what it gave up, is printed. Settings from other flags, such as --samples, are not
    /// changed.
    #[arg(long, value_name = "TIME", value_parser = values::duration, allow_negative_numbers = true, conflicts_with = "replay", help_heading = "Look")]
    pub(crate) time_budget: Option<Duration>,

    /// Measure what the image costs at many settings, and how wrong it then is: a plot (.svg) or a table (.csv)
    ///
    /// Each setting is drawn several times, in random order. Errors are relative to --preset=reference at this size, not
    /// to the exact image. The settings that no other one beats in both time and error are printed. All flags for the
    /// camera, the look and effects count; --time-budget marks what that time buys. The name has the variables of
    /// --output.
    #[arg(
        long,
        value_name = "FILE",
        value_parser = plot_name,
        conflicts_with_all = [
            "output", "capture", "replay", "reference", "compare", "check", "explain", "explain_pixel", "no_render",
            "turntable", "cameras", "json",
        ],
        help_heading = "Files"
    )]
    pub(crate) frontier: Option<Template>,
}

/// Quality settings from individual flags; `None` if not given.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Insisted {
    /// Samples along each side of a pixel, and in each of those.
    pub(crate) samples: Option<(u32, u32)>,
    pub(crate) shading: Option<ShadingModel>,
    pub(crate) shadows: Option<Shadows>,
    pub(crate) occlusion_rays: Option<u32>,
    pub(crate) occlusion_sampling: Option<RaySampling>,
    pub(crate) shadow_rays: Option<u32>,
    pub(crate) shadow_sampling: Option<RaySampling>,
}

impl Insisted {
    /// A quality with the fixed settings applied.
    pub(crate) fn change(&self, quality: Quality) -> Quality {
        let (samples_per_axis, samples) = self.samples.unwrap_or((quality.samples_per_axis, quality.samples));
        Quality {
            samples_per_axis,
            samples,
            shading: self.shading.unwrap_or(quality.shading),
            shadows: self.shadows.unwrap_or(quality.shadows),
            occlusion_rays: self.occlusion_rays.unwrap_or(quality.occlusion_rays),
            occlusion_sampling: self.occlusion_sampling.unwrap_or(quality.occlusion_sampling),
            shadow_rays: self.shadow_rays.unwrap_or(quality.shadow_rays),
            shadow_sampling: self.shadow_sampling.unwrap_or(quality.shadow_sampling),
            // --bounces asks for mirrors, too, and a quality changes only glass without them.
            glass_bounces: quality.glass_bounces,
        }
    }
}

/// The time budget.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Limit {
    time: Duration,
    insisted: Insisted,
}

impl Limit {
    pub(crate) fn new(time: Duration, insisted: Insisted) -> Self {
        Self { time, insisted }
    }

    /// The time.
    pub(crate) fn time(&self) -> Duration {
        self.time
    }

    /// A budget without knowledge of any scene yet.
    pub(crate) fn budget(&self) -> TimeBudget {
        TimeBudget::new(self.time).insisting(|quality| self.insisted.change(quality))
    }
}
