//! The rows of a background that has one colour in each.

use crate::pass::Background;
use crate::shade::Encoding;
use trigon_math::Vec4;

/// A row of a background that has one colour in each row.
#[derive(Clone, Copy)]
pub(crate) struct BackgroundRow {
    pub(super) color: Vec4,
    /// The colour as bytes, in frames that keep bytes of one kind and nothing else of colour.
    pub(super) code: u32,
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
                let color = finite(function(y));
                let code = bytes.map_or(0, |encoding| u32::from_le_bytes(encoding.encode(color)));
                Self { color, code }
            }));
        }
    }
}

pub(super) fn finite(color: Vec4) -> Vec4 {
    if color.is_finite() { color } else { Vec4::ZERO }
}
