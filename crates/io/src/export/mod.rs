//! Scenes for other programs, in formats that hold less than a scene does.
//!
//! `gather` puts every visible mesh in its place in the file, `losses` says what the format cannot
//! hold, and the module of the format writes (`obj/write`, `ply/write`, `stl/write`, `off/write`). A GLB
//! holds nearly everything and goes its own way (`gltf/write`).

mod gather;
mod losses;
mod number;
mod vertex_table;

use std::path::Path;

use trigon_math::{DAffine3, DMat3, DVec3};
use trigon_scene::{NodeId, Scene};

use crate::error::Place;
use crate::format::{Format, writers};
use crate::gltf::{GltfSource, Loss};
use crate::write::{WriteError, write_atomically};

pub(crate) use gather::{Gathered, Object};
pub(crate) use losses::{HeldPoints, Holds};
pub(crate) use number::{Precision, number_text, push_number};
pub(crate) use vertex_table::{Columns, VertexTable};

/// Which way is up in a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UpAxis {
    /// +Y, as glTF and OBJ define it.
    #[default]
    Y,
    /// +Z, as programs for printing and scanning have it.
    Z,
}

/// What faces are in a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FaceExport {
    /// Polygons, where the format has them.
    #[default]
    Polygons,
    /// Triangles.
    Triangles,
}

/// How numbers are in a file, where the format leaves a choice: PLY and STL.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Encoding {
    /// Bytes, the lowest first.
    #[default]
    Binary,
    /// Bytes, the highest first; only PLY has it, and STL is written with the lowest first.
    BinaryBigEndian,
    /// Decimal digits, as many as bring back the same number.
    Text,
}

/// How to write a model for other programs.
#[derive(Clone, Debug)]
pub struct ExportOptions<'a> {
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
    /// Whether polygons are cut into triangles. GLB and STL have nothing else.
    pub faces: FaceExport,
    /// How numbers are written.
    pub encoding: Encoding,
}

impl Default for ExportOptions<'_> {
    fn default() -> Self {
        Self {
            nodes: None,
            scale: 1.0,
            up: UpAxis::Y,
            pictures: None,
            faces: FaceExport::Polygons,
            encoding: Encoding::Binary,
        }
    }
}

impl ExportOptions<'_> {
    /// The map from the scene to the file; none if they are the same.
    pub(crate) fn root(&self) -> Option<DAffine3> {
        let scale = if self.scale > 0.0 && self.scale.is_finite() { self.scale } else { 1.0 };
        let turn = match self.up {
            UpAxis::Y => DMat3::IDENTITY,
            UpAxis::Z => DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y),
        };
        let map = DAffine3::from_mat3(turn * DMat3::from_diagonal(DVec3::splat(scale)));
        Some(map).filter(|map| *map != DAffine3::IDENTITY)
    }
}

/// A file to write.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExportedFile {
    /// Its name, without a folder.
    pub name: String,
    /// What is in it.
    pub bytes: Vec<u8>,
}

/// A model that is ready to be written.
#[derive(Clone, Debug)]
pub struct Export {
    /// The files in the order in which they are to be written: what a model refers to comes before the
    /// model, which is the last.
    pub files: Vec<ExportedFile>,
    losses: Vec<Loss>,
}

impl Export {
    /// What the scene holds and the files do not.
    pub fn what_would_be_lost(&self) -> &[Loss] {
        &self.losses
    }

    /// Writes the files into a folder, each whole or not at all.
    ///
    /// # Errors
    /// When one cannot be written; those before it are there.
    pub fn write(&self, folder: impl AsRef<Path>) -> Result<(), WriteError> {
        self.files.iter().try_for_each(|file| {
            write_atomically(&folder.as_ref().join(&file.name), |writer| writer.write_all(&file.bytes))
        })
    }
}

/// How a format is written.
pub(crate) enum Writing {
    /// It is not.
    Unwritten,
    /// As a whole.
    Scene(fn(&Scene, &ExportOptions<'_>) -> Result<Vec<u8>, WriteError>),
    /// Mesh by mesh, in a file of a name and others beside it.
    Objects(Holds, fn(&str, &mut Gathered<'_>, &ExportOptions<'_>) -> Result<Vec<ExportedFile>, WriteError>),
}

/// Makes the files of a scene in a format. `name` is that of the model's file, such as `chair.obj`:
/// what is written beside it has names that begin with `chair`.
///
/// Positions are in the world, as f32 like those of meshes; where a model lies so far from the origin
/// that f32 would not do, text and PLY have all digits of f64. What is written and read
/// again has positions with the same bits.
///
/// ```
/// use trigon_io::{ExportOptions, Format, LoadOptions, export, load_from_slice};
/// use trigon_mesh::primitives;
/// use trigon_scene::{Material, Scene};
///
/// let mut scene = Scene::new();
/// scene.add_object("cube", primitives::cube(2.0), Material::default());
/// let written = export(&scene, "cube.off", Format::Off, &ExportOptions::default())?;
/// assert_eq!(written.what_would_be_lost()[0].to_string(), "materials and their textures");
///
/// let again = load_from_slice("cube.off", &written.files[0].bytes, &LoadOptions::default())?;
/// let (_, cube) = again.scene.meshes().iter().next().expect("it was written");
/// assert_eq!((cube.mesh().vertex_count(), cube.mesh().face_count()), (8, 6), "polygons stay polygons");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// When the format is not written, or cannot count as much.
pub fn export(
    scene: &Scene,
    name: &str,
    format: Format,
    options: &ExportOptions<'_>,
) -> Result<Export, WriteError> {
    match &format.row().writing {
        Writing::Unwritten => Err(WriteError::Unwritten { name: name.to_owned(), writers: endings() }),
        Writing::Scene(write) => {
            let files = vec![ExportedFile { name: name.to_owned(), bytes: write(scene, options)? }];
            Ok(Export { files, losses: Vec::new() })
        }
        Writing::Objects(holds, write) => {
            let mut gathered = Gathered::new(scene, options);
            losses::add(&mut gathered, holds);
            let files = write(name, &mut gathered, options)?;
            Ok(Export { files, losses: gathered.losses })
        }
    }
}

/// For messages: `.obj, .glb, …`.
pub(crate) fn endings() -> String {
    let endings: Vec<String> = writers().map(|writer| format!(".{}", writer.extensions[0])).collect();
    endings.join(", ")
}

/// Something of the whole scene that is lost.
pub(crate) fn loss(what: impl Into<String>) -> Loss {
    Loss { place: Place::Whole, what: what.into() }
}

/// A name that text formats take: without spaces, comments and what ends or continues a line; never empty.
pub(crate) fn plain_name(name: &str, otherwise: &str) -> String {
    let is_odd = |c: char| c.is_whitespace() || c.is_control() || matches!(c, '#' | '\\' | '/' | '"');
    let name: String = name.trim().chars().map(|c| if is_odd(c) { '_' } else { c }).collect();
    if name.is_empty() { otherwise.to_owned() } else { name }
}
