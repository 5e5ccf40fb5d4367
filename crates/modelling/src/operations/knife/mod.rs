//! The knife: cuts faces along strokes.
//!
//! `path` finds the edges that strokes split and the lines within each face; `net` finds the parts into which these
//! divide the face; `divide` makes them. All is known before anything is changed.

mod divide;
mod in_view;
mod intersect;
mod line;
mod net;
#[cfg(test)]
mod others_tests;
mod path;
mod project;
#[cfg(test)]
mod tests;
mod through;

use std::collections::HashMap;

use super::boolean::position_key;
use super::delete::require;
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, VertexId};
use crate::numbering::sorted_once;
use crate::refusal::Refusal;
pub use intersect::IntersectWith;
pub use line::ProjectedLine;
use path::{CutFace, CutLine, CutPlan, CutPoint, LineAlong, Site};
pub use project::KnifeProjection;
pub use through::Sight;
use trigon_math::Vec3;

const OPERATION: &str = "a knife cut";

/// A point of a stroke of [`EditMesh::knife`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum KnifePoint {
    /// At a vertex.
    Vertex(VertexId),
    /// On an edge, at a part of the way from its first vertex to its second: 0 to 1.
    Edge(EdgeId, f64),
    /// Within a face, near this position: it is moved along the face's normal onto the face.
    Face(FaceId, Vec3),
}

/// What [`EditMesh::knife`] made.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct KnifeCut {
    /// The edges of the cut, in ascending order; those that were there already, too, and not those that join a
    /// closed cut to the outline of its face.
    pub edges: Vec<EdgeId>,
    /// The vertex of each point of the strokes, one stroke after the other; `None` within a face where nothing is cut.
    pub vertices: Vec<Option<VertexId>>,
    /// The new faces. Cut faces keep their ids for one of their parts.
    pub faces: Vec<FaceId>,
    /// How many connected pieces of the strokes cut nothing: they end within a face, leave it, or run through a face that
    /// crosses itself as it is seen.
    pub uncut: usize,
}

impl EditMesh {
    /// Cuts faces along strokes: paths of points on edges, at vertices and within faces. Edges are
    /// split where strokes cross them, faces where strokes go through them.
    ///
    /// - Consecutive points belong to the same face. If several faces have both, the one with the lowest index
    ///   is cut; between two points of the same edge nothing is cut.
    /// - A stroke that ends in its first point is closed. A face that it does not leave is divided into what is inside,
    ///   and the ring around it. As faces have no holes, the shortest two lines that cross nothing join the cut to the
    ///   outline: the ring becomes two faces.
    /// - Where lines cross, of one stroke or of several, they get a vertex.
    /// - A piece that ends within a face divides nothing and is left out, as is a line that leaves its face, or runs
    ///   through a face that crosses itself as seen along the axis along which it is seen largest. They are counted.
    /// - Values are interpolated: on edges along them, within faces by mean value coordinates (Floater, "Mean value
    ///   coordinates", 2003), which are exact for values that are affine in position.
    ///
    /// What is cut is decided without rounding. All parts are simple polygons.
    ///
    /// Unlike in Blender's tool, the points are given; [`EditMesh::knife_line`] determines where a line that is seen from a
    /// camera meets edges, and [`EditMesh::knife_through`] what it cuts through.
    ///
    /// # Errors
    /// No stroke is given, or one has fewer than two points; an element does not exist; a position on an edge is not
    /// within 0…1; consecutive points have no face in common; nothing at all is cut; there would be too many elements.
    pub fn knife(&mut self, strokes: &[Vec<KnifePoint>]) -> Result<KnifeCut, Refusal> {
        require(strokes, OPERATION, "a stroke of at least two points")?;
        let (mut points, mut lines) = (Vec::new(), Vec::new());
        for stroke in strokes {
            require(stroke.get(1..).unwrap_or_default(), OPERATION, "strokes of at least two points")?;
            let first = points.len();
            for &point in stroke {
                points.push(self.cut_point(point)?);
            }
            let pairs = points[first..].windows(2);
            lines.extend(pairs.map(|pair| CutLine { ends: [pair[0], pair[1]], face: None }));
        }
        self.cut_lines(&lines, &points)
    }

    /// Cuts along lines. The vertices are those of some of their ends.
    fn cut_lines(&mut self, lines: &[CutLine], points: &[CutPoint]) -> Result<KnifeCut, Refusal> {
        let plan = self.plan_cut(lines)?;
        self.check_capacity_for(self.needed_for(&plan))?;
        self.whole(|mesh| {
            let cut = mesh.carry_out(&plan, points)?;
            if cut.edges.is_empty() {
                let reason = "the strokes divide no face: each goes from edge to edge, or closes";
                return Err(Refusal::NotPossible { operation: OPERATION, reason });
            }
            Ok(cut)
        })
    }

    fn carry_out(&mut self, plan: &CutPlan, points: &[CutPoint]) -> Result<KnifeCut, Refusal> {
        let mut cut = KnifeCut { uncut: plan.uncut, ..KnifeCut::default() };
        // The vertices of edges, from one end to the other.
        let mut rows: HashMap<EdgeId, Vec<VertexId>> = HashMap::new();
        for (&edge, cuts) in &plan.edges {
            let [first, last] = self.edge_vertices(edge);
            let parameters: Vec<f64> = cuts.iter().map(|cut| cut.parameter).collect();
            let made = self.cut_rung(edge, first, &parameters)?;
            rows.insert(edge, [first].into_iter().chain(made).chain([last]).collect());
        }
        let mut inside: HashMap<(FaceId, [u32; 3]), VertexId> = HashMap::new();
        for CutFace { face, net } in &plan.faces {
            let (vertices, faces) = self.divide_by_net(*face, net)?;
            let ends = net.cuts.iter().map(|line| line.map(|point| vertices[point as usize]));
            cut.edges.extend(ends.filter_map(|[a, b]| self.find_edge(a, b)));
            cut.faces.extend(&faces[1..]);
            let within = net.points.iter().zip(&vertices).skip(net.outline);
            inside.extend(within.map(|(point, &vertex)| ((*face, position_key(point.position)), vertex)));
        }
        let vertex_of = |mesh: &Self, point: &CutPoint| match point.site {
            Site::Vertex(vertex) => Some(vertex),
            Site::Edge(edge) => {
                rows.get(&edge)?.iter().copied().find(|&vertex| mesh.position(vertex) == point.position)
            }
            Site::Face(face) => inside.get(&(face, position_key(point.position))).copied(),
        };
        for LineAlong { edge, ends } in &plan.along {
            let row = rows.get(edge).cloned().unwrap_or_else(|| self.edge_vertices(*edge).to_vec());
            let index = |end: &CutPoint| row.iter().position(|&vertex| vertex_of(self, end) == Some(vertex));
            let [Some(from), Some(to)] = ends.each_ref().map(index) else { continue };
            let steps = row[from.min(to)..=from.max(to)].windows(2);
            cut.edges.extend(steps.filter_map(|pair| self.find_edge(pair[0], pair[1])));
        }
        cut.edges = sorted_once(cut.edges);
        cut.faces.sort_unstable();
        cut.vertices = points.iter().map(|point| vertex_of(self, point)).collect();
        Ok(cut)
    }
}
