//! What a light meter reads, and where a scene keeps it. [`light_meter`](crate::light_meter) measures it.

use std::sync::OnceLock;

use trigon_math::elementary;

/// What a surface of middle grey reflects.
const MIDDLE_GREY: f64 = 0.18;

/// In brighter light even middle grey would be clipped.
pub(crate) const MOST_LIGHT: f64 = 1.0 / MIDDLE_GREY;

/// In fainter light even white would be darker than a tenth of middle grey, which shows as 36 of 255.
pub(crate) const LEAST_LIGHT: f64 = MIDDLE_GREY / 10.0;

/// What a light meter reads in a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightReading {
    /// The value of a white diffuse surface in the key light; 1 is the white of the display.
    pub white: f32,
    /// The exposure that shows such a surface well, in stops; a multiple of a hundredth.
    pub stops: f32,
}

/// Neither number is ever NaN.
impl Eq for LightReading {}

impl LightReading {
    /// Whether a display can show surfaces in the key light as it is.
    #[must_use]
    pub fn is_in_range(&self) -> bool {
        (LEAST_LIGHT..=MOST_LIGHT).contains(&f64::from(self.white))
    }

    /// How bright white is, in at least three digits.
    pub(crate) fn white_text(&self) -> String {
        short(f64::from(self.white))
    }

    /// The factor for the lamps that the exposure stands for.
    #[must_use]
    pub fn factor(&self) -> f32 {
        elementary::exp2_f32(self.stops)
    }
}

/// A brightness in at least three digits.
pub(crate) fn short(value: f64) -> String {
    match value {
        0.0 => "0".to_owned(),
        100.0..1e7 => format!("{value:.0}"),
        0.01..100.0 => format!("{value:.3}"),
        _ => format!("{value:.2e}"),
    }
}

/// The reading that a scene keeps until its nodes or meshes change. Poses leave it as it is.
#[derive(Clone, Debug, Default)]
pub(crate) struct CachedReading(OnceLock<Measured>);

#[derive(Clone, Debug)]
struct Measured {
    reading: Option<LightReading>,
    /// The number of animated properties: a scene does not notice when they are added.
    channels: usize,
}

impl CachedReading {
    /// The kept reading, or a new one. `channels` is the number of animated properties now.
    pub(crate) fn get(
        &self,
        channels: usize,
        measure: impl Fn() -> Option<LightReading>,
    ) -> Option<LightReading> {
        let cached = self.0.get_or_init(|| Measured { reading: measure(), channels });
        if cached.channels == channels { cached.reading } else { measure() }
    }

    /// Something has changed.
    pub(crate) fn forget(&mut self) {
        self.0.take();
    }
}
