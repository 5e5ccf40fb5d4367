//! Transactions: changes that happen as a whole or not at all, and that can be undone to the same bytes.
//!
//! A column saves the old value of an entry when the entry is written for the first time. As soon as a copy of the
//! whole old column would be smaller, the column keeps such a copy instead.

use trigon_math::Vec3;

use super::column::ColumnDifference;
use super::edit_mesh::{AllSlots, EditMesh};
use super::group_weight::GroupName;
use super::ids::VertexId;
use super::layers::{Layer, LayerDifference};
use super::modifier::StackedModifier;
use super::records::{CornerRecord, EdgeRecord, FaceRecord, VertexRecord};
use super::refusal::Refusal;

/// What leads from a mesh to its state before or after a change.
///
/// It keeps the values that differ, or whole lists where these take less memory. [`Difference::apply`] goes
/// to the other state and turns the difference around. So one difference serves to undo and to redo, any
/// number of times.
#[derive(Debug, Clone)]
#[must_use = "without it the change cannot be undone"]
pub struct Difference {
    pub(super) vertices: Option<ColumnDifference<VertexRecord>>,
    pub(super) positions: Option<ColumnDifference<Vec3>>,
    first_positions: Option<ColumnDifference<Vec3>>,
    pub(super) edges: Option<ColumnDifference<EdgeRecord>>,
    pub(super) corners: Option<ColumnDifference<CornerRecord>>,
    pub(super) faces: Option<ColumnDifference<FaceRecord>>,
    pub(super) vertex_layers: LayersDifference,
    pub(super) corner_layers: LayersDifference,
    pub(super) slots: AllSlots,
    /// The modifiers of the other state, if they differ.
    modifiers: Option<Vec<StackedModifier>>,
    /// The vertex groups of the other state, if their names differ.
    groups: Option<Vec<GroupName>>,
}

/// Of the layers of one kind of element. A change may add layers after the others.
#[derive(Debug, Clone)]
pub(super) struct LayersDifference {
    pub(super) common: Vec<LayerDifference>,
    /// Those that the state without them has not.
    pub(super) added: Vec<Layer>,
    /// Whether there are any, although they are with the mesh.
    adds_any: bool,
}

impl EditMesh {
    /// Runs a change. If it is refused, the mesh is as it was before, to the last byte.
    /// Otherwise what it returns, and what undoes it.
    ///
    /// A transaction within another belongs to the outer one; so operations may be
    /// used within operations. Its own difference is empty then, and a refusal within is only
    /// taken back when the outer one is refused, too: pass it on.
    ///
    /// # Errors
    /// The errors of the change.
    ///
    /// ```
    /// use trigon_mesh::math::Vec3;
    /// use trigon_modelling::{EditMesh, Refusal};
    ///
    /// let mut mesh = EditMesh::new();
    /// let (vertex, mut difference) = mesh.transaction(|mesh| Ok::<_, Refusal>(mesh.add_vertex(Vec3::X)?))?;
    /// difference.apply(&mut mesh);
    /// assert!(!mesh.has_vertex(vertex), "undone");
    /// difference.apply(&mut mesh);
    /// assert_eq!(mesh.position(vertex), Vec3::X, "and done again");
    /// # Ok::<(), Refusal>(())
    /// ```
    pub fn transaction<T, E>(
        &mut self,
        change: impl FnOnce(&mut Self) -> Result<T, E>,
    ) -> Result<(T, Difference), E> {
        if self.is_recording {
            let slots = self.slots;
            return change(self).map(|result| (result, Difference::none(slots)));
        }
        let recording = Recording::begin(self);
        let result = change(self);
        let mut difference = recording.finish(self);
        match result {
            Ok(result) => Ok((result, difference)),
            Err(refusal) => {
                difference.apply(self);
                Err(refusal)
            }
        }
    }

