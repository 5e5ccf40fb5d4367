//! Merging vertices: those that are close to one another, or all given ones, in one place.

mod near;
#[cfg(test)]
mod tests;

use super::delete::require;
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, VertexId};
use crate::numbering::{Numbering, sorted_once};
use crate::refusal::Refusal;
use near::NearPoints;
use trigon_math::DVec3;

/// The result of merging vertices.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct MergedVertices {
    /// The remaining vertices, ascending.
    pub vertices: Vec<VertexId>,
    /// The number of removed vertices.
    pub removed: usize,
    /// The number of edges that are fewer than before: those within the merged vertices, and those that became one.
    pub removed_edges: usize,
    /// The number of faces that are fewer than before: they had no area left, or lay on another one.
    pub removed_faces: usize,
}

impl EditMesh {
    /// Merges vertices that are at most `distance` metres apart.
    ///
    /// The vertex with the lowest index wins: in the order of indices, each vertex that is not merged yet
    /// absorbs all later ones within the distance that are not merged yet, and stays in place. So no vertex
    /// moves farther than the distance, and a chain of close vertices does not collapse as a whole; two
    /// remaining vertices are always farther apart. The order in which vertices are given does not matter.
    ///
    /// Corners keep their values. A vertex whose position is not finite is close to no other. For
    /// edges and faces, see [`Self::merge_vertices`].
    ///
    /// # Errors
    /// No vertex is given, one does not exist, or the distance is negative or not finite.
    pub fn merge_by_distance(
        &mut self,
        vertices: &[VertexId],
        distance: f64,
    ) -> Result<MergedVertices, Refusal> {
        require(vertices, "merging by distance", "at least two vertices")?;
        vertices.iter().try_for_each(|&vertex| self.check_vertex(vertex))?;
        if !(distance >= 0.0 && distance.is_finite()) {
            let (parameter, range) = ("the distance", "at least 0");
            return Err(Refusal::OutOfRange { parameter, value: distance, range });
        }
        let vertices = sorted_once(vertices.to_vec());
        let mut pairs = Vec::new();
        NearPoints::new(vertices.iter().map(|&vertex| (self.position(vertex), vertex.0)))
            .for_each_cluster(distance, |target, gone| pairs.push((VertexId(gone), VertexId(target))));
        self.merge_pairs(&pairs)
    }

    /// Merges vertices into one at their mean position: the one with the lowest index, which also
    /// gets the mean of their values. Corners keep theirs.
    ///
    /// # Errors
    /// No vertex is given, or one does not exist.
    pub fn merge_at_center(&mut self, vertices: &[VertexId]) -> Result<MergedVertices, Refusal> {
        require(vertices, "merging at the center", "at least two vertices")?;
        vertices.iter().try_for_each(|&vertex| self.check_vertex(vertex))?;
        let vertices = sorted_once(vertices.to_vec());
        self.move_to_center(&vertices);
        self.merge_pairs(&all_into(&vertices, vertices[0]))
    }

    /// Merges vertices into the first of them, which stays in place.
    ///
    /// # Errors
    /// No vertex is given, or one does not exist.
    pub fn merge_at_first(&mut self, vertices: &[VertexId]) -> Result<MergedVertices, Refusal> {
        require(vertices, "merging at the first vertex", "at least two vertices")?;
        self.merge_pairs(&all_into(vertices, vertices[0]))
    }

    /// Merges vertices into the last of them, which stays in place.
    ///
    /// # Errors
    /// No vertex is given, or one does not exist.
    pub fn merge_at_last(&mut self, vertices: &[VertexId]) -> Result<MergedVertices, Refusal> {
        require(vertices, "merging at the last vertex", "at least two vertices")?;
        self.merge_pairs(&all_into(vertices, vertices[vertices.len() - 1]))
    }

    /// Merges the vertices of each connected part of some edges at their mean position, each part
    /// separately, as [`Self::merge_at_center`] does.
    ///
    /// # Errors
    /// No edge is given, or one does not exist.
    pub fn collapse_edges(&mut self, edges: &[EdgeId]) -> Result<MergedVertices, Refusal> {
        require(edges, "collapsing edges", "at least one edge")?;
        edges.iter().try_for_each(|&edge| self.check_edge(edge))?;
        let ends = edges.iter().flat_map(|&edge| self.edge_vertices(edge));
        let vertices: Vec<VertexId> = sorted_once(ends.collect());
        let mut parts = self.connected_parts(&vertices, edges);
        parts.sort_unstable();
        let mut pairs = Vec::with_capacity(parts.len());
        let mut members = Vec::new();
        for part in parts.chunk_by(|a, b| a.0 == b.0) {
            members.clear();
            members.extend(part.iter().map(|&(_, vertex)| vertex));
            self.move_to_center(&members);
            pairs.extend(all_into(&members, members[0]));
        }
        self.merge_pairs(&pairs)
    }

    /// For each of some ascending vertices the number of its part: two ends of an edge are in
    /// the same one.
    fn connected_parts(&self, vertices: &[VertexId], edges: &[EdgeId]) -> Vec<(u32, VertexId)> {
        let indices: Vec<u32> = vertices.iter().map(|vertex| vertex.0).collect();
        let numbering = Numbering::new(&indices, self.vertex_capacity());
        let mut parents: Vec<u32> = (0..vertices.len() as u32).collect();
        for &edge in edges {
            let ends = self.edge_vertices(edge).map(|vertex| numbering.get(vertex.0).expect("it is an end"));
            let [a, b] = ends.map(|index| root(&mut parents, index as u32));
            // The lower number stays: it does not depend on the order of edges.
            parents[a.max(b) as usize] = a.min(b);
        }
        let parts = (0..vertices.len() as u32).map(|index| root(&mut parents, index));
        parts.zip(vertices.iter().copied()).collect()
    }

    /// Moves the first vertex to the mean of all, with the mean of their values.
    fn move_to_center(&mut self, vertices: &[VertexId]) {
        let [first, _, ..] = *vertices else { return };
        let share = 1.0 / vertices.len() as f64;
        let sum: DVec3 = vertices.iter().map(|&vertex| self.point(vertex)).sum();
        let shares: Vec<(VertexId, f64)> = vertices.iter().map(|&vertex| (vertex, share)).collect();
        self.set_position(first, (sum * share).as_vec3());
        self.blend_vertex(&shares, first);
    }

    fn merge_pairs(&mut self, pairs: &[(VertexId, VertexId)]) -> Result<MergedVertices, Refusal> {
        let counts = |mesh: &Self| [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()];
        let before = counts(self);
        self.merge_vertices(pairs)?;
        let after = counts(self);
        // A face that comes apart where two of its vertices are merged makes more.
        let [removed, removed_edges, removed_faces] =
            std::array::from_fn(|kind| before[kind].saturating_sub(after[kind]));
        let targets = pairs.iter().filter(|(gone, target)| gone != target).map(|&(_, target)| target);
        let vertices = sorted_once(targets.collect());
        Ok(MergedVertices { vertices, removed, removed_edges, removed_faces })
    }
}

/// The pairs of a merge into one vertex.
fn all_into(vertices: &[VertexId], target: VertexId) -> Vec<(VertexId, VertexId)> {
    vertices.iter().map(|&vertex| (vertex, target)).collect()
}

/// The lowest number of a part; paths are halved on the way.
fn root(parents: &mut [u32], mut number: u32) -> u32 {
    while parents[number as usize] != number {
        parents[number as usize] = parents[parents[number as usize] as usize];
        number = parents[number as usize];
    }
    number
}
