//! Flat subdivision: edges are cut into equal pieces, and their faces with them.

mod patterns;
#[cfg(test)]
mod tests;

use fixedbitset::FixedBitSet;

use super::delete::require;
use crate::edit_mesh::EditMesh;
use crate::euler::{Divided, PartPoint};
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::numbering::{Numbering, sorted_once};
use crate::refusal::Refusal;
use crate::slots::NewElements;
use patterns::{Interior, Outline, Pattern};
use trigon_math::{DVec3, area_vector};

/// The most cuts of an edge at once.
const MOST_CUTS: u32 = 1000;

/// The result of a subdivision.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Subdivided {
    /// The new vertices: those on edges, by edge from its first end on, then those inside faces.
    pub vertices: Vec<VertexId>,
    /// All pieces of the cut edges, including the old edges, and the new edges inside faces.
    pub edges: Vec<EdgeId>,
    /// All parts of the cut faces, including the old faces.
    pub faces: Vec<FaceId>,
}

/// Edges that were cut.
struct CutEdges {
    numbering: Numbering,
    cuts: usize,
    /// For each edge the vertices on it, from its first end on.
    vertices: Vec<VertexId>,
}

/// Memory that is used for one face after another.
#[derive(Default)]
struct SubdivisionScratch {
    corners: Vec<CornerId>,
    is_cut: Vec<bool>,
    starts: Vec<u32>,
    points: Vec<PartPoint>,
    pattern: Pattern,
    vertices: Vec<VertexId>,
}

impl EditMesh {
    /// Cuts edges into `cuts` + 1 equal pieces, and the faces at them so that no T-junctions
    /// remain. Nothing moves; all values are interpolated. How a face is cut depends on which of
    /// its sides are:
    ///
    /// | sides | cut | parts |
    /// |---|---|---|
    /// | 3 | all | (cuts + 1)² triangles, as a triangular grid |
    /// | 3 | 2 | a triangle at the common corner and a quad for each further piece |
    /// | 3 | 1 | a fan of triangles from the opposite corner |
    /// | 4 | all | (cuts + 1)² quads, as a grid |
    /// | 4 | 3 | quads between the opposite cut sides; the last strip is filled with triangles |
    /// | 4 | 2, opposite | a quad for each piece |
    /// | 4 | 2, adjacent | 2·cuts + 1 quads around new vertices on the diagonal |
    /// | 4 | 1 | triangles, and a quad in the middle where `cuts` is even |
    /// | more | 2 | strips between the two sides |
    /// | more | 3 or more | convex corners between two cut sides are cut off |
    /// | more | 1 | the face stays whole, with more corners |
    ///
    /// So does a face if one of these parts would lie on another face.
    ///
    /// The pieces of an edge have its marks, the parts of a face its material. Edge and face keep their
    /// ids as one of the parts.
    ///
    /// # Errors
    /// No edge is given, one does not exist, there are not 1 to 1000 cuts, or the mesh would have
    /// too many elements.
    pub fn subdivide(&mut self, edges: &[EdgeId], cuts: u32) -> Result<Subdivided, Refusal> {
        require(edges, "subdividing", "at least one edge")?;
        edges.iter().try_for_each(|&edge| self.check_edge(edge))?;
        if !(1..=MOST_CUTS).contains(&cuts) {
            let (parameter, range) = ("the number of cuts", "1 to 1000");
            return Err(Refusal::OutOfRange { parameter, value: f64::from(cuts), range });
        }
        let edges = sorted_once(edges.to_vec());
        let faces = self.faces_at(&edges);
        self.check_capacity_for_cuts(edges.len(), &faces, cuts)?;
        let mut made = Subdivided { edges: edges.clone(), ..Subdivided::default() };
        let cut = self.cut_edges(&edges, cuts as usize, &mut made.edges);
        made.vertices.extend_from_slice(&cut.vertices);
        let (mut scratch, mut divided) = (SubdivisionScratch::default(), Divided::default());
        for face in faces {
            self.cut_face_at(face, &cut, &mut scratch, &mut divided);
        }
        made.vertices.append(&mut scratch.vertices);
        made.edges.append(&mut divided.edges);
        made.faces = divided.faces;
        Ok(made)
    }

    /// The faces at some edges, ascending.
    fn faces_at(&self, edges: &[EdgeId]) -> Vec<FaceId> {
        let faces = edges.iter().flat_map(|&edge| self.edge_faces(edge));
        if edges.len() * 8 < self.face_capacity() {
            return sorted_once(faces.collect());
        }
        let mut found = FixedBitSet::with_capacity(self.face_capacity());
        faces.for_each(|face| found.insert(face.0 as usize));
        found.ones().map(|index| FaceId(index as u32)).collect()
    }

    /// Whether there is room for what a subdivision may add.
    fn check_capacity_for_cuts(&self, edges: usize, faces: &[FaceId], cuts: u32) -> Result<(), Refusal> {
        let (edges, cuts) = (edges as u64, u64::from(cuts));
        let (mut sides, mut small) = (0, 0);
        for &face in faces {
            sides += self.face_size(face) as u64;
            small += u64::from(self.face_size(face) <= 4);
        }
        // A quad of all whose sides are cut has the most parts. In others, each point on a side is
        // in at most four parts.
        let parts = small * (cuts + 1) * (cuts + 1);
        self.check_capacity_for(NewElements {
            vertices: edges * cuts + small * cuts * cuts,
            edges: edges * cuts + small * 2 * cuts * (cuts + 1) + sides * 2 * cuts,
            corners: parts * 4 + sides * 4 * (cuts + 1),
            faces: parts + sides * (cuts + 1),
        })
    }

