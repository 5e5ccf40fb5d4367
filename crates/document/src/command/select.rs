//! Selecting objects and elements by number, name or position; all, none, inverse; object mode, edit mode,
//! and the kind of element that is selected. The boxes that users draw on the image are in `display/pick`.

use std::collections::BTreeSet;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::DVec3;
use trigon_modelling::EditMesh;
use trigon_scene::MeshId;

use super::select_related::change_selections;
use super::{Action, ObjectName, Outcome};
use crate::error::EditError;
use crate::selection::{ElementKind, ElementKinds};
use crate::state::Change;

/// How a selection combines with the previous one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SelectAction {
    /// Replaces it.
    #[default]
    Replace,
    /// Adds to it.
    Add,
    /// Removes from it.
    Remove,
    /// Toggles: selected elements are deselected, the others selected.
    Toggle,
    /// Intersects with it.
    Intersect,
}

/// Selects objects, or elements of an edited object. In edit mode `elements` are numbers of
/// vertices, edges or faces, whichever kind is selected.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Select {
    /// In object mode: the objects. In edit mode: the object with the elements. Default: the only
    /// edited one.
    pub objects: Vec<ObjectName>,
    /// In edit mode: the numbers of the elements.
    pub elements: Vec<u32>,
    /// How this combines with the previous selection.
    pub action: SelectAction,
}

impl Action for Select {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let found: Result<Vec<_>, _> = self.objects.iter().map(|name| name.find(change.scene())).collect();
        let objects = found?;
        if !change.selection().is_editing() {
            let selection = change.selection_mut();
            if self.action == SelectAction::Replace {
                selection.objects.clear();
            }
            if self.action == SelectAction::Intersect {
                selection.objects.retain(|object| objects.contains(object));
            }
            for object in objects {
                let is_in = selection.objects.contains(&object);
                if self.selects(is_in) {
                    selection.objects.insert(object);
                    selection.active = Some(object);
                } else {
                    selection.objects.remove(&object);
                }
            }
            return Ok(Outcome::silent());
        }
        let id = change.only_edited_mesh(objects, "selecting elements")?;
        let kind = change.selection().kind();
        let (selection, meshes) = change.selection_and_meshes();
        let keeps_others = !matches!(self.action, SelectAction::Replace | SelectAction::Intersect);
        if !keeps_others {
            let is_cleared = |mesh: &MeshId| self.action == SelectAction::Replace || *mesh != id;
            let all: Vec<_> = selection.meshes().map(|(mesh, _)| mesh).filter(is_cleared).collect();
            for mesh in all {
                selection.of_mut(mesh).expect("it was just listed").clear();
            }
        }
        let (Some(mesh), Some(selection)) = (meshes.get(&id), selection.of_mut(id)) else {
            return Err(EditError::NotEditing("selecting elements of an object"));
        };
        self.elements.iter().try_for_each(|&element| check_element(mesh, kind, element))?;
        if self.action == SelectAction::Intersect {
            let named: BTreeSet<u32> = self.elements.iter().copied().collect();
            let others: Vec<u32> = selection.indices().filter(|element| !named.contains(element)).collect();
            selection.remove(&others);
        }
        let is_selected = |&element: &u32| self.selects(selection.contains(element));
        let (in_it, out_of_it): (Vec<u32>, Vec<u32>) = self.elements.iter().partition(|e| is_selected(e));
        selection.remove(&out_of_it);
        selection.insert(&in_it);
        Ok(Outcome::silent())
    }
}

impl Select {
    /// Whether a named element is selected afterwards.
    fn selects(&self, was_selected: bool) -> bool {
        match self.action {
            SelectAction::Replace | SelectAction::Add => true,
            SelectAction::Remove => false,
            SelectAction::Toggle => !was_selected,
            SelectAction::Intersect => was_selected,
        }
    }
}

pub(super) fn check_element(mesh: &EditMesh, kind: ElementKind, index: u32) -> Result<(), EditError> {
    use trigon_modelling::{EdgeId, FaceId, Refusal, VertexId};
    let (vertex, edge, face) = (VertexId::new(index), EdgeId::new(index), FaceId::new(index));
    match kind {
        ElementKind::Vertex if !mesh.has_vertex(vertex) => Err(Refusal::NoSuchVertex(vertex).into()),
        ElementKind::Edge if !mesh.has_edge(edge) => Err(Refusal::NoSuchEdge(edge).into()),
        ElementKind::Face if !mesh.has_face(face) => Err(Refusal::NoSuchFace(face).into()),
        _ if !kind.is_selectable(mesh, index) => {
            let reason = "it is hidden: reveal it first";
            Err(Refusal::NotPossible { operation: "selecting an element", reason }.into())
        }
        _ => Ok(()),
    }
}

