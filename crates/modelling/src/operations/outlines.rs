//! Loops and chains of edges, for filling and bridging.

use smallvec::SmallVec;

use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, VertexId};
use crate::numbering::sorted_once;
use crate::refusal::Refusal;

/// Connected edges in order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Chain {
    /// In order; the first is not repeated in a closed one.
    pub(super) vertices: Vec<VertexId>,
    pub(super) is_closed: bool,
}

impl Chain {
    /// Each vertex and the next one.
    pub(super) fn steps(&self) -> impl Iterator<Item = (VertexId, VertexId)> + '_ {
        let closing = if self.is_closed { self.vertices.first() } else { None };
        let next = self.vertices.iter().skip(1).chain(closing);
        self.vertices.iter().copied().zip(next.copied())
    }
}

impl EditMesh {
    /// The connected parts of some edges: open chains first, then loops, each kind by its lowest
    /// end or vertex.
    ///
    /// # Errors
    /// More than two of the edges meet in a vertex, or one does not exist.
    pub(super) fn chains(&self, edges: &[EdgeId], operation: &'static str) -> Result<Vec<Chain>, Refusal> {
        edges.iter().try_for_each(|&edge| self.check_edge(edge))?;
        let edges = sorted_once(edges.to_vec());
        let vertices = sorted_once(edges.iter().flat_map(|&edge| self.edge_vertices(edge)).collect());
        let index_of = |vertex: VertexId| vertices.binary_search(&vertex).expect("it is an end");
        let mut links: Vec<SmallVec<[usize; 2]>> = vec![SmallVec::new(); vertices.len()];
        for &edge in &edges {
            let [a, b] = self.edge_vertices(edge).map(index_of);
            links[a].push(b);
            links[b].push(a);
        }
        if links.iter().any(|links| links.len() > 2) {
            let reason = "at most two of the edges may meet in a vertex: select single loops";
            return Err(Refusal::NotPossible { operation, reason });
        }
        let mut is_walked = vec![false; vertices.len()];
        let mut chains = Vec::new();
        // Open chains from one of their ends; what is left are loops.
        let ends = (0..vertices.len()).filter(|&start| links[start].len() == 1);
        for start in ends.chain(0..vertices.len()) {
            if is_walked[start] {
                continue;
            }
            let mut walked = vec![start];
            is_walked[start] = true;
            let mut here = start;
            while let Some(&next) = links[here].iter().find(|&&next| !is_walked[next]) {
                is_walked[next] = true;
                walked.push(next);
                here = next;
            }
            chains.push(Chain {
                vertices: walked.into_iter().map(|index| vertices[index]).collect(),
                is_closed: links[start].len() == 2,
            });
        }
        Ok(chains)
    }

    /// How many more sides of faces run against the direction of some steps than with it: positive
    /// if a new face must run along them to be wound like its neighbours.
    pub(super) fn winding_votes(&self, steps: impl Iterator<Item = (VertexId, VertexId)>) -> i64 {
        let mut votes = 0;
        for (from, to) in steps {
            let corners = self.find_edge(from, to).into_iter().flat_map(|edge| self.edge_corners(edge));
            votes +=
                corners.map(|corner| if self.corner_vertex(corner) == from { -1 } else { 1 }).sum::<i64>();
        }
        votes
    }

    /// For each vertex of a chain a corner there of an adjacent face, whose values a new face
    /// takes.
    pub(super) fn corners_beside(&self, chain: &Chain) -> Vec<Option<CornerId>> {
        let mut corners = vec![None; chain.vertices.len()];
        let count = corners.len();
        for (i, (from, to)) in chain.steps().enumerate() {
            let Some(corner) = self.find_edge(from, to).and_then(|edge| self.edge_corners(edge).next())
            else {
                continue;
            };
            let ends = [corner, self.next_corner(corner)];
            for (index, vertex) in [(i, from), ((i + 1) % count, to)] {
                let at_vertex = ends.into_iter().find(|&end| self.corner_vertex(end) == vertex);
                corners[index] = corners[index].or(at_vertex);
            }
        }
        corners
    }
}
