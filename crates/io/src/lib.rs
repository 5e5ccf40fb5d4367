//! Model and image files for trigon. It reads OBJ with MTL, glTF and GLB, PLY, STL, OFF, 3MF, PNG, JPEG, WebP and
//! Radiance HDR. It writes OBJ, GLB, PLY, STL, OFF, 3MF, PNG, JPEG, WebP, OpenEXR and NumPy arrays, and sequences of
//! images as APNG and GIF. A capture stores everything that a frame was drawn from, and its image, in one file.
//!
//! A file becomes a [`Scene`](trigon_scene::Scene) and a list of warnings; an unusable file is an error.
//! Warnings and errors are one line each, with the file, the location in it, and a remedy. Files are
//! untrusted: nothing outside the model's folder is opened, every size is checked before memory is allocated
//! for it, and no file makes the loader panic. This crate never draws and never prints.
//!
//! ```
//! use trigon_io::{LoadOptions, load_from_slice};
//!
//! let obj = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 1 2\n";
//! let loaded = load_from_slice("square.obj", obj, &LoadOptions::default())?;
//! let (_, mesh) = loaded.scene.meshes().iter().next().expect("the file has faces");
//! assert_eq!(mesh.mesh().face_count(), 1, "a square is one polygon");
//! assert_eq!(
//!     loaded.warnings[0].to_string(),
//!     "square.obj, line 6: a face has fewer than 3 vertices and is left out; \
//!      remove it, or write edges with `l` and points with `p`"
//! );
//!
//! let error = load_from_slice("square.obj", b"v 0 0 0\nf 1 2 3\n", &LoadOptions::default()).unwrap_err();
//! assert_eq!(
//!     error.to_string(),
//!     "square.obj, line 2: face index \"2\" does not exist; the file has 1 vertex; \
//!      export the model again, or fix the line"
//! );
//! # Ok::<(), trigon_io::LoadError>(())
//! ```
//!
//! # Conventions
//! Right-handed, metres, counter-clockwise faces, as in glTF and OBJ. Coordinates are those of the file;
//! `Scene::up` says which axis is up: +Z in STL and 3MF, +Y in all others, or what [`LoadOptions::up`] says. PLY, STL
//! and OFF define no unit: their numbers are used as they are; those of a 3MF become metres. In texture
//! coordinates v = 0 is the top edge, and v grows downwards. Colours are linear light. A model far from the
//! origin is moved to the origin, and its node gets the offset. One node of the file is one node of the scene.

mod cameras;
mod capture;
mod compare;
mod encode_image;
mod environment;
mod error;
mod export;
mod folder;
mod format;
mod formats;
mod gltf_source;
mod import;
mod load;
mod native_document;
mod numbers;
mod options;
mod outputs;
mod polygons;
mod rebase;
mod refusal;
mod rgba_image;
mod root;
mod rows;
mod sequence;
mod texture_request;
mod textures;
mod unfinished;
mod uri;
mod vertex_table;
mod warning;
mod write;

pub use cameras::{CameraFile, CameraView, load_cameras};
pub use capture::{Capture, Mismatch, PixelMismatch};
pub use compare::{ImageDifference, SizeMismatch, compare_images};
pub use encode_image::{Pixels, encode_jpeg, encode_png, encode_webp, write_jpeg, write_png, write_webp};
pub use environment::load_environment;
pub use error::{LoadError, LoadErrorKind, Location};
pub use export::{Encoding, Export, ExportOptions, ExportedFile, FaceExport, Loss};
pub use format::{Format, Reader, Writer};
pub use formats::gltf::{encode_glb, write_glb};
pub use formats::{export, readers, writers};
pub use gltf_source::GltfSource;
pub use load::{Loaded, load, load_from_files, load_from_slice};
pub use native_document::{NativeDocument, NativeFile};
pub use options::{Limits, LoadOptions, LoadStage, Progress, ProgressHook, SceneChoice};
pub use outputs::{
    Output, UnknownOutput, encode_exr, encode_npy, encode_png16, write_exr, write_npy, write_origin_npy,
    write_png16,
};
pub use rgba_image::{RgbaImage, load_image};
pub use sequence::{Sequence, write_apng, write_gif};
/// Which way is up in a file.
pub use trigon_camera::UpAxis;
pub use unfinished::{
    FileIdentity, create_unfinished, end_on_signals, forget_unfinished, link_unfinished, unfinished_path,
};
pub use warning::Warning;
pub use write::{WriteError, write_atomically};

/// Runs the README's example as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
