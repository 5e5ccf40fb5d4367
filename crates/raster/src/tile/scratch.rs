//! What a worker keeps from tile to tile and from frame to frame, so that
//! nothing allocates once it is warm.

use super::buffer::VisibilityBuffer;
use super::masked::Waiting;
use crate::Stats;
use crate::bin::Place;
use crate::blend::Layers;
use crate::shade::{Job, Work};
use trigon_math::Vec4;

/// A pixel whose samples see different triangles, under multisampling.
#[derive(Clone, Copy)]
pub(crate) struct EdgePixel {
    pub(crate) pixel: u32,
    /// Where the colours of its samples are named in
    /// [`sample_colors`](Scratch::sample_colors).
    pub(crate) first: u32,
}

/// A worker's own memory.
pub(crate) struct Scratch {
    /// The tile's triangles: opaque, masked, translucent.
    pub(crate) places: Vec<Place>,
    pub(crate) buffer: VisibilityBuffer,
    pub(crate) counts: Vec<u32>,
    pub(crate) jobs: Vec<Job>,
    pub(crate) work: Vec<Work>,
    /// Fragments with the triangles that they belong to, before they are sorted.
    pub(crate) fragments: Vec<(u32, Work)>,
    /// The bytes of flat triangles.
    pub(crate) place_codes: Vec<u32>,
    /// Pixels as bytes.
    pub(crate) codes: Vec<u32>,
    /// Pixels in linear light, and from [`PIXELS`] on the colours of fragments
    /// that cover a part of their pixel.
    pub(crate) colors: Vec<[f32; 4]>,
    pub(crate) edge_pixels: Vec<EdgePixel>,
    /// For each sample of each edge pixel an index into the colours.
    pub(crate) sample_colors: Vec<u32>,
    /// Colours of samples, where something translucent is laid over them.
    pub(crate) samples: Vec<Vec4>,
    pub(crate) layers: Layers,
    /// Masked fragments that wait for the answers of their masks.
    pub(super) waiting: Vec<Waiting>,
    /// Whether all pixels of the tile have their colour, the background's
    /// included.
    pub(crate) blended: bool,
    pub(crate) kept: Vec<u8>,
    pub(crate) stats: Stats,
}

/// Pixels of the largest tile.
pub(crate) const PIXELS: usize = super::MAX_SIDE * super::MAX_SIDE;

impl Scratch {
    pub(crate) fn new() -> Self {
        Self {
            places: Vec::new(),
            buffer: VisibilityBuffer::new(),
            counts: Vec::new(),
            jobs: Vec::new(),
            work: Vec::new(),
            fragments: Vec::new(),
            place_codes: Vec::new(),
            codes: vec![0; PIXELS],
            colors: vec![[0.0; 4]; PIXELS],
            edge_pixels: Vec::new(),
            sample_colors: Vec::new(),
            samples: Vec::new(),
            layers: Layers::default(),
            waiting: Vec::new(),
            blended: false,
            kept: Vec::new(),
            stats: Stats::default(),
        }
    }
}
