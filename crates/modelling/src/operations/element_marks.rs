//! Marks of edges and faces: sharp, seam, crease, smooth, flat, material.
//!
//! Each operation returns how many elements it changed. Corner normals that were given, for example by a file,
//! would hide the effect on shading. Such normals are cleared there, and computed normals take their place.

use std::f64::consts::PI;

use trigon_math::elementary;

use super::delete::require;
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId};
use crate::measure::FaceNormals;
use crate::refusal::Refusal;

/// Normals are rounded: faces that meet at exactly the angle are still smooth.
const COSINE_ROUNDING: f64 = 1e-6;

/// Finds edges at which the normals of two faces differ by more than an angle.
struct EdgeAngles {
    least_cosine: f64,
    normals: FaceNormals,
}

impl EdgeAngles {
    /// The angle in radians.
    fn above(angle: f64) -> Result<Self, Refusal> {
        if !(0.0..=PI).contains(&angle) {
            return Err(Refusal::OutOfRange { parameter: "the angle", value: angle, range: "0 to π" });
        }
        let least_cosine = elementary::cos(angle) - COSINE_ROUNDING;
        Ok(Self { least_cosine, normals: FaceNormals::default() })
    }

    /// `None` of an edge without two such faces.
    fn is_greater(&mut self, mesh: &EditMesh, edge: EdgeId) -> Option<bool> {
        mesh.edge_normals(edge, &mut self.normals).map(|[one, two]| one.dot(two) < self.least_cosine)
    }
}

impl EditMesh {
    /// Keeps edges sharp in smooth shading. Given normals of the corners at their ends are cleared.
    ///
    /// # Errors
    /// None is given, or one does not exist.
    pub fn mark_sharp(&mut self, edges: &[EdgeId]) -> Result<usize, Refusal> {
        self.check_edges(edges, "marking edges sharp")?;
        Ok(self.change_sharp(edges, |_, _| Some(true)))
    }

    /// Makes shading smooth across edges again. Given normals of the corners at their ends are cleared.
    ///
    /// # Errors
    /// None is given, or one does not exist.
    pub fn clear_sharp(&mut self, edges: &[EdgeId]) -> Result<usize, Refusal> {
        self.check_edges(edges, "clearing sharp edges")?;
        Ok(self.change_sharp(edges, |_, _| Some(false)))
    }

    /// Of the edges at which exactly two faces meet in opposite directions, marks those sharp at
    /// which their normals differ by more than `angle` (radians, 0 to π), and clears the others.
    /// All other edges, and those of a face without area, are unchanged.
    ///
    /// # Errors
    /// No edge is given, one does not exist, or the angle is not within 0…π.
    pub fn mark_sharp_by_angle(&mut self, edges: &[EdgeId], angle: f64) -> Result<usize, Refusal> {
        self.check_edges(edges, "marking edges sharp by angle")?;
        let mut angles = EdgeAngles::above(angle)?;
        Ok(self.change_sharp(edges, |mesh, edge| angles.is_greater(mesh, edge)))
    }

    /// Marks edges sharp or not as a function decides; `None` leaves an edge unchanged. Returns how
    /// many changed.
    fn change_sharp(
        &mut self,
        edges: &[EdgeId],
        mut is_sharp: impl FnMut(&Self, EdgeId) -> Option<bool>,
    ) -> usize {
        let mut changed = 0;
        let mut ends = Vec::new();
        for &edge in edges {
            let Some(is_sharp) = is_sharp(self, edge).filter(|&is_sharp| is_sharp != self.is_sharp(edge))
            else {
                continue;
            };
            self.set_sharp(edge, is_sharp);
            ends.extend(self.edge_vertices(edge));
            changed += 1;
        }
        self.clear_custom_normals_at(&ends);
        changed
    }

    /// Marks edges as seams, where texture coordinates are cut.
    ///
    /// # Errors
    /// None is given, or one does not exist.
    pub fn mark_seams(&mut self, edges: &[EdgeId]) -> Result<usize, Refusal> {
        self.check_edges(edges, "marking seams")?;
        Ok(edges.iter().filter(|&&edge| self.change_seam(edge, true)).count())
    }

