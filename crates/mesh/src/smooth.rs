//! Corner normals that are smooth across flat edges and split at sharp ones.

use trigon_math::{DVec3, Vec3, elementary, unit_or_zero};

use crate::Mesh;

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
    fn smooth_regions(&self, face_normals: &[Vec3], angle: f64) -> Regions {
        let least_cosine = elementary::cos(angle.clamp(0.0, std::f64::consts::PI)) - COSINE_ROUNDING;
        let vertices = self.corner_vertices();
        let (faces, next) = self.faces_and_next_corners();
        let mut regions = Regions::new(self.corner_count());
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

/// Sets of corners (union-find; the smallest corner represents its set).
struct Regions(Vec<u32>);

impl Regions {
    fn new(corners: usize) -> Self {
        Self((0..corners as u32).collect())
    }

    fn root(&mut self, mut corner: u32) -> u32 {
        while self.0[corner as usize] != corner {
            // Halves the path for the next look-up.
            let above = self.0[self.0[corner as usize] as usize];
            self.0[corner as usize] = above;
            corner = above;
        }
        corner
    }

    fn join(&mut self, a: u32, b: u32) {
        let [a, b] = [self.root(a), self.root(b)];
        self.0[a.max(b) as usize] = a.min(b);
    }
}
