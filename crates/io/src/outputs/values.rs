//! An output of a frame as plain numbers.

use trigon_math::{Vec2, Vec3, Vec4};
use trigon_scene::Frame;

use super::Output;
use crate::write::WriteError;

/// The numbers of an output, pixel by pixel.
#[derive(Clone, Copy, Debug)]
pub(super) enum Values<'a> {
    /// Red, green, blue and alpha.
    Colors(&'a [u8]),
    Floats(&'a [f32]),
    Ids(&'a [u32]),
    Pairs(&'a [Vec2]),
    Vectors(&'a [Vec3]),
    /// Red, green, blue and alpha.
    Lights(&'a [Vec4]),
}

impl<'a> Values<'a> {
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
    pub(super) fn checked(frame: &'a Frame, output: Output) -> Result<Self, WriteError> {
        let values = Self::of(frame, output).ok_or(WriteError::Absent { what: output.name() })?;
        values.check(frame)?;
        Ok(values)
    }

    /// All that the frame holds, or an error when that is nothing.
    pub(super) fn all(frame: &'a Frame) -> Result<Vec<(Output, Self)>, WriteError> {
        let held = Output::ALL.into_iter().filter_map(|output| Some((output, Self::of(frame, output)?)));
        let held: Vec<_> = held.collect();
        held.iter().try_for_each(|(_, values)| values.check(frame))?;
        if held.is_empty() { Err(WriteError::Absent { what: "an output" }) } else { Ok(held) }
    }

    /// Numbers of a pixel; `None` for a number alone.
    pub(super) fn per_pixel(&self) -> Option<usize> {
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
