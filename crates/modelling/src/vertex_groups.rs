//! Vertex groups: named sets of weighted vertices. The weights of each are a layer, so that operations carry them along;
//! the names are a list of the mesh.

use super::column::Column;
use super::edit_mesh::EditMesh;
use super::group_weight::{GroupLayers, GroupName, GroupWeight};
use super::ids::VertexId;
use super::layers::{Layer, LayerKind, LayerValues};
use super::refusal::Refusal;

/// A named set of weighted vertices of a mesh.
#[derive(Debug, Clone, Copy)]
pub struct VertexGroup<'m> {
    mesh: &'m EditMesh,
    weights: &'m Column<GroupWeight>,
}

impl VertexGroup<'_> {
    /// The weight of a vertex, 0 to 1; `None` if it is not in the group.
    #[must_use]
    pub fn weight(&self, vertex: VertexId) -> Option<f32> {
        self.weights[vertex.0].get()
    }

    /// The vertices in the group with their weights, by index.
    pub fn vertices(&self) -> impl Iterator<Item = (VertexId, f32)> + '_ {
        self.mesh.vertices().filter_map(|vertex| Some((vertex, self.weight(vertex)?)))
    }

    /// How strongly something acts at a vertex that a group limits: its weight, 0 outside; or 1 minus that if the group is
    /// inverted.
    pub(super) fn factor(&self, vertex: VertexId, is_inverted: bool) -> f64 {
        let weight = f64::from(self.weight(vertex).unwrap_or(0.0));
        if is_inverted { 1.0 - weight } else { weight }
    }
}

impl EditMesh {
    /// The most vertex groups of a mesh.
    pub const MOST_VERTEX_GROUPS: usize = 64;

    /// The names of the vertex groups, in their order.
    #[must_use]
    pub fn vertex_group_names(&self) -> impl ExactSizeIterator<Item = &str> {
        self.groups.iter().map(|group| group.name.as_str())
    }

    /// A vertex group by its name.
    #[must_use]
    pub fn vertex_group(&self, name: &str) -> Option<VertexGroup<'_>> {
        let layer = self.group_named(name)?.layer;
        let weights = self.vertex_layers.iter().find_map(|known| match (&known.values, known.kind) {
            (LayerValues::Weights(column), LayerKind::Group(number)) if number == layer => Some(column),
            _ => None,
        });
        Some(VertexGroup { mesh: self, weights: weights.expect("each group has a layer") })
    }

    /// The group that limits where something acts; `None` for an empty name, which limits nothing.
    pub(super) fn limiting_group(&self, name: &str) -> Result<Option<VertexGroup<'_>>, Refusal> {
        match self.vertex_group(name) {
            None if !name.is_empty() => Err(Refusal::NoSuchGroup(name.to_owned())),
            found => Ok(found),
        }
    }

    pub(super) fn group_named(&self, name: &str) -> Option<&GroupName> {
        self.groups.iter().find(|group| group.name == name)
    }

    /// The weights of a group, for writing.
    pub(super) fn group_weights_mut(&mut self, name: &str) -> Result<&mut Column<GroupWeight>, Refusal> {
        let layer = self.group_named(name).map(|group| group.layer);
        let layer = layer.ok_or_else(|| Refusal::NoSuchGroup(name.to_owned()))?;
        Ok(self.group_layer_mut(layer).expect("each group has a layer"))
    }

    fn group_layer_mut(&mut self, number: u16) -> Option<&mut Column<GroupWeight>> {
        self.vertex_layers.iter_mut().find_map(|known| match (&mut known.values, known.kind) {
            (LayerValues::Weights(column), LayerKind::Group(other)) if other == number => Some(column),
            _ => None,
        })
    }

    /// Adds an empty group after the others, whose name and number were checked. A layer that a removed group left is
    /// used again: layers are only ever added, so that differences stay simple.
    pub(super) fn push_group(&mut self, name: &str) {
        let is_used = |number: u16| self.groups.iter().any(|group| group.layer == number);
        let layer = (0..).find(|&number| !is_used(number)).expect("there are few groups");
        if self.group_layer_mut(layer).is_none() {
            let values = LayerValues::Weights(Column::new(vec![GroupWeight::NONE; self.vertex_capacity()]));
            self.vertex_layers.push(Layer { kind: LayerKind::Group(layer), values });
        }
        self.groups.push(GroupName { name: name.to_owned(), layer });
    }

    /// Adds the groups of another mesh that this one has not.
    pub(super) fn unite_groups(&mut self, other: &Self) -> Vec<GroupLayers> {
        let pair = |theirs: &GroupName| {
            if self.group_named(&theirs.name).is_none() {
                self.push_group(&theirs.name);
            }
            let own = self.group_named(&theirs.name).expect("it was added").layer;
            GroupLayers { own, theirs: theirs.layer }
        };
        other.groups.iter().map(pair).collect()
    }

    /// Refuses to take over the groups of another mesh if there would be too many.
    pub(super) fn check_groups_with(&self, other: &Self) -> Result<(), Refusal> {
        let new = other.groups.iter().filter(|group| self.group_named(&group.name).is_none()).count();
        Self::check_group_count(self.groups.len() + new)
    }

    pub(super) fn check_group_count(count: usize) -> Result<(), Refusal> {
        if count <= Self::MOST_VERTEX_GROUPS {
            return Ok(());
        }
        Err(Refusal::OutOfRange {
            parameter: "the number of vertex groups",
            value: count as f64,
            range: "at most 64: remove some",
        })
    }
}
