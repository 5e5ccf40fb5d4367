//! Insetting: faces shrink in their planes, and a ring of quads fills the gap.

mod region;
#[cfg(test)]
mod tests;

use trigon_math::DVec3;

use super::frame::FaceFrame;
use super::lift::LiftedFaces;
use super::region::Region;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, FaceId, VertexId};
use crate::refusal::Refusal;

/// Settings of an inset.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Inset {
    /// The distance of each edge from its old position, in the plane of its face, in metres: at
    /// least 0. A thickness beyond the middle of a face turns it inside out: the caller must limit
    /// it.
    pub thickness: f64,
    /// How far the inset faces move along their normals, in metres; negative is inwards.
    pub depth: f64,
    /// Whether open borders move, too; otherwise their vertices slide along them. Ignored for
    /// individual faces, which are inset from all of their edges.
    pub open_borders: bool,
}

/// The result of insetting faces. The inset faces themselves keep their ids.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct InsetFaces {
    /// The quads between the old and the new outlines of the faces.
    pub rim: Vec<FaceId>,
    /// The vertices of the inset faces: move these.
    pub vertices: Vec<VertexId>,
}

impl Inset {
    fn check(&self) -> Result<(), Refusal> {
        if !(self.thickness >= 0.0 && self.thickness.is_finite()) {
            let (parameter, range) = ("the thickness", "at least 0 and finite");
            return Err(Refusal::OutOfRange { parameter, value: self.thickness, range });
        }
        if !self.depth.is_finite() {
            let (parameter, range) = ("the depth", "finite");
            return Err(Refusal::OutOfRange { parameter, value: self.depth, range });
        }
        Ok(())
    }
}

impl EditMesh {
    /// Insets each face individually, from all of its edges.
    ///
    /// The distance of each edge from its old position is the thickness: exactly in planar faces, in others
    /// as seen along the normal. Faces keep their ids and get new vertices; all values are interpolated in
    /// the face, so that those that are affine in position stay so. A face without area gets its border, but
    /// keeps its size.
    ///
    /// # Errors
    /// No face is given, or one does not exist; a parameter is out of its range; there would be too many
    /// elements.
    pub fn inset_individual(&mut self, faces: &[FaceId], inset: Inset) -> Result<InsetFaces, Refusal> {
        let region = Region::new(self, faces, "insetting")?;
        inset.check()?;
        self.check_capacity_for_walls(region.corner_count(self))?;
        let mut lifted = LiftedFaces::default();
        let mut shape = Shape::default();
        for &face in &region.faces {
            shape.compute(self, face, inset);
            self.lift_face(face, &shape.positions, &mut lifted);
            self.interpolate_face(&shape, &lifted);
        }
        Ok(InsetFaces { rim: lifted.walls, vertices: lifted.vertices })
    }

    /// Gives the corners and vertices of a face that was just lifted their share of the old ones.
    fn interpolate_face(&mut self, shape: &Shape, lifted: &LiftedFaces) {
        let corners = &shape.frame.corners;
        let count = corners.len();
        let walls = &lifted.walls[lifted.walls.len() - count..];
        let vertices = &lifted.vertices[lifted.vertices.len() - count..];
        // The corners of the walls at the old vertices get all values first, the new ones are made of these.
        let first_of = |mesh: &Self, wall: FaceId| CornerId(mesh.faces[wall.0].corner);
        for (i, &wall) in walls.iter().enumerate() {
            let first = first_of(self, wall);
            self.copy_corner(corners[i], first);
            self.copy_corner(corners[(i + 1) % count], self.next_corner(first));
        }
        let (mut corner_parts, mut vertex_parts) = (Vec::new(), Vec::new());
        for i in 0..count {
            let weights = &shape.weights[shape.starts[i]..shape.starts[i + 1]];
            if weights.len() > 1 {
                let old = |&(part, weight): &(usize, f64)| (first_of(self, walls[part]), weight);
                corner_parts.clear();
                corner_parts.extend(weights.iter().map(old));
                vertex_parts.clear();
                vertex_parts.extend(
                    corner_parts.iter().map(|&(corner, weight)| (self.corner_vertex(corner), weight)),
                );
                self.blend_corner(&corner_parts, corners[i]);
                self.blend_vertex(&vertex_parts, vertices[i]);
            }
        }
        for (i, &wall) in walls.iter().enumerate() {
            let last = self.previous_corner(first_of(self, wall));
            self.copy_corner(corners[i], last);
            self.copy_corner(corners[(i + 1) % count], self.previous_corner(last));
        }
    }
}

/// Where the corners of a face go, and what they are made of.
#[derive(Default)]
struct Shape {
    frame: FaceFrame,
    positions: Vec<DVec3>,
    /// Numbers of corners and weights, for one corner after the other; a corner that stays has one part.
    weights: Vec<(usize, f64)>,
    /// Where the weights of each corner start, and the end of all.
    starts: Vec<usize>,
    of_one: Vec<(usize, f64)>,
}

impl Shape {
    fn compute(&mut self, mesh: &EditMesh, face: FaceId, inset: Inset) {
        let Self { frame, positions, weights, starts, of_one } = self;
        frame.load(mesh, face);
        let count = frame.positions.len();
        positions.clear();
        weights.clear();
        starts.clear();
        let mut before = frame.inward(count - 1);
        for i in 0..count {
            let after = frame.inward(i);
            let mut sides = Sides::default();
            sides.add(before);
            sides.add(after);
            before = after;
            frame.weights(i, frame.positions[i] + sides.step(inset.thickness), of_one);
            // The mixture of the places lies on the face even where that is not planar.
            let position =
                of_one.iter().fold(DVec3::ZERO, |sum, &(part, weight)| sum + frame.positions[part] * weight);
            positions.push(position + frame.normal * inset.depth);
            starts.push(weights.len());
            weights.append(of_one);
        }
        starts.push(weights.len());
    }
}

/// Edges at a vertex that all move inwards by the same distance: the sum of their directions.
#[derive(Debug, Clone, Copy, Default)]
struct Sides {
    first: DVec3,
    sum: DVec3,
    count: u32,
}

impl Sides {
    /// Adds the unit vector from an edge inwards; zero is left out.
    fn add(&mut self, inward: DVec3) {
        if inward != DVec3::ZERO {
            if self.count == 0 {
                self.first = inward;
            }
            self.sum += inward;
            self.count += 1;
        }
    }

    /// How the vertex moves: of two edges, to where both are at the distance; of more, in the mean.
    fn step(&self, distance: f64) -> DVec3 {
        /// Edges that run back along each other, to within this angle in radians, have no
        /// meeting point that is of use.
        const FOLDED: f64 = 1e-5;
        let square = self.sum.length_squared();
        let count = f64::from(self.count);
        if square > count * count * (FOLDED * FOLDED) {
            self.sum * (count * distance / square)
        } else {
            self.first * distance
        }
    }
}
