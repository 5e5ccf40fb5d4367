//! Smooth and flat shading: corner normals that are smooth across flat edges and split at sharp ones; and
//! polygons that are shaded flat. In a pose their normals are those of the posed polygons: transforming the
//! old ones would be wrong.

use std::ops::Range;

use trigon_math::{DVec3, DisjointSets, Vec3, area_vector, elementary, unit_or_zero};

use super::{Attributes, Mesh};

/// Polygons that are shaded flat, by their vertices in a
/// [`RenderMesh`](crate::RenderMesh), which they share with no other polygon.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FlatFaces {
    /// Where the vertices of each begin, and the end.
    starts: Vec<u32>,
    vertices: Vec<u32>,
}

impl FlatFaces {
    /// The flat faces of a mesh; none of one that no pose bends.
    pub(crate) fn of(mesh: &Mesh, vertex_of_corner: &[u32]) -> Self {
        let mut faces = Self { starts: vec![0], vertices: Vec::new() };
        for corners in flat_faces(mesh) {
            faces.vertices.extend_from_slice(&vertex_of_corner[corners]);
            faces.starts.push(faces.vertices.len() as u32);
        }
        faces
    }

    /// Gives every one the normal of its polygon. One without area keeps what it has,
    /// and `is_mirrored` says of a vertex whether its surroundings are turned inside out.
    pub(super) fn set_normals(
        &self,
        positions: &[Vec3],
        normals: &mut [Vec3],
        is_mirrored: impl Fn(usize) -> bool,
    ) {
        for ends in self.starts.windows(2) {
            let vertices = &self.vertices[ends[0] as usize..ends[1] as usize];
            let corners = vertices.iter().map(|&vertex| positions[vertex as usize].as_dvec3());
            let normal = unit_or_zero(area_vector(corners)).as_vec3();
            let Some(&first) = vertices.first().filter(|_| normal != Vec3::ZERO) else { continue };
            let normal = if is_mirrored(first as usize) { -normal } else { normal };
            vertices.iter().for_each(|&vertex| normals[vertex as usize] = normal);
        }
    }
}

/// A number for each corner that no two flat faces share; 0 at other faces, and no
/// numbers at all for a mesh that no pose bends.
pub(crate) fn flat_classes(mesh: &Mesh) -> Vec<u32> {
    let mut classes = Vec::new();
    for (corners, class) in flat_faces(mesh).zip(1..) {
        classes.resize(mesh.corner_count(), 0);
        classes[corners].fill(class);
    }
    classes
}

/// The corners of each face that a pose can bend and that is shaded flat: it is not
/// smooth, and no corner has a normal of its own or is told by a target where its
/// normal goes.
fn flat_faces(mesh: &Mesh) -> impl Iterator<Item = Range<usize>> + '_ {
    let attributes = mesh.attributes();
    let mut targets = attributes.morph_targets.iter();
    let moves = attributes.skin.is_some() || targets.any(|target| !target.positions.is_empty());
    let is_smooth = |face: usize| attributes.face_smooth.as_ref().is_some_and(|smooth| smooth[face]);
    let has_normal = if moves { corners_with_normals(attributes, mesh.corner_count()) } else { Vec::new() };
    let faces = mesh.faces().enumerate().take(if moves { mesh.face_count() } else { 0 });
    let flat = faces
        .filter(move |(face, corners)| !is_smooth(*face) && !has_normal[corners.clone()].contains(&true));
    flat.map(|(_, corners)| corners)
}

/// Which corners have a normal, or a change of it.
fn corners_with_normals(attributes: &Attributes, count: usize) -> Vec<bool> {
    let is_given = |normal: &Vec3| unit_or_zero(normal.as_dvec3()) != DVec3::ZERO;
    let given = attributes.corner_normals.as_ref();
    let mut has_normal =
        given.map_or_else(|| vec![false; count], |normals| normals.iter().map(is_given).collect());
    for target in &attributes.morph_targets {
        target.normals.iter().for_each(|(corner, _)| has_normal[corner as usize] = true);
    }
    has_normal
}

impl Mesh {
    /// Sets corner normals so that faces are smooth across every edge at which their normals differ
    /// by at most `angle` radians, and marks the faces smooth. Edges that do not join exactly two
    /// faces in opposite directions stay sharp. At 0 and below only coplanar faces are smooth, from
    /// π on all are.
    ///
    /// Within a smooth region around a vertex the normals are weighted by angle, as in
    /// [`Mesh::vertex_normals`]. Corners of faces without area are ignored and get the zero normal,
    /// "not given".
    pub fn smooth_by_angle(&mut self, angle: f64) {
        let face_normals = self.face_normals();
        let mut regions = self.smooth_regions(&face_normals, angle);
        let mut sums = vec![DVec3::ZERO; self.corner_count()];
        self.for_each_weighted_corner(
            &face_normals,
            |_| true,
            |corner, weighted| {
                sums[regions.root(corner as u32) as usize] += weighted;
            },
        );
        let of_corner = |corner| unit_or_zero(sums[regions.root(corner) as usize]).as_vec3();
        let normals = (0..self.corner_count() as u32).map(of_corner).collect();
        let faces = self.face_count();
        let attributes = self.attributes_mut();
        attributes.corner_normals = Some(normals);
        attributes.face_smooth = Some(vec![true; faces]);
    }

    /// Joins, at both ends of every smooth edge, the corners of its two faces.
    fn smooth_regions(&self, face_normals: &[Vec3], angle: f64) -> DisjointSets {
        let least_cosine = elementary::cos(angle.clamp(0.0, std::f64::consts::PI)) - COSINE_ROUNDING;
        let vertices = self.corner_vertices();
        let (faces, next) = self.faces_and_next_corners();
        let mut regions = DisjointSets::new(self.corner_count());
        let meeting = self.edge_corners();
        for (&[a, b], &count) in meeting.corners.iter().zip(&meeting.counts) {
            if count != 2 || vertices[a as usize] == vertices[b as usize] {
                continue;
            }
            let [one, other] = [a, b].map(|corner| face_normals[faces[corner as usize] as usize].as_dvec3());
            if one.dot(other) >= least_cosine && one != DVec3::ZERO && other != DVec3::ZERO {
                regions.join(a, next[b as usize]);
                regions.join(next[a as usize], b);
            }
        }
        regions
    }

    /// The face of every corner, and the corner that follows it there.
    fn faces_and_next_corners(&self) -> (Vec<u32>, Vec<u32>) {
        let mut faces = Vec::with_capacity(self.corner_count());
        let mut next = Vec::with_capacity(self.corner_count());
        for (face, corners) in self.faces().enumerate() {
            faces.resize(corners.end, face as u32);
            next.extend(corners.start as u32 + 1..corners.end as u32);
            next.push(corners.start as u32);
        }
        (faces, next)
    }
}

/// Normals are rounded to f32: faces that meet at exactly the angle are still smooth.
const COSINE_ROUNDING: f64 = 1e-6;
