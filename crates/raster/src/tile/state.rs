//! What a worker holds from tile to tile for the visibility stage: the triangles of a tile, listed by kind of surface
//! ([`Surfaces`]); the budget for ties ([`Ties`]); and the triangles in the order of their keys ([`KeyOrder`]).
//!
//! A tie is a sample at which several triangles have the same depth. The rule is [`FrameView::compare`]: the triangle with the smaller (object, face) is visible. Most tiles have
//! few ties, and the keys of two triangles are compared at each tie. With many ties, that would take far longer
//! than everything else in the tile. So every tile has a budget for comparisons: about what it takes to sort its triangles
//! by their keys. Once the budget is spent, the opaque triangles are drawn again in the order of their keys, in which a
//! later one is never visible at equal depth (`visibility`). Masked and translucent ones are compared by their
//! ranks in that order.

use super::depth_query::TileView;
use super::front_to_back::FrontToBack;
use super::masked::MaskQueue;
use crate::BlendMode;
use crate::bin::TriangleRef;
use crate::tile_buffer::{NO_TRIANGLE, TileArea, VisibilityBuffer};
use crate::view::{FrameView, VisibleTile};
use std::cmp::Ordering;
use std::ops::Range;
use std::sync::atomic::AtomicU32;
use std::sync::atomic::Ordering::Relaxed;
use std::sync::{Mutex, OnceLock};

/// The triangles of a tile, and which of them is visible at each sample.
pub(crate) struct TileState {
    /// The tile's triangles: opaque, masked, overlay, translucent. Those of a draw may have any order.
    pub(crate) triangles: Vec<TriangleRef>,
    pub(crate) buffer: VisibilityBuffer,
    pub(crate) ties: Ties,
    pub(super) key_order: KeyOrder,
    pub(super) front_to_back: FrontToBack,
    /// Triangles in another order, where that is needed.
    pub(super) reordered: Vec<TriangleRef>,
    /// Where each triangle stands in that order.
    pub(super) ranks: Vec<u32>,
    pub(super) mask_queue: MaskQueue,
}

impl TileState {
    pub(crate) fn new() -> Self {
        Self {
            triangles: Vec::new(),
            buffer: VisibilityBuffer::new(),
            ties: Ties::default(),
            key_order: KeyOrder::default(),
            front_to_back: FrontToBack::default(),
            reordered: Vec::new(),
            ranks: Vec::new(),
            mask_queue: MaskQueue::default(),
        }
    }

    /// Lists triangles of a tile, and no others.
    pub(crate) fn list(&mut self, frame: &FrameView<'_>, tile: u32, listing: Listing) -> Surfaces {
        self.triangles.clear();
        Surfaces::list(frame, tile, listing, &mut self.triangles)
    }

    /// Empties the buffer for the triangles that are listed.
    pub(crate) fn begin(&mut self, frame: &FrameView<'_>, tile: u32) {
        self.buffer.clear(&frame.area(tile), frame.grid.pattern.count());
        self.ties.reset(self.triangles.len());
    }

    /// What the tile shows.
    pub(crate) fn visible<'t>(&'t self, area: &'t TileArea) -> VisibleTile<'t> {
        VisibleTile { area, buffer: &self.buffer, triangles: &self.triangles }
    }

    /// The tile for queries of masked and translucent triangles.
    #[inline(always)]
    pub(crate) fn view<'t>(&'t self, frame: &'t FrameView<'t>, area: &'t TileArea) -> TileView<'t> {
        let Self { buffer, triangles, ties, .. } = self;
        TileView { frame, area, buffer, triangles, ties }
    }
}

/// The tile's triangles by kind of surface: ranges of its list.
pub(crate) struct Surfaces {
    pub(crate) opaque: Range<usize>,
    pub(crate) masked: Range<usize>,
    pub(crate) overlay: Range<usize>,
    pub(crate) translucent: Range<usize>,
}

/// Which of a tile's triangles.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Listing {
    All,
    /// Those of primitives that are not listed apart.
    Still,
    /// Those of primitives that are listed apart: [`MovingChunk`](crate::bin::MovingChunk).
    Moving,
}

