//! Keeps the scene in step with the edited meshes, and a window's scene in step with that.
//!
//! An edit records which values of a mesh it changed. When the scene is requested, its mesh gets
//! these values; it is rebuilt only after edits that add, remove or join elements. Changes for the
//! copy of the scene are recorded, too.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

use trigon_mesh::{ChangedElements, Mesh};
use trigon_modelling::{ChangedValues, Difference, EditMesh, ElementMap, ElementNumbers, Evaluation};
use trigon_scene::{MeshId, Scene};

use super::MarkedElements;
use super::visible::SceneChange;
use super::visible::{Sight, VisibleMesh};
use crate::objects::SceneObjects;
use crate::revision::next_revision;
use crate::selection::Selection;

/// How the scene shows an edited mesh.
#[derive(Debug)]
pub(crate) struct ShownMesh {
    pub(crate) map: ElementMap,
    /// Computed on demand.
    numbers: OnceLock<ElementNumbers>,
    /// Likewise.
    marked: OnceLock<MarkedElements>,
}

/// How the scene's mesh differs from the edited one.
#[derive(Debug)]
pub(crate) enum Outdated {
    Whole,
    Values(ChangedValues),
}

/// Changes that the copy of the scene has not received yet.
#[derive(Debug, Default)]
pub(crate) struct Untold {
    pub(crate) parts: bool,
    pub(crate) meshes: BTreeSet<MeshId>,
    /// Shown instead of the scene's.
    pub(crate) visible: BTreeMap<MeshId, Mesh>,
    pub(crate) values: BTreeMap<MeshId, ChangedElements>,
    /// The number of meshes in the copy.
    pub(crate) known_meshes: usize,
}

/// A document's record of its scene.
#[derive(Debug, Default)]
pub(crate) struct Shown {
    pub(crate) meshes: BTreeMap<MeshId, ShownMesh>,
    pub(crate) outdated: BTreeMap<MeshId, Outdated>,
    /// `None` until the first request.
    pub(crate) untold: Option<Untold>,
    /// What a copy shows instead of the scene's mesh.
    pub(crate) visible: BTreeMap<MeshId, VisibleMesh>,
    /// Meshes after their modifiers.
    evaluations: BTreeMap<MeshId, Evaluation>,
    /// Another number after each change of a mesh or its modifiers, for those of other objects that use it.
    revisions: BTreeMap<MeshId, u64>,
    /// Another one after each change that affects marks, other than of the selection.
    pub(crate) marks_revision: u64,
}

impl Shown {
    /// An edited mesh is in the other state of a difference.
    pub(crate) fn note_difference(&mut self, id: MeshId, mesh: &EditMesh, difference: &Difference) {
        if difference.changes_marks() {
            self.marks_revision = next_revision();
            if let Some(shown) = self.meshes.get_mut(&id) {
                shown.marked = OnceLock::new();
            }
            self.note_visible(id);
        }
        if difference.changes_modifiers() {
            self.note_visible(id);
            self.revisions.insert(id, next_revision());
        }
        if difference.changes_elements() {
            self.forget_evaluation(id);
        }
        let values = mesh.changed_values(difference).filter(|_| self.meshes.contains_key(&id));
        match (values, self.outdated.get_mut(&id)) {
            (_, Some(Outdated::Whole)) => {}
            (Some(values), Some(Outdated::Values(known))) => known.append(values),
            (Some(values), None) if values.is_empty() => {}
            (Some(values), None) => drop(self.outdated.insert(id, Outdated::Values(values))),
            (None, _) => self.note_mesh(id),
        }
    }

    /// The visible part of a mesh must be computed again.
    fn note_visible(&mut self, id: MeshId) {
        if let Some(visible) = self.visible.get_mut(&id) {
            visible.is_outdated = true;
        }
    }

    /// What modifiers made of a mesh is outdated.
    fn forget_evaluation(&mut self, id: MeshId) {
        self.revisions.insert(id, next_revision());
        if let Some(evaluation) = self.evaluations.get_mut(&id) {
            evaluation.forget();
        }
    }

