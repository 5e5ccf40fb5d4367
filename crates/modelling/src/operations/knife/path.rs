//! Where strokes of a knife run: which edges they split, and their lines within each face.

use std::collections::BTreeMap;

use smallvec::SmallVec;
use trigon_math::Vec3;

use super::net::{FaceNet, NetParts, NetPoint};
use super::{KnifePoint, OPERATION};
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, VertexId};
use crate::operations::boolean::position_key;
use crate::refusal::Refusal;
use crate::slots::NewElements;

/// What a point of a stroke is on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Site {
    Vertex(VertexId),
    Edge(EdgeId),
    Face(FaceId),
}

/// A point of a stroke, in the position that its vertex will have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CutPoint {
    pub(super) site: Site,
    pub(super) position: Vec3,
    /// On an edge the position along it, from 0 to 1.
    pub(super) parameter: f64,
}

/// A straight line between two points.
#[derive(Debug, Clone, Copy)]
pub(super) struct CutLine {
    pub(super) ends: [CutPoint; 2],
    /// The face that it is within; `None` for the lowest that has both ends.
    pub(super) face: Option<FaceId>,
}

/// A vertex that an edge gets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct EdgeCut {
    pub(super) parameter: f64,
    pub(super) position: Vec3,
}

/// A face that lines run through.
#[derive(Debug)]
pub(super) struct CutFace {
    pub(super) face: FaceId,
    pub(super) net: NetParts,
}

/// A line along an edge.
#[derive(Debug, Clone, Copy)]
pub(super) struct LineAlong {
    pub(super) edge: EdgeId,
    pub(super) ends: [CutPoint; 2],
}

/// All that a cut does, before anything is changed.
#[derive(Debug, Default)]
pub(super) struct CutPlan {
    /// In ascending order of parameters.
    pub(super) edges: BTreeMap<EdgeId, Vec<EdgeCut>>,
    pub(super) faces: Vec<CutFace>,
    pub(super) along: Vec<LineAlong>,
    /// How many connected pieces of lines cut nothing.
    pub(super) uncut: usize,
}

impl EditMesh {
    /// Where a point of a stroke will be.
    pub(super) fn cut_point(&self, point: KnifePoint) -> Result<CutPoint, Refusal> {
        match point {
            KnifePoint::Vertex(vertex) => {
                self.check_vertex(vertex)?;
                Ok(self.cut_point_at(vertex))
            }
            KnifePoint::Edge(edge, parameter) => {
                self.check_edge(edge)?;
                if !(0.0..=1.0).contains(&parameter) {
                    let (name, range) = ("the position on the edge", "0 to 1");
                    return Err(Refusal::OutOfRange { parameter: name, value: parameter, range });
                }
                Ok(self.on_edge(edge, parameter))
            }
            KnifePoint::Face(face, position) => {
                self.check_face(face)?;
                let Some(parts) = self.mean_value_parts(face, position.as_dvec3()) else {
                    let reason = "a point within a face is on its border or outside; give it on an edge, or in its face";
                    return Err(Refusal::NotPossible { operation: OPERATION, reason });
                };
                let sum =
                    parts.iter().map(|&(corner, weight)| self.point(self.corner_vertex(corner)) * weight);
                let position = sum.sum::<trigon_math::DVec3>().as_vec3();
                Ok(CutPoint { site: Site::Face(face), position, parameter: 0.0 })
            }
        }
    }

    pub(super) fn cut_point_at(&self, vertex: VertexId) -> CutPoint {
        CutPoint { site: Site::Vertex(vertex), position: self.position(vertex), parameter: 0.0 }
    }

    /// The point of an edge, or the end that it rounds to.
    pub(super) fn on_edge(&self, edge: EdgeId, parameter: f64) -> CutPoint {
        let ends = self.edge_vertices(edge);
        let [a, b] = ends.map(|vertex| self.point(vertex));
        // As an edge is split.
        let position = (a * (1.0 - parameter) + b * parameter).as_vec3();
        let end = ends.into_iter().find(|&end| self.position(end) == position);
        let on_edge = CutPoint { site: Site::Edge(edge), position, parameter };
        end.map_or(on_edge, |end| self.cut_point_at(end))
    }