    /// Clears seams.
    ///
    /// # Errors
    /// None is given, or one does not exist.
    pub fn clear_seams(&mut self, edges: &[EdgeId]) -> Result<usize, Refusal> {
        self.check_edges(edges, "clearing seams")?;
        Ok(edges.iter().filter(|&&edge| self.change_seam(edge, false)).count())
    }

    /// Of the edges at which exactly two faces meet in opposite directions, makes those seams at which their normals
    /// differ by more than `angle` (radians, 0 to π), and clears the others. All other edges, and those of a face without
    /// area, are unchanged.
    ///
    /// # Errors
    /// No edge is given, one does not exist, or the angle is not within 0…π.
    pub fn mark_seams_by_angle(&mut self, edges: &[EdgeId], angle: f64) -> Result<usize, Refusal> {
        self.check_edges(edges, "marking seams by angle")?;
        let mut angles = EdgeAngles::above(angle)?;
        let mut changes = |&edge: &EdgeId| {
            angles.is_greater(self, edge).is_some_and(|is_seam| self.change_seam(edge, is_seam))
        };
        Ok(edges.iter().filter(|edge| changes(edge)).count())
    }

    /// Returns whether it was different.
    pub(super) fn change_seam(&mut self, edge: EdgeId, is_seam: bool) -> bool {
        let changes = self.is_seam(edge) != is_seam;
        if changes {
            self.set_seam(edge, is_seam);
        }
        changes
    }

    /// Sets how sharp edges stay in Catmull-Clark subdivision: 0 (smooth, clears it) to 1 (sharp).
    ///
    /// # Errors
    /// No edge is given, one does not exist, or the crease is not within 0…1.
    pub fn crease_edges(&mut self, edges: &[EdgeId], crease: f32) -> Result<usize, Refusal> {
        self.check_edges(edges, "creasing edges")?;
        if !(0.0..=1.0).contains(&crease) {
            let value = f64::from(crease);
            return Err(Refusal::OutOfRange { parameter: "the crease", value, range: "0 to 1" });
        }
        let mut changed = 0;
        for &edge in edges {
            if self.crease(edge) != crease {
                self.set_crease(edge, crease);
                changed += 1;
            }
        }
        Ok(changed)
    }

    /// Shades faces smooth: across all edges between smooth faces that are not sharp. Given normals
    /// of their corners are cleared.
    ///
    /// # Errors
    /// None is given, or one does not exist.
    pub fn shade_smooth(&mut self, faces: &[FaceId]) -> Result<usize, Refusal> {
        self.check_faces(faces, "shading faces smooth")?;
        Ok(faces.iter().filter(|&&face| self.change_smooth(face, true)).count())
    }

    /// Shades faces flat. Given normals of their corners are cleared.
    ///
    /// # Errors
    /// None is given, or one does not exist.
    pub fn shade_flat(&mut self, faces: &[FaceId]) -> Result<usize, Refusal> {
        self.check_faces(faces, "shading faces flat")?;
        Ok(faces.iter().filter(|&&face| self.change_smooth(face, false)).count())
    }

    fn change_smooth(&mut self, face: FaceId, is_smooth: bool) -> bool {
        let changes = self.is_smooth(face) != is_smooth;
        let had_normals = self.clear_custom_normals(face);
        self.set_smooth(face, is_smooth);
        changes || had_normals
    }

    /// Assigns a material slot to faces.
    ///
    /// # Errors
    /// No face is given, or one does not exist.
    pub fn assign_material(&mut self, faces: &[FaceId], material: u32) -> Result<usize, Refusal> {
        self.check_faces(faces, "assigning a material")?;
        let mut changed = 0;
        for &face in faces {
            if self.material(face) != material {
                self.set_material(face, material);
                changed += 1;
            }
        }
        Ok(changed)
    }

    pub(super) fn check_edges(&self, edges: &[EdgeId], operation: &'static str) -> Result<(), Refusal> {
        require(edges, operation, "at least one edge")?;
        edges.iter().try_for_each(|&edge| self.check_edge(edge))
    }

    pub(super) fn check_faces(&self, faces: &[FaceId], operation: &'static str) -> Result<(), Refusal> {
        require(faces, operation, "at least one face")?;
        faces.iter().try_for_each(|&face| self.check_face(face))
    }

