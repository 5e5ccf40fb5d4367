//! What a view shows of edited meshes with hidden elements.
//!
//! The document's scene always has all elements, so that exports are complete; a displayed copy
//! gets a mesh without the hidden ones.

use std::collections::BTreeMap;

use trigon_mesh::MeshChange;
use trigon_mesh::edit::{ChangedValues, EditMesh, ElementMap, ElementNumbers};
use trigon_scene::MeshId;

use super::shown::Shown;
use crate::selection::Selection;

/// What a copy of the scene shows of a mesh.
#[derive(Debug)]
pub(super) struct VisibleMesh {
    pub(super) map: ElementMap,
    pub(super) numbers: ElementNumbers,
    /// Changes that the copy has not received.
    pub(super) values: ChangedValues,
    /// Whether the visible elements have changed since.
    pub(super) is_outdated: bool,
}

impl VisibleMesh {
    /// The change that the copy has not received.
    pub(super) fn take(&mut self, edited: &EditMesh) -> Option<MeshChange> {
        let values = std::mem::take(&mut self.values);
        (!values.is_empty()).then(|| edited.mesh_change(&values, &self.numbers))
    }
}

/// Brings what a copy shows up to date, if there is a copy.
pub(super) fn refresh(shown: &mut Shown, edited: &BTreeMap<MeshId, EditMesh>, selection: &Selection) {
    let Some(mut untold) = shown.untold.take() else { return };
    let is_partly = |id: MeshId| {
        let mesh = edited.get(&id).filter(|_| selection.of(id).is_some());
        mesh.is_some_and(|mesh| shown.marked(id, mesh).has_hidden)
    };
    let whole: Vec<MeshId> = shown.visible.keys().copied().filter(|&id| !is_partly(id)).collect();
    let is_new = |id: &MeshId| shown.visible.get(id).is_none_or(|visible| visible.is_outdated);
    let partly = selection.meshes().map(|(id, _)| id).filter(|&id| is_partly(id));
    let made: Vec<MeshId> = partly.filter(is_new).collect();
    for id in whole {
        shown.visible.remove(&id);
        untold.visible.remove(&id);
        untold.meshes.insert(id);
        shown.marks_revision += 1;
    }
    for id in made {
        let (mesh, map) = edited[&id].to_visible_mesh();
        let numbers = ElementNumbers::new(&edited[&id], &mesh, &map);
        let values = ChangedValues::default();
        shown.visible.insert(id, VisibleMesh { map, numbers, values, is_outdated: false });
        untold.visible.insert(id, mesh);
        shown.marks_revision += 1;
    }
    shown.untold = Some(untold);
}
