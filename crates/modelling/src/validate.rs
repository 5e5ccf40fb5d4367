//! Checks whether a mesh satisfies the rules of its structure, for tests and for debugging.

use super::edit_mesh::EditMesh;
use super::group_weight::GroupWeight;
use super::ids::{EdgeId, FaceId, NONE, VertexId};
use super::layers::{LayerKind, LayerValues};
use super::records::{ALIVE, Slots};

impl EditMesh {
    /// Checks every rule of the structure, in time proportional to the mesh.
    ///
    /// # Errors
    /// The first rule that is broken, in words. That is a fault of this crate, never of a file
    /// or a user.
    pub fn check_structure(&self) -> Result<(), String> {
        self.check_rings_of_vertices()?;
        self.check_rings_of_edges()?;
        self.faces().try_for_each(|face| self.check_outline_of_face(face))?;
        self.check_counts()?;
        self.check_layers()
    }

    /// A ring that closes visits each of its members once, so an edge that both of its vertices know is
    /// visited twice in all. To look for each edge in its rings would take quadratic time where many meet.
    fn check_rings_of_vertices(&self) -> Result<(), String> {
        let mut visits = vec![0u8; self.edge_capacity()];
        for vertex in self.vertices() {
            self.check_ring_of_vertex(vertex)?;
            self.vertex_edges(vertex).for_each(|edge| visits[edge.index() as usize] += 1);
        }
        for edge in self.edges() {
            let [a, b] = self.edge_vertices(edge);
            if a == b || !self.has_vertex(a) || !self.has_vertex(b) {
                return Err(format!("{edge} joins {a} and {b}"));
            }
            if visits[edge.index() as usize] != 2 {
                return Err(format!("{a} or {b} does not know {edge}"));
            }
        }
        Ok(())
    }

    /// The same for corners, which one edge knows.
    fn check_rings_of_edges(&self) -> Result<(), String> {
        let mut is_known = vec![false; self.corner_capacity()];
        for edge in self.edges() {
            self.check_ring_of_edge(edge)?;
            self.edge_corners(edge).for_each(|corner| is_known[corner.index() as usize] = true);
        }
        match self.corners().find(|corner| !is_known[corner.index() as usize]) {
            Some(corner) => Err(format!("{} does not know {corner}", self.corner_edge(corner))),
            None => Ok(()),
        }
    }

