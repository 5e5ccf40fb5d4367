//! Positions of vertices after a level.

use trigon_math::{DVec3, Vec3};

use super::fill;
use super::numbers::Numbers;
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, VertexId};
use crate::records::ALIVE;

/// For how many levels an edge stays sharp: Blender's measure.
pub(super) fn sharpness(crease: f32) -> f64 {
    /// Of the largest crease that ends.
    const LEVELS: f64 = 10.0;
    if crease >= 1.0 { f64::INFINITY } else { LEVELS * f64::from(crease) * f64::from(crease) }
}

/// The crease of an edge's halves.
pub(super) fn crease_after(crease: f32) -> f32 {
    let left = sharpness(crease) - 1.0;
    if left == f64::INFINITY { 1.0 } else { (left.max(0.0) / 10.0).sqrt() as f32 }
}

/// What is sharp at a vertex.
#[derive(Debug, Clone, Copy, Default)]
struct SharpEdges {
    count: usize,
    /// The sum of the other ends of the first two.
    ends: DVec3,
}

/// Which rule moves a vertex, by how many sharp edges it has.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Rule {
    Smooth,
    Crease,
    Corner,
}

impl SharpEdges {
    fn add(&mut self, end: DVec3) {
        self.count += 1;
        if self.count <= 2 {
            self.ends += end;
        }
    }

    fn rule(&self) -> Rule {
        match self.count {
            0 | 1 => Rule::Smooth,
            2 => Rule::Crease,
            _ => Rule::Corner,
        }
    }
}

impl EditMesh {
    /// The rules for positions, applied to any values of vertices that are linear in them.
    pub(super) fn refined_points(&self, numbers: &Numbers, old: &[Vec3]) -> Vec<Vec3> {
        let in_faces = fill(numbers.faces.count(), |rank| {
            let face = FaceId(numbers.faces.index(rank));
            let sum: DVec3 = self.face_vertices(face).map(|vertex| old[vertex.0 as usize].as_dvec3()).sum();
            sum / self.face_size(face) as f64
        });
        let in_face = |corner: u32| in_faces[numbers.faces.rank(self.corners[corner].face) as usize];
        fill(numbers.vertex_total(), |index| {
            if index < numbers.vertices {
                let is_alive = self.vertices[index].flags & ALIVE != 0;
                let moved = if is_alive { self.moved_vertex(VertexId(index), old, in_face) } else { None };
                return moved.map_or(old[index as usize], |point| point.as_vec3());
            }
            let number = index - numbers.vertices;
            if number < numbers.edges.count() {
                self.edge_point(EdgeId(numbers.edges.index(number)), old, in_face).as_vec3()
            } else {
                in_faces[(number - numbers.edges.count()) as usize].as_vec3()
            }
        })
    }

    fn edge_point(&self, edge: EdgeId, old: &[Vec3], in_face: impl Fn(u32) -> DVec3) -> DVec3 {
        let ends = self.edge_vertices(edge).map(|vertex| old[vertex.0 as usize].as_dvec3());
        let middle = (ends[0] + ends[1]) * 0.5;
        let sharpness = sharpness(self.edges[edge.0].crease);
        match self.edge_pair(edge) {
            Some([one, two]) if sharpness < 1.0 => {
                let smooth = (ends[0] + ends[1] + in_face(one.0) + in_face(two.0)) * 0.25;
                if sharpness > 0.0 { middle * sharpness + smooth * (1.0 - sharpness) } else { smooth }
            }
            _ => middle,
        }
    }

    /// Where an old vertex goes; `None` if it stays.
    fn moved_vertex(&self, vertex: VertexId, old: &[Vec3], in_face: impl Fn(u32) -> DVec3) -> Option<DVec3> {
        let here = old[vertex.0 as usize].as_dvec3();
        let (mut neighbors, mut faces, mut count) = (DVec3::ZERO, DVec3::ZERO, 0usize);
        // Now and at the next level. Of those that are sharp now and not then, the sum and number.
        let (mut sharp, mut stays_sharp) = (SharpEdges::default(), SharpEdges::default());
        let (mut ending, mut endings, mut is_whole) = (0.0, 0u32, true);
        for edge in self.vertex_edges(vertex) {
            let end = old[self.other_vertex(edge, vertex).0 as usize].as_dvec3();
            count += 1;
            neighbors += end;
            let mut sides = 0;
            for corner in self.edge_corners(edge) {
                sides += 1;
                if self.corner_vertex(corner) == vertex {
                    faces += in_face(corner.0);
                }
            }
            is_whole &= sides == 2;
            let s = if sides == 2 { sharpness(self.edges[edge.0].crease) } else { f64::INFINITY };
            if s > 0.0 {
                sharp.add(end);
                if s > 1.0 {
                    stays_sharp.add(end);
                } else {
                    ending += s;
                    endings += 1;
                }
            }
        }
        // A single edge that has not two faces holds its end.
        let is_smooth = is_whole && count > 1;
        let point_by_rule = |edges: SharpEdges| match edges.rule() {
            Rule::Smooth if is_smooth => {
                let n = count as f64;
                here * ((n - 2.0) / n) + (neighbors + faces) / (n * n)
            }
            Rule::Crease => here * 0.75 + edges.ends * 0.125,
            Rule::Smooth | Rule::Corner => here,
        };
        if sharp.rule() == stays_sharp.rule() {
            let stays = match sharp.rule() {
                Rule::Smooth => !is_smooth,
                Rule::Crease => false,
                Rule::Corner => true,
            };
            // Its bytes, too, also where the place is not finite.
            return (!stays).then(|| point_by_rule(sharp));
        }
        let share = ending / f64::from(endings);
        Some(point_by_rule(sharp) * share + point_by_rule(stays_sharp) * (1.0 - share))
    }
}
