//! A polygon on the screen: how far its vertices and edges are from a pixel.

use trigon_camera::Projector;
use trigon_math::{DVec2, DVec3};
use trigon_mesh::Mesh;

use super::screen::nearer_first;

/// A polygon on the screen.
pub(super) struct FaceOutline<'m> {
    mesh: &'m Mesh,
    face: usize,
    /// For each corner where it is drawn; `None` before the near plane.
    corners: Vec<Option<DVec2>>,
    /// For each corner what is drawn of the side to the next one.
    sides: Vec<Option<[DVec2; 2]>>,
}

impl<'m> FaceOutline<'m> {
    /// `position` tells where a vertex is in the world.
    pub(super) fn new(
        mesh: &'m Mesh,
        face: usize,
        projector: &Projector,
        position: impl Fn(u32) -> DVec3,
    ) -> Self {
        let points: Vec<DVec3> = mesh.face_vertices(face).iter().map(|&vertex| position(vertex)).collect();
        let near = projector.camera().projection.near();
        let is_visible = |point: DVec3| -projector.to_camera(point).z >= near;
        let corner = |&point: &DVec3| projector.to_screen(point).filter(|_| is_visible(point));
        let side =
            |from: usize| projector.line_to_screen([points[from], points[(from + 1) % points.len()]], near);
        let corners = points.iter().map(corner).collect();
        Self { mesh, face, corners, sides: (0..points.len()).map(side).collect() }
    }

    /// The vertices with their distances from a point in pixels.
    pub(super) fn vertices(&self, point: DVec2) -> Vec<(u32, f64)> {
        let vertices = self.mesh.face_vertices(self.face).iter().zip(&self.corners);
        vertices.filter_map(|(&vertex, corner)| Some((vertex, corner.as_ref()?.distance(point)))).collect()
    }

    /// The edges with their distances from a point in pixels.
    pub(super) fn edges(&self, point: DVec2) -> Vec<(u32, f64)> {
        let sides = self.mesh.face_corners(self.face).zip(&self.sides);
        let distances = sides.filter_map(|(corner, side)| {
            Some((self.mesh.corner_edge(corner)?, distance_to_segment(point, side.as_ref()?)))
        });
        distances.collect()
    }
}

fn distance_to_segment(point: DVec2, &ends: &[DVec2; 2]) -> f64 {
    let [start, end] = nearer_first(ends, |&end| end);
    let along = end - start;
    let share = (point - start).dot(along) / along.length_squared();
    // A segment without length is its start.
    let share = if share > 0.0 { share.clamp(0.0, 1.0) } else { 0.0 };
    point.distance(start + along * share)
}
