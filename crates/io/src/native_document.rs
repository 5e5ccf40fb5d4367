//! The editor's native file: a GLB that every program reads, with everything that is edited besides
//! the triangles.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use trigon_camera::UpAxis;
use trigon_mesh::{EditData, Mesh};
use trigon_scene::{MeshId, Scene};

use super::export::Loss;
use crate::error::LoadError;
use crate::export::{Export, ExportOptions};
use crate::format::Format;
use crate::formats::export;
use crate::formats::gltf::{GlbFile, Input, RetainedFile, write_scene};
use crate::load::{Loaded, load, load_from_slice};
use crate::options::LoadOptions;
use crate::warning::Warning;
use crate::write::{WriteError, write_atomically};

/// A scene with the edit data of its meshes, and the glTF file that it came from.
///
/// Saving writes one GLB. It contains polygons, edit data and all values of meshes besides their triangles,
/// restored to the bit on reading. If another program changed the triangles of a mesh in the meantime, the
/// changed triangles are used, with a warning. Unchanged parts of a loaded glTF (including what trigon does
/// not know: extensions, `extras`, other scenes) are written back as they were read; anything that cannot be
/// is listed before anything is written.
///
/// ```
/// use trigon_io::{LoadOptions, NativeDocument};
/// use trigon_mesh::{EdgeMark, EditData, primitives};
/// use trigon_scene::{Material, Scene};
///
/// let mut scene = Scene::new();
/// scene.add_object("cube", primitives::cube(2.0), Material::default());
/// let mut document = NativeDocument::new(scene);
/// let (id, asset) = document.scene.meshes().iter().next().expect("one was added");
/// let vertices = asset.mesh().edges()[0];
/// let edges = vec![EdgeMark { vertices, crease: 0.5, ..EdgeMark::default() }];
/// let data = EditData { edges, ..EditData::default() };
/// document.edit_data.insert(id, data.clone());
///
/// let file = document.encode()?;
/// assert!(file.what_would_be_lost().is_empty());
/// let bytes = file.to_bytes();
///
/// let (again, warnings) = NativeDocument::load_from_slice("cube.glb", &bytes, &LoadOptions::default())?;
/// assert!(warnings.is_empty());
/// let again = again.edit_data.values().next().expect("the mesh still has its data");
/// assert!(*again == data, "the crease is still there");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// A clone shares meshes, textures and the loaded file.
#[derive(Debug, Clone, Default)]
pub struct NativeDocument {
    /// The scene, with +Y up as in glTF: a loaded file in which another axis is up is turned
    /// ([`Scene::turn_to`]).
    pub scene: Scene,
    /// What is saved with the meshes that are being edited. It is read as it stands in the file: whether it
    /// belongs to the mesh, the caller checks.
    pub edit_data: BTreeMap<MeshId, EditData>,
    /// Every file that its contents were read from, the model first: none of them but the model is to be replaced by an
    /// export.
    pub files: Vec<PathBuf>,
    retained: Option<Arc<RetainedFile>>,
}

impl NativeDocument {
    /// A document without a file. The scene is turned if another axis than +Y is up in it.
    #[must_use]
    pub fn new(mut scene: Scene) -> Self {
        scene.turn_to(UpAxis::Y);
        Self { scene, ..Self::default() }
    }

    /// Loads a file of any readable format. A glTF is kept for writing it back. A file with nothing to draw is a document
    /// without anything to draw.
    ///
    /// # Errors
    /// As [`load`].
    pub fn load(
        path: impl AsRef<Path>,
        options: &LoadOptions<'_>,
    ) -> Result<(Self, Vec<Warning>), LoadError> {
        Ok(Self::from_loaded(load(path, &keeping(options))?))
    }

    /// Loads a file from memory. `name` stands for it in messages.
    ///
    /// # Errors
    /// As [`load_from_slice`].
    pub fn load_from_slice(
        name: impl AsRef<Path>,
        bytes: &[u8],
        options: &LoadOptions<'_>,
    ) -> Result<(Self, Vec<Warning>), LoadError> {
        Ok(Self::from_loaded(load_from_slice(name, bytes, &keeping(options))?))
    }

    fn from_loaded(loaded: Loaded) -> (Self, Vec<Warning>) {
        let Loaded { mut scene, edit_data, source, warnings, files, .. } = loaded;
        let keep =
            |source| Arc::new(RetainedFile { source, scene: scene.clone(), edit_data: edit_data.clone() });
        let retained = source.map(keep);
        scene.turn_to(UpAxis::Y);
        (Self { scene, edit_data, files, retained }, warnings)
    }

    /// A mesh as it was read from a glTF, with its edit data if it has any. A document with the same mesh and
    /// data is written with that mesh as it stands in the file.
    #[must_use]
    pub fn loaded_mesh(&self, id: MeshId) -> Option<(&Mesh, Option<&EditData>)> {
        let retained = self.retained.as_ref()?;
        Some((retained.scene.meshes().get(id)?.mesh(), retained.edit_data.get(&id)))
    }

    /// The document as a file, not written yet, so that the caller can first ask about losses.
    ///
    /// # Errors
    /// The file would have 4 GiB or more.
    pub fn encode(&self) -> Result<NativeFile<'_>, WriteError> {
        let written = write_scene(&Input {
            scene: &self.scene,
            edit_data: Some(&self.edit_data),
            retained: self.retained.as_deref(),
            images: self.retained.as_ref().map(|retained| &retained.source),
            nodes: None,
            root: None,
        })?;
        Ok(NativeFile { file: written.file, losses: written.losses })
    }

    /// The scene for other programs; see [`export`](crate::export). Edit data are left out, and meshes are written
    /// as they are edited, without their modifiers. Images are those of the loaded file, unless the options name another.
    ///
    /// # Errors
    /// As [`export`](crate::export).
    pub fn export(
        &self,
        name: &str,
        format: Format,
        options: &ExportOptions<'_>,
    ) -> Result<Export, WriteError> {
        let images = options.images.or(self.retained.as_ref().map(|retained| &retained.source));
        export(&self.scene, name, format, &ExportOptions { images, ..options.clone() })
    }
}

fn keeping<'a>(options: &LoadOptions<'a>) -> LoadOptions<'a> {
    LoadOptions { keep_source: true, may_be_empty: true, ..options.clone() }
}

/// A document ready to be written.
pub struct NativeFile<'a> {
    file: GlbFile<'a>,
    losses: Vec<Loss>,
}

impl NativeFile<'_> {
    /// What the loaded file or the scene contains, and this one does not.
    #[must_use]
    pub fn what_would_be_lost(&self) -> &[Loss] {
        &self.losses
    }

    /// The bytes of the file.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        self.file.to_bytes()
    }

    /// Writes the file; an old one of that name is replaced at once or not at all.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), WriteError> {
        write_atomically(path.as_ref(), |file| self.file.write_to(file))
    }
}

impl std::fmt::Debug for NativeFile<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("NativeFile").field("losses", &self.losses).finish_non_exhaustive()
    }
}