    pub(super) fn check_vertices(
        &self,
        vertices: &[crate::ids::VertexId],
        operation: &'static str,
    ) -> Result<(), Refusal> {
        require(vertices, operation, "at least one vertex")?;
        vertices.iter().try_for_each(|&vertex| self.check_vertex(vertex))
    }
}

#[cfg(test)]
mod tests {
    use trigon_mesh::primitives;

    use super::*;

    fn cube() -> (EditMesh, Vec<EdgeId>, Vec<FaceId>) {
        let (cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        let (edges, faces) = (cube.edges().collect(), cube.faces().collect());
        (cube, edges, faces)
    }

    #[test]
    fn marks_are_set_and_cleared_and_counted() {
        let (mut cube, edges, faces) = cube();
        let twice = [edges[0], edges[1], edges[0]];
        assert_eq!(cube.mark_sharp(&twice), Ok(2), "twice is once");
        assert_eq!(cube.mark_sharp(&edges), Ok(10), "the others");
        assert_eq!(cube.clear_sharp(&twice), Ok(2), "sharp no longer");
        assert_eq!((cube.mark_seams(&twice), cube.clear_seams(&edges)), (Ok(2), Ok(2)), "seams");
        assert_eq!(
            (cube.crease_edges(&twice, 0.5), cube.crease_edges(&edges, 0.0)),
            (Ok(2), Ok(2)),
            "creases"
        );
        assert_eq!((cube.shade_smooth(&faces[..4]), cube.shade_flat(&faces)), (Ok(4), Ok(4)), "shading");
        assert_eq!(
            (cube.assign_material(&faces, 3), cube.assign_material(&faces, 3)),
            (Ok(6), Ok(0)),
            "slots"
        );
        let before = cube.clone();
        assert!(cube.crease_edges(&edges, 1.5).is_err(), "at most 1");
        assert!(cube.mark_sharp(&[]).is_err(), "nothing given");
        assert!(cube.mark_seams(&[edges[0], EdgeId(12)]).is_err(), "there are twelve");
        assert!(cube == before, "nothing was done");
    }

    #[test]
    fn an_angle_decides_which_edges_are_sharp() {
        let (mut cube, edges, _) = cube();
        assert_eq!(cube.mark_sharp_by_angle(&edges, PI / 2.0), Ok(0), "a right angle is not more than one");
        assert_eq!(cube.mark_sharp_by_angle(&edges, 1.5), Ok(12), "but more than this");
        assert_eq!(cube.mark_sharp_by_angle(&edges, PI), Ok(12), "and they are cleared again");
        assert!(cube.mark_sharp_by_angle(&edges, 4.0).is_err(), "more than half a turn");
        assert_eq!(
            cube.mark_seams_by_angle(&edges, PI / 2.0),
            Ok(0),
            "seams: a right angle is not more than one"
        );
        assert_eq!(cube.mark_seams_by_angle(&edges[2..], 1.5), Ok(10), "but more than this");
        assert_eq!(cube.mark_seams_by_angle(&edges, PI), Ok(10), "and they are cleared again");
        assert!(cube.mark_seams_by_angle(&edges, -0.1).is_err(), "less than none");
    }

    #[test]
    fn a_mark_that_changes_the_shading_clears_given_normals() {
        let mut mesh = primitives::uv_sphere(1.0, 8, 6);
        mesh.smooth_by_angle(3.0);
        let (mut sphere, _) = EditMesh::from_mesh(&mesh);
        let edge = sphere.edges().next().expect("it has edges");
        sphere.mark_sharp(&[edge]).expect("it exists");
        let ends = sphere.edge_vertices(edge);
        for corner in sphere.corners() {
            let is_at_end = ends.contains(&sphere.corner_vertex(corner));
            assert_eq!(sphere.custom_normal(corner).is_none(), is_at_end, "{corner}");
        }
        let faces: Vec<FaceId> = sphere.faces().collect();
        sphere.shade_flat(&faces).expect("they exist");
        assert!(sphere.corners().all(|corner| sphere.custom_normal(corner).is_none()), "none is given");
    }
}
