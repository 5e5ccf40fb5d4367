//! The scene in step with what is edited, and a window's scene in step with that.
//!
//! An edit notes which of a mesh's values it changed. [`Document::scene`] then gives the
//! scene's mesh these values; it makes the mesh anew only after edits that add, remove or join
//! elements. A copy of the scene, such as a window has, follows by
//! [`Document::take_scene_changes`].

use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

use trigon_mesh::edit::{ChangedValues, Difference, EditMesh, ElementMap, ElementNumbers};
use trigon_mesh::{ChangedElements, Mesh, MeshChange};
use trigon_scene::{MeshId, Scene};

use super::Document;
use crate::display::MarkedEdges;

/// What a copy of a document's scene has to do to be equal to it again.
#[derive(Debug, Clone, PartialEq)]
pub enum SceneChange {
    /// Become a clone of it.
    Whole,
    /// Take over a mesh: [`Scene::adopt_mesh`].
    Mesh(MeshId),
    /// Take over everything but meshes: [`Scene::swap_parts`].
    Parts,
    /// Give a mesh other values: [`Scene::change_mesh`].
    Values(MeshId, MeshChange),
}

impl SceneChange {
    /// Makes the change in a copy. For a scene that tells others of changes, such as a
    /// window's, call what the variants name.
    pub fn apply(&self, from: &Scene, copy: &mut Scene) {
        match self {
            Self::Whole => *copy = from.clone(),
            Self::Mesh(id) => {
                copy.adopt_mesh(from, *id).expect("meshes are told of in the order of their ids")
            }
            Self::Parts => copy.swap_parts(&mut from.parts()),
            Self::Values(id, change) => copy.change_mesh(*id, change).expect("the original was changed so"),
        }
    }
}

/// What the scene shows of a mesh that is edited.
#[derive(Debug)]
struct ShownMesh {
    map: ElementMap,
    /// Found when somebody asks.
    numbers: OnceLock<ElementNumbers>,
    /// Likewise.
    marked_edges: OnceLock<MarkedEdges>,
}

/// How the scene's mesh differs from the one that is edited.
#[derive(Debug)]
enum Outdated {
    Whole,
    Values(ChangedValues),
}

/// What the copy of the scene has not been told yet.
#[derive(Debug, Default)]
struct Untold {
    parts: bool,
    meshes: BTreeSet<MeshId>,
    values: BTreeMap<MeshId, ChangedElements>,
    /// How many meshes the copy has.
    known_meshes: usize,
}

/// What a document knows of its scene.
#[derive(Debug, Default)]
pub(super) struct Shown {
    meshes: BTreeMap<MeshId, ShownMesh>,
    outdated: BTreeMap<MeshId, Outdated>,
    /// `None` until somebody asks.
    untold: Option<Untold>,
    /// Counts changes of what marks are made of, beside the selection.
    marks_revision: u64,
}

impl Shown {
    /// An edited mesh is in the other state of a difference.
    pub(super) fn note_difference(&mut self, id: MeshId, mesh: &EditMesh, difference: &Difference) {
        if difference.changes_marks() {
            self.marks_revision += 1;
            if let Some(shown) = self.meshes.get_mut(&id) {
                shown.marked_edges = OnceLock::new();
            }
        }
        let values = mesh.changed_values(difference).filter(|_| self.meshes.contains_key(&id));
        match (values, self.outdated.get_mut(&id)) {
            (_, Some(Outdated::Whole)) => {}
            (Some(values), Some(Outdated::Values(known))) => known.append(values),
            (Some(values), None) => drop(self.outdated.insert(id, Outdated::Values(values))),
            (None, _) => self.note_mesh(id),
        }
    }

    /// The scene's mesh has to be made anew.
    pub(super) fn note_mesh(&mut self, id: MeshId) {
        self.outdated.insert(id, Outdated::Whole);
    }

    /// A mesh is edited from now on: its elements get numbers in the scene.
    pub(super) fn note_edited(&mut self, id: MeshId) {
        if !self.meshes.contains_key(&id) {
            self.note_mesh(id);
        }
    }

    /// Nodes, materials or the like may have changed.
    pub(super) fn note_parts(&mut self) {
        self.marks_revision += 1;
        if let Some(untold) = &mut self.untold {
            untold.parts = true;
        }
    }

    fn make_anew(&mut self, scene: &mut Scene, id: MeshId, edited: &EditMesh) {
        let (mesh, map) = edited.to_mesh();
        // A mesh is never taken out of the scene, so that an undone object finds it again.
        if scene.replace_mesh(id, mesh).is_some() {
            self.marks_revision += 1;
            self.meshes
                .insert(id, ShownMesh { map, numbers: OnceLock::new(), marked_edges: OnceLock::new() });
            if let Some(untold) = &mut self.untold {
                untold.meshes.insert(id);
            }
        }
    }

    /// Gives the scene's mesh the values that changed; `None` if it cannot take them.
    fn follow(
        &mut self,
        scene: &mut Scene,
        id: MeshId,
        edited: &EditMesh,
        values: &ChangedValues,
    ) -> Option<()> {
        let mesh = scene.meshes().get(id)?.mesh();
        let numbers = self.meshes.get(&id)?.numbers(edited, mesh);
        let change = edited.mesh_change(values, mesh, numbers);
        scene.change_mesh(id, &change).ok()?;
        if let Some(untold) = &mut self.untold {
            untold.values.entry(id).or_default().add(&change);
        }
        Some(())
    }
}

