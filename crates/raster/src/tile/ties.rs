//! The budget for ties: samples at which several triangles have the same depth.
//!
//! The rule is [`FrameView::compare`]: the triangle with the smaller (object, face) is visible. Most tiles have
//! few ties, and the keys of two triangles are compared at each of them. With many, that would take far longer
//! than everything else in the tile. So every tile has a budget for it: about what it takes to sort its triangles
//! by their keys. Once that is spent, the opaque triangles are drawn again in the order of their keys, in which a
//! later one is never visible at equal depth (`visibility`). Masked and translucent ones are compared by their
//! ranks in that order.

use super::key_order::KeyOrder;
use crate::bin::TriangleRef;
use crate::view::FrameView;
use std::cmp::Ordering;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};
use std::sync::{Mutex, OnceLock};

/// The cost of comparing two keys. The unit is the cost of testing a single sample, a few nanoseconds.
pub(super) const COMPARISON: u32 = 8;

/// The budget of a tile: a number of units for each of its triangles, plus a constant. Sorting
/// takes about twice as many units for each triangle, and what was drawn before is lost.
const UNITS_PER_TRIANGLE: usize = 4;
const BASE_UNITS: usize = 256;

const NOT_POISONED: &str = "sorting by keys does not panic";

/// What is left of a tile's budget, and the ranks of its triangles if the budget is spent.
///
/// Comparisons change it behind a shared reference. Only one thread at a time draws with it; it is
/// `Sync` so that [`Rasterizer`](crate::Rasterizer) is.
#[derive(Default)]
pub(crate) struct Ties {
    left: AtomicU32,
    ranks: OnceLock<Vec<u32>>,
    /// Memory for the ranks and for sorting, kept from tile to tile.
    spare: Mutex<(KeyOrder, Vec<u32>)>,
}

impl Ties {
    /// Starts a tile.
    pub(super) fn reset(&mut self, triangle_count: usize) {
        let budget = triangle_count.saturating_mul(UNITS_PER_TRIANGLE).saturating_add(BASE_UNITS);
        *self.left.get_mut() = u32::try_from(budget).unwrap_or(u32::MAX);
        if let Some(ranks) = self.ranks.take() {
            self.spare.get_mut().expect(NOT_POISONED).1 = ranks;
        }
    }

    /// Spends some of the budget. Returns whether any is left.
    #[inline]
    pub(super) fn spend(&self, units: u32) -> bool {
        // Not one atomic operation, which would take longer: no other thread uses it.
        self.left.store(self.left.load(Relaxed).saturating_sub(units), Relaxed);
        !self.are_many()
    }

    /// Whether the budget is spent.
    #[inline(always)]
    pub(super) fn are_many(&self) -> bool {
        self.left.load(Relaxed) == 0
    }

    /// The order of two of the tile's `triangles` at equal depth, as
    /// [`FrameView::compare`] has it.
    #[inline]
    pub(crate) fn compare(
        &self,
        frame: &FrameView<'_>,
        triangles: &[TriangleRef],
        [a, b]: [u32; 2],
    ) -> Ordering {
        match self.ranks.get() {
            Some(ranks) => ranks[a as usize].cmp(&ranks[b as usize]),
            None => self.compare_keys(frame, triangles, [a, b]),
        }
    }

    #[cold]
    fn compare_keys(&self, frame: &FrameView<'_>, triangles: &[TriangleRef], [a, b]: [u32; 2]) -> Ordering {
        if self.spend(COMPARISON) {
            return frame.compare(triangles[a as usize], triangles[b as usize]);
        }
        let ranks = self.ranks.get_or_init(|| self.find_ranks(frame, triangles));
        ranks[a as usize].cmp(&ranks[b as usize])
    }

    fn find_ranks(&self, frame: &FrameView<'_>, triangles: &[TriangleRef]) -> Vec<u32> {
        let mut spare = self.spare.lock().expect(NOT_POISONED);
        let (order, ranks) = &mut *spare;
        order.sort(frame, triangles);
        order.ranks(triangles, ranks);
        std::mem::take(ranks)
    }
}
