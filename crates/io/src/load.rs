//! The entry points: from a file or a stream to a scene and warnings.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use rayon::ThreadPoolBuilder;
use trigon_mesh::EditData;
use trigon_scene::{MeshId, Scene};

use super::refusal::is_lfs_pointer;
use crate::error::{LoadError, LoadErrorKind, Location};
use crate::folder::Folder;
use crate::format::Format;
use crate::formats::{detect_format, supported};
use crate::gltf_source::{GltfSource, SourceDraft};
use crate::import::Import;
use crate::options::{LoadOptions, LoadStage};
use crate::refusal::Refusal;
use crate::warning::{Warning, Warnings};

/// A loaded model.
#[derive(Debug)]
#[non_exhaustive]
pub struct Loaded {
    /// The contents of the file, in its own coordinates; [`Scene::up`] says which axis is up.
    pub scene: Scene,
    /// The names of all scenes in the file, in order; `scene` is one of them. Empty for formats
    /// without scenes.
    pub scene_names: Vec<String>,
    /// The names of all variants of the file's materials, in order. Empty for formats without variants.
    pub variant_names: Vec<String>,
    /// What could not be loaded, and why.
    pub warnings: Vec<Warning>,
    /// Every file that was read, the model first: watch these for changes.
    pub files: Vec<PathBuf>,
    /// The format that was found.
    pub format: Format,
    /// The file itself, for writing it back; only for glTF and GLB, and only with
    /// [`LoadOptions::keep_source`].
    pub source: Option<GltfSource>,
    /// The edit data of the meshes that were being edited when a native file was saved; see
    /// [`NativeDocument`](crate::NativeDocument).
    pub edit_data: BTreeMap<MeshId, EditData>,
}

/// Loads a model file and the files it refers to, nothing outside its folder.
///
/// The format follows from the name, or from the contents if the name has no known extension.
/// Problems that leave something to draw are warnings.
///
/// # Errors
/// The file cannot be read, has no supported format, is too broken to use, exceeds the limits, or
/// contains nothing to draw.
pub fn load(path: impl AsRef<Path>, options: &LoadOptions<'_>) -> Result<Loaded, LoadError> {
    let path = path.as_ref();
    options.report(path, LoadStage::Reading, 0.0)?;
    if path.is_dir() {
        return Err(LoadError::new(LoadErrorKind::Read, path, "it is a folder", "name a file in it"));
    }
    let mut folder = Folder::of(path, &options.limits).map_err(|error| LoadError::read(path, &error))?;
    let follow = |share| options.report(path, LoadStage::Reading, share).map_err(|_| Refusal::Cancelled);
    let bytes = folder.read_model(path, &follow)?;
    options.report(path, LoadStage::Reading, 1.0)?;
    import_on(path, Cow::Owned(bytes), folder, options)
}

/// Loads a model from memory, such as standard input. It cannot refer to files, so a GLB or an OBJ
/// without materials works best. `name` stands for the file in messages, and its extension may
/// determine the format.
///
/// # Errors
/// As [`load`].
pub fn load_from_slice(
    name: impl AsRef<Path>,
    bytes: &[u8],
    options: &LoadOptions<'_>,
) -> Result<Loaded, LoadError> {
    let name = name.as_ref();
    let (length, limit) = (bytes.len() as u64, options.limits.file_bytes);
    if length > limit {
        return Err(Refusal::TooLarge(length, limit).of_model(name));
    }
    if is_lfs_pointer(bytes) {
        return Err(Refusal::LfsPointer.of_model(name));
    }
    options.report(name, LoadStage::Reading, 1.0)?;
    import_on(name, Cow::Borrowed(bytes), Folder::none(&options.limits), options)
}

/// Loads a model from files in memory, such as those that were dropped on a web page. `files` holds them by their
/// paths from a common folder, with `/` between names; `model` is one of these paths. As on the disk, the model finds the
/// files in its own folder and below it, and no others.
///
/// ```
/// use trigon_io::{LoadOptions, load_from_files};
///
/// let obj = b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";
/// let files = [("models/a.obj", &obj[..]), ("models/a.mtl", b"newmtl red\nKd 1 0 0\n")];
/// let files = files.into_iter().map(|(path, bytes)| (path.to_owned(), bytes.to_vec())).collect();
/// let loaded = load_from_files("models/a.obj", files, &LoadOptions::default())?;
/// assert!(loaded.warnings.is_empty());
/// assert_eq!(loaded.files.len(), 2);
/// # Ok::<(), trigon_io::LoadError>(())
/// ```
///
/// # Errors
/// As [`load`]; there is no file of the model's path.
pub fn load_from_files(
    model: &str,
    mut files: BTreeMap<String, Vec<u8>>,
    options: &LoadOptions<'_>,
) -> Result<Loaded, LoadError> {
    let path = Path::new(model);
    let bytes = files.remove(model).ok_or_else(|| Refusal::Missing.of_model(path))?;
    let mut folder = Folder::in_memory(path, files, &options.limits);
    let bytes = folder.accepted_model(path, bytes)?;
    options.report(path, LoadStage::Reading, 1.0)?;
    import_on(path, Cow::Owned(bytes), folder, options)
}

/// Imports with the number of threads in the options.
fn import_on(
    path: &Path,
    bytes: Cow<'_, [u8]>,
    folder: Folder,
    options: &LoadOptions<'_>,
) -> Result<Loaded, LoadError> {
    let Some(threads) = options.threads else { return import(path, bytes, folder, options) };
    let pool = ThreadPoolBuilder::new().num_threads(threads.get()).build().map_err(|error| {
        let what = format!("there are no {threads} threads to load it with ({error})");
        LoadError::new(LoadErrorKind::Read, path, what, "use fewer threads")
    })?;
    pool.install(|| import(path, bytes, folder, options))
}

fn import(
    path: &Path,
    bytes: Cow<'_, [u8]>,
    folder: Folder,
    options: &LoadOptions<'_>,
) -> Result<Loaded, LoadError> {
    let format = options.format.map_or_else(|| detect_format(path, &bytes), Ok).map_err(|what| {
        LoadError::new(
            LoadErrorKind::Unsupported,
            path,
            what,
            format!("export it as GLB, for example from Blender; {}", supported()),
        )
    })?;
    let mut scene = Scene::new();
    scene.up = options.up.unwrap_or(format.up());
    let mut import = Import {
        path,
        options,
        folder,
        warnings: Warnings::about(path),
        scene,
        scene_names: Vec::new(),
        variant_names: Vec::new(),
        source: options.keep_source.then(SourceDraft::default),
        edit_data: BTreeMap::new(),
    };
    (format.row().import)(&mut import, bytes)?;
    options.report(path, LoadStage::Textures, 1.0)?;
    if let Some(wanted) = options.variant.as_ref().filter(|_| import.variant_names.is_empty()) {
        let what = format!("it has no variants of its materials, so there is no {wanted:?}");
        import.warnings.push(Location::Whole, what, "choose a variant for files that have some");
    }
    let Import { folder, warnings, scene, scene_names, variant_names, source, edit_data, .. } = import;
    let (warnings, files) = (warnings.into_list(), folder.into_files());
    let source = source.and_then(SourceDraft::finish);
    Ok(Loaded { scene, scene_names, variant_names, warnings, files, format, source, edit_data })
}
