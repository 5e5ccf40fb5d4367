//! Topology (what stays the same when a surface is bent), and size.

use trigon_math::DVec3;

use crate::Mesh;
use crate::edges::NO_EDGE;

/// The corners that leave along an edge, for each edge of the faces: the first
/// two, and how many there are.
pub(crate) struct EdgeCorners {
    pub(crate) corners: Vec<[u32; 2]>,
    pub(crate) counts: Vec<u32>,
}

impl Mesh {
    /// Euler's characteristic, vertices minus edges plus faces: 2 for every solid without a hole
    /// through it, 0 for a torus, the sum over the parts if there are several.
    pub fn euler_characteristic(&self) -> i64 {
        self.vertex_count() as i64 - self.edge_count() as i64 + self.face_count() as i64
    }

    /// Whether the faces enclose a volume without gaps: there are faces, and every edge of theirs
    /// belongs to exactly two, in opposite directions.
    pub fn is_closed(&self) -> bool {
        let meeting = self.edge_corners();
        let opposed = |[a, b]: &[u32; 2]| {
            let vertices = self.corner_vertices();
            vertices[*a as usize] != vertices[*b as usize]
        };
        self.face_count() > 0
            && meeting.counts.iter().all(|&count| count == 2)
            && meeting.corners.iter().all(opposed)
    }

    /// The area of all faces in square metres; for a non-planar face, that of its area vector.
    pub fn surface_area(&self) -> f64 {
        (0..self.face_count()).map(|face| self.face_area_vector(face).length()).sum()
    }

    /// The volume inside the faces in cubic metres, by the divergence theorem over the
    /// triangulation. Negative if the faces point inwards. Meaningless unless the mesh [is
    /// closed](Mesh::is_closed).
    pub fn volume(&self) -> f64 {
        let corner = |corner: u32| self.position(self.corner_vertices()[corner as usize]);
        let origin = self.positions().first().map_or(DVec3::ZERO, |p| p.as_dvec3());
        let of_tetrahedron = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|c| corner(c) - origin);
            a.dot(b.cross(c)) / 6.0
        };
        self.triangulation().triangles.iter().map(of_tetrahedron).sum()
    }

    pub(crate) fn edge_corners(&self) -> EdgeCorners {
        let mut corners = vec![[NO_EDGE; 2]; self.face_edge_count()];
        let mut counts = vec![0u32; self.face_edge_count()];
        for corner in 0..self.corner_count() {
            let Some(edge) = self.corner_edge(corner) else { continue };
            let count = &mut counts[edge as usize];
            if let Some(slot) = corners[edge as usize].get_mut(*count as usize) {
                *slot = corner as u32;
            }
            *count += 1;
        }
        EdgeCorners { corners, counts }
    }
}