    /// A mesh after its modifiers, up to date.
    pub(crate) fn evaluate(
        &mut self,
        id: MeshId,
        scene: &Scene,
        edited: &BTreeMap<MeshId, EditMesh>,
    ) -> &Evaluation {
        let objects = SceneObjects::new(scene, edited, Some(&self.revisions), id);
        let evaluation = self.evaluations.entry(id).or_default();
        if let Some(mesh) = edited.get(&id)
            && evaluation.update(mesh, &objects)
            && let Some(visible) = self.visible.get_mut(&id)
            && visible.values.is_empty()
        {
            // Not its own elements changed, but its modifiers, or other objects that these use.
            visible.is_outdated = true;
        }
        evaluation
    }

    /// A mesh after its modifiers, as of the last update.
    pub(crate) fn evaluation(&self, id: MeshId) -> Option<&Evaluation> {
        self.evaluations.get(&id)
    }

    /// The scene's mesh must be rebuilt.
    pub(crate) fn note_mesh(&mut self, id: MeshId) {
        self.forget_evaluation(id);
        self.outdated.insert(id, Outdated::Whole);
    }

    /// A mesh is edited from now on: its elements get numbers in the scene.
    pub(crate) fn note_edited(&mut self, id: MeshId) {
        if !self.meshes.contains_key(&id) {
            self.note_mesh(id);
        }
    }

    /// Nodes, materials or the like may have changed.
    pub(crate) fn note_parts(&mut self) {
        self.marks_revision = next_revision();
        if let Some(untold) = &mut self.untold {
            untold.parts = true;
        }
    }

    /// Makes the scene show the current state of the edited meshes.
    pub(crate) fn update(
        &mut self,
        scene: &mut Scene,
        meshes: &BTreeMap<MeshId, EditMesh>,
        selection: &Selection,
    ) {
        for (id, outdated) in std::mem::take(&mut self.outdated) {
            let Some(edited) = meshes.get(&id) else { continue };
            let followed = match &outdated {
                Outdated::Whole => None,
                Outdated::Values(values) => self.follow(scene, id, edited, values),
            };
            if followed.is_none() {
                self.make_anew(scene, id, edited);
            }
        }
        self.refresh(scene, meshes, selection);
    }

    fn make_anew(&mut self, scene: &mut Scene, id: MeshId, edited: &EditMesh) {
        let (mesh, map) = edited.to_mesh();
        // A mesh is never removed from the scene, so that an undone object finds it again.
        if scene.replace_mesh(id, mesh).is_some() {
            self.marks_revision = next_revision();
            self.note_visible(id);
            self.meshes.insert(id, ShownMesh { map, numbers: OnceLock::new(), marked: OnceLock::new() });
            if let Some(untold) = &mut self.untold {
                untold.meshes.insert(id);
            }
        }
    }

    /// Brings what a copy shows up to date, if there is a copy.
    fn refresh(&mut self, scene: &Scene, edited: &BTreeMap<MeshId, EditMesh>, selection: &Selection) {
        let Some(mut untold) = self.untold.take() else { return };
        let candidates: BTreeSet<MeshId> = edited
            .iter()
            .filter(|(id, mesh)| !mesh.modifiers().is_empty() || selection.of(**id).is_some())
            .map(|(id, _)| *id)
            .chain(self.visible.keys().copied())
            .collect();
        for id in candidates {
            let sight = edited.get(&id).map_or(Sight::Whole, |mesh| {
                let is_edited = selection.of(id).is_some();
                let has_hidden = is_edited && self.marked(id, mesh).has_hidden;
                Sight::of(self.evaluate(id, scene, edited), is_edited, has_hidden)
            });
            let known = self.visible.get(&id);
            let is_current = match known {
                None => sight == Sight::Whole,
                Some(visible) => visible.sight == sight && !visible.is_outdated,
            };
            if is_current {
                continue;
            }
            self.marks_revision = next_revision();
            if sight == Sight::Whole {
                self.visible.remove(&id);
                untold.visible.remove(&id);
                untold.meshes.insert(id);
            } else {
                let (visible, mesh) = VisibleMesh::new(sight, &edited[&id], self.evaluate(id, scene, edited));
                self.visible.insert(id, visible);
                untold.visible.insert(id, mesh);
            }
        }
        self.untold = Some(untold);
    }

