//! What commands on whole meshes share.

use trigon_modelling::EditMesh;
use trigon_scene::MeshId;

use crate::error::EditError;
use crate::selection::ElementKind;
use crate::state::Change;

/// The meshes that are edited, or those of the selected objects. `command` names the command in the error
/// if there are none.
pub(super) fn whole_meshes(change: &Change<'_>, command: &'static str) -> Result<Vec<MeshId>, EditError> {
    let ids: Vec<MeshId> = if change.selection().is_editing() {
        change.selection().meshes().map(|(id, _)| id).collect()
    } else {
        change.meshes_of(change.selection().objects.iter().copied())
    };
    if ids.is_empty() {
        return Err(EditError::NothingSelected { command, needed: "at least one object with a mesh" });
    }
    Ok(ids)
}

/// Gives a mesh other edges and faces throughout, so that those selected before are gone whatever their
/// numbers; vertices stay selected. Returns how many faces it has.
pub(super) fn remake(
    change: &mut Change<'_>,
    id: MeshId,
    with: impl FnOnce(&mut EditMesh) -> Result<(), EditError>,
) -> Result<usize, EditError> {
    let faces = change.edit(id, |mesh| {
        with(mesh)?;
        Ok(mesh.face_count())
    })?;
    let kind = change.selection().kind();
    let selection = change.selection_mut().of_mut(id);
    if let Some(selection) = selection.filter(|_| kind != ElementKind::Vertex) {
        selection.clear();
    }
    Ok(faces)
}
