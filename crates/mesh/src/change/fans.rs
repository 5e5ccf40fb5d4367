//! Vertices whose normal is the mean of the faces around them, as those of most meshes are.

use rayon::prelude::*;
use trigon_math::Vec3;

use super::corner_faces::FaceCorner;
use super::face_normals::{FaceNormals, NearPlaces};
use super::normal_lists::NormalLists;
use super::render_update::{RenderUpdate, UpdatedVertex};
use crate::Mesh;

/// Vertices each of which is one render vertex, with what lies around them. That does not depend on their values,
/// so it is found once for a drag that changes the same vertices in each frame.
#[derive(Debug, Clone, Default)]
pub(super) struct Fans {
    /// Some vertices each.
    pieces: Vec<FanPiece>,
    /// How many vertices there are, and how many of them were moved.
    pub(super) count: usize,
    pub(super) moved: usize,
    /// Vertices of the mesh around a change that are no fans, increasing.
    pub(super) others: Vec<u32>,
    /// Whether the corners are numbered as in [`FaceNormals::near`], or else as in the mesh.
    are_near: bool,
}

/// The corners at some vertices.
#[derive(Debug, Clone, Default)]
pub(super) struct FanPiece {
    corners: Vec<FaceCorner>,
    /// Where those of each vertex end.
    ends: Vec<u32>,
}

/// Some vertices, divided into fans and others.
#[derive(Default)]
pub(super) struct FoundFans {
    pub(super) fans: FanPiece,
    /// What the fans show.
    pub(super) shown: Vec<UpdatedVertex>,
    /// Those of `shown` that show other values than normals, as indices.
    pub(super) replaced: Vec<u32>,
    /// The vertices that are no fans.
    pub(super) others: Vec<u32>,
}

impl Fans {
    /// Of vertices that were divided piece by piece. Replaces the update by what the fans show.
    pub(super) fn new(found: Vec<FoundFans>, update: &mut RenderUpdate) -> Self {
        update.vertices.clear();
        update.replaced.clear();
        let (mut pieces, mut others) = (Vec::with_capacity(found.len()), Vec::new());
        for part in found {
            update.add(&part.shown, &part.replaced);
            others.extend(part.others);
            pieces.push(part.fans);
        }
        Self { pieces, count: update.vertices.len(), moved: update.replaced.len(), others, are_near: false }
    }

    /// Finds where the values are from now on that the fans take: side by side, those of faces that do not change
    /// in the order of the fans, after those of faces that do.
    fn bring_near(&mut self, mesh: &Mesh, face_normals: &mut FaceNormals) {
        let (places, all) = (face_normals.near_places(mesh), face_normals.all());
        let others = self.pieces.par_iter_mut().map(|piece| piece.bring_near(&places, all)).collect();
        let end = places.end();
        let starts = face_normals.keep_others(others);
        for (piece, start) in self.pieces.iter_mut().zip(starts) {
            for of in piece.corners.iter_mut().filter(|of| of.face >= end.face) {
                of.face += start.face - end.face;
                of.corner += start.corner - end.corner;
            }
        }
        self.are_near = true;
    }

    /// Brings the normals of the vertices up to date, which come in the order of the fans. Whether each has one.
    pub(super) fn update(
        &mut self,
        mesh: &Mesh,
        face_normals: &mut FaceNormals,
        mut vertices: &mut [UpdatedVertex],
    ) -> bool {
        // Not when they are found: other elements may change the next time.
        if !self.are_near {
            self.bring_near(mesh, face_normals);
        }
        let near = face_normals.near();
        let mut parts = Vec::with_capacity(self.pieces.len());
        for piece in &self.pieces {
            let own = vertices.split_off_mut(..piece.ends.len()).expect("one for each fan");
            parts.push((piece, own));
        }
        parts.into_par_iter().map(|(piece, own)| piece.update(near, own)).reduce(|| true, |a, b| a & b)
    }
}

impl FanPiece {
    /// Adds a vertex with these corners, which increase; returns its normal. `None`, with nothing added, if one of
    /// them is missing, or if they have no mean.
    pub(super) fn push(
        &mut self,
        face_normals: &NormalLists,
        corners: impl Iterator<Item = Option<FaceCorner>>,
    ) -> Option<Vec3> {
        let first = self.corners.len();
        let mut are_there = true;
        self.corners.extend(corners.map_while(|corner| {
            are_there &= corner.is_some();
            corner
        }));
        let normal = are_there.then(|| face_normals.mean(self.corners[first..].iter().copied()));
        let normal = normal.filter(|&normal| normal != Vec3::ZERO);
        if normal.is_some() {
            self.ends.push(self.corners.len() as u32);
        } else {
            self.corners.truncate(first);
        }
        normal
    }

    /// Replaces the corners by their places among the values of the faces that change, or after these values; returns
    /// what belongs there for this piece.
    fn bring_near(&mut self, places: &NearPlaces<'_>, all: &NormalLists) -> NormalLists {
        let most = self.corners.len();
        let mut others = NormalLists { normals: Vec::with_capacity(most), angles: Vec::with_capacity(most) };
        let end = places.end();
        for of in &mut self.corners {
            let FaceCorner { face, corner } = *of;
            *of = places.get(*of).unwrap_or_else(|| {
                let number = others.normals.len() as u32;
                others.normals.push(all.normals[face as usize]);
                others.angles.push(all.angles[corner as usize]);
                FaceCorner { face: end.face + number, corner: end.corner + number }
            });
        }
        others
    }

    fn update(&self, near: &NormalLists, vertices: &mut [UpdatedVertex]) -> bool {
        let (mut first, mut have_all) = (0, true);
        for (vertex, &end) in vertices.iter_mut().zip(&self.ends) {
            vertex.normal = near.mean(self.corners[first..end as usize].iter().copied());
            have_all &= vertex.normal != Vec3::ZERO;
            first = end as usize;
        }
        have_all
    }
}
