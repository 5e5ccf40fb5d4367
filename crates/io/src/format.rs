//! The model formats by name.

use trigon_camera::UpAxis;

/// A model format that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Format {
    /// Wavefront OBJ with its MTL.
    Obj,
    /// glTF 2.0: JSON with buffers and images beside it or embedded.
    Gltf,
    /// glTF 2.0 in one binary file.
    Glb,
    /// The Stanford triangle format, as text or binary.
    Ply,
    /// The format of stereolithography, as text or binary.
    Stl,
    /// The object file format of Geomview, as text.
    Off,
    /// The format of 3D printing: a zip archive of XML.
    ThreeMf,
}

/// One format as printed by `--list-readers`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reader {
    /// The format.
    pub format: Format,
    /// For people.
    pub name: &'static str,
    /// The file extensions, in lower case, without the dot. The first names the format.
    pub extensions: &'static [&'static str],
    /// The axis that points up in its files: that of the specification, or what programs write mostly.
    pub up: UpAxis,
    /// What is read.
    pub reads: &'static str,
}

/// A format that can be written; see [`export`](crate::export()).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Writer {
    /// The format.
    pub format: Format,
    /// For people.
    pub name: &'static str,
    /// The file extensions, in lower case, without the dot.
    pub extensions: &'static [&'static str],
}
