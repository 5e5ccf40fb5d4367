//! Gives a mesh the triangles that are left.

use super::surface::{Merge, Surface};
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, NONE, VertexId};
use crate::operations::region::Region;
use trigon_math::Vec3;

impl EditMesh {
    /// Removes the triangles of a region that a surface has no longer, and gives the others their vertices and values. The
    /// faces that are left.
    pub(super) fn rebuild(&mut self, region: &Region, surface: &Surface) -> Vec<FaceId> {
        let mut is_gone = vec![true; surface.faces.len()];
        surface.triangles.iter().for_each(|triangle| is_gone[triangle.face as usize] = false);
        self.merge_values(surface);
        let mut is_changed = vec![false; surface.triangles.len()];
        for (triangle, is_changed) in surface.triangles.iter().zip(&mut is_changed) {
            let corners = surface.corners(self, triangle.face);
            let vertices = triangle.vertices.map(|vertex| surface.vertices[vertex as usize]);
            *is_changed = corners.map(|corner| self.corner_vertex(corner)) != vertices;
        }
        let edges: Vec<EdgeId> = region.faces.iter().flat_map(|&face| self.face_edges(face)).collect();
        for (triangle, _) in surface.triangles.iter().zip(&is_changed).filter(|(_, is_changed)| **is_changed)
        {
            surface.corners(self, triangle.face).into_iter().for_each(|corner| self.unlink_at_edge(corner.0));
        }
        for (&face, _) in surface.faces.iter().zip(&is_gone).filter(|(_, is_gone)| **is_gone) {
            self.remove_whole_face(face);
        }
        for edge in edges {
            self.remove_loose_edge(edge);
        }
        for merge in &surface.merges {
            self.remove_loose_vertex(surface.vertices[merge.gone as usize]);
        }
        self.move_merged(surface);
        for (triangle, _) in surface.triangles.iter().zip(&is_changed).filter(|(_, is_changed)| **is_changed)
        {
            let vertices = triangle.vertices.map(|vertex| surface.vertices[vertex as usize]);
            let corners = surface.corners(self, triangle.face);
            for (side, &corner) in corners.iter().enumerate() {
                let edge = self.join(vertices[side], vertices[(side + 1) % 3]);
                self.corners.write(corner.0).vertex = vertices[side].0;
                self.link_at_edge(corner.0, edge.0);
            }
        }
        self.mark_features(surface);
        surface.triangles.iter().map(|triangle| surface.faces[triangle.face as usize]).collect()
    }

    fn remove_whole_face(&mut self, face: FaceId) {
        self.remove_face(face).expect("it was there when the region was made");
    }

    /// Blends the values of merged vertices and corners.
    fn merge_values(&mut self, surface: &Surface) {
        for &Merge { retained, gone, part } in &surface.merges {
            let [retained, gone] = [retained, gone].map(|vertex| surface.vertices[vertex as usize]);
            self.blend_vertex(&[(retained, 1.0 - part), (gone, part)], retained);
        }
        if surface.values.of.is_empty() {
            return;
        }
        let mut is_split = surface.values.has_split_normals.clone();
        is_split.grow(self.corner_capacity());
        let mut is_blended = vec![false; self.corner_capacity()];
        for &Merge { retained, gone, part } in &surface.values.merges {
            let parts = [(CornerId(retained), 1.0 - part), (CornerId(gone), part)];
            self.blend_corner(&parts, CornerId(retained));
            is_blended[retained as usize] = true;
            is_split.set(retained as usize, is_split[retained as usize] || is_split[gone as usize]);
        }
        for triangle in &surface.triangles {
            let corners = surface.corners(self, triangle.face);
            for (corner, wedge) in corners.into_iter().zip(surface.values.of[triangle.face as usize]) {
                if is_blended[wedge as usize] {
                    if corner.0 != wedge {
                        self.copy_corner(CornerId(wedge), corner);
                    }
                    if is_split[wedge as usize] {
                        // The surface around it has another shape now.
                        self.set_custom_normal(corner, Vec3::ZERO);
                    }
                }
            }
        }
    }

    fn move_merged(&mut self, surface: &Surface) {
        for merge in &surface.merges {
            let vertex: VertexId = surface.vertices[merge.retained as usize];
            // One that merged into another later on is gone.
            if self.has_vertex(vertex) {
                let position = (surface.points[merge.retained as usize] + surface.origin).as_vec3();
                self.set_position(vertex, position);
            }
        }
    }

    fn mark_features(&mut self, surface: &Surface) {
        for triangle in &surface.triangles {
            let corners = surface.corners(self, triangle.face);
            for (corner, &feature) in corners.iter().zip(&triangle.features) {
                if feature == NONE {
                    continue;
                }
                let marks = surface.features[feature as usize];
                let edge = self.corner_edge(*corner);
                let record = self.edges[edge.0];
                if record.flags & marks.flags != marks.flags || record.crease < marks.crease {
                    let record = self.edges.write(edge.0);
                    record.flags |= marks.flags;
                    record.crease = record.crease.max(marks.crease);
                }
            }
        }
    }
}
