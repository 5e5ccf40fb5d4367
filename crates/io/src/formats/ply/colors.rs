//! The colours of vertices and faces. Integers say what is full light by their type; of floats, which most programs
//! write from 0 to 1 and some from 0 to 255, the whole file tells.

use trigon_math::Vec4;

use super::header::{Element, Kind};
use crate::error::Location;
use crate::polygons::{RawColors, light_from_srgb};
use crate::warning::Warnings;

/// The colours of an element while they are read.
pub(super) struct Channels {
    /// What stands for 1, for red, green, blue and alpha.
    full: [f64; 4],
    has_alpha: bool,
    /// Those that are floats.
    raw: Option<RawColors>,
}

impl Channels {
    /// For the properties of red, green, blue and alpha.
    pub(super) fn new(element: &Element, properties: [Option<usize>; 4]) -> Self {
        let scalar = |channel: usize| match element.properties[properties[channel]?].kind {
            Kind::Scalar(scalar) => Some(scalar),
            Kind::List { .. } => None,
        };
        let full = [0, 1, 2, 3].map(|channel| scalar(channel).map_or(255.0, |scalar| scalar.full_channel()));
        let is_float = (0..3).any(|channel| scalar(channel).is_some_and(|scalar| scalar.is_float()));
        Self { full, has_alpha: scalar(3).is_some(), raw: is_float.then(RawColors::default) }
    }

    /// The values of opaque white.
    pub(super) fn full(&self) -> [f64; 4] {
        self.full
    }

    /// Adds a colour in sRGB as linear light.
    pub(super) fn push(&mut self, channels: [f64; 4], colors: &mut Vec<Vec4>) {
        let units: [f32; 4] =
            std::array::from_fn(|channel| channels[channel] as f32 / self.full[channel] as f32);
        match &mut self.raw {
            Some(raw) => raw.push(&units.map(f64::from)[..if self.has_alpha { 4 } else { 3 }]),
            None => colors.push(light_from_srgb(units)),
        }
    }

    /// Adds those that had to wait for the others.
    pub(super) fn finish(self, colors: &mut Vec<Vec4>, warnings: &mut Warnings) {
        let Some(raw) = self.raw.filter(|raw| raw.len() > 0) else { return };
        let full = raw.full();
        if full > 1.0 {
            let what =
                format!("the colours are fractions above 1, and are taken as numbers from 0 to {full}");
            warnings.push(Location::Whole, what, "write them from 0 to 1, or as uchar");
        }
        if let Some(what) = raw.fault() {
            warnings.push(Location::Whole, what, "write them from 0 to 1, or as uchar");
        }
        colors.append(&mut raw.finish());
    }
}
