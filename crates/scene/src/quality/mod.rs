//! Quality: named choices of all settings that trade accuracy for time, and choosing one that fits
//! into a time.
//!
//! A [`Quality`] is the values of these settings, and nothing else. A [`Preset`] is a named one.
//! Whether there are shadows at all, and everything else that defines the content of a frame, is
//! not part of it and stays unchanged.
//!
//! A [`TimeBudget`] chooses the most accurate quality that fits into a time: a [`CostModel`]
//! predicts times from measured frames, an [`ErrorModel`] predicts errors from images and
//! references. Times come from the caller; the same times give the same choices.
//!
//! A [`Sweep`] measures many qualities of one image, and its [`Frontier`] says which of them another one beats in both time
//! and error.
//!
//! The renderer does not know this module; apply a quality to its settings before drawing.
//!
//! ```
//! use trigon_scene::quality::{Preset, Quality};
//! use trigon_scene::{EffectSettings, RenderSettings, Shadows};
//!
//! let effects = EffectSettings { shadows: Shadows::Maps { resolution: 64 }, ..Default::default() };
//! let mut settings = RenderSettings { effects, ..RenderSettings::new(100, 60) };
//! Preset::Reference.apply(&mut settings);
//! assert_eq!((settings.samples_per_axis, settings.effects.shadows), (4, Shadows::Rays));
//! assert!(settings.effects.ambient_occlusion.is_none(), "nobody asked for it");
//! assert_eq!(Quality::of(&settings).to_string(), "4×4 samples of 16, lighting per pixel, shadows by rays");
//! ```

mod budget;
mod choice;
mod cost;
mod error;
mod frontier;
mod knobs;
pub mod plot;
mod probe;
mod sweep;

#[cfg(test)]
mod tests;

pub use budget::TimeBudget;
pub use choice::{Choice, Prediction, candidates};
pub use cost::CostModel;
pub use error::{ErrorModel, rmse, rounding_floor};
pub use frontier::{Frontier, FrontierDot, Standing, TimeSpread};
pub use knobs::{Preset, Quality, UnknownPreset};
pub use sweep::{Sweep, SweepOptions, SweepProgress};
