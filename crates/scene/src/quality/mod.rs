//! How accurately a picture is drawn: named choices of all settings that trade
//! accuracy for time.
//!
//! A [`Quality`] is what those settings say, and nothing else. A [`Preset`] is one with a
//! name. Whether there are shadows at all, and all else that a picture is to show, is
//! no quality: it stays as it is.
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
//! assert_eq!(Quality::of(&settings).to_string(), "4×4 samples of 16, light at each pixel, shadows by rays");
//! ```

mod knobs;
mod preset;

pub use knobs::Quality;
pub use preset::{Preset, UnknownPreset};
