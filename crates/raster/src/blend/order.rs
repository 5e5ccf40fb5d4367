//! In which order layers are laid.

use super::runs::{Layer, Order};
use crate::bin::Place;
use crate::frame::FrameView;
use std::cmp::Ordering;

/// The order of layers: a total key.
#[derive(Clone, Copy)]
pub(super) struct DepthOrder<'t> {
    pub(super) frame: &'t FrameView<'t>,
    pub(super) places: &'t [Place],
}

impl Order for DepthOrder<'_> {
    #[inline(always)]
    fn compare(&self, a: &Layer, b: &Layer) -> Ordering {
        // Depths are numbers.
        match a.depth.partial_cmp(&b.depth) {
            Some(Ordering::Equal) | None => self.compare_keys(a, b),
            Some(order) => order,
        }
    }
}

impl DepthOrder<'_> {
    /// Of equal depths the smaller (object, face) is in front. Parts of one
    /// primitive, which may meet in a sample after snapping, go by their number.
    #[cold]
    fn compare_keys(&self, a: &Layer, b: &Layer) -> Ordering {
        let [a, b] = [a, b].map(|layer| self.places[layer.place as usize]);
        self.frame.compare(b, a).then_with(|| b.extra().cmp(&a.extra()))
    }
}
