//! How the quads around a change are cut.

use rayon::prelude::*;
use trigon_mesh::{Mesh, Outlines, QuadCut, QuadGroup};
use trigon_raster::EdgeFlags;

use super::super::edge_flags::flags_of_quads;
use super::face_places::PIECE;

/// A quad, or another face.
#[derive(Clone, Copy)]
pub(super) struct CutQuad {
    /// If it is a quad that needs no closer look.
    pub(super) cut: Option<QuadCut>,
    /// Of its triangles then, if somebody needs them.
    pub(super) flags: [EdgeFlags; 2],
}

impl CutQuad {
    /// A face that is no quad, or needs a closer look.
    pub(super) const NONE: Self = Self { cut: None, flags: [EdgeFlags::NONE; 2] };
}

/// Of all faces that have outlines, in their order.
pub(super) fn cut_quads(mesh: &Mesh, outlines: &Outlines, has_flags: bool) -> Vec<CutQuad> {
    let mut cut = vec![CutQuad::NONE; outlines.face_count()];
    let groups = cut.par_chunks_mut(QuadGroup::MOST).with_min_len(PIECE / QuadGroup::MOST).enumerate();
    groups.for_each_init(QuadGroup::default, |room, (number, cut)| {
        outlines.group(mesh, number, room).for_each(
            #[inline(always)]
            |numbers, quads| {
                let cuts = quads.cuts();
                let flags = if has_flags { flags_of_quads(quads, &cuts) } else { [CutQuad::NONE.flags; _] };
                for ((&number, made), flags) in numbers.iter().zip(cuts).zip(flags) {
                    cut[number as usize] = CutQuad { cut: made, flags };
                }
            },
        );
    });
    cut
}
