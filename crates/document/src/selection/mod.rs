//! The selection: objects, and within them vertices, edges or faces. Clicks and regions select one kind of
//! element, or several at once.

mod convert;
mod loops;
mod properties;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use fixedbitset::FixedBitSet;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::DVec3;
use trigon_modelling::{EdgeId, EditMesh, FaceId, VertexId};
use trigon_scene::{MeshId, NodeId};

pub use loops::{edge_loop, edge_ring, face_loop, shortest_path};
pub use properties::{
    Similarity, border_edges, faces_of_material, faces_towards, non_manifold_edges, sharp_edges, similar,
};

/// The kind of element that is selected in edit mode. The other kinds are derived from it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ElementKind {
    /// An edge or a face is selected if all its vertices are.
    #[default]
    Vertex,
    /// A vertex is selected if one of its edges is, a face if all its edges are.
    Edge,
    /// Edges and vertices are selected if one of their faces is.
    Face,
}

/// The selected objects, and the selected elements of edited meshes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Selection {
    /// Objects, in object mode.
    pub objects: BTreeSet<NodeId>,
    /// The object selected last: the one that others are joined to, and whose values are shown.
    pub active: Option<NodeId>,
    kinds: ElementKinds,
    elements: BTreeMap<MeshId, MeshSelection>,
}

/// The selected elements of one mesh, of the kind given by its [`Selection`]. In a document all of
/// them exist and none is hidden.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MeshSelection {
    /// Shared by copies until one of them changes: a history of moves stores a selection once.
    bits: Arc<FixedBitSet>,
    /// Elements that were selected individually, the last at the end; bulk selections clear it.
    order: Vec<u32>,
}

impl Selection {
    /// The kind of element that is selected; of several the first one. The others consist of elements of this
    /// kind, and are selected if all of these are.
    #[must_use]
    pub fn kind(&self) -> ElementKind {
        self.kinds.first()
    }

    /// The kinds of elements that clicks and regions select.
    #[must_use]
    pub fn kinds(&self) -> ElementKinds {
        self.kinds
    }

    /// The meshes whose elements can be selected: the edited ones.
    pub fn meshes(&self) -> impl Iterator<Item = (MeshId, &MeshSelection)> {
        self.elements.iter().map(|(&mesh, selection)| (mesh, selection))
    }

    /// The selected elements of a mesh; `None` if it is not edited.
    #[must_use]
    pub fn of(&self, mesh: MeshId) -> Option<&MeshSelection> {
        self.elements.get(&mesh)
    }

    /// The same, mutable.
    pub fn of_mut(&mut self, mesh: MeshId) -> Option<&mut MeshSelection> {
        self.elements.get_mut(&mesh)
    }

    /// Whether elements are selected rather than objects.
    #[must_use]
    pub fn is_editing(&self) -> bool {
        !self.elements.is_empty()
    }

    /// Deselects elements of a mesh that no longer exist or are hidden. Their numbers may later be reused for
    /// elements that nobody selected.
    pub(crate) fn keep_selectable(&mut self, id: MeshId, mesh: &EditMesh) {
        let kind = self.kind();
        if let Some(selection) = self.elements.get_mut(&id) {
            selection.retain(|index| kind.is_selectable(mesh, index));
        }
    }

    /// Enables selecting elements of a mesh, if it is not already.
    pub(crate) fn enter(&mut self, mesh: MeshId) {
        self.elements.entry(mesh).or_default();
    }

    /// Returns to selecting objects. The selection of elements is forgotten.
    pub(crate) fn leave(&mut self) {
        self.elements.clear();
    }

    /// Sets the kinds of elements, and converts the selection if the first of them is another one.
    pub(crate) fn set_kinds(&mut self, kinds: ElementKinds, meshes: &BTreeMap<MeshId, EditMesh>) {
        let (old, new) = (self.kind(), kinds.first());
        self.kinds = kinds;
        for (id, selection) in self.elements.iter_mut().filter(|_| old != new) {
            if let Some(mesh) = meshes.get(id) {
                selection.convert(mesh, old, new);
            }
        }
    }

