//! The changes that a running command may make.

use std::collections::BTreeMap;
use std::path::PathBuf;

use trigon_modelling::{Difference, EdgeId, EditMesh, Evaluation, FaceId, Modifier, Refusal, VertexId};
use trigon_scene::{MeshId, NodeId, Scene, SceneError, SceneParts};

use super::{Names, State};
use crate::error::EditError;
use crate::objects::{SceneObjects, UsedObject};
use crate::selection::{Elements, MeshSelection, Selection};

/// A running command: all changes go through it, so that they can be undone.
pub(crate) struct Change<'d> {
    pub(crate) state: &'d mut State,
    pub(crate) meshes: Vec<(MeshId, Difference)>,
    pub(crate) parts: Option<Box<SceneParts>>,
}

/// The selection of a mesh after a change.
pub(crate) enum AfterEdit {
    /// What was.
    Keep,
    /// Nothing.
    Clear,
    /// These, or what represents them in the selected kind.
    Select(Elements),
}

impl Change<'_> {
    pub(crate) fn state(&self) -> &State {
        self.state
    }

    pub(crate) fn scene(&self) -> &Scene {
        &self.state.file.native.scene
    }

    /// The scene, for changing nodes and materials. Meshes may be added, but not replaced: use
    /// [`Self::edit`].
    pub(crate) fn scene_mut(&mut self) -> &mut Scene {
        if self.parts.is_none() {
            self.parts = Some(Box::new(self.state.file.native.scene.parts()));
        }
        self.state.shown.note_parts();
        &mut self.state.file.native.scene
    }

    /// How many bytes of memory an operation may let a mesh take.
    pub(crate) fn memory(&self) -> u64 {
        self.state.memory.unwrap_or(EditMesh::MEMORY)
    }

    /// Notes files that contents were read from. They stay noted if the command is undone: it may be done again.
    pub(crate) fn note_files(&mut self, files: &[PathBuf]) {
        self.state.file.native.files.extend_from_slice(files);
    }

    /// Refuses a placement that the numbers of a file cannot hold.
    pub(crate) fn check_placements(&self) -> Result<(), EditError> {
        let Some(before) = &self.parts else { return Ok(()) };
        let was = |id: NodeId| before.node(id).map(|node| node.transform);
        let mut nodes = self.scene().nodes().iter();
        match nodes.find(|(id, node)| !node.transform.fits_f32() && was(*id) != Some(node.transform)) {
            Some((_, node)) => Err(EditError::Overflow(node.name.clone())),
            None => Ok(()),
        }
    }

    pub(crate) fn selection(&self) -> &Selection {
        &self.state.selection
    }

    pub(crate) fn selection_mut(&mut self) -> &mut Selection {
        &mut self.state.selection
    }

    /// The selection, for changing it, and the meshes, for reading.
    pub(crate) fn selection_and_meshes(&mut self) -> (&mut Selection, &BTreeMap<MeshId, EditMesh>) {
        (&mut self.state.selection, &self.state.file.edited)
    }

    /// A mesh with its adjacency, built from the scene's at the first call.
    pub(crate) fn mesh(&mut self, id: MeshId) -> Option<&EditMesh> {
        if !self.state.file.edited.contains_key(&id) {
            let asset = self.state.file.native.scene.meshes().get(id)?;
            let (mesh, left_out) = EditMesh::from_mesh(asset.mesh());
            self.state.untold.extend(left_out.warnings(&asset.name));
            self.state.file.edited.insert(id, mesh);
        }
        self.state.shown.note_edited(id);
        self.state.file.edited.get(&id)
    }

    /// A copy of a mesh that is only looked at: unlike by [`Self::mesh`] nothing changes, so that undoing has nothing to
    /// restore.
    pub(crate) fn mesh_to_read(&self, id: MeshId) -> Option<EditMesh> {
        let edited = self.state.file.edited.get(&id).cloned();
        edited.or_else(|| Some(EditMesh::from_mesh(self.state.file.native.scene.meshes().get(id)?.mesh()).0))
    }

    /// An edited mesh after its modifiers, as a view shows it.
    pub(crate) fn evaluate(&mut self, id: MeshId) -> Option<&Evaluation> {
        let State { file, shown, .. } = &mut *self.state;
        file.edited.contains_key(&id).then(|| shown.evaluate(id, &file.native.scene, &file.edited))
    }

    /// The edited meshes that pass a test.
    pub(crate) fn edited_where(&self, is_one: impl Fn(&EditMesh) -> bool) -> Vec<MeshId> {
        let all = self.state.file.edited.iter();
        all.filter(|(_, mesh)| is_one(mesh)).map(|(id, _)| *id).collect()
    }

    /// What a modifier of a mesh uses of other objects, as it is now.
    pub(crate) fn objects_of(&self, id: MeshId, modifier: &Modifier) -> UsedObject {
        let file = &self.state.file;
        let objects = SceneObjects::new(&file.native.scene, &file.edited, None, id);
        UsedObject::of(&objects, modifier)
    }

    /// Changes a mesh. On an error that mesh is unchanged.
    pub(crate) fn edit<T>(
        &mut self,
        id: MeshId,
        change: impl FnOnce(&mut EditMesh) -> Result<T, EditError>,
    ) -> Result<T, EditError> {
        self.mesh(id);
        let memory = self.memory();
        let Some(mesh) = self.state.file.edited.get_mut(&id) else {
            return Err(SceneError::NoSuchMesh(id).into());
        };
        let (result, mut difference) = mesh.transaction_within(memory, change)?;
        if let Some(vertex) = mesh.overflow(&difference) {
            difference.apply(mesh);
            return Err(Refusal::Overflow(vertex).into());
        }
        if !difference.is_empty() {
            self.state.shown.note_difference(id, mesh, &difference);
            self.meshes.push((id, difference));
            if let Some(mesh) = self.state.file.edited.get(&id) {
                self.state.selection.keep_selectable(id, mesh);
            }
        }
        Ok(result)
    }

    /// A copy of a mesh as it is now, for another object.
    pub(crate) fn copy_mesh(&mut self, id: MeshId) -> Option<MeshId> {
        let asset = self.state.file.native.scene.meshes().get(id)?;
        let (name, mesh) = (asset.name.clone(), asset.mesh().clone());
        let edited = self.state.file.edited.get(&id).cloned();
        // Meshes are only ever added, so this needs no record: an undone copy stays unused.
        let copy = self.state.file.native.scene.add_mesh(name, mesh);
        if let Some(edited) = edited {
            self.state.file.edited.insert(copy, edited);
            self.state.shown.note_mesh(copy);
        }
        Some(copy)
    }

    /// A name for a new object: the wanted one, with a number if another object has it.
    pub(crate) fn free_name(&self, wanted: &str) -> String {
        Names::of(self.scene()).take(wanted)
    }

    /// Makes a part of a mesh a separate object, next to the object that shows the mesh. Returns it.
    pub(crate) fn add_part(&mut self, of: MeshId, part: EditMesh) -> NodeId {
        let owner = self.state.owner(of);
        let mut node = owner.and_then(|id| self.scene().node(id)).cloned().unwrap_or_default();
        node.name = self.free_name(&node.name);
        // The part is a piece of the mesh alone.
        (node.light, node.camera) = (None, None);
        node.mesh = Some(self.add_mesh(node.name.clone(), part));
        let scene = self.scene_mut();
        let child = node.parent().and_then(|parent| scene.add_child(parent, node.clone()));
        child.unwrap_or_else(|| scene.add(node))
    }

    /// Adds an edited mesh.
    fn add_mesh(&mut self, name: String, edited: EditMesh) -> MeshId {
        let (mesh, _) = edited.to_mesh();
        let id = self.state.file.native.scene.add_mesh(name, mesh);
        self.set_edited(id, edited);
        id
    }

    /// Makes a mesh that was just added to the scene an edited one.
    pub(crate) fn set_edited(&mut self, id: MeshId, edited: EditMesh) {
        self.state.file.edited.insert(id, edited);
        self.state.shown.note_mesh(id);
    }

    /// The meshes of objects, each once, in the order of objects.
    pub(crate) fn meshes_of(&self, objects: impl IntoIterator<Item = NodeId>) -> Vec<MeshId> {
        let mut meshes = Vec::new();
        for object in objects {
            let mesh = self.state.file.native.scene.node(object).and_then(|node| node.mesh);
            meshes.extend(mesh.filter(|mesh| !meshes.contains(mesh)));
        }
        meshes
    }

    /// The mesh of these objects, or the only edited one if none is given.
    pub(crate) fn only_edited_mesh(
        &self,
        objects: impl IntoIterator<Item = NodeId>,
        command: &'static str,
    ) -> Result<MeshId, EditError> {
        let mut meshes = self.meshes_of(objects);
        if meshes.is_empty() {
            meshes = self.selection().meshes().map(|(mesh, _)| mesh).collect();
        }
        match meshes[..] {
            [] => Err(EditError::NotEditing(command)),
            [id] if self.selection().of(id).is_none() => Err(EditError::NotEditing(command)),
            [id] => Ok(id),
            _ => Err(EditError::NothingSelected { command, needed: "the object with the elements" }),
        }
    }

    /// Changes each edited mesh with a selection. `change` gets the selection and returns the new
    /// one. A mesh whose change fails is skipped if another succeeds. Returns how many were
    /// changed.
    pub(crate) fn edit_selected(
        &mut self,
        command: &'static str,
        needed: &'static str,
        mut operation: impl FnMut(&mut EditMesh, &MeshSelection) -> Result<AfterEdit, Refusal>,
    ) -> Result<usize, EditError> {
        self.edit_selected_meshes(command, needed, |_, mesh, selection| operation(mesh, selection))
    }

    /// The same for a change that needs to know the mesh.
    pub(crate) fn edit_selected_meshes(
        &mut self,
        command: &'static str,
        needed: &'static str,
        mut operation: impl FnMut(MeshId, &mut EditMesh, &MeshSelection) -> Result<AfterEdit, Refusal>,
    ) -> Result<usize, EditError> {
        if !self.selection().is_editing() {
            return Err(EditError::NotEditing(command));
        }
        let kind = self.selection().kind();
        let selected = |(id, selection): (MeshId, &MeshSelection)| {
            (!selection.is_empty()).then(|| (id, selection.clone()))
        };
        let meshes: Vec<_> = self.selection().meshes().filter_map(selected).collect();
        let mut refused = None;
        let mut changed = 0;
        for (id, selection) in meshes {
            match self.edit(id, |mesh| operation(id, mesh, &selection).map_err(EditError::from)) {
                Ok(result) => {
                    changed += 1;
                    let (selections, meshes) = self.selection_and_meshes();
                    if let (Some(selection), Some(mesh)) = (selections.of_mut(id), meshes.get(&id)) {
                        match result {
                            AfterEdit::Select(elements) => selection.select(mesh, kind, &elements),
                            AfterEdit::Clear => selection.clear(),
                            AfterEdit::Keep => {}
                        }
                    }
                }
                Err(refusal) => refused = Some(refusal),
            }
        }
        match refused {
            Some(refusal) if changed == 0 => Err(refusal),
            None if changed == 0 => Err(EditError::NothingSelected { command, needed }),
            _ => Ok(changed),
        }
    }

    /// Changes the selected vertices of each edited mesh; the selection is kept.
    pub(crate) fn edit_selected_vertices(
        &mut self,
        command: &'static str,
        needed: &'static str,
        mut operation: impl FnMut(&mut EditMesh, &[VertexId]) -> Result<(), Refusal>,
    ) -> Result<usize, EditError> {
        let kind = self.selection().kind();
        self.edit_selected(command, needed, |mesh, selection| {
            operation(mesh, &selection.vertices(mesh, kind))?;
            Ok(AfterEdit::Keep)
        })
    }

    /// Changes the selected edges of each edited mesh; the selection is kept.
    pub(crate) fn edit_selected_edges(
        &mut self,
        command: &'static str,
        needed: &'static str,
        mut operation: impl FnMut(&mut EditMesh, &[EdgeId]) -> Result<(), Refusal>,
    ) -> Result<usize, EditError> {
        let kind = self.selection().kind();
        self.edit_selected(command, needed, |mesh, selection| {
            operation(mesh, &selection.edges(mesh, kind))?;
            Ok(AfterEdit::Keep)
        })
    }

    /// Changes the selected faces of each edited mesh; the selection is kept.
    pub(crate) fn edit_selected_faces(
        &mut self,
        command: &'static str,
        needed: &'static str,
        mut operation: impl FnMut(&mut EditMesh, &[FaceId]) -> Result<(), Refusal>,
    ) -> Result<usize, EditError> {
        let kind = self.selection().kind();
        self.edit_selected(command, needed, |mesh, selection| {
            operation(mesh, &selection.faces(mesh, kind))?;
            Ok(AfterEdit::Keep)
        })
    }
}
