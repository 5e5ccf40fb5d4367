//! Selects which given edges and vertices can be beveled, and finds the fans of faces there.

use super::BevelLeftOut;
use super::fans::Fans;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, VertexId};

impl EditMesh {
    /// Which of some edges can be beveled, each once; the fans at their ends; and for each edge of the
    /// mesh 1 + its number among these, or 0.
    pub(super) fn beveled_edges(
        &self,
        edges: &[EdgeId],
        left_out: &mut BevelLeftOut,
    ) -> (Vec<EdgeId>, Fans, Vec<u32>) {
        // The zeros cost nothing until they are touched.
        let mut marks: Vec<u32> = vec![0; self.edge_capacity()];
        let mut chosen = Vec::with_capacity(edges.len());
        for &edge in edges {
            let mark = &mut marks[edge.0 as usize];
            if *mark == 0 && self.can_bevel(edge, left_out) {
                chosen.push(edge);
            }
            // Also of those that are left out, so that they count once.
            *mark = u32::MAX;
        }
        for &edge in edges {
            marks[edge.0 as usize] = 0;
        }
        for (number, edge) in (1..).zip(&chosen) {
            marks[edge.0 as usize] = number;
        }
        let fans = self.bevel_fans_of_edges(&chosen, &mut marks, left_out);
        chosen.retain(|edge| marks[edge.0 as usize] != 0);
        for (number, edge) in (1..).zip(&chosen) {
            marks[edge.0 as usize] = number;
        }
        (chosen, fans, marks)
    }

    /// The fans at the ends of edges, each once; unmarks edges that end at one that is not simple.
    fn bevel_fans_of_edges(&self, edges: &[EdgeId], marks: &mut [u32], left_out: &mut BevelLeftOut) -> Fans {
        let mut fans = Fans::default();
        let mut is_known = vec![[false; 2]; edges.len()];
        let mut is_unclear = vec![false; edges.len()];
        for (number, &edge) in edges.iter().enumerate() {
            for side in self.edge_corners(edge) {
                let vertex = self.corner_vertex(side);
                if is_known[number][usize::from(self.edge_vertices(edge)[0] != vertex)] {
                    continue;
                }
                let fan = fans.walk(self, side);
                for &corner in &fans.corners[fan.start..fan.end] {
                    let edge = self.corner_edge(corner);
                    if marks[edge.0 as usize] != 0 {
                        let other = marks[edge.0 as usize] as usize - 1;
                        is_known[other][usize::from(self.edge_vertices(edge)[0] != vertex)] = true;
                        is_unclear[other] |= !fan.is_simple;
                    }
                }
            }
        }
        for (edge, is_unclear) in edges.iter().zip(is_unclear) {
            if is_unclear {
                marks[edge.0 as usize] = 0;
                left_out.unclear += 1;
            }
        }
        fans
    }

    /// Whether two faces meet at an edge that wind in the same way. Otherwise it is counted.
    fn can_bevel(&self, edge: EdgeId, left_out: &mut BevelLeftOut) -> bool {
        let mut sides = self.edge_corners(edge);
        let counter = match [sides.next(), sides.next(), sides.next()] {
            [Some(a), Some(b), None] if self.corner_vertex(a) != self.corner_vertex(b) => return true,
            [Some(_), Some(_), None] => &mut left_out.opposite,
            [Some(_), Some(_), Some(_)] => &mut left_out.non_manifold,
            [Some(_), ..] => &mut left_out.borders,
            _ => &mut left_out.wires,
        };
        *counter += 1;
        false
    }

    /// The fans at vertices that can be beveled, each vertex once.
    pub(super) fn bevel_fans_of_vertices(&self, vertices: &[VertexId], left_out: &mut BevelLeftOut) -> Fans {
        let mut sorted = vertices.to_vec();
        sorted.sort_unstable();
        sorted.dedup();
        let mut fans = Fans::default();
        for vertex in sorted {
            let (corners, known) = (fans.corners.len(), fans.fans.len());
            let mut all: Vec<CornerId> = self.vertex_corners(vertex).collect();
            all.sort_unstable();
            let mut visited: Vec<bool> = vec![false; all.len()];
            for i in 0..all.len() {
                if visited[i] {
                    continue;
                }
                let fan = fans.walk(self, all[i]);
                for corner in &fans.corners[fan.start..fan.end] {
                    if let Ok(index) = all.binary_search(corner) {
                        visited[index] = true;
                    }
                }
            }
            let is_simple = fans.fans[known..].iter().all(|fan| fan.is_simple);
            if !is_simple {
                fans.corners.truncate(corners);
                fans.fans.truncate(known);
            }
            left_out.unclear += usize::from(!is_simple);
            left_out.wires += usize::from(all.is_empty());
        }
        fans
    }
}
