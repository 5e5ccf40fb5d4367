//! The editable mesh: its columns, and which slots of them are in use.
//!
//! The edges at a vertex form a ring, and so do the corners at an edge, for any number of faces (K. Weiler's radial
//! edges), so non-manifold and open meshes need no special case.

use trigon_math::{DVec3, Vec3};

use super::column::Column;
use super::group_weight::GroupName;
use super::ids::{CornerId, EdgeId, FaceId, NONE, VertexId};
use super::layers::Layer;
use super::modifier::StackedModifier;
use super::records::{ALIVE, CornerRecord, EdgeRecord, FaceRecord, Slots, VertexRecord};
use super::refusal::Refusal;

/// An editable polygon mesh: explicit vertices, edges, corners and faces with full adjacency.
///
/// Any number of faces may share an edge, edges and vertices may stand alone, and faces may be
/// open, folded or duplicated: non-manifold meshes need no special treatment. Two vertices are
/// joined by at most one edge. A face has at least three corners and
/// visits each of its vertices once: it neither touches itself nor runs along an edge and back.
///
/// An id stays valid while its element exists; a local edit takes time proportional to its
/// neighbourhood, not to the mesh. Changes within [`EditMesh::transaction`] can be undone to the
/// same bytes.
///
/// Created from a [`Mesh`](trigon_mesh::Mesh) by [`EditMesh::from_mesh`], and converted back by
/// [`EditMesh::to_mesh`].
///
/// ```
/// use trigon_mesh::primitives;
/// use trigon_modelling::EditMesh;
///
/// let (cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
/// let face = cube.faces().next().expect("a cube has six");
/// assert_eq!(cube.face_size(face), 4);
/// for edge in cube.face_edges(face) {
///     assert_eq!(cube.edge_faces(edge).count(), 2, "a cube is closed");
/// }
/// ```
///
/// Two are equal if all elements have the same ids, neighbours in the same order, and values, and
/// the same slots are free.
#[derive(Debug, Clone, PartialEq)]
pub struct EditMesh {
    pub(super) vertices: Column<VertexRecord>,
    /// In metres.
    pub(super) positions: Column<Vec3>,
    /// The original position of each vertex, to which it can be reset.
    pub(super) first_positions: Column<Vec3>,
    pub(super) edges: Column<EdgeRecord>,
    pub(super) corners: Column<CornerRecord>,
    pub(super) faces: Column<FaceRecord>,
    pub(super) vertex_layers: Vec<Layer>,
    pub(super) corner_layers: Vec<Layer>,
    pub(super) slots: AllSlots,
    /// The vertex groups; their weights are layers.
    pub(super) groups: Vec<GroupName>,
    /// What is shown and exported is the mesh after these.
    pub(super) modifiers: Vec<StackedModifier>,
    /// Whether a transaction is active.
    pub(super) is_recording: bool,
    /// How many bytes of memory an operation may let the mesh take: [`Self::MEMORY`] but within
    /// [`Self::transaction_within`], so that meshes do not differ in it.
    pub(super) memory: u64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct AllSlots {
    pub(super) vertices: Slots,
    pub(super) edges: Slots,
    pub(super) corners: Slots,
    pub(super) faces: Slots,
}

impl Default for EditMesh {
    fn default() -> Self {
        Self::new()
    }
}

impl EditMesh {
    /// An empty mesh.
    #[must_use]
    pub fn new() -> Self {
        Self {
            vertices: Column::new(Vec::new()),
            positions: Column::new(Vec::new()),
            first_positions: Column::new(Vec::new()),
            edges: Column::new(Vec::new()),
            corners: Column::new(Vec::new()),
            faces: Column::new(Vec::new()),
            vertex_layers: Vec::new(),
            corner_layers: Vec::new(),
            slots: AllSlots::default(),
            groups: Vec::new(),
            modifiers: Vec::new(),
            is_recording: false,
            memory: Self::MEMORY,
        }
    }

    /// The number of vertices.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.slots.vertices.alive as usize
    }

    /// The number of edges, including loose ones.
    #[must_use]
    pub fn edge_count(&self) -> usize {
        self.slots.edges.alive as usize
    }

    /// The number of corners of all faces.
    #[must_use]
    pub fn corner_count(&self) -> usize {
        self.slots.corners.alive as usize
    }

    /// The number of faces.
    #[must_use]
    pub fn face_count(&self) -> usize {
        self.slots.faces.alive as usize
    }

    /// An upper bound of vertex indices: the required length of a list by index.
    #[must_use]
    pub fn vertex_capacity(&self) -> usize {
        self.vertices.len() as usize
    }

    /// An upper bound of edge indices.
    #[must_use]
    pub fn edge_capacity(&self) -> usize {
        self.edges.len() as usize
    }

