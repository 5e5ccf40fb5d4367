//! Where the triangles of changed faces are.

use std::ops::Range;

use rayon::prelude::*;
use trigon_mesh::{QuadCut, RenderUpdate};

/// Faces per task.
pub(super) const PIECE: usize = 1024;

/// The slots of the triangles of some faces. No change alters them, so they are found once for a drag that changes
/// the same faces in each frame.
#[derive(Clone, Debug, Default)]
pub(crate) struct FacePlaces {
    /// Those that were looked for, increasing.
    faces: Vec<u32>,
    /// The version of the outlines in which they were found.
    version: u64,
    /// Of those that have any, in the order of their slots.
    places: Vec<FacePlace>,
}

/// A face and the slots of its triangles in the geometry.
#[derive(Clone, Debug)]
pub(super) struct FacePlace {
    pub(super) face: u32,
    start: u32,
    end: u32,
    /// The place of its outline, if it has one.
    pub(super) outline: Option<u32>,
    /// How the last change has cut it, if it has, and it is a quad.
    pub(super) cut: Option<QuadCut>,
}

impl FacePlace {
    pub(super) fn slots(&self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

impl FacePlaces {
    /// Forgets how faces were cut: their triangles have other vertices now.
    pub(super) fn forget_cuts(&mut self) {
        self.places.iter_mut().for_each(|place| place.cut = None);
    }

    /// Takes the place of those of an earlier change, if that was of other faces.
    pub(super) fn update(
        &mut self,
        RenderUpdate { faces, outlines, .. }: &RenderUpdate,
        slots_of: impl Fn(u32) -> Range<usize> + Sync,
    ) -> &mut [FacePlace] {
        if self.faces != *faces || self.version != outlines.version() {
            self.version = outlines.version();
            let place = |&face: &u32| {
                let Range { start, end } = slots_of(face);
                let outline = outlines.place_of(face).map(|place| place as u32);
                FacePlace { face, start: start as u32, end: end as u32, outline, cut: None }
            };
            let places = faces.par_iter().with_min_len(PIECE).map(place);
            self.faces.clone_from(faces);
            self.places = places.filter(|place| place.start < place.end).collect();
            // Out of order where faces of several slots change.
            self.places.sort_by_key(|place| place.start);
        }
        &mut self.places
    }
}