    /// The same with another limit than [`Self::MEMORY`] for the bytes of memory that an operation may let the mesh
    /// take. Within another transaction its limit stays.
    ///
    /// # Errors
    /// The errors of the change; among them [`Refusal::Memory`], before anything is allocated.
    ///
    /// ```
    /// use trigon_mesh::primitives;
    /// use trigon_modelling::{EditMesh, Refusal};
    ///
    /// let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    /// let refusal = cube.transaction_within(1 << 20, |mesh| mesh.catmull_clark(6)).expect_err("one MiB");
    /// assert!(matches!(refusal, Refusal::Memory { allowed: 0x10_0000, .. }), "{refusal}");
    /// ```
    pub fn transaction_within<T, E>(
        &mut self,
        memory: u64,
        change: impl FnOnce(&mut Self) -> Result<T, E>,
    ) -> Result<(T, Difference), E> {
        let before =
            if self.is_recording { self.memory } else { std::mem::replace(&mut self.memory, memory) };
        let result = self.transaction(change);
        self.memory = before;
        result
    }

    /// Runs an operation that may be refused half way: then the mesh is as it was before.
    /// Within a transaction it belongs to that.
    pub(super) fn whole<T>(
        &mut self,
        operation: impl FnOnce(&mut Self) -> Result<T, Refusal>,
    ) -> Result<T, Refusal> {
        // What undoes it is not wanted here.
        self.transaction(operation).map(|(result, _)| result)
    }
}

/// A transaction that runs.
struct Recording {
    slots: AllSlots,
    modifiers: Vec<StackedModifier>,
    groups: Vec<GroupName>,
    vertex_layers: usize,
    corner_layers: usize,
}

impl Recording {
    fn begin(mesh: &mut EditMesh) -> Self {
        mesh.is_recording = true;
        mesh.vertices.begin();
        mesh.positions.begin();
        mesh.first_positions.begin();
        mesh.edges.begin();
        mesh.corners.begin();
        mesh.faces.begin();
        mesh.vertex_layers.iter_mut().for_each(Layer::begin);
        mesh.corner_layers.iter_mut().for_each(Layer::begin);
        let (vertex_layers, corner_layers) = (mesh.vertex_layers.len(), mesh.corner_layers.len());
        let (modifiers, groups) = (mesh.modifiers.clone(), mesh.groups.clone());
        Self { slots: mesh.slots, modifiers, groups, vertex_layers, corner_layers }
    }

    fn finish(self, mesh: &mut EditMesh) -> Difference {
        mesh.is_recording = false;
        let layers = |layers: &mut [Layer], common: usize| LayersDifference {
            common: layers[..common].iter_mut().map(Layer::finish).collect(),
            added: Vec::new(),
            adds_any: layers.len() > common,
        };
        Difference {
            vertices: mesh.vertices.finish(),
            positions: mesh.positions.finish(),
            first_positions: mesh.first_positions.finish(),
            edges: mesh.edges.finish(),
            corners: mesh.corners.finish(),
            faces: mesh.faces.finish(),
            vertex_layers: layers(&mut mesh.vertex_layers, self.vertex_layers),
            corner_layers: layers(&mut mesh.corner_layers, self.corner_layers),
            slots: self.slots,
            modifiers: (self.modifiers != mesh.modifiers).then_some(self.modifiers),
            groups: (self.groups != mesh.groups).then_some(self.groups),
        }
    }
}

impl EditMesh {
    /// A vertex that the change of a difference took farther away than its coordinates can say.
    #[must_use]
    pub fn overflow(&self, difference: &Difference) -> Option<VertexId> {
        let before = difference.positions.as_ref()?;
        self.positions.first_new_fault(before, |position| !position.is_finite()).map(VertexId::new)
    }
}

