//! A chapter for each question: its variants, measured.

mod antialiasing;
mod color;
mod coordinates;
mod depth;
mod fill;
mod frames;
mod interpolation;
mod line;
mod shading;
mod shadow;
mod storage;
mod texture;
mod threads;
mod transparency;
mod visibility;

use super::figures::{Row, number, times, value};
use super::{Chapter, Effort, Picture, Plot, Question, grey, heat, tint, tinted};
use crate::measure::{Spread, interleaved};

/// The chapters in their order.
pub(super) const CHAPTERS: [Question; 15] = [
    ("fill", fill::measure),
    ("visibility", visibility::measure),
    ("line", line::measure),
    ("shading", shading::measure),
    ("interpolation", interpolation::measure),
    ("depth", depth::measure),
    ("antialiasing", antialiasing::measure),
    ("texture", texture::measure),
    ("transparency", transparency::measure),
    ("shadow", shadow::measure),
    ("color", color::measure),
    ("coordinates", coordinates::measure),
    ("storage", storage::measure),
    ("threads", threads::measure),
    ("frames", frames::measure),
];

/// The nanoseconds that each variant takes, in turn.
fn nanoseconds<'a, V: Copy>(
    rounds: usize,
    variants: &[V],
    mut run: impl FnMut(V) -> Box<dyn FnMut() + 'a>,
) -> Vec<Spread> {
    let mut candidates: Vec<Box<dyn FnMut() + 'a>> = variants.iter().map(|&variant| run(variant)).collect();
    interleaved(rounds, &mut candidates)
}
