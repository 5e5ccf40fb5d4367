//! Normals of faces and the angles at their corners. They are kept: a change touches few faces, and the normals of the
//! other faces around a vertex are still valid.

use std::mem::take;
use std::ops::Range;

use rayon::prelude::*;
use trigon_math::Vec3;

use super::Outlines;
use super::corner_faces::FaceCorner;
use super::marks::{Marks, Ranks};
use super::normal_lists::{NormalLists, angles_at};
use crate::Mesh;
use crate::face_starts::FaceStarts;
use crate::quads::{QuadGroup, Quads};

/// Faces or vertices that a thread takes at a time: about a tenth of a millisecond's work,
/// a few times what it takes to wake a thread.
pub(super) const PIECE: usize = 1024;

/// The normals of all faces of a mesh. Those of the faces around the last change lie all over the memory, so they are kept
/// side by side as long as the same faces change.
#[derive(Debug, Clone, Default)]
pub(super) struct FaceNormals {
    all: NormalLists,
    /// Of the faces around the last change, in their order; then copies of others that are read with them.
    near: NormalLists,
    /// These faces, increasing, and their corners in `near`.
    faces: Vec<u32>,
    starts: FaceStarts,
    /// Whether `all` still has older values of them.
    is_behind: bool,
}

impl FaceNormals {
    pub(super) fn new(mesh: &Mesh) -> Self {
        Self { all: NormalLists::new(mesh), ..Self::default() }
    }

    /// Expects changes of other faces, which increase.
    pub(super) fn replace(&mut self, mesh: &Mesh, faces: &[u32]) {
        self.settle(mesh);
        let sizes: Vec<u32> =
            faces.iter().map(|&face| mesh.face_corners(face as usize).len() as u32).collect();
        self.starts = FaceStarts::of_sizes(&sizes);
        self.faces = faces.to_vec();
        self.near.normals = vec![Vec3::ZERO; faces.len()];
        let angles = if self.all.angles.is_empty() { 0 } else { sizes.iter().sum::<u32>() as usize };
        self.near.angles = vec![0.0; angles];
    }

    /// Brings the normals of these faces up to date, which have these outlines.
    pub(super) fn update(&mut self, mesh: &Mesh, outlines: &Outlines) {
        let Self { near, faces, starts, .. } = self;
        let (mut normals, mut angles) = (near.normals.as_mut_slice(), near.angles.as_mut_slice());
        let mut parts = Vec::with_capacity(faces.len().div_ceil(PIECE));
        for (faces, first) in faces.chunks(PIECE).zip((0..).step_by(PIECE)) {
            let first_corner = starts.corners(first).start;
            let end_corner = starts.corners(first + faces.len() - 1).end;
            let own_angles = if angles.is_empty() { 0 } else { end_corner - first_corner };
            parts.push(Part {
                faces,
                starts,
                first,
                first_corner,
                normals: normals.split_off_mut(..faces.len()).expect("one of each face"),
                angles: angles.split_off_mut(..own_angles).expect("one at each corner"),
            });
        }
        parts.into_par_iter().for_each(|part| part.update(mesh, outlines));
        self.is_behind = true;
    }

    /// Writes what is kept side by side to where it belongs in the mesh.
    pub(super) fn settle(&mut self, mesh: &Mesh) {
        if !take(&mut self.is_behind) {
            return;
        }
        let Self { all, near, faces, starts, .. } = self;
        let (mut normals, mut angles) = (all.normals.as_mut_slice(), all.angles.as_mut_slice());
        let (mut first_face, mut first_corner) = (0, 0);
        let mut parts = Vec::with_capacity(faces.len().div_ceil(PIECE));
        for (faces, first) in faces.chunks(PIECE).zip((0..).step_by(PIECE)) {
            let end = faces[faces.len() - 1] as usize + 1;
            let end_corner = mesh.face_corners(end - 1).end;
            let own_angles = if angles.is_empty() { 0 } else { end_corner - first_corner };
            parts.push(SettledPart {
                faces,
                first,
                first_face,
                first_corner,
                normals: normals.split_off_mut(..end - first_face).expect("faces increase"),
                angles: angles.split_off_mut(..own_angles).expect("so do their corners"),
            });
            (first_face, first_corner) = (end, end_corner);
        }
        parts.into_par_iter().for_each(|part| part.settle(mesh, near, starts));
    }

    /// Those of all faces of the mesh, as they were [settled](Self::settle) last.
    pub(super) fn all(&self) -> &NormalLists {
        &self.all
    }

    /// The normals that the faces around the last change show if they are flat.
    pub(super) fn shown(&self) -> impl Iterator<Item = (u32, Vec3)> {
        self.faces.iter().enumerate().map(|(place, &face)| (face, self.near.shown(place)))
    }

    /// Where the faces around the last change and their corners are among those that are kept side by side.
    pub(super) fn near_places<'a>(&'a self, mesh: &'a Mesh) -> NearPlaces<'a> {
        let mut marks = Marks::new(mesh.face_count());
        self.faces.iter().for_each(|&face| marks.insert(face));
        NearPlaces { mesh, ranks: marks.ranks(), starts: &self.starts, end: self.end() }
    }