impl Surfaces {
    /// Appends triangles of a tile to `triangles`.
    pub(crate) fn list(
        frame: &FrameView<'_>,
        tile: u32,
        listing: Listing,
        triangles: &mut Vec<TriangleRef>,
    ) -> Self {
        let start = triangles.len();
        let mut ends = [start; 4];
        for (number, chunk) in frame.chunks.iter().enumerate() {
            let first = triangles.len();
            if listing != Listing::Moving && !chunk.is_empty() {
                chunk.collect(&frame.grid, tile, triangles);
            }
            let moving = frame.moving.get(number).filter(|_| listing != Listing::Still);
            if let Some(moving) = moving.filter(|moving| !moving.listed.is_empty()) {
                let still = triangles.len();
                moving.listed.collect(&frame.grid, tile, triangles);
                if first < still && still < triangles.len() {
                    triangles[first..].sort_unstable_by_key(|triangle| triangle.order());
                }
            }
            let kind = match chunk.blend_mode {
                BlendMode::Opaque => 0,
                BlendMode::Masked | BlendMode::MaskedPerSample => 1,
                BlendMode::Overlay => 2,
                BlendMode::Translucent => 3,
            };
            ends[kind..].fill(triangles.len());
        }
        let [opaque, masked, overlay, translucent] = ends;
        Surfaces {
            opaque: start..opaque,
            masked: opaque..masked,
            overlay: masked..overlay,
            translucent: overlay..translucent,
        }
    }
}

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

/// A triangle of a tile: its object, its face, its number among the tile's.
///
/// In one number, from the highest bits down, because such numbers are sorted much faster
/// than anything that takes a function to compare.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Keyed(u128);

impl Keyed {
    fn new(object_and_face: u64, number: u32) -> Self {
        Self(u128::from(object_and_face) << 32 | u128::from(number))
    }

    fn object_and_face(self) -> u64 {
        (self.0 >> 32) as u64
    }

    fn number(self) -> usize {
        self.0 as u32 as usize
    }
}

/// Some of a tile's triangles in the order of their keys: at equal depth the first is
/// visible.
#[derive(Default)]
pub(crate) struct KeyOrder {
    sorted: Vec<Keyed>,
}

impl KeyOrder {
    /// Sorts triangles by [`FrameView::compare`]. Parts of one primitive keep their order.
    pub(super) fn sort(&mut self, frame: &FrameView<'_>, triangles: &[TriangleRef]) {
        self.sorted.clear();
        // Neighbours mostly belong to the same draw.
        let mut draw = 0;
        self.sorted.extend(triangles.iter().zip(0..).map(|(&triangle, number)| {
            if !frame.plan.draws[draw].ordinals.contains(&triangle.ordinal) {
                draw = frame.draw_of(triangle);
            }
            Keyed::new(frame.object_and_face(draw, triangle), number)
        }));
        self.sorted.sort_unstable();
        let same_face = |a: &Keyed, b: &Keyed| a.object_and_face() == b.object_and_face();
        for face in self.sorted.chunk_by_mut(same_face).filter(|face| face.len() > 1) {
            let triangle_of = |keyed: &Keyed| triangles[keyed.number()];
            let [first, last] =
                [&face[0], &face[face.len() - 1]].map(|keyed| frame.draw_of(triangle_of(keyed)));
            if first == last {
                face.sort_unstable_by_key(|keyed| (triangle_of(keyed).ordinal, *keyed));
            } else {
                face.sort_unstable_by(|a, b| frame.compare(triangle_of(a), triangle_of(b)).then(a.cmp(b)));
            }
        }
    }

    /// The same triangles in this order.
    pub(super) fn of(&self, triangles: &[TriangleRef]) -> impl Iterator<Item = TriangleRef> {
        self.sorted.iter().map(|keyed| triangles[keyed.number()])
    }

    /// For each triangle how many primitives come before it.
    pub(super) fn ranks(&self, triangles: &[TriangleRef], ranks: &mut Vec<u32>) {
        ranks.clear();
        ranks.resize(triangles.len(), 0);
        let same_primitive =
            |a: &Keyed, b: &Keyed| triangles[a.number()].ordinal == triangles[b.number()].ordinal;
        for (rank, parts) in (0..).zip(self.sorted.chunk_by(same_primitive)) {
            for part in parts {
                ranks[part.number()] = rank;
            }
        }
    }

    /// Replaces the indices in this order by those among the tile's triangles.
    pub(super) fn name_visible(&self, buffer: &mut VisibilityBuffer) {
        for visible in buffer.visible_mut().iter_mut().filter(|visible| **visible != NO_TRIANGLE) {
            *visible = self.sorted[*visible as usize].number() as u32;
        }
    }
}
