//! The types of numbers in a PLY.

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ByteOrder {
    Little,
    Big,
}

/// A type of number. All values of all types are f64 values, too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    Int8,
    Uint8,
    Int16,
    Uint16,
    Int32,
    Uint32,
    Float32,
    Float64,
}

impl Scalar {
    /// By the names of 1994 and by those with sizes.
    pub(super) fn from_name(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Self::Int8,
            b"uchar" | b"uint8" => Self::Uint8,
            b"short" | b"int16" => Self::Int16,
            b"ushort" | b"uint16" => Self::Uint16,
            b"int" | b"int32" => Self::Int32,
            b"uint" | b"uint32" => Self::Uint32,
            b"float" | b"float32" => Self::Float32,
            b"double" | b"float64" => Self::Float64,
            _ => return None,
        })
    }

    /// In bytes.
    pub(super) fn size(self) -> usize {
        match self {
            Self::Int8 | Self::Uint8 => 1,
            Self::Int16 | Self::Uint16 => 2,
            Self::Int32 | Self::Uint32 | Self::Float32 => 4,
            Self::Float64 => 8,
        }
    }

    /// The number in the first bytes, of which there are enough.
    pub(super) fn read(self, bytes: &[u8], order: ByteOrder) -> f64 {
        match self {
            Self::Int8 => f64::from(bytes[0].cast_signed()),
            Self::Uint8 => f64::from(bytes[0]),
            Self::Int16 => f64::from(i16::from_le_bytes(little(bytes, order))),
            Self::Uint16 => f64::from(u16::from_le_bytes(little(bytes, order))),
            Self::Int32 => f64::from(i32::from_le_bytes(little(bytes, order))),
            Self::Uint32 => f64::from(u32::from_le_bytes(little(bytes, order))),
            Self::Float32 => f64::from(f32::from_le_bytes(little(bytes, order))),
            Self::Float64 => f64::from_le_bytes(little(bytes, order)),
        }
    }

    pub(super) fn is_float(self) -> bool {
        matches!(self, Self::Float32 | Self::Float64)
    }

    /// What stands for 1 where a number of this type is a channel of a colour: floats go to 1,
    /// and what is wider than a byte and not 16 bits without a sign still counts to 255.
    pub(super) fn full_channel(self) -> f64 {
        match self {
            Self::Float32 | Self::Float64 => 1.0,
            Self::Uint16 => 65535.0,
            _ => 255.0,
        }
    }
}

/// The first bytes with the lowest one first.
fn little<const N: usize>(bytes: &[u8], order: ByteOrder) -> [u8; N] {
    let mut first: [u8; N] = std::array::from_fn(|index| bytes[index]);
    if order == ByteOrder::Big {
        first.reverse();
    }
    first
}
