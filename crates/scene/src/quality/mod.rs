//! How accurately a picture is drawn: named choices of all settings that trade
//! accuracy for time, and the choice of one that fits into a time.
//!
//! A [`Quality`] is what those settings say, and nothing else. A [`Preset`] is one with a
//! name. Whether there are shadows at all, and all else that a picture is to show, is
//! no quality: it stays as it is.
//!
//! A [`TimeBudget`] chooses the most accurate quality that fits into a time: a
//! [`CostModel`] foresees from measured frames how long others take, an [`ErrorModel`]
//! from pictures and references how wrong they are. Times come from the caller; the
//! same times give the same choices.
//!
//! The renderer knows nothing of this module; whoever draws a picture applies a quality
//! to its settings first.
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
mod candidates;
mod choice;
mod cost;
mod error;
mod knobs;
mod patience;
mod preset;
mod probe;
mod window;

#[cfg(test)]
mod tests;

pub use budget::TimeBudget;
pub use candidates::candidates;
pub use choice::{Choice, Foreseen};
pub use cost::CostModel;
pub use error::{ErrorModel, rmse};
pub use knobs::Quality;
pub use preset::{Preset, UnknownPreset};
