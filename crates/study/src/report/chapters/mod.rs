//! The chapters: for each question, the variants and their measurements.

mod depth;
pub(super) mod effects;
mod fill;
pub(super) mod frames;
mod interpolation;
pub(super) mod line;
pub(super) mod rivals;
mod same_bytes;
mod shading;
mod shadow;
mod storage;
mod texture;
mod threads;
mod transparency;
mod visibility;

use super::chapter::{Chapter, Effort, Question};
use super::chapter::{Row, number, value};
use super::headline::Headline;
use super::markdown::{ImageRow, grey, heat, tint, tinted};
use super::plot::Plot;
use crate::measure::{Spread, interleaved, nanoseconds};

#[cfg(test)]
pub(super) mod tests;

/// The chapters in their order.
pub(super) const CHAPTERS: [Question; 15] = [
    Question { name: "fill", measure: fill::measure, headlines: fill::headlines },
    Question { name: "visibility", measure: visibility::measure, headlines: visibility::headlines },
    Question { name: "line", measure: line::measure, headlines: line::headlines },
    Question { name: "shading", measure: shading::measure, headlines: shading::headlines },
    Question { name: "interpolation", measure: interpolation::measure, headlines: interpolation::headlines },
    Question { name: "depth", measure: depth::measure, headlines: depth::headlines },
    Question { name: "texture", measure: texture::measure, headlines: texture::headlines },
    Question { name: "transparency", measure: transparency::measure, headlines: transparency::headlines },
    Question { name: "shadow", measure: shadow::measure, headlines: shadow::headlines },
    Question { name: "same-bytes", measure: same_bytes::measure, headlines: same_bytes::headlines },
    Question { name: "storage", measure: storage::measure, headlines: storage::headlines },
    Question { name: "threads", measure: threads::measure, headlines: threads::headlines },
    Question { name: "frames", measure: frames::measure, headlines: frames::headlines },
    Question { name: "effects", measure: effects::measure, headlines: effects::headlines },
    Question { name: "rivals", measure: rivals::measure, headlines: rivals::headlines },
];
