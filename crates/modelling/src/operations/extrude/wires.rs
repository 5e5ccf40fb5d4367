//! Extruding edges and vertices.

use smallvec::SmallVec;
use trigon_math::DVec3;

use super::super::delete::require;
use super::super::region::SplitVertices;
use super::check_finite;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, VertexId};
use crate::refusal::Refusal;
use crate::slots::NewElements;

/// The result of extruding edges.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct ExtrudedEdges {
    /// The quads, one for each edge, in the order of their ids.
    pub walls: Vec<FaceId>,
    /// The new edges opposite to the given ones: move these.
    pub edges: Vec<EdgeId>,
    /// The ends of the new edges.
    pub vertices: Vec<VertexId>,
}

/// The result of extruding vertices.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct ExtrudedVertices {
    /// From each given vertex to its new one.
    pub edges: Vec<EdgeId>,
    /// The new vertices: move these.
    pub vertices: Vec<VertexId>,
}

impl EditMesh {
    /// Extrudes edges to quads: loose edges, open borders, or edges between faces, which then have
    /// a fin. Edges that share a vertex share the new vertex, too.
    ///
    /// The given edges stay where they are; the new ones, with the same marks, move by the offset
    /// (metres). A quad at an open border is wound as the face there and has its material, texture
    /// coordinates and colours. Quads at wires are wound as their neighbours; those of a chain on its own
    /// from the first end of its edge with the lowest id to the second.
    ///
    /// # Errors
    /// No edge is given, or one does not exist; the offset is not finite; there would be too many
    /// elements.
    pub fn extrude_edges(&mut self, edges: &[EdgeId], offset: DVec3) -> Result<ExtrudedEdges, Refusal> {
        require(edges, "extruding edges", "at least one edge")?;
        edges.iter().try_for_each(|&edge| self.check_edge(edge))?;
        check_finite(&offset.to_array())?;
        let walls = edges.len() as u64;
        self.check_capacity_for(NewElements {
            vertices: 2 * walls,
            edges: 3 * walls,
            corners: 4 * walls,
            faces: walls,
        })?;
        let mut edges = edges.to_vec();
        edges.sort_unstable();
        edges.dedup();
        let starts = self.wall_starts(&edges);
        let mut splits = SplitVertices::new(self, 2 * edges.len());
        let mut hinges: Vec<EdgeId> = Vec::new();
        let mut extruded = ExtrudedEdges::default();
        for (&edge, &from) in edges.iter().zip(&starts) {
            let to = self.other_vertex(edge, from);
            let [(new_from, hinge_from), (new_to, hinge_to)] = [from, to].map(|vertex| {
                let new = splits.split(self, vertex);
                if hinges.len() < splits.list.len() {
                    hinges.push(self.fresh_edge(vertex, new));
                    self.set_position(new, (self.point(vertex) + offset).as_vec3());
                }
                (new, hinges[splits.index_of(vertex).expect("it was split")])
            });
            let new_edge = self.fresh_edge(new_from, new_to);
            self.copy_edge(edge, new_edge);
            let side = self.edge_corners(edge).next();
            let outline = [(from, edge), (to, hinge_to), (new_to, new_edge), (new_from, hinge_from)];
            let wall = self.face_along(&outline);
            if let Some(side) = side {
                self.dress_fin(wall, side);
            }
            extruded.walls.push(wall);
            extruded.edges.push(new_edge);
        }
        extruded.vertices = splits.list.iter().map(|split| split.base).collect();
        Ok(extruded)
    }

    /// Gives a quad that starts at an edge the values of a face there.
    fn dress_fin(&mut self, wall: FaceId, side: CornerId) {
        self.copy_face(self.corner_face(side), wall);
        let along = [side, self.next_corner(side)];
        let corners: SmallVec<[CornerId; 4]> = self.face_corners(wall).collect();
        let is_opposite = self.corner_vertex(corners[0]) != self.corner_vertex(side);
        let [from, to] = if is_opposite { [along[1], along[0]] } else { along };
        for (corner, source) in corners.into_iter().zip([from, to, to, from]) {
            self.copy_corner_upright(source, corner);
        }
    }