    /// Puts vertices on edges; corners still leave along the first pieces afterwards. Adds the new
    /// pieces to `pieces`.
    fn cut_edges(&mut self, edges: &[EdgeId], cuts: usize, pieces: &mut Vec<EdgeId>) -> CutEdges {
        let indices: Vec<u32> = edges.iter().map(|edge| edge.0).collect();
        let numbering = Numbering::new(&indices, self.edge_capacity());
        let mut vertices = Vec::with_capacity(edges.len() * cuts);
        for &edge in edges {
            let [a, b] = self.edge_vertices(edge);
            let (from, to) = (self.point(a), self.point(b));
            self.unlink_at_vertex(edge.0, 1);
            let mut piece = edge;
            for number in 1..=cuts {
                let t = number as f64 / (cuts + 1) as f64;
                let vertex = VertexId(self.new_vertex((from * (1.0 - t) + to * t).as_vec3()));
                self.blend_vertex(&[(a, 1.0 - t), (b, t)], vertex);
                self.edges.write(piece.0).vertices[1] = vertex.0;
                self.link_at_vertex(piece.0, 1);
                piece = EdgeId(self.new_edge([vertex.0, b.0]));
                self.copy_edge(edge, piece);
                self.link_at_vertex(piece.0, 0);
                vertices.push(vertex);
                pieces.push(piece);
            }
            self.link_at_vertex(piece.0, 1);
        }
        CutEdges { numbering, cuts, vertices }
    }

    /// Divides a face at edges that were cut.
    fn cut_face_at(
        &mut self,
        face: FaceId,
        cut: &CutEdges,
        scratch: &mut SubdivisionScratch,
        divided: &mut Divided,
    ) {
        self.gather_points(face, cut, scratch);
        let SubdivisionScratch { corners, is_cut, starts, points, pattern, vertices } = scratch;
        let outline = Outline { is_cut, starts, cuts: cut.cuts, count: points.len() as u32 };
        pattern.choose(&outline, |corner| self.is_convex_at(corners, corner));
        // Triangles with such parts lie on each other already.
        if pattern.parts.len() > 1 && corners.len() > 3 {
            let is_doubled = |outline: &[u32]| {
                let vertices: Option<Vec<VertexId>> = outline
                    .iter()
                    .map(|&index| points.get(index as usize).map(|point| point.vertex))
                    .collect();
                vertices.is_some_and(|vertices| self.face_over(&vertices, |_| false).is_some())
            };
            if pattern.parts.iter().any(is_doubled) {
                pattern.keep_whole(&outline);
            }
        }
        for interior in &pattern.interior {
            let point = self.interior_point(face, corners, interior);
            vertices.push(point.vertex);
            points.push(point);
        }
        self.divide_face(face, points, &pattern.parts, divided);
    }

    /// The points on the outline of a face: its corners and the new vertices on its sides.
    fn gather_points(&mut self, face: FaceId, cut: &CutEdges, scratch: &mut SubdivisionScratch) {
        let SubdivisionScratch { corners, is_cut, starts, points, .. } = scratch;
        corners.clear();
        corners.extend(self.face_corners(face));
        is_cut.clear();
        starts.clear();
        points.clear();
        for (i, &corner) in corners.iter().enumerate() {
            let vertex = self.corner_vertex(corner);
            starts.push(points.len() as u32);
            points.push(PartPoint { vertex, corner, is_taken: false });
            let edge = self.corner_edge(corner).0;
            let index = cut.numbering.get(edge);
            is_cut.push(index.is_some());
            let Some(index) = index else { continue };
            let on_edge = &cut.vertices[index * cut.cuts..][..cut.cuts];
            let is_forward = self.edges[edge].vertices[0] == vertex.0;
            let next = corners[if i + 1 == corners.len() { 0 } else { i + 1 }];
            for number in 0..cut.cuts {
                let vertex = on_edge[if is_forward { number } else { cut.cuts - 1 - number }];
                let t = (number + 1) as f64 / (cut.cuts + 1) as f64;
                let new = CornerId(self.new_corner(vertex.0, face.0));
                self.blend_corner(&[(corner, 1.0 - t), (next, t)], new);
                points.push(PartPoint { vertex, corner: new, is_taken: false });
            }
        }
    }

    /// A new vertex within a face, with a corner of the face there.
    fn interior_point(&mut self, face: FaceId, corners: &[CornerId], interior: &Interior) -> PartPoint {
        let mut shares = [(corners[0], 0.0); 4];
        let mut vertex_shares = [(VertexId(0), 0.0); 4];
        let mut position = DVec3::ZERO;
        for (i, &(corner, weight)) in interior.iter().enumerate() {
            let (corner, vertex) = (corners[corner], self.corner_vertex(corners[corner]));
            shares[i] = (corner, weight);
            vertex_shares[i] = (vertex, weight);
            position += self.point(vertex) * weight;
        }
        let vertex = VertexId(self.new_vertex(position.as_vec3()));
        self.blend_vertex(&vertex_shares[..interior.len()], vertex);
        let corner = CornerId(self.new_corner(vertex.0, face.0));
        self.blend_corner(&shares[..interior.len()], corner);
        PartPoint { vertex, corner, is_taken: false }
    }

    /// Whether a face, given by its corners, turns left at one of them.
    fn is_convex_at(&self, corners: &[CornerId], corner: usize) -> bool {
        let point = |i: usize| self.point(self.corner_vertex(corners[i % corners.len()]));
        let (before, here, after) = (point(corner + corners.len() - 1), point(corner), point(corner + 1));
        let normal = area_vector((0..corners.len()).map(point));
        (here - before).cross(after - here).dot(normal) > 0.0
    }
}
