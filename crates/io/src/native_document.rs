//! The editor's native file: a GLB that every program reads, with everything that is edited besides
//! the triangles.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use trigon_camera::UpAxis;
use trigon_modelling::EditMesh;
use trigon_scene::{MeshId, Scene};

use crate::error::{LoadError, Place};
use crate::export::{Export, ExportOptions};
use crate::format::Format;
use crate::formats::export;
use crate::formats::gltf::{GlbFile, Input, KeptFile, exported, write_scene};
use crate::load::{Loaded, load, load_from_slice};
use crate::loss::Loss;
use crate::options::LoadOptions;
use crate::warning::{Warning, Warnings};
use crate::write::{WriteError, write_atomically};

/// A scene with the meshes that are being edited, and the glTF file that it came from.
///
/// Saving writes one GLB. It contains polygons, original positions, marks and all values of meshes
/// besides their triangles, restored to the bit on reading; if another program changed the
/// triangles of a mesh in the meantime, these are used, with a warning. Unchanged parts of a loaded
/// glTF (including what trigon does not know: extensions, `extras`, other scenes) are written back
/// as they were read; anything that cannot be is listed before anything is written.
///
/// ```
/// use trigon_io::{LoadOptions, NativeDocument};
/// use trigon_modelling::EditMesh;
/// use trigon_mesh::math::Vec3;
/// use trigon_mesh::primitives;
/// use trigon_scene::{Material, Scene};
///
/// let mut scene = Scene::new();
/// scene.add_object("cube", primitives::cube(2.0), Material::default());
/// let mut document = NativeDocument::new(scene);
/// let (id, asset) = document.scene.meshes().iter().next().expect("one was added");
/// let (mut cube, _) = EditMesh::from_mesh(asset.mesh());
/// let corner = cube.vertices().next().expect("a cube has eight");
/// cube.set_position(corner, Vec3::ONE * 3.0);
/// document.edited.insert(id, cube.clone());
///
/// let file = document.encode()?;
/// assert!(file.what_would_be_lost().is_empty());
/// let bytes = file.to_bytes();
///
/// let (again, warnings) = NativeDocument::load_from_slice("cube.glb", &bytes, &LoadOptions::default())?;
/// assert!(warnings.is_empty());
/// let (_, again) = again.edited.iter().next().expect("it is still being edited");
/// assert!(*again == cube, "also where the corner was before");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// A clone shares textures and the loaded file; meshes that are being edited are copied.
#[derive(Debug, Clone, Default)]
pub struct NativeDocument {
    /// The scene, with +Y up as in glTF: a loaded file in which another axis is up is turned
    /// ([`Scene::turn_to`]). A mesh that is being edited may be outdated here.
    pub scene: Scene,
    /// The meshes that are being edited: these are saved instead of the scene's.
    pub edited: BTreeMap<MeshId, EditMesh>,
    kept: Option<Arc<KeptFile>>,
}

impl NativeDocument {
    /// A document without a file. The scene is turned if another axis than +Y is up in it.
    #[must_use]
    pub fn new(mut scene: Scene) -> Self {
        scene.turn_to(UpAxis::Y);
        Self { scene, edited: BTreeMap::new(), kept: None }
    }

    /// Loads a file of any readable format. A glTF is kept for writing it back.
    ///
    /// # Errors
    /// As [`load`].
    pub fn load(
        path: impl AsRef<Path>,
        options: &LoadOptions<'_>,
    ) -> Result<(Self, Vec<Warning>), LoadError> {
        let path = path.as_ref();
        Ok(Self::from_loaded(path, load(path, &keeping(options))?))
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
        let name = name.as_ref();
        Ok(Self::from_loaded(name, load_from_slice(name, bytes, &keeping(options))?))
    }

    fn from_loaded(name: &Path, loaded: Loaded) -> (Self, Vec<Warning>) {
        let Loaded { mut scene, marks, source, mut warnings, .. } = loaded;
        let mut edited = BTreeMap::new();
        let mut about = Warnings::about(name);
        for (&id, marks) in &marks {
            let Some(asset) = scene.meshes().get(id) else { continue };
            match EditMesh::from_mesh_and_marks(asset.mesh(), marks) {
                Ok((mesh, _)) => drop(edited.insert(id, mesh)),
                Err(error) => {
                    let place = Place::Named(format!("mesh \"{}\"", asset.name));
                    let what = format!("marks and original positions are left out: {error}");
                    about.push(place, what, "open an older copy of the file if you need them");
                }
            }
        }
        warnings.extend(about.into_list());
        let kept = source.map(|source| Arc::new(KeptFile { source, scene: scene.clone(), marks }));
        scene.turn_to(UpAxis::Y);
        (Self { scene, edited, kept }, warnings)
    }

    /// The document as a file, not written yet, so that the caller can first ask about losses.
    ///
    /// # Errors
    /// The file would have 4 GiB or more.
    pub fn encode(&self) -> Result<NativeFile<'_>, WriteError> {
        let written = write_scene(&Input {
            scene: &self.scene,
            edited: Some(&self.edited),
            kept: self.kept.as_deref(),
            images: self.kept.as_ref().map(|kept| &kept.source),
            nodes: None,
            root: None,
        })?;
        Ok(NativeFile { file: written.file, losses: written.losses })
    }

    /// The document for other programs; see [`export`](crate::export). A mesh with a subdivision surface
    /// ([`EditMesh::subdivision`]) is written as that surface, with all levels. Images are those of the
    /// loaded file, unless the options name another.
    ///
    /// # Errors
    /// As [`export`](crate::export), or a subdivision surface is too large.
    pub fn export(
        &self,
        name: &str,
        format: Format,
        options: &ExportOptions<'_>,
    ) -> Result<Export, WriteError> {
        // Meshes are shared: a copy of the scene only copies its lists.
        let mut scene = self.scene.clone();
        for (&id, edited) in &self.edited {
            if let Some(asset) = self.scene.meshes().get(id) {
                let mesh = exported(asset, edited);
                let mesh = mesh.map_err(|source| WriteError::Surface { name: asset.name.clone(), source })?;
                scene.replace_mesh(id, mesh);
            }
        }
        let images = options.images.or(self.kept.as_ref().map(|kept| &kept.source));
        export(&scene, name, format, &ExportOptions { images, ..options.clone() })
    }
}

fn keeping<'a>(options: &LoadOptions<'a>) -> LoadOptions<'a> {
    LoadOptions { keep_source: true, ..options.clone() }
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
