//! Bisecting: faces are cut along a plane, one side can be removed, and the cut filled.

mod loops;
mod side;
#[cfg(test)]
mod tests;

use std::cmp::Ordering;
use std::collections::BTreeMap;

use fixedbitset::FixedBitSet;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_math::{DVec3, Plane};

use self::loops::CutEdge;
use self::side::side_of;
use super::halves::{Halves, Side};
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, VertexId};
use crate::numbering::sorted_once;
use crate::refusal::Refusal;
use crate::slots::NewElements;

/// Parameters of [`EditMesh::bisect`].
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct BisectSettings {
    /// Whether what is in front of the plane, where its normal points to, is removed.
    pub clear_outer: bool,
    /// Whether what is behind it is removed.
    pub clear_inner: bool,
    /// Whether the cut is filled with faces.
    pub fill: bool,
    /// Vertices at most this far from the plane, in metres, count as on it; at least 0.
    pub threshold: f64,
}

/// What a bisection made.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Bisected {
    /// The edges on the plane.
    pub edges: Vec<EdgeId>,
    /// The faces that fill the cut.
    pub fill: Vec<FaceId>,
    /// What is left of the given faces, without those.
    pub faces: Vec<FaceId>,
    /// How many faces were removed, including parts of cut ones.
    pub removed: usize,
}

const OPERATION: &str = "bisecting";

impl EditMesh {
    /// Cuts faces along a plane through a point, and removes what is on one side, or on both.
    ///
    /// Sides are exact: a vertex is on the plane only if no rounding hides that it is not, or within the threshold. Edges
    /// that cross the plane get a vertex there, with interpolated values, and faces are cut between these. A face that no
    /// straight cut divides, because it is concave and not flat, is first cut into triangles. A face on the plane belongs
    /// to the side behind its back.
    ///
    /// Filling closes each loop of the cut with faces that look away from what is left; loops within loops become holes.
    /// They have the material, texture coordinates and colours found beside them. If neither side is removed, or both are,
    /// they look to the front.
    ///
    /// # Errors
    /// No face is given, or one does not exist; the normal has no direction, or a parameter is out of range; there would be
    /// too many elements.
    ///
    /// ```
    /// use trigon_mesh::{math::DVec3, primitives};
    /// use trigon_modelling::{BisectSettings, EditMesh, FaceId};
    ///
    /// let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    /// let faces: Vec<FaceId> = cube.faces().collect();
    /// let settings = BisectSettings { clear_outer: true, fill: true, ..BisectSettings::default() };
    /// let made = cube.bisect(&faces, DVec3::ZERO, DVec3::X, &settings)?;
    /// assert_eq!(made.fill.len(), 1);
    /// assert!(cube.is_watertight() && (cube.volume() - 4.0).abs() < 1e-12);
    /// # Ok::<(), trigon_modelling::Refusal>(())
    /// ```
    pub fn bisect(
        &mut self,
        faces: &[FaceId],
        point: DVec3,
        normal: DVec3,
        settings: &BisectSettings,
    ) -> Result<Bisected, Refusal> {
        self.check_faces(faces, OPERATION)?;
        if !(settings.threshold >= 0.0 && settings.threshold.is_finite()) {
            let parameter = "the threshold of a bisection";
            return Err(Refusal::OutOfRange { parameter, value: settings.threshold, range: "at least 0" });
        }
        let Some(plane) = Plane::from_point_and_normal(point, normal) else {
            let reason = "the plane's normal is zero or not finite";
            return Err(Refusal::NotPossible { operation: OPERATION, reason });
        };
        let faces = sorted_once(faces.to_vec());
        let mut halves = Halves::new(self, &plane, OPERATION);
        let side = |vertex: VertexId| {
            let at = self.point(vertex);
            if plane.signed_distance(at).abs() <= settings.threshold {
                return Side::Middle;
            }
            match side_of(normal, point, at) {
                Ordering::Less => Side::Behind,
                Ordering::Equal => Side::Middle,
                Ordering::Greater => Side::InFront,
            }
        };
        for vertex in sorted_once(faces.iter().flat_map(|&face| self.face_vertices(face)).collect()) {
            halves.set_side(vertex, side(vertex));
        }
        self.check_capacity_for(self.new_elements(&halves, &faces, settings.fill))?;
        self.whole(|mesh| {
            let pieces = halves.cut_all(mesh, &faces)?;
            mesh.finish_cut(&halves, pieces, &plane, settings)
        })
    }

    /// At most so many elements come from a cut.
    fn new_elements(&self, halves: &Halves<'_>, faces: &[FaceId], fill: bool) -> NewElements {
        let crossing = faces.iter().filter(|&&face| halves.crosses(self, face));
        let corners: usize = crossing.clone().map(|&face| self.face_size(face)).sum();
        let edges: Vec<EdgeId> = sorted_once(crossing.flat_map(|&face| self.face_edges(face)).collect());
        let sides: usize = edges.iter().map(|&edge| self.edge_corners(edge).count()).sum();
        // Each side and each diagonal of a crossing face can get a vertex, and each of its triangles a cut.
        let (corners, sides) = (corners as u64, sides as u64);
        let on_plane = if fill { self.count_on_plane(halves, faces) + 2 * corners } else { 0 };
        NewElements {
            vertices: 2 * corners,
            edges: 5 * corners + 2 * on_plane,
            corners: sides + 8 * corners + 3 * on_plane,
            faces: 2 * corners + on_plane,
        }
    }