    /// What lines between points do.
    ///
    /// # Errors
    /// The ends of a line have no face in common.
    pub(super) fn plan_cut(&self, lines: &[CutLine]) -> Result<CutPlan, Refusal> {
        let mut plan = CutPlan::default();
        plan.add_edge_cuts(lines);
        let mut by_face: BTreeMap<FaceId, Vec<[CutPoint; 2]>> = BTreeMap::new();
        for &CutLine { ends, face } in
            lines.iter().filter(|line| line.ends[0].position != line.ends[1].position)
        {
            if let Some(edge) = self.edge_along(ends) {
                plan.along.push(LineAlong { edge, ends });
                continue;
            }
            let Some(face) = face.or_else(|| self.common_face(ends)) else {
                let reason = "consecutive points of a stroke have no face in common; add points between";
                return Err(Refusal::NotPossible { operation: OPERATION, reason });
            };
            by_face.entry(face).or_default().push(ends);
        }
        for (face, lines) in by_face {
            let Some(mut net) = FaceNet::new(self.outline_with(face, &plan.edges)) else {
                plan.uncut += lines.len();
                continue;
            };
            for ends in lines {
                let ends = ends.map(|end| net.point(end.position, || self.parts_within(face, end.position)));
                net.add_line(ends);
            }
            let Some(net) = net.divide() else {
                let reason = "a face would be divided into too many parts at once; cut in several steps";
                return Err(Refusal::NotPossible { operation: OPERATION, reason });
            };
            plan.uncut += net.left_out;
            plan.faces.push(CutFace { face, net });
        }
        Ok(plan)
    }

    /// The edge along which a line runs.
    pub(super) fn edge_along(&self, [from, to]: [CutPoint; 2]) -> Option<EdgeId> {
        match (from.site, to.site) {
            (Site::Vertex(a), Site::Vertex(b)) => self.find_edge(a, b),
            (Site::Edge(a), Site::Edge(b)) => (a == b).then_some(a),
            (Site::Vertex(vertex), Site::Edge(edge)) | (Site::Edge(edge), Site::Vertex(vertex)) => {
                self.edge_vertices(edge).contains(&vertex).then_some(edge)
            }
            _ => None,
        }
    }

    /// The lowest face that both ends belong to.
    fn common_face(&self, ends: [CutPoint; 2]) -> Option<FaceId> {
        let [from, to] = ends.map(|end| self.faces_at_site(end.site));
        from.into_iter().filter(|face| to.contains(face)).min()
    }

    pub(super) fn faces_at_site(&self, site: Site) -> SmallVec<[FaceId; 4]> {
        match site {
            Site::Vertex(vertex) => self.vertex_faces(vertex).collect(),
            Site::Edge(edge) => self.edge_faces(edge).collect(),
            Site::Face(face) => SmallVec::from_slice(&[face]),
        }
    }

    /// The outline of a face after its edges were split.
    fn outline_with(&self, face: FaceId, cuts: &BTreeMap<EdgeId, Vec<EdgeCut>>) -> Vec<NetPoint> {
        let mut outline = Vec::new();
        for corner in self.face_corners(face) {
            let (vertex, edge, next) =
                (self.corner_vertex(corner), self.corner_edge(corner), self.next_corner(corner));
            outline.push(NetPoint { position: self.position(vertex), parts: vec![(corner, 1.0)] });
            let first = outline.len();
            let is_forward = self.edge_vertices(edge)[0] == vertex;
            outline.extend(cuts.get(&edge).into_iter().flatten().map(|cut| {
                let share = if is_forward { cut.parameter } else { 1.0 - cut.parameter };
                NetPoint { position: cut.position, parts: vec![(corner, 1.0 - share), (next, share)] }
            }));
            if !is_forward {
                outline[first..].reverse();
            }
        }
        outline
    }

    /// What a plan adds at most, and all of it where no two lines meet in one edge.
    pub(super) fn needed_for(&self, plan: &CutPlan) -> NewElements {
        let mut needed = NewElements::default();
        for (&edge, cuts) in &plan.edges {
            let count = cuts.len() as u64;
            needed.vertices += count;
            needed.edges += count;
            needed.corners += count * self.edge_corners(edge).count() as u64;
        }
        for CutFace { net, .. } in &plan.faces {
            let inside = (net.points.len() - net.outline) as u64;
            needed.vertices += inside;
            needed.edges += net.lines as u64;
            // Each line has a corner on both sides.
            needed.corners += 2 * net.lines as u64;
            needed.faces += net.parts.len().saturating_sub(1) as u64;
        }
        needed
    }
}

impl CutPlan {
    fn add_edge_cuts(&mut self, lines: &[CutLine]) {
        for point in lines.iter().flat_map(|line| line.ends) {
            if let Site::Edge(edge) = point.site {
                let cut = EdgeCut { parameter: point.parameter, position: point.position };
                self.edges.entry(edge).or_default().push(cut);
            }
        }
        for cuts in self.edges.values_mut() {
            cuts.sort_by(|a, b| a.parameter.total_cmp(&b.parameter));
            cuts.dedup_by_key(|cut| position_key(cut.position));
        }
    }
}