/// Selects all objects, or all elements of the edited meshes that are not hidden.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectAll {}

impl Action for SelectAll {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        if !change.selection().is_editing() {
            let all = change.scene().nodes().iter().map(|(id, _)| id).collect();
            change.selection_mut().objects = all;
            return Ok(Outcome::silent());
        }
        change_selections(change, "select all", |mesh, kind, selection| {
            selection.set(kind.visible(mesh));
            Ok(())
        })
    }
}

/// Selects nothing.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectNone {}

impl Action for SelectNone {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        if !change.selection().is_editing() {
            change.selection_mut().objects.clear();
            return Ok(Outcome::silent());
        }
        change_selections(change, "select none", |_, _, selection| {
            selection.clear();
            Ok(())
        })
    }
}

/// Inverts the selection; hidden elements stay unselected.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectInverse {}

impl Action for SelectInverse {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        if !change.selection().is_editing() {
            let all = change.scene().nodes().iter().map(|(id, _)| id);
            let rest = all.filter(|id| !change.selection().objects.contains(id)).collect();
            change.selection_mut().objects = rest;
            return Ok(Outcome::silent());
        }
        change_selections(change, "invert selection", |mesh, kind, selection| {
            let mut rest = kind.visible(mesh);
            rest.difference_with(selection.bits());
            selection.set(rest);
            Ok(())
        })
    }
}

/// Enters edit mode, in which vertices, edges and faces of the objects' meshes can be selected.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct EditObjects {
    /// The objects. Default: the selected ones.
    pub objects: Vec<ObjectName>,
}

impl Action for EditObjects {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let objects = if self.objects.is_empty() {
            change.selection().objects.iter().copied().collect()
        } else {
            let found: Result<Vec<_>, _> =
                self.objects.iter().map(|name| name.find(change.scene())).collect();
            found?
        };
        let meshes = change.meshes_of(objects.iter().copied());
        if meshes.is_empty() {
            let needed = "at least one object with a mesh";
            return Err(EditError::NothingSelected { command: "edit mode", needed });
        }
        for &mesh in &meshes {
            change.mesh(mesh);
            change.selection_mut().enter(mesh);
        }
        let selection = change.selection_mut();
        selection.objects.extend(&objects);
        selection.active = selection.active.or(objects.last().copied());
        Ok(Outcome::silent())
    }
}

/// Returns to object mode. The selection of elements is forgotten.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct LeaveEditMode {}

impl Action for LeaveEditMode {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        change.selection_mut().leave();
        Ok(Outcome::silent())
    }
}

/// Sets which of vertices, edges and faces are selected. The current selection is converted. With several
/// kinds, elements are numbered and selected as those of the first of them, and the others by their parts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SetElementKind {
    /// Which kind.
    pub kind: ElementKind,
    /// Whether it is added to the kinds that are selected already, or removed from them if it is one of
    /// several.
    #[serde(default)]
    pub extend: bool,
}

impl Action for SetElementKind {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let (selection, meshes) = change.selection_and_meshes();
        let one = ElementKinds::one(self.kind);
        selection.set_kinds(if self.extend { selection.kinds().toggled(self.kind) } else { one }, meshes);
        Ok(Outcome::silent())
    }
}

/// Selects the elements whose centre (the mean of their vertices) lies within a box, boundary included.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectWithin {
    /// The smallest coordinates, in metres in the space of the mesh.
    pub min: [f64; 3],
    /// The largest coordinates, in metres in the space of the mesh.
    pub max: [f64; 3],
    /// Whether to add to the previous selection.
    pub add: bool,
}

impl Default for SelectWithin {
    fn default() -> Self {
        Self { min: [-1e30; 3], max: [1e30; 3], add: false }
    }
}

impl Action for SelectWithin {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let (min, max) = (DVec3::from(self.min), DVec3::from(self.max));
        let is_within = |middle: DVec3| middle.cmpge(min).all() && middle.cmple(max).all();
        change_selections(change, "select within a box", |mesh, kind, selection| {
            let mut found = kind.visible(mesh);
            let outside = found.ones().filter(|&index| !is_within(kind.middle_of(mesh, index as u32)));
            let outside: Vec<usize> = outside.collect();
            outside.into_iter().for_each(|index| found.remove(index));
            if self.add {
                found.union_with(selection.bits());
            }
            selection.set(found);
            Ok(())
        })
    }
}
