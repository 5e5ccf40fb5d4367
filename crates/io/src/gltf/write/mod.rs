//! Scenes to GLB: for other programs, and as trigon's own file.
//!
//! `draft` (lists of objects, and the bytes of the buffer) is filled by `scene`, part by part:
//! `nodes`, `meshes` with `geometry`, `materials` with `textures`, `movement`. If the scene
//! came from a glTF, the draft starts as that file (`kept`), and each part changes only what
//! differs from it, as text (`raw`): what nobody touched is written as it was read. `freed` takes
//! out what meshes leave behind that are written anew.

mod draft;
mod freed;
mod geometry;
mod glb_file;
mod kept;
mod materials;
mod meshes;
mod movement;
mod native_document;
mod nodes;
mod raw;
mod scene;
mod textures;

use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;

use trigon_math::{DAffine3, DMat3, DVec3};
use trigon_mesh::edit::Marks;
use trigon_scene::{MeshId, NodeId, Scene};

pub use native_document::{NativeDocument, NativeFile};
use scene::{Input, write_scene};

use super::source::GltfSource;
use crate::error::Place;
use crate::write::{WriteError, write_atomically};

/// Which way is up in a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UpAxis {
    /// +Y, as glTF defines it.
    #[default]
    Y,
    /// +Z, for programs that take no notice of what glTF defines.
    Z,
}

/// How to write a GLB.
#[derive(Clone, Debug)]
pub struct GlbOptions<'a> {
    /// The nodes to write, in their places; all by default. What hangs on them is written only
    /// if it is named, too.
    pub nodes: Option<Vec<NodeId>>,
    /// Units of the file per metre: 1 is what glTF defines. Positive and finite, else it counts as 1.
    pub scale: f64,
    /// Which way is up.
    pub up: UpAxis,
    /// The file that the scene came from: pictures are taken from it as they were encoded.
    /// Others are written as PNG.
    pub pictures: Option<&'a GltfSource>,
}

impl Default for GlbOptions<'_> {
    fn default() -> Self {
        Self { nodes: None, scale: 1.0, up: UpAxis::Y, pictures: None }
    }
}

impl GlbOptions<'_> {
    /// The map from the scene to the file; none if they are the same.
    fn root(&self) -> Option<DAffine3> {
        let scale = if self.scale > 0.0 && self.scale.is_finite() { self.scale } else { 1.0 };
        let turn = match self.up {
            UpAxis::Y => DMat3::IDENTITY,
            UpAxis::Z => DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y),
        };
        let map = DAffine3::from_mat3(turn * DMat3::from_diagonal(DVec3::splat(scale)));
        Some(map).filter(|map| *map != DAffine3::IDENTITY)
    }
}

/// The scene as one self-contained GLB, for other programs: nodes, meshes as triangles (loose
/// edges as lines, loose points as points), materials with their pictures, lights, cameras,
/// skins, morph targets and animations.
///
/// glTF has no Lambert and no Blinn-Phong: what comes near is written, and the exact model
/// beside it in `extras`. It has no ambient light and no off-centre cameras. Transforms keep
/// all digits of their f64; most programs round them to f32.
///
/// ```
/// use trigon_io::{GlbOptions, LoadOptions, encode_glb, load_from_slice};
/// use trigon_scene::showcase;
///
/// let scene = showcase();
/// let glb = encode_glb(&scene, &GlbOptions::default())?;
/// let again = load_from_slice("showcase.glb", &glb, &LoadOptions::default())?;
/// assert_eq!(again.scene.nodes().len(), scene.nodes().len());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// When the file would have 4 GiB or more.
pub fn encode_glb(scene: &Scene, options: &GlbOptions<'_>) -> Result<Vec<u8>, WriteError> {
    Ok(write_scene(&export(scene, options))?.file.to_bytes())
}

/// Writes a file as [`encode_glb`] makes it; an old one of that name is replaced at once or
/// not at all.
///
/// # Errors
/// As [`encode_glb`], or when the file cannot be written.
pub fn write_glb(path: impl AsRef<Path>, scene: &Scene, options: &GlbOptions<'_>) -> Result<(), WriteError> {
    let written = write_scene(&export(scene, options))?;
    write_atomically(path.as_ref(), |file| written.file.write_to(file))
}

fn export<'a>(scene: &'a Scene, options: &'a GlbOptions<'a>) -> Input<'a> {
    Input {
        scene,
        edited: None,
        kept: None,
        pictures: options.pictures,
        nodes: options.nodes.as_deref(),
        root: options.root(),
    }
}

/// A file, and what was made of it: what is the same in a scene is the same in the file.
#[derive(Debug)]
struct KeptFile {
    source: GltfSource,
    scene: Scene,
    marks: BTreeMap<MeshId, Marks>,
}

/// Something that a file holds, or a scene, and that would not be there any more after saving.
/// Its `Display` is one line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Loss {
    /// Where it is in the file that was loaded, or in the scene.
    pub place: Place,
    /// What it is.
    pub what: String,
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let place = self.place.to_string();
        match place.strip_prefix(", ") {
            Some(place) => write!(f, "{place}: {}", self.what),
            None => f.write_str(&self.what),
        }
    }
}
