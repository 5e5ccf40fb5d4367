//! Extruding: elements are lifted off the mesh, and walls connect them to their old position.
//!
//! The editor extrudes without an offset and then moves the result; an extrusion that the user
//! cancels is undone as a whole, so that it leaves no duplicate vertices behind.

#[cfg(test)]
mod tests;
mod wires;

use trigon_math::DVec3;

use super::lift::LiftedFaces;
use super::region::Region;
use crate::edit_mesh::EditMesh;
use crate::ids::{FaceId, VertexId};
use crate::refusal::Refusal;

pub use wires::{ExtrudedEdges, ExtrudedVertices};

/// How far extruded faces move.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum ExtrudeOffset {
    /// Not at all: the caller moves them afterwards.
    #[default]
    Zero,
    /// Along normals, in metres: of a region each vertex along the mean of the region's normals there,
    /// weighted by angle; of individual faces each along its own. Negative is inwards. What has no
    /// normal stays.
    Along(f64),
    /// All by the same vector, in metres.
    By(DVec3),
}

/// The result of extruding faces. The extruded faces themselves keep their ids.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct ExtrudedFaces {
    /// The quads around the extruded faces.
    pub walls: Vec<FaceId>,
    /// The faces that close an extruded sheet from below.
    pub bottoms: Vec<FaceId>,
    /// The vertices of the extruded faces: move these.
    pub vertices: Vec<VertexId>,
}

impl EditMesh {
    /// Extrudes faces as regions: a quad is added at each edge where the region ends, and faces
    /// inside stay joined.
    ///
    /// The region keeps its vertices, edges, faces and corners; the rest of the mesh, and loose edges at the
    /// border, get new ones in the same positions. Walls are wound like the faces below them, with the
    /// material, texture coordinates and colours found there; they have no given normals.
    ///
    /// A part of the region that no edge joins to other faces is a sheet. Its flipped faces become its
    /// bottom, so that a plane becomes a closed box and a closed surface a hollow one. (Blender decides this
    /// for all selected faces together.) A vertex in which parts touch gets one edge to its base, as in
    /// Blender.
    ///
    /// # Errors
    /// No face is given, or one does not exist; the offset is not finite; there would be too many
    /// elements.
    ///
    /// ```
    /// use trigon_mesh::primitives;
    /// use trigon_modelling::{EditMesh, ExtrudeOffset, FaceId};
    ///
    /// let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(1.0));
    /// let extruded = cube.extrude_region(&[FaceId::new(0)], ExtrudeOffset::Along(1.0))?;
    /// assert_eq!(extruded.walls.len(), 4);
    /// assert_eq!((cube.vertex_count(), cube.edge_count(), cube.face_count()), (12, 20, 10));
    /// # Ok::<(), trigon_modelling::Refusal>(())
    /// ```
    pub fn extrude_region(
        &mut self,
        faces: &[FaceId],
        offset: ExtrudeOffset,
    ) -> Result<ExtrudedFaces, Refusal> {
        let region = Region::new(self, faces, "extruding")?;
        offset.check()?;
        let border = region.border(self);
        let sheets = region.sheets(self, &border);
        self.check_capacity_for_lift(&border, &sheets)?;
        let vertices = region.vertices(self);
        let normals = match offset {
            ExtrudeOffset::Along(_) => self.region_normals(&region, &vertices),
            _ => Vec::new(),
        };
        let lifted = self.lift_region(&region, &border, &sheets);
        match offset {
            ExtrudeOffset::Zero => {}
            ExtrudeOffset::Along(distance) => {
                for (&vertex, normal) in vertices.iter().zip(normals) {
                    self.move_by(vertex, normal.direction() * distance);
                }
            }
            ExtrudeOffset::By(by) => vertices.iter().for_each(|&vertex| self.move_by(vertex, by)),
        }
        Ok(ExtrudedFaces { walls: lifted.walls, bottoms: lifted.bottoms, vertices })
    }

    /// Extrudes each face individually: every one gets its own vertices and a quad on each of its
    /// edges.
    ///
    /// Faces keep their ids and get new vertices, so neighbours that are both extruded come apart. Walls are
    /// as those of [`Self::extrude_region`]; there are no bottoms, as in Blender.
    ///
    /// # Errors
    /// No face is given, or one does not exist; the offset is not finite; there would be too many
    /// elements.
    pub fn extrude_individual(
        &mut self,
        faces: &[FaceId],
        offset: ExtrudeOffset,
    ) -> Result<ExtrudedFaces, Refusal> {
        let region = Region::new(self, faces, "extruding")?;
        offset.check()?;
        self.check_capacity_for_walls(region.corner_count(self))?;
        let mut lifted = LiftedFaces::default();
        let mut positions = Vec::new();
        for &face in &region.faces {
            let by = match offset {
                ExtrudeOffset::Zero => DVec3::ZERO,
                ExtrudeOffset::Along(distance) => self.unit_normal(face) * distance,
                ExtrudeOffset::By(by) => by,
            };
            positions.clear();
            positions.extend(self.face_vertices(face).map(|vertex| self.point(vertex) + by));
            self.lift_face(face, &positions, &mut lifted);
            self.dress_walls(&lifted);
        }
        Ok(ExtrudedFaces { walls: lifted.walls, bottoms: Vec::new(), vertices: lifted.vertices })
    }

    fn move_by(&mut self, vertex: VertexId, by: DVec3) {
        if by != DVec3::ZERO {
            self.set_position(vertex, (self.point(vertex) + by).as_vec3());
        }
    }
}

impl ExtrudeOffset {
    fn check(self) -> Result<(), Refusal> {
        match self {
            Self::Zero => Ok(()),
            Self::Along(distance) => check_finite(&[distance]),
            Self::By(by) => check_finite(&by.to_array()),
        }
    }
}

/// Refuses offsets that are not finite.
fn check_finite(offset: &[f64]) -> Result<(), Refusal> {
    match offset.iter().find(|value| !value.is_finite()) {
        Some(&value) => Err(Refusal::OutOfRange { parameter: "the offset", value, range: "finite" }),
        None => Ok(()),
    }
}
