//! What a worker keeps from tile to tile and from frame to frame, so that
//! nothing allocates once it is warm.

use super::buffer::VisibilityBuffer;
use super::key_order::KeyOrder;
use super::masked::Questions;
use super::ties::Ties;
use crate::Stats;
use crate::bin::Place;
use crate::blend::Layers;
use crate::resolve::Strip;
use crate::shade::Shading;
use trigon_math::Vec4;

/// A worker's own memory.
pub(crate) struct Scratch {
    /// The tile's triangles: opaque, masked, translucent.
    pub(crate) places: Vec<Place>,
    pub(crate) buffer: VisibilityBuffer,
    pub(crate) ties: Ties,
    pub(super) key_order: KeyOrder,
    /// The opaque triangles in the order of their keys, where that is needed.
    pub(super) reordered: Vec<Place>,
    pub(crate) shading: Shading,
    /// Colours of samples, where something translucent is laid over them.
    pub(crate) samples: Vec<Vec4>,
    pub(crate) layers: Layers,
    pub(super) questions: Questions,
    /// Whether all pixels of the tile have their colour, the background's
    /// included.
    pub(crate) blended: bool,
    /// Tiles that are not written yet.
    pub(crate) strip: Strip,
    pub(crate) stats: Stats,
}

impl Scratch {
    pub(crate) fn new() -> Self {
        Self {
            places: Vec::new(),
            buffer: VisibilityBuffer::new(),
            ties: Ties::default(),
            key_order: KeyOrder::default(),
            reordered: Vec::new(),
            shading: Shading::new(),
            samples: Vec::new(),
            layers: Layers::default(),
            questions: Questions::default(),
            blended: false,
            strip: Strip::default(),
            stats: Stats::default(),
        }
    }
}