    /// An upper bound of corner indices.
    #[must_use]
    pub fn corner_capacity(&self) -> usize {
        self.corners.len() as usize
    }

    /// An upper bound of face indices.
    #[must_use]
    pub fn face_capacity(&self) -> usize {
        self.faces.len() as usize
    }

    /// Whether this vertex exists.
    #[must_use]
    pub fn has_vertex(&self, vertex: VertexId) -> bool {
        self.vertices.values().get(vertex.0 as usize).is_some_and(|record| record.flags & ALIVE != 0)
    }

    /// Whether this edge exists.
    #[must_use]
    pub fn has_edge(&self, edge: EdgeId) -> bool {
        self.edges.values().get(edge.0 as usize).is_some_and(|record| record.flags & ALIVE != 0)
    }

    /// Whether this corner exists.
    #[must_use]
    pub fn has_corner(&self, corner: CornerId) -> bool {
        self.corners.values().get(corner.0 as usize).is_some_and(|record| record.face != NONE)
    }

    /// Whether this face exists.
    #[must_use]
    pub fn has_face(&self, face: FaceId) -> bool {
        self.faces.values().get(face.0 as usize).is_some_and(|record| record.flags & ALIVE != 0)
    }

    /// All vertices, by index.
    pub fn vertices(&self) -> impl Iterator<Item = VertexId> + Clone + '_ {
        let alive = (0u32..).zip(self.vertices.values()).filter(|(_, record)| record.flags & ALIVE != 0);
        alive.map(|(index, _)| VertexId(index))
    }

    /// All edges, by index.
    pub fn edges(&self) -> impl Iterator<Item = EdgeId> + Clone + '_ {
        let alive = (0u32..).zip(self.edges.values()).filter(|(_, record)| record.flags & ALIVE != 0);
        alive.map(|(index, _)| EdgeId(index))
    }

    /// All corners, by index.
    pub fn corners(&self) -> impl Iterator<Item = CornerId> + Clone + '_ {
        let alive = (0u32..).zip(self.corners.values()).filter(|(_, record)| record.face != NONE);
        alive.map(|(index, _)| CornerId(index))
    }

    /// All faces, by index.
    pub fn faces(&self) -> impl Iterator<Item = FaceId> + Clone + '_ {
        let alive = (0u32..).zip(self.faces.values()).filter(|(_, record)| record.flags & ALIVE != 0);
        alive.map(|(index, _)| FaceId(index))
    }

    /// The position of a vertex, in metres. Any value is kept, even if it is not finite.
    ///
    /// # Panics
    /// The index is out of range. All functions that take an id panic in this case, unless they say
    /// otherwise; for a free slot they return unspecified values.
    #[must_use]
    pub fn position(&self, vertex: VertexId) -> Vec3 {
        self.positions[vertex.0]
    }

    /// The same in double precision, for computations.
    pub(super) fn point(&self, vertex: VertexId) -> DVec3 {
        self.positions[vertex.0].as_dvec3()
    }

    /// Moves a vertex.
    pub fn set_position(&mut self, vertex: VertexId, position: Vec3) {
        *self.positions.write(vertex.0) = position;
    }

    /// The original position of a vertex, to which it can be reset.
    #[must_use]
    pub fn first_position(&self, vertex: VertexId) -> Vec3 {
        self.first_positions[vertex.0]
    }

    /// Sets the position to which a vertex is reset.
    pub fn set_first_position(&mut self, vertex: VertexId, position: Vec3) {
        *self.first_positions.write(vertex.0) = position;
    }

    /// The memory of the mesh, in bytes, without undo records.
    pub fn bytes(&self) -> usize {
        let layers = self.vertex_layers.iter().chain(&self.corner_layers).map(Layer::bytes);
        self.vertices.bytes()
            + self.positions.bytes()
            + self.first_positions.bytes()
            + self.edges.bytes()
            + self.corners.bytes()
            + self.faces.bytes()
            + layers.sum::<usize>()
    }

    pub(super) fn check_vertex(&self, vertex: VertexId) -> Result<(), Refusal> {
        if self.has_vertex(vertex) { Ok(()) } else { Err(Refusal::NoSuchVertex(vertex)) }
    }

    pub(super) fn check_edge(&self, edge: EdgeId) -> Result<(), Refusal> {
        if self.has_edge(edge) { Ok(()) } else { Err(Refusal::NoSuchEdge(edge)) }
    }

    pub(super) fn check_face(&self, face: FaceId) -> Result<(), Refusal> {
        if self.has_face(face) { Ok(()) } else { Err(Refusal::NoSuchFace(face)) }
    }

    pub(super) fn check_corner(&self, corner: CornerId) -> Result<(), Refusal> {
        if self.has_corner(corner) { Ok(()) } else { Err(Refusal::NoSuchCorner(corner)) }
    }
}