    /// The approximate memory that it takes in addition to another one, in bytes: shared data is not counted.
    pub(crate) fn bytes_beside(&self, other: Option<&Self>) -> usize {
        let is_shared = |id: MeshId, selection: &MeshSelection| {
            other
                .and_then(|other| other.of(id))
                .is_some_and(|other| Arc::ptr_eq(&other.bits, &selection.bits))
        };
        let of_mesh = |(id, selection): (MeshId, &MeshSelection)| {
            let bits = if is_shared(id, selection) { 0 } else { selection.bits.len() / 8 };
            bits + selection.order.len() * 4
        };
        self.objects.len() * 16 + self.meshes().map(of_mesh).sum::<usize>()
    }
}

impl MeshSelection {
    /// Whether an element is selected, by its index.
    #[must_use]
    pub fn contains(&self, index: u32) -> bool {
        self.bits.contains(index as usize)
    }

    /// The indices of selected elements, increasing.
    pub fn indices(&self) -> impl Iterator<Item = u32> + '_ {
        self.bits.ones().map(|index| index as u32)
    }

    /// How many elements are selected.
    #[must_use]
    pub fn len(&self) -> usize {
        self.bits.count_ones(..)
    }

    /// Whether nothing is selected.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.bits.is_clear()
    }

    /// The elements that were selected individually, the last at the end.
    #[must_use]
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    /// Selects more elements individually.
    pub fn insert(&mut self, indices: &[u32]) {
        self.forget_order(indices);
        let bits = Arc::make_mut(&mut self.bits);
        for &index in indices {
            bits.grow(index as usize + 1);
            if !bits.put(index as usize) {
                self.order.push(index);
            }
        }
    }

    /// Deselects elements.
    pub fn remove(&mut self, indices: &[u32]) {
        self.forget_order(indices);
    }

    /// Removes elements from the bits and from the order.
    fn forget_order(&mut self, indices: &[u32]) {
        let bits = Arc::make_mut(&mut self.bits);
        let length = bits.len();
        for index in indices.iter().map(|&index| index as usize).filter(|&index| index < length) {
            bits.remove(index);
        }
        self.order.retain(|&index| self.bits.contains(index as usize));
    }

    /// Keeps only the selected elements for which `stays` returns true.
    fn retain(&mut self, stays: impl Fn(u32) -> bool) {
        let gone: Vec<u32> = self.indices().filter(|&index| !stays(index)).collect();
        if !gone.is_empty() {
            self.remove(&gone);
        }
    }

    /// Selects nothing.
    pub fn clear(&mut self) {
        Arc::make_mut(&mut self.bits).clear();
        self.order.clear();
    }

    /// Selects exactly these elements.
    pub fn set(&mut self, bits: FixedBitSet) {
        self.bits = Arc::new(bits);
        self.order.clear();
    }

    /// The selected elements as bits by index; there may be fewer bits than indices.
    #[must_use]
    pub fn bits(&self) -> &FixedBitSet {
        &self.bits
    }
}

impl ElementKind {
    /// Whether a mesh has an element of this kind and index that is not hidden.
    pub(crate) fn is_selectable(self, mesh: &EditMesh, index: u32) -> bool {
        let (vertex, edge, face) = (VertexId::new(index), EdgeId::new(index), FaceId::new(index));
        match self {
            Self::Vertex => mesh.has_vertex(vertex) && !mesh.is_vertex_hidden(vertex),
            Self::Edge => mesh.has_edge(edge) && !mesh.is_edge_hidden(edge),
            Self::Face => mesh.has_face(face) && !mesh.is_face_hidden(face),
        }
    }

    /// The mean of the positions of an element's vertices. The element has to exist.
    pub(crate) fn middle_of(self, mesh: &EditMesh, index: u32) -> DVec3 {
        let mean = |vertices: &mut dyn Iterator<Item = VertexId>| {
            let (sum, count) = vertices.fold((DVec3::ZERO, 0u32), |(sum, count), vertex| {
                (sum + mesh.position(vertex).as_dvec3(), count + 1)
            });
            sum / f64::from(count)
        };
        match self {
            Self::Vertex => mesh.position(VertexId::new(index)).as_dvec3(),
            Self::Edge => mean(&mut mesh.edge_vertices(EdgeId::new(index)).into_iter()),
            Self::Face => mean(&mut mesh.face_vertices(FaceId::new(index))),
        }
    }

