//! What files hold of a document: its scene, and the meshes that are being edited with their edit data.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use thiserror::Error;
use trigon_io::{Export, ExportOptions, Format, Location, NativeDocument, Warning, WriteError};
use trigon_mesh::{EditData, Mesh};
use trigon_modelling::{EditMesh, Refusal};
use trigon_scene::{MeshAsset, MeshId, NodeId};

use crate::objects::SceneObjects;

/// What a file holds of a document, with its meshes as they are edited. A clone shares everything but these, and
/// another thread can save it while editing continues.
#[derive(Debug, Clone, Default)]
pub struct DocumentFile {
    /// The scene, without edit data. A mesh that is being edited may be outdated here.
    pub(crate) native: NativeDocument,
    /// The meshes that are being edited: these are saved instead of the scene's.
    pub(crate) edited: BTreeMap<MeshId, EditMesh>,
}

/// Why a document was not exported.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The scene cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// What the modifiers of a mesh make is too large.
    #[error("mesh \"{name}\": {source}")]
    Modifiers {
        /// The name of the mesh.
        name: String,
        /// Why it cannot be made.
        source: Refusal,
    },
}

impl DocumentFile {
    /// Makes the meshes with edit data editable. Data that do not belong to their mesh are left out with a warning,
    /// in which `name` stands for the file.
    pub(crate) fn open(mut native: NativeDocument, name: &Path, warnings: &mut Vec<Warning>) -> Self {
        let mut edited = BTreeMap::new();
        for (id, data) in std::mem::take(&mut native.edit_data) {
            let Some(asset) = native.scene.meshes().get(id) else { continue };
            match EditMesh::from_mesh_and_data(asset.mesh(), &data) {
                Ok((mesh, _)) => drop(edited.insert(id, mesh)),
                Err(error) => {
                    let location = Location::Named(format!("mesh \"{}\"", asset.name));
                    let what = format!("marks and original positions are left out: {error}");
                    let remedy = "open an older copy of the file if you need them";
                    warnings.push(Warning::new(name, location, &what, remedy));
                }
            }
        }
        Self { native, edited }
    }

    /// The document as trigon's own file holds it: [`NativeDocument::encode`] makes the file. Takes the time to
    /// convert the meshes that are or were edited.
    #[must_use]
    pub fn to_native(&self) -> NativeDocument {
        let nodes = self.native.scene.nodes();
        let shown: BTreeSet<MeshId> = nodes.iter().filter_map(|(_, node)| node.mesh).collect();
        // Meshes are shared: a copy of the scene only copies its lists.
        let mut native = self.native.clone();
        for (&id, edited) in self.edited.iter().filter(|(id, _)| shown.contains(id)) {
            if let Some(asset) = self.native.scene.meshes().get(id) {
                let (mesh, data) = self.saved_mesh(id, asset, edited);
                native.scene.replace_mesh(id, mesh);
                native.edit_data.insert(id, data);
            }
        }
        native
    }

    /// A mesh that is being edited, as it is saved: as it was loaded if nothing has changed, also where converting it
    /// there and back would change how it is stored.
    fn saved_mesh(&self, id: MeshId, asset: &MeshAsset, edited: &EditMesh) -> (Mesh, EditData) {
        let (mut now, map) = edited.to_mesh();
        if let Some((was, data)) = self.native.loaded_mesh(id) {
            let data = data.cloned().unwrap_or_default();
            // Most changes are found here, and the rest takes as long as saving everything.
            let is_alike =
                was.positions() == now.positions() && was.corner_vertices() == now.corner_vertices();
            let is_same = |(first, _): (EditMesh, _)| first == *edited;
            if is_alike && EditMesh::from_mesh_and_data(was, &data).is_ok_and(is_same) {
                return (was.clone(), data);
            }
        }
        name_targets(&mut now, asset);
        (now, edited.edit_data(&map))
    }

    /// The document for other programs; see [`trigon_io::export()`]. A mesh with modifiers
    /// ([`EditMesh::modifiers`]) is written as all that are on make it, unless the options say otherwise. Images are those of
    /// the loaded file, unless the options name another.
    ///
    /// # Errors
    /// As [`trigon_io::export()`], or what modifiers make is too large ([`EditMesh::evaluated`]).
    pub fn export(
        &self,
        name: &str,
        format: Format,
        options: &ExportOptions<'_>,
    ) -> Result<Export, ExportError> {
        let mut native = self.native.clone();
        for (&id, edited) in &self.edited {
            if let Some(asset) = self.native.scene.meshes().get(id) {
                let objects = SceneObjects::new(&self.native.scene, &self.edited, None, id);
                let evaluated = if options.modifiers { edited.evaluated(&objects) } else { Ok(None) };
                let refused = |source| ExportError::Modifiers { name: asset.name.clone(), source };
                let (mut mesh, _) = evaluated.map_err(refused)?.as_ref().unwrap_or(edited).to_mesh();
                name_targets(&mut mesh, asset);
                native.scene.replace_mesh(id, mesh);
            }
        }
        let mut export = native.export(name, format, options)?;
        for asset in self.exported_with_groups(options) {
            export.add_loss(Location::Named(format!("mesh \"{}\"", asset.name)), "vertex groups");
        }
        Ok(export)
    }

    /// The meshes of an export that have vertex groups, which no format holds.
    fn exported_with_groups(&self, options: &ExportOptions<'_>) -> Vec<&MeshAsset> {
        let is_chosen = |id: NodeId| options.nodes.as_ref().is_none_or(|nodes| nodes.contains(&id));
        let nodes = self.native.scene.nodes().iter().filter(|(id, _)| is_chosen(*id));
        let exported: BTreeSet<MeshId> = nodes.filter_map(|(_, node)| node.mesh).collect();
        let with_groups = self
            .edited
            .iter()
            .filter(|(id, mesh)| exported.contains(id) && mesh.vertex_group_names().len() > 0);
        with_groups.filter_map(|(&id, _)| self.native.scene.meshes().get(id)).collect()
    }
}

/// Gives morph targets the names that they have in the scene.
fn name_targets(mesh: &mut Mesh, asset: &MeshAsset) {
    let names = &asset.mesh().attributes().morph_targets;
    if !names.is_empty() {
        let mut attributes = mesh.attributes().clone();
        for (target, named) in attributes.morph_targets.iter_mut().zip(names) {
            target.name.clone_from(&named.name);
        }
        mesh.set_attributes(attributes).expect("only names are others");
    }
}

#[cfg(test)]
mod tests;
