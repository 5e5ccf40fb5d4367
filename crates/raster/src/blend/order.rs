//! The order in which layers are blended.

use super::runs::{Layer, Order};
use crate::tile::TileView;
use std::cmp::Ordering;

/// The order of layers: a total key.
#[derive(Clone, Copy)]
pub(super) struct DepthOrder<'t>(pub(super) TileView<'t>);

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
    #[inline]
    fn compare_keys(&self, a: &Layer, b: &Layer) -> Ordering {
        let TileView { frame, triangles, ties, .. } = self.0;
        let part = |layer: &Layer| triangles[layer.triangle as usize].part();
        ties.compare(frame, triangles, [b.triangle, a.triangle]).then_with(|| part(b).cmp(&part(a)))
    }
}