    fn check_ring_of_vertex(&self, vertex: VertexId) -> Result<(), String> {
        let mut neighbors = Vec::new();
        for (steps, edge) in self.vertex_edges(vertex).enumerate() {
            if !self.has_edge(edge) || !self.edge_vertices(edge).contains(&vertex) {
                return Err(format!("{vertex} knows {edge}, which does not end there"));
            }
            let end = self.edges[edge.0].end(vertex.0);
            let next = EdgeId(self.edges[edge.0].next[end]);
            let next_end = self.edges[next.0].end(vertex.0);
            if self.edges[next.0].previous[next_end] != edge.0 {
                return Err(format!("at {vertex}, {edge} comes before {next}, but not the other way round"));
            }
            if steps > self.edge_capacity() {
                return Err(format!("the ring of {vertex} does not close"));
            }
            neighbors.push(self.other_vertex(edge, vertex));
        }
        neighbors.sort_unstable();
        match neighbors.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => Err(format!("{vertex} and {} are joined by two edges", pair[0])),
            None => Ok(()),
        }
    }

    fn check_ring_of_edge(&self, edge: EdgeId) -> Result<(), String> {
        for (steps, corner) in self.edge_corners(edge).enumerate() {
            let next = self.radial_next(corner);
            if self.corner_edge(corner) != edge || !self.has_face(self.corner_face(corner)) {
                return Err(format!("{edge} knows {corner}, which does not leave along it"));
            }
            if self.corners[next.0].radial_previous != corner.0 {
                return Err(format!("at {edge}, {corner} comes before {next}, but not the other way round"));
            }
            if steps > self.corner_capacity() {
                return Err(format!("the ring of {edge} does not close"));
            }
        }
        Ok(())
    }

    fn check_outline_of_face(&self, face: FaceId) -> Result<(), String> {
        let mut vertices = Vec::new();
        for corner in self.face_corners(face) {
            let (vertex, next) = (self.corner_vertex(corner), self.next_corner(corner));
            if self.corner_face(corner) != face || self.previous_corner(next) != corner {
                return Err(format!("{corner} and {next} of {face} do not know each other"));
            }
            let edge = self.corner_edge(corner);
            let ends = self.edge_vertices(edge);
            if ends != [vertex, self.corner_vertex(next)] && ends != [self.corner_vertex(next), vertex] {
                return Err(format!("{corner} of {face} leaves along {edge}, which leads elsewhere"));
            }
            vertices.push(vertex);
            if vertices.len() > self.face_size(face) {
                return Err(format!("{face} has more corners than it says"));
            }
        }
        if vertices.len() != self.face_size(face) {
            return Err(format!("{face} has fewer corners than it says"));
        }
        vertices.sort_unstable();
        vertices.dedup();
        if vertices.len() < self.face_size(face) {
            Err(format!("{face} visits a vertex twice"))
        } else {
            Ok(())
        }
    }

    /// Elements that live and slots that are free are all that there is.
    fn check_counts(&self) -> Result<(), String> {
        let check =
            |kind: &str, slots: Slots, found: usize, capacity: usize, next: &dyn Fn(u32) -> Option<u32>| {
                let mut free = 0;
                let mut here = slots.free;
                while here != NONE {
                    here = next(here).ok_or_else(|| format!("a free {kind} is in use"))?;
                    free += 1;
                    if free > capacity {
                        return Err(format!("the list of free {kind} does not end"));
                    }
                }
                let alive = slots.alive as usize;
                if found == alive && alive + free == capacity {
                    return Ok(());
                }
                Err(format!("{found} {kind} of {alive} live, {free} are free, of {capacity}"))
            };
        let slots = &self.slots;
        check("vertices", slots.vertices, self.vertices().count(), self.vertex_capacity(), &|index| {
            let record = self.vertices[index];
            (record.flags & ALIVE == 0).then_some(record.edge)
        })?;
        check("edges", slots.edges, self.edges().count(), self.edge_capacity(), &|index| {
            let record = self.edges[index];
            (record.flags & ALIVE == 0).then_some(record.next[0])
        })?;
        check("corners", slots.corners, self.corners().count(), self.corner_capacity(), &|index| {
            let record = self.corners[index];
            (record.face == NONE).then_some(record.next)
        })?;
        check("faces", slots.faces, self.faces().count(), self.face_capacity(), &|index| {
            let record = self.faces[index];
            (record.flags & ALIVE == 0).then_some(record.corner)
        })?;
        let of_faces: usize = self.faces().map(|face| self.face_size(face)).sum();
        if of_faces == self.corner_count() { Ok(()) } else { Err("corners without a face".into()) }
    }

    fn check_layers(&self) -> Result<(), String> {
        let lengths = [self.positions.len(), self.first_positions.len()];
        let of_vertices = self.vertex_layers.iter().map(|layer| layer.len());
        if lengths.into_iter().chain(of_vertices).any(|length| length != self.vertices.len()) {
            return Err("a layer has not one value for each vertex".into());
        }
        if self.corner_layers.iter().any(|layer| layer.len() != self.corners.len()) {
            return Err("a layer has not one value for each corner".into());
        }
        self.check_groups()
    }

    /// Each group has a name and a layer of its own, and weights are in their range.
    fn check_groups(&self) -> Result<(), String> {
        for (number, group) in self.groups.iter().enumerate() {
            let others = &self.groups[..number];
            if others.iter().any(|other| other.name == group.name || other.layer == group.layer) {
                return Err("two vertex groups have the same name or layer".into());
            }
            let kind = LayerKind::Group(group.layer);
            if self.vertex_layers.iter().filter(|layer| layer.kind == kind).count() != 1 {
                return Err("a vertex group has no layer".into());
            }
        }
        for layer in &self.vertex_layers {
            let (LayerValues::Weights(column), LayerKind::Group(number)) = (&layer.values, layer.kind) else {
                continue;
            };
            let is_named = self.groups.iter().any(|group| group.layer == number);
            let is_right = |weight: GroupWeight| weight.is_valid() && (is_named || weight.get().is_none());
            if !self.vertices().all(|vertex| is_right(column[vertex.0])) {
                return Err("a weight in a vertex group is out of its range".into());
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use trigon_mesh::primitives;

    use super::*;
    use crate::ids::CornerId;

    #[test]
    fn a_broken_rule_is_found() {
        let (mesh, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        mesh.check_structure().expect("a cube keeps every rule");
        let broken = |damage: &dyn Fn(&mut EditMesh)| {
            let mut mesh = mesh.clone();
            damage(&mut mesh);
            mesh.check_structure().expect_err("the damage is found")
        };
        let corner = CornerId(0);
        broken(&|mesh| mesh.corners.write(corner.0).vertex = 7);
        broken(&|mesh| mesh.edges.write(3).corner = NONE);
        broken(&|mesh| mesh.faces.write(2).size = 5);
        broken(&|mesh| mesh.slots.vertices.alive = 9);
        broken(&|mesh| mesh.edges.write(0).next[0] = 0);
        broken(&|mesh| mesh.unlink_at_vertex(0, 1));
        broken(&|mesh| mesh.unlink_at_edge(3));
        broken(&|mesh| mesh.positions.push(trigon_math::Vec3::ZERO));
    }
}