    /// How many corners of faces begin an edge on the plane.
    fn count_on_plane(&self, halves: &Halves<'_>, faces: &[FaceId]) -> u64 {
        let corners = faces.iter().flat_map(|&face| self.face_corners(face));
        let is_on = |corner| halves.side(self.corner_vertex(corner)) == Side::Middle;
        corners.filter(|&corner| is_on(corner) && is_on(self.next_corner(corner))).count() as u64
    }

    /// Fills and clears after all faces were cut.
    fn finish_cut(
        &mut self,
        halves: &Halves<'_>,
        pieces: Vec<FaceId>,
        plane: &Plane,
        settings: &BisectSettings,
    ) -> Result<Bisected, Refusal> {
        let &BisectSettings { clear_outer, clear_inner, fill, .. } = settings;
        let is_in_front = |mesh: &Self, face: FaceId| {
            let sides = mesh.face_vertices(face).map(|vertex| halves.side(vertex));
            match sides.clone().find(|&side| side != Side::Middle) {
                Some(side) => side == Side::InFront,
                None => mesh.face_normal(face).dot(plane.normal()) < 0.0,
            }
        };
        let is_cleared = |mesh: &Self, face| if is_in_front(mesh, face) { clear_outer } else { clear_inner };
        let (removed, faces): (Vec<FaceId>, Vec<FaceId>) =
            pieces.iter().copied().partition(|&face| is_cleared(self, face));
        let mut made = Bisected { removed: removed.len(), faces, ..Bisected::default() };
        let is_on = |&edge: &EdgeId| {
            self.edge_vertices(edge).iter().all(|&vertex| halves.side(vertex) == Side::Middle)
        };
        let edges =
            sorted_once(pieces.iter().flat_map(|&face| self.face_edges(face)).filter(is_on).collect());
        if fill {
            let mut is_removed = FixedBitSet::with_capacity(self.face_capacity());
            removed.iter().for_each(|face| is_removed.insert(face.0 as usize));
            let counts = |mesh: &Self, face: FaceId| match clear_outer == clear_inner {
                true => !is_in_front(mesh, face),
                false => !is_removed.contains(face.0 as usize),
            };
            let cut: Vec<CutEdge> =
                edges.iter().filter_map(|&edge| self.cut_edge_of(edge, |face| counts(self, face))).collect();
            let towards = if clear_inner && !clear_outer { -plane.normal() } else { plane.normal() };
            made.fill = self.fill_cut(&cut, towards);
        }
        if !removed.is_empty() {
            self.delete_faces(&removed)?;
        }
        made.edges = edges.into_iter().filter(|&edge| self.has_edge(edge)).collect();
        Ok(made)
    }

    /// The step of a filling face along an edge: against those of some of its faces, if more go one way than the other.
    fn cut_edge_of(&self, edge: EdgeId, counts: impl Fn(FaceId) -> bool) -> Option<CutEdge> {
        let [a, b] = self.edge_vertices(edge);
        let mut sides = self.edge_corners(edge).filter(|&side| counts(self.corner_face(side))).peekable();
        let source = *sides.peek()?;
        let sum: i32 = sides.map(|side| if self.corner_vertex(side) == a { 1 } else { -1 }).sum();
        let ends = match sum.cmp(&0) {
            Ordering::Greater => [b, a],
            Ordering::Less => [a, b],
            Ordering::Equal => return None,
        };
        Some(CutEdge { ends, source })
    }
}

impl Halves<'_> {
    /// Cuts all faces along the plane, by way of triangles where it cannot be done otherwise. All of their pieces.
    fn cut_all(&mut self, mesh: &mut EditMesh, faces: &[FaceId]) -> Result<Vec<FaceId>, Refusal> {
        let edges = sorted_once(faces.iter().flat_map(|&face| mesh.face_edges(face)).collect());
        for edge in edges {
            self.cut_edge(mesh, edge)?;
        }
        let mut pieces = faces.to_vec();
        for &face in faces {
            self.cut_into(mesh, face, &mut pieces)?;
        }
        Ok(pieces)
    }

    fn cut_into(
        &mut self,
        mesh: &mut EditMesh,
        face: FaceId,
        pieces: &mut Vec<FaceId>,
    ) -> Result<(), Refusal> {
        if !self.crosses(mesh, face) {
            return Ok(());
        }
        let first = pieces.len();
        let divided = match self.cut_face(mesh, face, pieces) {
            Ok(()) => true,
            Err(Refusal::NotPossible { .. }) => false,
            Err(other) => return Err(other),
        };
        let crossing: Vec<FaceId> = std::iter::once(face)
            .chain(pieces[first..].iter().copied())
            .filter(|&piece| self.crosses(mesh, piece))
            .collect();
        if divided && crossing.is_empty() {
            return Ok(());
        }
        let made = mesh.triangulate_faces(&crossing)?;
        let mut known: BTreeMap<FaceId, ()> = crossing.iter().map(|&piece| (piece, ())).collect();
        pieces.extend(made.faces.iter().copied().filter(|&piece| known.insert(piece, ()).is_none()));
        for edge in made.edges {
            self.cut_edge(mesh, edge)?;
        }
        for piece in made.faces {
            if self.crosses(mesh, piece) {
                self.cut_face(mesh, piece, pieces)?;
            }
        }
        Ok(())
    }
}
