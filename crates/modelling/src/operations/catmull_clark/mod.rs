//! Subdivision after Catmull and Clark ("Recursively generated B-spline surfaces on arbitrary
//! topological meshes", 1978), with creases after DeRose, Kass and Truong ("Subdivision surfaces
//! in character animation", 1998).
//!
//! The whole mesh changes, so each level writes complete new lists: the content of a slot follows
//! from the old mesh by a formula, without any search, and slots can be filled in any order.

mod numbers;
mod points;
mod records;
#[cfg(test)]
mod tests;
mod values;

use rayon::prelude::*;

use crate::edit_mesh::EditMesh;
use crate::refusal::Refusal;
use crate::slots::NewElements;
use numbers::Numbers;

/// The most levels at once: a quad becomes a million.
const MOST_LEVELS: u32 = 10;

impl EditMesh {
    /// Subdivides the whole mesh into a smooth surface: in each of `levels` steps a face of n
    /// corners becomes n quads.
    ///
    /// - A new vertex in a face is the mean of its corners. A new vertex on an edge is the mean of the edge's
    ///   ends and the two adjacent new face vertices. An old vertex with n edges moves to (n − 2)/n of
    ///   itself, 1/n of the mean of its neighbours and 1/n of that of the new vertices in its faces.
    /// - A crease c makes an edge sharp for 10·c² levels, as in Blender, and for all levels if it is 1. New
    ///   vertices on a sharp edge are at its midpoint. A vertex with two sharp edges moves to ¾ of itself and
    ///   ⅛ of each of their other ends; with three or more it is a corner, and stays. If sharpness ends
    ///   between two levels, the smooth and sharp rules are blended. The pieces of an edge keep the remaining
    ///   sharpness as their crease.
    /// - An edge with one face, with more than two, or with none is sharp at all levels. So borders
    ///   become curves of their own (corners of a border are rounded), and a vertex
    ///   with only one such edge stays.
    ///
    /// Texture coordinates, colours and other values of corners are interpolated linearly within each face,
    /// independent of its neighbours, as are joints and their weights. Morph targets and original positions
    /// follow the rule for positions. Pieces of edges and parts of faces keep their marks.
    ///
    /// All old ids are kept. A vertex is the same one in its new position, an edge is its first half, and a
    /// face its part at its first corner. A corner is that of the part at its vertex.
    ///
    /// # Errors
    /// There is no face, there are not 1 to 10 levels, or the mesh would have too many elements.
    pub fn catmull_clark(&mut self, levels: u32) -> Result<(), Refusal> {
        if self.face_count() == 0 {
            return Err(Refusal::NothingGiven { operation: "subdividing", needed: "at least one face" });
        }
        if !(1..=MOST_LEVELS).contains(&levels) {
            let (parameter, range) = ("the number of levels", "1 to 10");
            return Err(Refusal::OutOfRange { parameter, value: f64::from(levels), range });
        }
        self.check_capacity_for_levels(levels)?;
        for _ in 0..levels {
            self.subdivide_once();
        }
        Ok(())
    }

    /// Refuses surfaces for which there is no room: what it would have after so many levels.
    pub(crate) fn check_capacity_for_levels(&self, levels: u32) -> Result<(), Refusal> {
        let [mut vertices, mut edges, mut corners, mut faces] =
            [self.vertex_count(), self.edge_count(), self.corner_count(), self.face_count()]
                .map(|count| count as u64);
        for _ in 0..levels {
            vertices += edges + faces;
            edges = 2 * edges + corners;
            faces = corners;
            corners *= 4;
        }
        self.check_capacity_for(NewElements { vertices, edges, corners, faces })
    }

    fn subdivide_once(&mut self) {
        let numbers = Numbers::of(self);
        let vertices = fill(numbers.vertex_total(), |index| self.refined_vertex(&numbers, index));
        let edges = fill(numbers.edge_total(), |index| self.refined_edge(&numbers, index));
        let corners = fill(numbers.corner_total(), |index| self.refined_corner(&numbers, index));
        let faces = self.refined_faces(&numbers);
        self.refine_values(&numbers);
        self.slots.vertices.alive += numbers.edges.count() + numbers.faces.count();
        self.slots.edges.alive += numbers.edges.count() + numbers.corners.count();
        self.slots.faces.alive = self.slots.corners.alive;
        self.slots.corners.alive *= 4;
        self.vertices.replace(vertices);
        self.edges.replace(edges);
        self.corners.replace(corners);
        self.faces.replace(faces);
    }
}

/// A list, each value of which is known by its index.
fn fill<T: Send>(count: u32, value: impl Fn(u32) -> T + Sync + Send) -> Vec<T> {
    /// What a thread does at least: some tens of microseconds of work.
    const LEAST: usize = 4096;
    (0..count).into_par_iter().with_min_len(LEAST).map(value).collect()
}
