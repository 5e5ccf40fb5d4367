//! Allocates and frees slots. The slot that was freed last is reused first, so that a mesh does not grow
//! while it is edited for a long time, and the same steps give the same ids.

use trigon_math::Vec3;

use super::edit_mesh::EditMesh;
use super::ids::NONE;
use super::layers::Layer;
use super::records::{ALIVE, CornerRecord, EdgeRecord, FaceRecord, VertexRecord};
use super::refusal::Refusal;

/// An edge's record without neighbours.
fn lone_edge(vertices: [u32; 2]) -> EdgeRecord {
    EdgeRecord { vertices, next: [NONE; 2], previous: [NONE; 2], corner: NONE, crease: 0.0, flags: ALIVE }
}

/// What a corner's slot holds while it is free.
fn free_corner(next: u32) -> CornerRecord {
    CornerRecord {
        vertex: NONE,
        edge: NONE,
        face: NONE,
        next,
        previous: NONE,
        radial_next: NONE,
        radial_previous: NONE,
    }
}

/// How many elements of each kind an operation may add.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct NewElements {
    pub(super) vertices: u64,
    pub(super) edges: u64,
    pub(super) corners: u64,
    pub(super) faces: u64,
}

impl NewElements {
    pub(super) fn and(self, other: Self) -> Self {
        Self {
            vertices: self.vertices + other.vertices,
            edges: self.edges + other.edges,
            corners: self.corners + other.corners,
            faces: self.faces + other.faces,
        }
    }

    /// As many as a mesh has.
    pub(super) fn of(mesh: &EditMesh) -> Self {
        Self {
            vertices: mesh.vertex_count() as u64,
            edges: mesh.edge_count() as u64,
            corners: mesh.corner_count() as u64,
            faces: mesh.face_count() as u64,
        }
    }

    /// So many of each kind.
    pub(super) fn each(count: usize) -> Self {
        let count = count as u64;
        Self { vertices: count, edges: count, corners: count, faces: count }
    }
}

impl EditMesh {
    /// How many bytes of memory an operation may let a mesh take by default: 4 GiB, about 17 million quads. The same on
    /// every machine, so that a script has the same result; [`Self::transaction_within`] takes another limit.
    pub const MEMORY: u64 = 4 << 30;

    /// Refuses where indices could not name so many more elements, or the mesh would take more memory than is allowed.
    /// Every operation that may add many asks for all of them before it adds the first.
    pub(super) fn check_capacity_for(&self, new: NewElements) -> Result<(), Refusal> {
        let totals = [
            u64::from(self.vertices.len()) + new.vertices,
            u64::from(self.edges.len()) + new.edges,
            u64::from(self.corners.len()) + new.corners,
            u64::from(self.faces.len()) + new.faces,
        ];
        // `NONE` is no index.
        if totals.into_iter().any(|total| total >= u64::from(NONE)) {
            return Err(Refusal::TooMany);
        }
        let needed = (self.bytes() as u64).saturating_add(self.bytes_of(new));
        if needed > self.memory {
            return Err(Refusal::Memory { needed, allowed: self.memory });
        }
        Ok(())
    }

    /// The memory of elements with all their values, in bytes, without undo records.
    fn bytes_of(&self, NewElements { vertices, edges, corners, faces }: NewElements) -> u64 {
        let values = |layers: &[Layer]| layers.iter().map(Layer::bytes_of_one).sum::<u64>();
        let positions = self.positions.bytes_of_one() + self.first_positions.bytes_of_one();
        let vertex = self.vertices.bytes_of_one() + positions + values(&self.vertex_layers);
        let corner = self.corners.bytes_of_one() + values(&self.corner_layers);
        // Counts are below 2^32 here, and elements have some hundred bytes.
        vertices * vertex
            + edges * self.edges.bytes_of_one()
            + corners * corner
            + faces * self.faces.bytes_of_one()
    }

    /// A vertex without edges; its values are the usual ones.
    pub(super) fn new_vertex(&mut self, position: Vec3) -> u32 {
        let record = VertexRecord { edge: NONE, flags: ALIVE };
        let slots = &mut self.slots.vertices;
        slots.alive += 1;
        let index = slots.free;
        if index == NONE {
            let index = self.vertices.len();
            self.vertices.push(record);
            self.positions.push(position);
            self.first_positions.push(position);
            for layer in &mut self.vertex_layers {
                layer.push_default();
                layer.set_usual(index);
            }
            return index;
        }
        slots.free = self.vertices[index].edge;
        *self.vertices.write(index) = record;
        *self.positions.write(index) = position;
        *self.first_positions.write(index) = position;
        for layer in &mut self.vertex_layers {
            layer.set_usual(index);
        }
        index
    }

    pub(super) fn free_vertex(&mut self, index: u32) {
        debug_assert_eq!(self.vertices[index].edge, NONE, "its edges were removed first");
        let slots = &mut self.slots.vertices;
        *self.vertices.write(index) = VertexRecord { edge: slots.free, flags: 0 };
        slots.free = index;
        slots.alive -= 1;
    }

    /// An edge that no vertex knows yet.
    pub(super) fn new_edge(&mut self, vertices: [u32; 2]) -> u32 {
        let record = lone_edge(vertices);
        let slots = &mut self.slots.edges;
        slots.alive += 1;
        let index = slots.free;
        if index == NONE {
            self.edges.push(record);
            return self.edges.len() - 1;
        }
        slots.free = self.edges[index].next[0];
        *self.edges.write(index) = record;
        index
    }

    pub(super) fn free_edge(&mut self, index: u32) {
        let slots = &mut self.slots.edges;
        let free = EdgeRecord { next: [slots.free, NONE], flags: 0, ..lone_edge([NONE; 2]) };
        *self.edges.write(index) = free;
        slots.free = index;
        slots.alive -= 1;
    }

    /// A corner that neither its face nor its edge know yet; its values are zero.
    pub(super) fn new_corner(&mut self, vertex: u32, face: u32) -> u32 {
        let record = CornerRecord { vertex, face, ..free_corner(NONE) };
        let slots = &mut self.slots.corners;
        slots.alive += 1;
        let index = slots.free;
        if index == NONE {
            self.corners.push(record);
            self.corner_layers.iter_mut().for_each(Layer::push_default);
            return self.corners.len() - 1;
        }
        slots.free = self.corners[index].next;
        *self.corners.write(index) = record;
        for layer in &mut self.corner_layers {
            layer.clear(index);
        }
        index
    }

    pub(super) fn free_corner(&mut self, index: u32) {
        let slots = &mut self.slots.corners;
        *self.corners.write(index) = free_corner(slots.free);
        slots.free = index;
        slots.alive -= 1;
    }

    /// A face without corners.
    pub(super) fn new_face(&mut self) -> u32 {
        let record = FaceRecord { corner: NONE, size: 0, material: 0, flags: ALIVE };
        let slots = &mut self.slots.faces;
        slots.alive += 1;
        let index = slots.free;
        if index == NONE {
            self.faces.push(record);
            return self.faces.len() - 1;
        }
        slots.free = self.faces[index].corner;
        *self.faces.write(index) = record;
        index
    }

    pub(super) fn free_face(&mut self, index: u32) {
        let slots = &mut self.slots.faces;
        *self.faces.write(index) = FaceRecord { corner: slots.free, size: 0, material: 0, flags: 0 };
        slots.free = index;
        slots.alive -= 1;
    }
}