impl Difference {
    fn none(slots: AllSlots) -> Self {
        let none = || LayersDifference { common: Vec::new(), added: Vec::new(), adds_any: false };
        Self {
            vertices: None,
            positions: None,
            first_positions: None,
            edges: None,
            corners: None,
            faces: None,
            vertex_layers: none(),
            corner_layers: none(),
            slots,
            modifiers: None,
            groups: None,
        }
    }

    /// Takes the mesh to the other state: the one before the change, or after it again. In
    /// time proportional to what differs.
    ///
    /// # Panics
    /// May panic, or leave a mesh without sense, unless the mesh is in the state to which this
    /// difference belongs: differences are applied backwards in the order of their changes.
    pub fn apply(&mut self, mesh: &mut EditMesh) {
        fn swap<T: Copy>(
            column: &mut super::column::Column<T>,
            difference: &mut Option<ColumnDifference<T>>,
        ) {
            if let Some(difference) = difference {
                column.swap(difference);
            }
        }
        swap(&mut mesh.vertices, &mut self.vertices);
        swap(&mut mesh.positions, &mut self.positions);
        swap(&mut mesh.first_positions, &mut self.first_positions);
        swap(&mut mesh.edges, &mut self.edges);
        swap(&mut mesh.corners, &mut self.corners);
        swap(&mut mesh.faces, &mut self.faces);
        self.vertex_layers.apply(&mut mesh.vertex_layers);
        self.corner_layers.apply(&mut mesh.corner_layers);
        std::mem::swap(&mut mesh.slots, &mut self.slots);
        if let Some(modifiers) = &mut self.modifiers {
            std::mem::swap(&mut mesh.modifiers, modifiers);
        }
        if let Some(groups) = &mut self.groups {
            std::mem::swap(&mut mesh.groups, groups);
        }
    }

    /// Whether both states are the same.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.modifiers.is_none() && !self.changes_elements()
    }

    /// Whether the two states differ in more than their modifiers.
    #[must_use]
    pub fn changes_elements(&self) -> bool {
        // What only added elements takes no memory until it is undone.
        let is_same = self.vertices.is_none()
            && self.positions.is_none()
            && self.first_positions.is_none()
            && self.edges.is_none()
            && self.corners.is_none()
            && self.faces.is_none()
            && self.groups.is_none()
            && [&self.vertex_layers, &self.corner_layers].iter().all(|layers| layers.is_empty());
        !is_same
    }

    /// Whether the two states have different modifiers.
    #[must_use]
    pub fn changes_modifiers(&self) -> bool {
        self.modifiers.is_some()
    }

    /// The memory that it takes, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        fn of<T>(difference: &Option<ColumnDifference<T>>) -> usize {
            difference.as_ref().map_or(0, ColumnDifference::bytes)
        }
        of(&self.vertices)
            + of(&self.positions)
            + of(&self.first_positions)
            + of(&self.edges)
            + of(&self.corners)
            + of(&self.faces)
            + self.vertex_layers.bytes()
            + self.corner_layers.bytes()
            + self.modifiers.as_ref().map_or(0, |stack| size_of_val(stack.as_slice()))
            + self.groups.as_ref().map_or(0, |groups| size_of_val(groups.as_slice()))
    }
}

impl LayersDifference {
    fn apply(&mut self, layers: &mut Vec<Layer>) {
        for (layer, difference) in layers.iter_mut().zip(&mut self.common) {
            layer.swap(difference);
        }
        if self.added.is_empty() {
            self.added = layers.split_off(self.common.len());
        } else {
            layers.append(&mut self.added);
        }
    }

    /// Whether both states have the same layers with the same values.
    pub(super) fn is_empty(&self) -> bool {
        let is_unchanged = |layer: &LayerDifference| matches!(layer, LayerDifference::Unchanged);
        !self.adds_any && self.common.iter().all(is_unchanged)
    }

    fn bytes(&self) -> usize {
        let common = self.common.iter().map(LayerDifference::bytes);
        common.sum::<usize>() + self.added.iter().map(Layer::bytes).sum::<usize>()
    }
}