    /// Those of the faces around the last change, and of others that are kept beside them.
    pub(super) fn near(&self) -> &NormalLists {
        &self.near
    }

    /// Keeps values of other faces beside those of the faces around the last change, in place of earlier ones. Returns
    /// where each part begins.
    pub(super) fn keep_others(&mut self, others: Vec<NormalLists>) -> Vec<FaceCorner> {
        let FaceCorner { face, corner } = self.end();
        let NormalLists { normals, angles } = &mut self.near;
        normals.truncate(face as usize);
        angles.truncate(corner as usize);
        normals.reserve_exact(others.iter().map(|part| part.normals.len()).sum());
        angles.reserve_exact(others.iter().map(|part| part.angles.len()).sum());
        let keep = |part: NormalLists| {
            let start = FaceCorner { face: normals.len() as u32, corner: angles.len() as u32 };
            normals.extend(part.normals);
            angles.extend(part.angles);
            start
        };
        others.into_iter().map(keep).collect()
    }

    /// How many faces there are around the last change, and how many corners they have.
    fn end(&self) -> FaceCorner {
        let corner = self.faces.len().checked_sub(1).map_or(0, |last| self.starts.corners(last).end as u32);
        FaceCorner { face: self.faces.len() as u32, corner }
    }
}

/// Finds faces among those around a change.
pub(super) struct NearPlaces<'a> {
    mesh: &'a Mesh,
    ranks: Ranks,
    starts: &'a FaceStarts,
    end: FaceCorner,
}

impl NearPlaces<'_> {
    /// What comes after the faces around the change, and after their corners.
    pub(super) fn end(&self) -> FaceCorner {
        self.end
    }

    /// The place of a face and of one of its corners; `None` if it is not around the change.
    pub(super) fn get(&self, FaceCorner { face, corner }: FaceCorner) -> Option<FaceCorner> {
        let place = self.ranks.get(face)?;
        let first = self.starts.corners(place as usize).start as u32;
        let number = corner - self.mesh.face_corners(face as usize).start as u32;
        Some(FaceCorner { face: place, corner: first + number })
    }
}

/// Some of the faces around a change.
struct Part<'a> {
    faces: &'a [u32],
    starts: &'a FaceStarts,
    /// The place of the first face and of its first corner.
    first: usize,
    first_corner: usize,
    normals: &'a mut [Vec3],
    /// None if no face is smooth.
    angles: &'a mut [f64],
}

impl Part<'_> {
    fn update(mut self, mesh: &Mesh, outlines: &Outlines) {
        let mut room = QuadGroup::default();
        for start in (0..self.faces.len()).step_by(QuadGroup::MOST) {
            let group = outlines.group(mesh, (self.first + start) / QuadGroup::MOST, &mut room);
            for &other in group.others() {
                self.update_any(mesh, start + other as usize);
            }
            group.for_each(
                #[inline(always)]
                |numbers, quads| {
                    self.update_quads(quads, numbers.iter().map(|&number| start + number as usize));
                },
            );
        }
    }

    fn update_any(&mut self, mesh: &Mesh, place: usize) {
        let face = self.faces[place] as usize;
        self.normals[place] = mesh.face_normal(face);
        let own = self.corners(place);
        if let Some(angles) = self.angles.get_mut(own) {
            let made = angles_at(mesh, mesh.face_corners(face));
            angles.iter_mut().zip(made).for_each(|(angle, made)| *angle = made);
        }
    }

    /// Updates the faces of the first of some quads.
    #[inline(always)]
    fn update_quads<const N: usize>(
        &mut self,
        quads: &Quads<N>,
        places: impl Iterator<Item = usize> + Clone,
    ) {
        for (place, normal) in places.clone().zip(quads.normals()) {
            self.normals[place] = normal;
        }
        if self.angles.is_empty() {
            return;
        }
        for (place, angles) in places.zip(quads.angles()) {
            let own = self.corners(place);
            self.angles[own].copy_from_slice(&angles);
        }
    }

    /// The corners of a face among the own ones.
    #[inline(always)]
    fn corners(&self, place: usize) -> Range<usize> {
        let Range { start, end } = self.starts.corners(self.first + place);
        start - self.first_corner..end - self.first_corner
    }
}

/// Some of the faces around a change, and what is known of all faces of the mesh from one of them to another.
struct SettledPart<'a> {
    faces: &'a [u32],
    /// The place of the first of them.
    first: usize,
    first_face: usize,
    normals: &'a mut [Vec3],
    first_corner: usize,
    /// None if no face is smooth.
    angles: &'a mut [f64],
}

impl SettledPart<'_> {
    fn settle(self, mesh: &Mesh, near: &NormalLists, starts: &FaceStarts) {
        for (place, &face) in (self.first..).zip(self.faces) {
            self.normals[face as usize - self.first_face] = near.normals[place];
            let Range { start, end } = mesh.face_corners(face as usize);
            if let Some(angles) = self.angles.get_mut(start - self.first_corner..end - self.first_corner) {
                angles.copy_from_slice(&near.angles[starts.corners(place)]);
            }
        }
    }
}
