//! The data of a load in progress, which every importer fills.

use std::collections::BTreeMap;
use std::path::Path;

use trigon_mesh::EditData;
use trigon_scene::{MeshId, Scene};

use crate::folder::Folder;
use crate::gltf_source::SourceDraft;
use crate::options::LoadOptions;
use crate::warning::Warnings;

/// A load in progress.
pub(crate) struct Import<'a> {
    /// The model's own file, as the caller named it.
    pub(crate) path: &'a Path,
    pub(crate) options: &'a LoadOptions<'a>,
    pub(crate) folder: Folder,
    pub(crate) warnings: Warnings,
    pub(crate) scene: Scene,
    /// Of all scenes in the file.
    pub(crate) scene_names: Vec<String>,
    /// Of all variants of its materials.
    pub(crate) variant_names: Vec<String>,
    /// The file itself, if it is kept.
    pub(crate) source: Option<SourceDraft>,
    /// Of the meshes of a native file that were being edited.
    pub(crate) edit_data: BTreeMap<MeshId, EditData>,
}
