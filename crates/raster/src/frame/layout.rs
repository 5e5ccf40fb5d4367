//! What is known of a frame before any vertex runs: options, outputs, tiles, grid, and ink. No option changes a byte of
//! the frame.

use crate::bin::Grid;
use crate::fragments::Encoding;
use crate::geometry::Geometry;
use crate::ink::Ink;
use crate::pass::Pass;
use crate::pool::Workers;
use crate::simd::Token;
use crate::tile_buffer::MAX_SIDE;
use crate::view::RequestedOutputs;
use crate::viewport::Viewport;
use crate::{Cancel, Target};

/// How a target is cut into tiles, and what is wanted of it.
pub(super) struct Layout {
    pub(super) axis: u32,
    pub(super) wants: RequestedOutputs,
    pub(super) ink: Option<Ink>,
    pub(super) grid: Grid,
}

impl Layout {
    pub(super) fn new(pass: &Pass<'_>, target: &Target<'_>, options: FrameOptions<'_>) -> Self {
        let axis = target.samples_per_axis();
        let viewport = Viewport { width: target.width() * axis, height: target.height() * axis };
        let wants = wants(target);
        let ink = if wants.color || options.finds_colors { ink(pass, axis) } else { None };
        let apron = ink.as_ref().map_or(0, |ink| ink.reach().next_multiple_of(axis));
        let tile_pixels = (own_side(options.tile_size, apron) / axis).max(1);
        let grid = Grid::new(viewport, target.pattern(), tile_pixels * axis).with_apron(apron);
        Self { axis, wants, ink, grid }
    }
}

/// What paints edges and marks, if there are any.
fn ink(pass: &Pass<'_>, axis: u32) -> Option<Ink> {
    let any = |has: fn(&Geometry<'_>) -> bool| pass.draws.iter().any(|draw| has(&draw.geometry));
    let edges = pass.edges.as_ref().filter(|_| any(|geometry| geometry.shows_edges()));
    let marks = pass.marks.as_ref().filter(|_| any(|geometry| geometry.marks().is_some()));
    Ink::new(edges, marks, axis)
}

/// The side of a tile without its margin. Including the margin it has the requested size, unless too little
/// would be left, and never more than the maximum.
fn own_side(tile_size: u32, apron: u32) -> u32 {
    if tile_size >= 4 * apron { tile_size - 2 * apron } else { tile_size.min(MAX_SIDE as u32 - 2 * apron) }
}

fn wants(target: &Target<'_>) -> RequestedOutputs {
    let (srgb8, unorm8) = (target.srgb8().is_some(), target.unorm8().is_some());
    let linear = target.linear().is_some();
    let bytes = match (srgb8, unorm8, linear, target.samples_per_axis()) {
        (true, false, false, 1) => Some(Encoding::Srgb8),
        (false, true, false, 1) => Some(Encoding::Unorm8),
        _ => None,
    };
    let ids = target.objects().is_some() || target.faces().is_some() || target.triangles().is_some();
    RequestedOutputs { color: srgb8 || unorm8 || linear, depth: target.depth().is_some(), ids, bytes }
}

/// How many vertices a worker runs at a time.
pub(super) const VERTICES: usize = 2048;

/// How a frame is drawn.
#[derive(Clone, Copy)]
pub(crate) struct FrameOptions<'w> {
    pub(crate) token: Token,
    pub(crate) workers: &'w Workers,
    pub(crate) tile_size: u32,
    pub(crate) hierarchical: bool,
    pub(crate) timed: bool,
    /// Whether colours are found, whatever the target keeps.
    pub(crate) finds_colors: bool,
    pub(crate) cancel: Option<&'w Cancel>,
}

impl FrameOptions<'_> {
    /// Whether no more work is to be begun.
    pub(super) fn is_cancelled(self) -> bool {
        self.cancel.is_some_and(Cancel::is_cancelled)
    }
}
