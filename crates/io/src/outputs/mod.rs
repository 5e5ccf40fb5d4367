//! Files for the outputs of a frame other than its image: NumPy's `.npy`, OpenEXR, and PNG of 16 bits.

mod encode;

use std::fmt;
use std::str::FromStr;

use thiserror::Error;
use trigon_math::{Vec2, Vec3, Vec4};
use trigon_scene::{Frame, Outputs};

use super::write::WriteError;

pub use encode::{encode_exr, encode_npy, encode_png16, write_exr, write_npy, write_origin_npy, write_png16};

/// One of the things that a [`Frame`] can hold.
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

/// The numbers of an output, pixel by pixel.
#[derive(Clone, Copy, Debug)]
enum OutputValues<'a> {
    /// Red, green, blue and alpha.
    Colors(&'a [u8]),
    Floats(&'a [f32]),
    Ids(&'a [u32]),
    Pairs(&'a [Vec2]),
    Vectors(&'a [Vec3]),
    /// Red, green, blue and alpha.
    Lights(&'a [Vec4]),
}

impl<'a> OutputValues<'a> {
    /// What the frame holds of an output; `None` when that was not asked for.
    fn of(frame: &'a Frame, output: Output) -> Option<Self> {
        let vectors = |list: &'a Option<Vec<Vec3>>| list.as_deref().map(Self::Vectors);
        let ids = |list: &'a Option<Vec<u32>>| list.as_deref().map(Self::Ids);
        match output {
            Output::Color => Some(Self::Colors(&frame.color)).filter(|_| !frame.color.is_empty()),
            Output::Radiance => frame.radiance.as_deref().map(Self::Lights),
            Output::Depth => frame.depth.as_deref().map(Self::Floats),
            Output::ObjectIds => ids(&frame.object_ids),
            Output::FaceIds => ids(&frame.face_ids),
            Output::MaterialIds => ids(&frame.material_ids),
            Output::TriangleIds => ids(&frame.triangle_ids),
            Output::Barycentrics => vectors(&frame.barycentrics),
            Output::Positions => vectors(&frame.positions),
            Output::Normals => vectors(&frame.normals),
            Output::GeometricNormals => vectors(&frame.geometric_normals),
            Output::Uvs => frame.uvs.as_deref().map(Self::Pairs),
            Output::Albedo => vectors(&frame.albedo),
        }
    }

    /// The same, or an error for what cannot be written.
    fn checked(frame: &'a Frame, output: Output) -> Result<Self, WriteError> {
        let values = Self::of(frame, output).ok_or(WriteError::Absent { what: output.name() })?;
        values.check(frame)?;
        Ok(values)
    }

    /// All that the frame holds, or an error when that is nothing.
    fn all(frame: &'a Frame) -> Result<Vec<(Output, Self)>, WriteError> {
        let held = Output::ALL.into_iter().filter_map(|output| Some((output, Self::of(frame, output)?)));
        let held: Vec<_> = held.collect();
        held.iter().try_for_each(|(_, values)| values.check(frame))?;
        if held.is_empty() { Err(WriteError::Absent { what: "an output" }) } else { Ok(held) }
    }

    /// Numbers of a pixel; `None` for a number alone.
    fn per_pixel(&self) -> Option<usize> {
        match self {
            Self::Colors(_) | Self::Lights(_) => Some(4),
            Self::Floats(_) | Self::Ids(_) => None,
            Self::Pairs(_) => Some(2),
            Self::Vectors(_) => Some(3),
        }
    }

    fn check(&self, frame: &Frame) -> Result<(), WriteError> {
        let Frame { width, height, .. } = *frame;
        let (length, per_pixel) = match self {
            Self::Colors(values) => (values.len(), 4),
            Self::Floats(values) => (values.len(), 1),
            Self::Ids(values) => (values.len(), 1),
            Self::Pairs(values) => (values.len(), 1),
            Self::Vectors(values) => (values.len(), 1),
            Self::Lights(values) => (values.len(), 1),
        };
        let fits = u128::from(width) * u128::from(height) * per_pixel == length as u128;
        if fits && length > 0 { Ok(()) } else { Err(WriteError::Size { width, height, length }) }
    }
}

#[cfg(test)]
mod tests;
