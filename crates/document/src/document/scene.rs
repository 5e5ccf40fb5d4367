//! The document's scene for drawing.

use trigon_mesh::Mesh;
use trigon_modelling::{ElementMap, ElementNumbers, Evaluation, ModifierState};
use trigon_scene::{MeshId, Scene};

use super::Document;
use crate::state::{MarkedElements, Outdated, SceneChange, State, Untold};

impl Document {
    /// The scene as it is now, for drawing. Its meshes follow the edits since the last call: in
    /// time proportional to these if only vertices moved or corner values changed, and otherwise to
    /// the whole mesh. Hidden elements are part of it.
    pub fn scene(&mut self) -> &Scene {
        let State { file, shown, selection, .. } = &mut self.state;
        shown.update(&mut file.native.scene, &file.edited, selection);
        &file.native.scene
    }

    /// The scene as an image shows it: meshes after their modifiers, with what a view leaves out of those
    /// ([`ModifierState`](trigon_modelling::ModifierState)), and what is hidden of meshes. Copies the nodes, and no mesh that is
    /// shown as it is.
    pub fn scene_to_render(&mut self) -> Scene {
        let mut scene = self.scene().clone();
        let State { file, shown, .. } = &mut self.state;
        for (&id, _) in file.edited.iter().filter(|(_, edited)| !edited.modifiers().is_empty()) {
            if let Some(mesh) = shown.evaluate(id, &file.native.scene, &file.edited).to_mesh() {
                scene.replace_mesh(id, mesh).expect("an edited mesh is in the scene");
            }
        }
        scene
    }

    /// What a view shows of the modifiers of a mesh, in the order of its stack, as of the last [`Self::take_scene_changes`]
    /// or [`Self::scene_to_render`]; none if it was never edited.
    pub fn modifier_states(&self, id: MeshId) -> impl Iterator<Item = &ModifierState> {
        // A stack that became empty is not evaluated again.
        let count = self.mesh(id).map_or(0, |mesh| mesh.modifiers().len());
        self.state.shown.evaluation(id).into_iter().flat_map(Evaluation::states).take(count)
    }

    /// The changes of [`Self::scene`] since the last call, for a displayed copy; apply them in this
    /// order. The first call returns the whole scene.
    ///
    /// ```
    /// use trigon_document::{Command, Document};
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
        let is_first = self.state.shown.untold.is_none();
        self.state.shown.untold.get_or_insert_default();
        self.scene();
        let State { file, shown, .. } = &mut self.state;
        let untold = shown.untold.as_mut().expect("it was just made");
        if is_first {
            // The whole scene includes all other changes.
            let visible = std::mem::take(&mut untold.visible);
            let known_meshes = file.native.scene.meshes().index_bound();
            *untold = Untold { known_meshes, visible, ..Untold::default() };
        }
        let mut changes: Vec<_> = is_first.then_some(SceneChange::Whole).into_iter().collect();
        changes.extend(untold.take(&file.native.scene, &shown.visible));
        changes.extend(shown.take_visible(&file.native.scene, &file.edited));
        changes
    }

    /// Which elements of an edited mesh are visible, as of the last [`Self::scene`]. Their numbers are those
    /// in the mesh of a copy of the scene that follows it, or in the scene if there is none. `None` for a
    /// mesh that was never edited, whose numbers are all the same.
    #[must_use]
    pub fn shown_elements(&self, id: MeshId) -> Option<&ElementMap> {
        let visible = self.state.shown.visible.get(&id).map(|visible| &visible.map);
        visible.or_else(|| self.state.shown.meshes.get(&id).map(|shown| &shown.map))
    }

    /// The numbers of an edited mesh's elements there; `None` for a mesh that was never edited, or
    /// whose elements were added or removed since. Computed at the first call after that, in time
    /// proportional to the mesh.
    #[must_use]
    pub fn shown_numbers(&self, id: MeshId) -> Option<&ElementNumbers> {
        if matches!(self.state.shown.outdated.get(&id), Some(Outdated::Whole)) {
            return None;
        }
        if let Some(visible) = self.state.shown.visible.get(&id) {
            return (!visible.is_outdated).then_some(&visible.numbers);
        }
        let mesh = self.state.file.native.scene.meshes().get(id)?.mesh();
        let shown = self.state.shown.meshes.get(&id)?;
        Some(shown.numbers(self.state.file.edited.get(&id)?, mesh))
    }

    /// What modifiers make of a mesh and a copy shows; `None` where it shows the mesh itself.
    pub(crate) fn shown_surface(&self, id: MeshId) -> Option<&Mesh> {
        self.state.shown.visible.get(&id)?.surface.as_ref()
    }

    /// The mesh that is shown of an edited one, if it is all of it and nothing else: modifiers change nothing, and nothing is
    /// hidden. As of the last [`Self::scene`].
    pub(crate) fn shown_whole(&self, id: MeshId) -> Option<&Mesh> {
        let shown = &self.state.shown;
        let is_whole = !shown.outdated.contains_key(&id)
            && !shown.visible.contains_key(&id)
            && shown.meshes.contains_key(&id)
            && !self.marked(id)?.has_hidden;
        is_whole.then(|| Some(self.state.file.native.scene.meshes().get(id)?.mesh())).flatten()
    }

    /// A number that changes with every change of nodes, elements or their marks (sharp, seam, crease, hidden, …), as
    /// of the last [`Self::scene`], and with every document that is opened. Unlike [`Self::revision`] it stays the same
    /// while vertices only move, and does not tell whether the selection changed.
    #[must_use]
    pub fn marks_revision(&self) -> u64 {
        self.state.shown.marks_revision
    }

    /// The marks of a mesh; `None` if it is not edited.
    pub(crate) fn marked(&self, id: MeshId) -> Option<&MarkedElements> {
        Some(self.state.shown.marked(id, self.state.file.edited.get(&id)?))
    }
}
