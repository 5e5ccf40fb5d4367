//! Values of attributes in the types of glTF.

use gltf::json::accessor::ComponentType;

use super::symbols::Failure;
use crate::formats::gltf::stream::Broken;

/// The values of an attribute, one after the other as in an accessor.
pub(crate) struct AttributeValues {
    pub(crate) component: ComponentType,
    /// Per value.
    pub(crate) components: usize,
    /// Whether integers are fractions of the largest one.
    pub(crate) normalized: bool,
    pub(crate) bytes: Vec<u8>,
}

impl AttributeValues {
    /// The values that points have.
    pub(super) fn of_points(self, points: &[u32]) -> Result<Self, Broken> {
        let size = self.component.size() * self.components;
        let mut bytes = Vec::with_capacity(points.len() * size);
        for &value in points {
            let start = value as usize * size;
            bytes.extend_from_slice(self.bytes.get(start..start + size).ok_or("a point has no value")?);
        }
        Ok(Self { bytes, ..self })
    }
}

/// The types of numbers in a stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Number {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
    Bool,
}

impl Number {
    pub(super) fn from_code(code: u8) -> Result<Self, Failure> {
        Ok(match code {
            1 => Self::I8,
            2 => Self::U8,
            3 => Self::I16,
            4 => Self::U16,
            5 => Self::I32,
            6 => Self::U32,
            7 => Self::I64,
            8 => Self::U64,
            9 => Self::F32,
            10 => Self::F64,
            11 => Self::Bool,
            _ => return Err(Failure::Foreign("an attribute of an unknown type")),
        })
    }

    /// In bytes.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 | Self::Bool => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }

    /// The type in glTF; floating point for those that it lacks.
    pub(super) fn component(self) -> ComponentType {
        match self {
            Self::I8 => ComponentType::I8,
            Self::U8 | Self::Bool => ComponentType::U8,
            Self::I16 => ComponentType::I16,
            Self::U16 => ComponentType::U16,
            Self::U32 => ComponentType::U32,
            Self::I32 | Self::I64 | Self::U64 | Self::F32 | Self::F64 => ComponentType::F32,
        }
    }

    /// Numbers of this type in that of glTF. `bytes` are whole numbers.
    pub(super) fn converted(self, bytes: &[u8]) -> Vec<u8> {
        match self {
            Self::I32 => floats(bytes, |number| i32::from_le_bytes(number) as f32),
            Self::I64 => floats(bytes, |number| i64::from_le_bytes(number) as f32),
            Self::U64 => floats(bytes, |number| u64::from_le_bytes(number) as f32),
            Self::F64 => floats(bytes, |number| f64::from_le_bytes(number) as f32),
            _ => bytes.to_vec(),
        }
    }

    /// Integers in the type of glTF; the upper bits are dropped.
    pub(super) fn narrowed(self, integers: &[i32]) -> Result<Vec<u8>, Failure> {
        let words = integers.iter();
        Ok(match self {
            Self::I8 | Self::U8 => words.map(|&word| word as u8).collect(),
            Self::I16 | Self::U16 => words.flat_map(|&word| (word as u16).to_le_bytes()).collect(),
            Self::U32 => words.flat_map(|word| word.to_le_bytes()).collect(),
            Self::I32 => words.flat_map(|&word| (word as f32).to_le_bytes()).collect(),
            _ => return Err("an attribute has integers of an impossible type".into()),
        })
    }
}

/// Numbers of `N` bytes as floating point.
fn floats<const N: usize>(bytes: &[u8], float: impl Fn([u8; N]) -> f32) -> Vec<u8> {
    bytes.as_chunks().0.iter().flat_map(|&number| float(number).to_le_bytes()).collect()
}