    /// The elements of this kind that are not hidden, as bits by index.
    pub(crate) fn visible(self, mesh: &EditMesh) -> FixedBitSet {
        let all: Box<dyn Iterator<Item = u32>> = match self {
            Self::Vertex => Box::new(mesh.vertices().map(VertexId::index)),
            Self::Edge => Box::new(mesh.edges().map(EdgeId::index)),
            Self::Face => Box::new(mesh.faces().map(FaceId::index)),
        };
        bits(self.capacity(mesh), all.filter(|&index| self.is_selectable(mesh, index)))
    }

    /// The number of indices of this kind.
    pub(crate) fn capacity(self, mesh: &EditMesh) -> usize {
        match self {
            Self::Vertex => mesh.vertex_capacity(),
            Self::Edge => mesh.edge_capacity(),
            Self::Face => mesh.face_capacity(),
        }
    }
}

/// The distinct indices of a list in increasing order; `limit` is an upper bound on their number. Takes time
/// proportional to the list.
fn each_once(capacity: usize, mut indices: Vec<u32>) -> Vec<u32> {
    /// From this size on, setting and reading a bit for each possible index is faster than sorting.
    const DENSE: usize = 16;
    if indices.len() * DENSE < capacity {
        indices.sort_unstable();
        indices.dedup();
        return indices;
    }
    bits(capacity, indices.into_iter()).ones().map(|index| index as u32).collect()
}

/// Elements as bits by index.
fn bits(capacity: usize, indices: impl Iterator<Item = u32>) -> FixedBitSet {
    let mut bits = FixedBitSet::with_capacity(capacity);
    indices.for_each(|index| bits.insert(index as usize));
    bits
}

/// A set of elements of any kind of one mesh, such as those that an operation made.
#[derive(Debug, Clone, PartialEq)]
pub enum Elements {
    /// Vertices.
    Vertices(Vec<VertexId>),
    /// Edges.
    Edges(Vec<EdgeId>),
    /// Faces.
    Faces(Vec<FaceId>),
}

/// A set of kinds of elements, never empty.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ElementKinds {
    /// Whether vertices, edges and faces are in it.
    contains: [bool; 3],
}

const ALL: [ElementKind; 3] = [ElementKind::Vertex, ElementKind::Edge, ElementKind::Face];

impl ElementKinds {
    /// One kind alone.
    #[must_use]
    pub fn one(kind: ElementKind) -> Self {
        Self { contains: ALL.map(|other| other == kind) }
    }

    /// With a kind added, or removed if it is one of several.
    #[must_use]
    pub fn toggled(self, kind: ElementKind) -> Self {
        let mut contains = self.contains;
        contains[kind as usize] ^= true;
        if contains == [false; 3] { self } else { Self { contains } }
    }

    /// Whether elements of a kind are selected.
    #[must_use]
    pub fn contains(self, kind: ElementKind) -> bool {
        self.contains[kind as usize]
    }

    /// The first kind, in the order vertices, edges, faces: the others consist of elements of it.
    #[must_use]
    pub fn first(self) -> ElementKind {
        self.iter().next().expect("the set is never empty")
    }

    /// The kinds in the order vertices, edges, faces.
    pub fn iter(self) -> impl Iterator<Item = ElementKind> {
        ALL.into_iter().filter(move |&kind| self.contains(kind))
    }
}

impl Default for ElementKinds {
    fn default() -> Self {
        Self::one(ElementKind::default())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_are_added_and_removed_but_never_the_last() {
        let edges = ElementKinds::one(ElementKind::Edge);
        assert_eq!(edges.toggled(ElementKind::Edge), edges, "it is the only one");
        let both = edges.toggled(ElementKind::Vertex);
        assert_eq!((both.first(), both.iter().count()), (ElementKind::Vertex, 2), "vertices come first");
        assert!(both.contains(ElementKind::Edge) && !both.contains(ElementKind::Face), "two of three");
        assert_eq!(both.toggled(ElementKind::Vertex), edges, "as before");
        assert_eq!(ElementKinds::default().first(), ElementKind::Vertex, "in the beginning");
    }
}