    /// The changes of meshes that the copy shows in another way than the scene, since the last call.
    pub(crate) fn take_visible(
        &mut self,
        scene: &Scene,
        edited: &BTreeMap<MeshId, EditMesh>,
    ) -> Vec<SceneChange> {
        let mut changes = Vec::new();
        for (&id, visible) in &mut self.visible {
            let Some(mesh) = edited.get(&id) else { continue };
            let evaluation = self.evaluations.entry(id).or_default();
            evaluation.update(mesh, &SceneObjects::new(scene, edited, Some(&self.revisions), id));
            let change = visible.take(id, mesh, evaluation);
            if matches!(change, Some(SceneChange::Visible(..))) {
                self.marks_revision = next_revision();
            }
            changes.extend(change);
        }
        changes
    }

    pub(crate) fn marked(&self, id: MeshId, edited: &EditMesh) -> &MarkedElements {
        static NONE: MarkedElements = MarkedElements::NONE;
        match self.meshes.get(&id) {
            Some(shown) => shown.marked.get_or_init(|| MarkedElements::of(edited)),
            None => &NONE,
        }
    }

    /// Gives the scene's mesh the changed values; `None` if it cannot take them.
    fn follow(
        &mut self,
        scene: &mut Scene,
        id: MeshId,
        edited: &EditMesh,
        values: &ChangedValues,
    ) -> Option<()> {
        let mesh = scene.meshes().get(id)?.mesh();
        let numbers = self.meshes.get(&id)?.numbers(edited, mesh);
        let change = edited.mesh_change(values, numbers);
        scene.change_mesh(id, &change).ok()?;
        if let Some(visible) = self.visible.get_mut(&id) {
            visible.values.append(values.clone());
        }
        if let Some(untold) = &mut self.untold {
            untold.values.entry(id).or_default().add(&change);
        }
        Some(())
    }
}

impl ShownMesh {
    pub(crate) fn numbers(&self, edited: &EditMesh, mesh: &Mesh) -> &ElementNumbers {
        self.numbers.get_or_init(|| ElementNumbers::new(edited, mesh, &self.map))
    }
}

impl Untold {
    /// The pending changes, meshes first, because nodes refer to them. Another function handles
    /// meshes of which the copy shows a part.
    pub(crate) fn take(&mut self, scene: &Scene, partly: &BTreeMap<MeshId, VisibleMesh>) -> Vec<SceneChange> {
        let known = std::mem::replace(&mut self.known_meshes, scene.meshes().index_bound());
        let mut meshes = std::mem::take(&mut self.meshes);
        meshes.extend(scene.meshes().iter().map(|(id, _)| id).filter(|id| id.index() >= known));
        let values = std::mem::take(&mut self.values).into_iter();
        let values: Vec<_> = values
            .filter(|(id, _)| !meshes.contains(id) && !partly.contains_key(id))
            .filter_map(|(id, changed)| {
                let mesh = scene.meshes().get(id)?.mesh();
                Some(SceneChange::Values(id, changed.values_in(mesh)))
            })
            .collect();
        let parts = std::mem::take(&mut self.parts).then_some(SceneChange::Parts);
        let visible = std::mem::take(&mut self.visible).into_iter();
        let visible = visible.map(|(id, mesh)| SceneChange::Visible(id, Box::new(mesh)));
        meshes.into_iter().map(SceneChange::Mesh).chain(visible).chain(parts).chain(values).collect()
    }
}

#[cfg(test)]
mod tests;
