//! What happened at one sample.

use super::{FragmentExplanation, Verdict};
use trigon_math::Vec4;

/// What happened at one sample of a pixel.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SampleExplanation {
    /// The pixel of the finer grid that it belongs to; without supersampling the
    /// pixel itself.
    pub cell: [u32; 2],
    /// Its number in the standard pattern.
    pub number: usize,
    /// Where it lies, in 1/256 pixel of the finer grid from the top left.
    pub position: [i32; 2],
    /// The triangles: the visible one first, then layers from the nearest to the farthest, then hidden
    /// triangles from the nearest on, and then those that miss the sample.
    pub fragments: Vec<FragmentExplanation>,
    /// What the sample shows: linear light, premultiplied.
    pub color: Vec4,
}

impl SampleExplanation {
    /// The triangle whose depth and ids the sample has; `None` for the
    /// background.
    #[must_use]
    pub fn visible(&self) -> Option<&FragmentExplanation> {
        self.fragments.iter().find(|fragment| fragment.verdict == Verdict::Visible)
    }

    /// The translucent layers, the one furthest away first.
    pub fn layers(&self) -> impl Iterator<Item = &FragmentExplanation> {
        self.fragments.iter().rev().filter(|fragment| matches!(fragment.verdict, Verdict::Layer(_)))
    }
}
