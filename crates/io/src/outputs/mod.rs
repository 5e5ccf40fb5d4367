//! Files for the outputs of a frame other than its image: NumPy's `.npy`, OpenEXR, and PNG of 16 bits.

mod npy;
mod openexr;
mod png16;
mod values;

use std::fmt;
use std::str::FromStr;

use thiserror::Error;
use trigon_scene::Outputs;

pub use npy::{encode_npy, write_npy, write_origin_npy};
pub use openexr::{encode_exr, write_exr};
pub use png16::{encode_png16, write_png16};

/// One of the things that a [`Frame`](trigon_scene::Frame) can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Output {
    /// [`Frame::color`](trigon_scene::Frame::color).
    Color,
    /// [`Frame::radiance`](trigon_scene::Frame::radiance).
    Radiance,
    /// [`Frame::depth`](trigon_scene::Frame::depth).
    Depth,
    /// [`Frame::object_ids`](trigon_scene::Frame::object_ids).
    ObjectIds,
    /// [`Frame::face_ids`](trigon_scene::Frame::face_ids).
    FaceIds,
    /// [`Frame::material_ids`](trigon_scene::Frame::material_ids).
    MaterialIds,
    /// [`Frame::triangle_ids`](trigon_scene::Frame::triangle_ids).
    TriangleIds,
    /// [`Frame::barycentrics`](trigon_scene::Frame::barycentrics).
    Barycentrics,
    /// [`Frame::positions`](trigon_scene::Frame::positions).
    Positions,
    /// [`Frame::normals`](trigon_scene::Frame::normals).
    Normals,
    /// [`Frame::geometric_normals`](trigon_scene::Frame::geometric_normals).
    GeometricNormals,
    /// [`Frame::uvs`](trigon_scene::Frame::uvs).
    Uvs,
    /// [`Frame::albedo`](trigon_scene::Frame::albedo).
    Albedo,
}

/// A word that names no output.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{0:?} is not an output; write one of {names}", names = Output::names())]
pub struct UnknownOutput(pub String);

impl Output {
    /// All of them, in the order of the frame's fields.
    pub const ALL: [Self; 13] = [
        Self::Color,
        Self::Radiance,
        Self::Depth,
        Self::ObjectIds,
        Self::FaceIds,
        Self::MaterialIds,
        Self::TriangleIds,
        Self::Barycentrics,
        Self::Positions,
        Self::Normals,
        Self::GeometricNormals,
        Self::Uvs,
        Self::Albedo,
    ];

    /// The name on command lines and in names of files, such as `object-ids`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Color => "color",
            Self::Radiance => "radiance",
            Self::Depth => "depth",
            Self::ObjectIds => "object-ids",
            Self::FaceIds => "face-ids",
            Self::MaterialIds => "material-ids",
            Self::TriangleIds => "triangle-ids",
            Self::Barycentrics => "barycentrics",
            Self::Positions => "positions",
            Self::Normals => "normals",
            Self::GeometricNormals => "geometric-normals",
            Self::Uvs => "uvs",
            Self::Albedo => "albedo",
        }
    }

    /// Asks for it, so that the next frame holds it. The ids of objects and of faces
    /// have one switch.
    pub fn ask_for(self, outputs: &mut Outputs) {
        let switch = match self {
            Self::Color => &mut outputs.color,
            Self::Radiance => &mut outputs.radiance,
            Self::Depth => &mut outputs.depth,
            Self::ObjectIds | Self::FaceIds => &mut outputs.ids,
            Self::MaterialIds => &mut outputs.material_ids,
            Self::TriangleIds => &mut outputs.triangle_ids,
            Self::Barycentrics => &mut outputs.barycentrics,
            Self::Positions => &mut outputs.positions,
            Self::Normals => &mut outputs.normals,
            Self::GeometricNormals => &mut outputs.geometric_normals,
            Self::Uvs => &mut outputs.uvs,
            Self::Albedo => &mut outputs.albedo,
        };
        *switch = true;
    }

    /// Whether [`write_png16`] has a place for it.
    #[must_use]
    pub fn fits_png16(self) -> bool {
        match self {
            Self::Depth | Self::ObjectIds | Self::FaceIds | Self::MaterialIds | Self::TriangleIds => true,
            Self::Normals | Self::GeometricNormals => true,
            Self::Color | Self::Radiance | Self::Barycentrics => false,
            Self::Positions | Self::Uvs | Self::Albedo => false,
        }
    }

    fn names() -> String {
        Self::ALL.map(Self::name).join(", ")
    }
}

impl fmt::Display for Output {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Output {
    type Err = UnknownOutput;

    fn from_str(name: &str) -> Result<Self, UnknownOutput> {
        let found = Self::ALL.into_iter().find(|output| output.name() == name);
        found.ok_or_else(|| UnknownOutput(name.to_owned()))
    }
}

#[cfg(test)]
mod tests;
