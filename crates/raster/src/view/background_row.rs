//! The rows of a background that has one colour in each row.

use crate::fragments::Encoding;
use crate::pass::Background;
use trigon_math::Vec4;

/// A row of a background that has one colour in each row.
#[derive(Clone, Copy)]
pub(crate) struct BackgroundRow {
    pub(crate) color: Vec4,
    /// The colour as bytes, in frames that keep bytes of one kind and nothing else of colour.
    pub(crate) code: u32,
}

impl BackgroundRow {
    /// Lists the rows of a target of this height; none if the background has none.
    pub(crate) fn list(
        background: Background<'_>,
        height: u32,
        bytes: Option<Encoding>,
        rows: &mut Vec<Self>,
    ) {
        rows.clear();
        if let Background::PerRow(function) = background {
            rows.extend((0..height).map(|y| {
                let color = finite_color(function(y));
                let code = bytes.map_or(0, |encoding| u32::from_le_bytes(encoding.encode(color)));
                Self { color, code }
            }));
        }
    }
}

pub(crate) fn finite_color(color: Vec4) -> Vec4 {
    if color.is_finite() { color } else { Vec4::ZERO }
}
