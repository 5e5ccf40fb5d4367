//! The vertex stage: each vertex once, then its outcode and its place on the
//! grid.

mod used;

pub(crate) use used::UsedVertices;

use crate::clip::Outcode;
use crate::setup::ScreenVertex;
use crate::viewport::Viewport;
use trigon_math::{Band, Vec4};

impl ScreenVertex {
    /// Where a position with w >= [`W_MIN`](crate::clip::W_MIN) lies; `None` if
    /// it has no place on the grid.
    #[inline]
    pub(crate) fn new(position: Vec4, viewport: Viewport) -> Option<Self> {
        let point = viewport.snap(position)?;
        Some(Self { point, depth: depth(position), inverse_w: 1.0 / position.w })
    }
}

/// z / w, at most 1 (cutting rounds) and never so far behind the far plane that
/// arithmetic with it could overflow. Zero is positive.
#[inline]
fn depth(position: Vec4) -> f32 {
    const LEAST: f32 = -1e30;
    let depth = position.z / position.w;
    if depth > 1.0 {
        1.0
    } else if depth > LEAST {
        depth + 0.0
    } else {
        LEAST
    }
}

/// The vertices of one draw as set-up needs them.
pub(crate) struct VertexStore<'u> {
    used: &'u UsedVertices,
    positions: Vec<Vec4>,
    processed: Vec<Processed>,
}

/// A vertex's outcode and, where that allows it, its place.
#[derive(Clone, Copy)]
struct Processed {
    screen: ScreenVertex,
    outcode: Outcode,
}

impl<'u> VertexStore<'u> {
    /// The `used` vertices at these positions, slot by slot.
    pub(crate) fn new(used: &'u UsedVertices, positions: Vec<Vec4>, viewport: Viewport) -> Self {
        let guard = viewport.guard();
        let process = |&position: &Vec4| Processed::new(position, viewport, guard);
        let processed = positions.iter().map(process).collect();
        Self { used, positions, processed }
    }

    /// The slots of a primitive's vertices; `None` if one does not exist.
    #[inline]
    pub(crate) fn slots<const N: usize>(&self, indices: [u32; N]) -> Option<[usize; N]> {
        let mut slots = [0; N];
        for (slot, index) in slots.iter_mut().zip(indices) {
            *slot = self.used.slot(index)?;
        }
        Some(slots)
    }

    #[inline]
    pub(crate) fn outcode(&self, slot: usize) -> Outcode {
        self.processed[slot].outcode
    }

    /// Where a vertex lies that needs no cutting.
    #[inline]
    pub(crate) fn screen(&self, slot: usize) -> ScreenVertex {
        self.processed[slot].screen
    }

    /// Where a vertex lies in clip space.
    #[inline]
    pub(crate) fn position(&self, slot: usize) -> Vec4 {
        self.positions[slot]
    }
}

impl Processed {
    #[inline]
    fn new(position: Vec4, viewport: Viewport, guard: [Band; 2]) -> Self {
        let outcode = Outcode::new(position, guard);
        if outcode.is_invalid() || outcode.cuts() {
            return Self { screen: ScreenVertex::default(), outcode };
        }
        match ScreenVertex::new(position, viewport) {
            Some(screen) => Self { screen, outcode },
            // Within the guard band everything has a place; this is for the
            // compiler, and safe.
            None => Self { screen: ScreenVertex::default(), outcode: Outcode::INVALID },
        }
    }
}

/// A depth moved towards the eye by a share of its distance, at most to the near
/// plane. A share that is not a number moves nothing.
#[inline]
pub(crate) fn nearer(depth: f32, share: f32) -> f32 {
    if share > 0.0 {
        let moved = depth * (1.0 + if share < 1.0 { share } else { 1.0 });
        if moved < 1.0 { moved } else { 1.0 }
    } else {
        depth
    }
}
