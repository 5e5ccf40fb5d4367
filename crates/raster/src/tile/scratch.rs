//! What a worker keeps from tile to tile, so that no triangle and no sample
//! allocates.

use super::STRIDE;
use crate::Stats;
use crate::blend::Joint;
use crate::shade::Span;
use trigon_math::Vec4;

/// No triangle: the background.
pub(crate) const NOBODY: u32 = u32::MAX;

/// A fragment that waits for its turn: masked or translucent.
#[derive(Clone, Copy)]
pub(crate) struct Waiting {
    /// Index of the sample in the tile's scratch.
    pub(crate) sample: u32,
    pub(crate) depth: f32,
    /// The triangle's ordinal (translucent) or place in the tile (masked).
    pub(crate) triangle: u32,
}

/// A worker's own memory.
pub(crate) struct Scratch {
    /// Depth of what is seen, 0 for the background.
    pub(crate) depth: Vec<f32>,
    /// The place of what is seen in `triangles`, or [`NOBODY`].
    pub(crate) winner: Vec<u32>,
    /// The ordinals of the tile's opaque and then its masked triangles.
    pub(crate) triangles: Vec<u32>,
    pub(crate) color: Vec<Vec4>,
    pub(crate) spans: Vec<Span>,
    pub(crate) sorted: Vec<Span>,
    pub(crate) counts: Vec<u32>,
    pub(crate) waiting: Vec<Waiting>,
    pub(crate) waiting_color: Vec<Vec4>,
    pub(crate) order: Vec<u32>,
    pub(crate) kept: Vec<bool>,
    pub(crate) joints: Vec<Joint>,
    pub(crate) stats: Stats,
}

impl Scratch {
    pub(crate) fn new() -> Self {
        const SAMPLES: usize = STRIDE * STRIDE;
        Self {
            depth: vec![0.0; SAMPLES],
            winner: vec![NOBODY; SAMPLES],
            triangles: Vec::new(),
            color: vec![Vec4::ZERO; SAMPLES],
            spans: Vec::new(),
            sorted: Vec::new(),
            counts: Vec::new(),
            waiting: Vec::new(),
            waiting_color: Vec::new(),
            order: Vec::new(),
            kept: Vec::new(),
            joints: Vec::new(),
            stats: Stats::default(),
        }
    }
}