impl ShownMesh {
    fn numbers(&self, edited: &EditMesh, mesh: &Mesh) -> &ElementNumbers {
        self.numbers.get_or_init(|| ElementNumbers::new(edited, mesh, &self.map))
    }
}

impl Untold {
    /// What was not told, meshes first: nodes name them.
    fn take(&mut self, scene: &Scene) -> Vec<SceneChange> {
        let known = std::mem::replace(&mut self.known_meshes, scene.meshes().index_bound());
        let mut meshes = std::mem::take(&mut self.meshes);
        meshes.extend(scene.meshes().iter().map(|(id, _)| id).filter(|id| id.index() >= known));
        let values = std::mem::take(&mut self.values).into_iter();
        let values: Vec<_> = values
            .filter(|(id, _)| !meshes.contains(id))
            .filter_map(|(id, changed)| {
                let mesh = scene.meshes().get(id)?.mesh();
                Some(SceneChange::Values(id, changed.values_in(mesh)))
            })
            .collect();
        let parts = std::mem::take(&mut self.parts).then_some(SceneChange::Parts);
        meshes.into_iter().map(SceneChange::Mesh).chain(parts).chain(values).collect()
    }
}

impl Document {
    /// The scene as it is now, to be drawn. Its meshes follow the edits since the last call: in
    /// time proportional to these where vertices were moved or corners got other values, and
    /// else to the whole mesh. Whether elements are hidden does not show.
    pub fn scene(&mut self) -> &Scene {
        let Self { file, shown, .. } = self;
        for (id, outdated) in std::mem::take(&mut shown.outdated) {
            let Some(edited) = file.edited.get(&id) else { continue };
            let followed = match &outdated {
                Outdated::Whole => None,
                Outdated::Values(values) => shown.follow(&mut file.scene, id, edited, values),
            };
            if followed.is_none() {
                shown.make_anew(&mut file.scene, id, edited);
            }
        }
        &file.scene
    }

    /// What changed in [`Self::scene`] since the last call, for a copy of it that is shown: to
    /// be applied in this order. The first call asks for the whole scene.
    ///
    /// ```
    /// use trigon_edit::{Command, Document};
    /// use trigon_scene::{Scene, showcase};
    ///
    /// let mut document = Document::new(showcase());
    /// let mut copy = Scene::new();
    /// for command in [r#"{ "op": "select_all" }"#, r#"{ "op": "translate", "offset": [1, 0, 0] }"#] {
    ///     document.run(serde_json::from_str(command)?)?;
    ///     for change in document.take_scene_changes() {
    ///         change.apply(document.nodes(), &mut copy);
    ///     }
    ///     assert_eq!(copy.bounds(), document.scene().bounds());
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn take_scene_changes(&mut self) -> Vec<SceneChange> {
        self.scene();
        let Self { file, shown, .. } = self;
        match &mut shown.untold {
            Some(untold) => untold.take(&file.scene),
            None => {
                let known_meshes = file.scene.meshes().index_bound();
                shown.untold = Some(Untold { known_meshes, ..Untold::default() });
                vec![SceneChange::Whole]
            }
        }
    }

    /// Which elements of an edited mesh those of the scene's mesh are, as of the last
    /// [`Self::scene`]; `None` for a mesh that was never edited, where all numbers are the same.
    #[must_use]
    pub fn shown_elements(&self, id: MeshId) -> Option<&ElementMap> {
        self.shown.meshes.get(&id).map(|shown| &shown.map)
    }

    /// The numbers of an edited mesh's elements in the scene's mesh, as of the last
    /// [`Self::scene`]; `None` for a mesh that was never edited, or that was edited since.
    /// Found at the first call after elements were added or removed, in time proportional
    /// to the mesh.
    #[must_use]
    pub fn shown_numbers(&self, id: MeshId) -> Option<&ElementNumbers> {
        let mesh = self.file.scene.meshes().get(id)?.mesh();
        let shown = self.shown.meshes.get(&id)?;
        let is_outdated = matches!(self.shown.outdated.get(&id), Some(Outdated::Whole));
        (!is_outdated).then(|| shown.numbers(self.file.edited.get(&id).expect("it was shown"), mesh))
    }

    /// Another number after every change of nodes or elements or of their marks, as of the
    /// last [`Self::scene`].
    pub(crate) fn marks_revision(&self) -> u64 {
        self.shown.marks_revision
    }

    /// The edges of an edited mesh that have marks.
    pub(crate) fn marked_edges(&self, id: MeshId) -> &MarkedEdges {
        static NONE: MarkedEdges = MarkedEdges::NONE;
        match (self.shown.meshes.get(&id), self.file.edited.get(&id)) {
            (Some(shown), Some(edited)) => shown.marked_edges.get_or_init(|| MarkedEdges::of(edited)),
            _ => &NONE,
        }
    }
}

#[cfg(test)]
mod tests;