    /// For each of some edges, in ascending order, the end at which its wall starts, so that walls
    /// continue the faces and each other.
    pub(in crate::operations) fn wall_starts(&self, edges: &[EdgeId]) -> Vec<VertexId> {
        // Which edges meet where: pairs of a vertex and the place of an edge in the list.
        let mut ends: Vec<(VertexId, usize)> = Vec::with_capacity(2 * edges.len());
        for (index, &edge) in edges.iter().enumerate() {
            ends.extend(self.edge_vertices(edge).map(|vertex| (vertex, index)));
        }
        ends.sort_unstable();
        let mut starts: Vec<Option<VertexId>> = vec![None; edges.len()];
        let mut waiting = Vec::new();
        for (index, &edge) in edges.iter().enumerate() {
            // The face runs from the side's vertex, so the wall runs towards it.
            if let Some(side) = self.edge_corners(edge).next().filter(|_| self.is_boundary(edge)) {
                starts[index] = Some(self.other_vertex(edge, self.corner_vertex(side)));
                waiting.push(index);
            }
        }
        let walls = Walls { edges, ends: &ends };
        walls.follow(self, &mut waiting, &mut starts);
        for seed in 0..edges.len() {
            if starts[seed].is_none() {
                starts[seed] = Some(self.edge_vertices(edges[seed])[0]);
                waiting.push(seed);
                walls.follow(self, &mut waiting, &mut starts);
            }
        }
        starts.into_iter().map(|start| start.expect("each edge was a seed or met one")).collect()
    }

    /// Extrudes vertices: an edge from each to a new vertex with the same values, which moves by the
    /// offset (metres). In the order of their ids.
    ///
    /// # Errors
    /// No vertex is given, or one does not exist; the offset is not finite; there would be too many
    /// elements.
    pub fn extrude_vertices(
        &mut self,
        vertices: &[VertexId],
        offset: DVec3,
    ) -> Result<ExtrudedVertices, Refusal> {
        require(vertices, "extruding vertices", "at least one vertex")?;
        vertices.iter().try_for_each(|&vertex| self.check_vertex(vertex))?;
        check_finite(&offset.to_array())?;
        let count = vertices.len() as u64;
        self.check_capacity_for(NewElements { vertices: count, edges: count, ..NewElements::default() })?;
        let mut vertices = vertices.to_vec();
        vertices.sort_unstable();
        vertices.dedup();
        let mut extruded = ExtrudedVertices::default();
        for vertex in vertices {
            let new = self.twin_vertex(vertex);
            self.set_position(new, (self.point(vertex) + offset).as_vec3());
            extruded.edges.push(self.fresh_edge(vertex, new));
            extruded.vertices.push(new);
        }
        Ok(extruded)
    }
}

/// Edges that become walls, and where they meet.
struct Walls<'a> {
    edges: &'a [EdgeId],
    /// Vertices with the places of their edges in the list, in ascending order.
    ends: &'a [(VertexId, usize)],
}

impl Walls<'_> {
    /// From walls that are wound already to those that continue them.
    fn follow(&self, mesh: &EditMesh, waiting: &mut Vec<usize>, starts: &mut [Option<VertexId>]) {
        while let Some(index) = waiting.pop() {
            let start = starts[index].expect("only such wait");
            let end = mesh.other_vertex(self.edges[index], start);
            for (vertex, is_start) in [(start, true), (end, false)] {
                let Some(other) = self.only_other(vertex, index) else { continue };
                if starts[other].is_none() {
                    let far = mesh.other_vertex(self.edges[other], vertex);
                    starts[other] = Some(if is_start { far } else { vertex });
                    waiting.push(other);
                }
            }
        }
    }

    /// The other edge at a vertex where exactly two meet: where more do, there is no one continuation.
    fn only_other(&self, vertex: VertexId, index: usize) -> Option<usize> {
        let first = self.ends.partition_point(|&(other, _)| other < vertex);
        let mut meeting = self.ends[first..].iter().take_while(|&&(other, _)| other == vertex);
        let (a, b) = (meeting.next()?.1, meeting.next()?.1);
        let is_pair = meeting.next().is_none();
        is_pair.then_some(if a == index { b } else { a })
    }
}
