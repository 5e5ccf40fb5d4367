//! The header of a PLY: its elements, their number, and the properties of each with the type of its numbers.

use crate::error::{LoadError, Location};
use crate::import::Import;
use crate::polygons::check_vertices;
use crate::rows::{quoted, words};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PlyEncoding {
    Text,
    Binary(ByteOrder),
}

/// What a property is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Scalar(Scalar),
    List { count: Scalar, item: Scalar },
}

#[derive(Clone, Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Kind,
}

#[derive(Clone, Debug)]
pub(super) struct Element {
    pub(super) name: String,
    /// As the file claims.
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

impl Element {
    /// The first property with one of these names.
    pub(super) fn position(&self, names: &[&str]) -> Option<usize> {
        self.properties.iter().position(|property| names.contains(&property.name.as_str()))
    }
}

#[derive(Debug)]
pub(super) struct PlyHeader {
    pub(super) encoding: PlyEncoding,
    pub(super) elements: Vec<Element>,
    /// The names of images in comments, with their lines.
    pub(super) textures: Vec<(u64, String)>,
    /// How many lines it has.
    pub(super) lines: u64,
    /// Where the data begin, in bytes.
    pub(super) data: usize,
}

impl PlyHeader {
    /// How many vertices there are, within the limits.
    pub(super) fn vertex_count(&self, import: &Import<'_>) -> Result<u32, LoadError> {
        let vertices = self.elements.iter().find(|element| element.name == "vertex");
        let count = vertices.map_or(0, |element| element.count);
        check_vertices(import, count)?;
        Ok(count as u32)
    }
}

/// The lines of a header. What ends the first ends all: `\r` before a byte of data may be either.
struct HeaderLines<'a> {
    bytes: &'a [u8],
    ending: u8,
    at: usize,
    number: u64,
}

impl<'a> HeaderLines<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        let first = memchr::memchr2(b'\n', b'\r', bytes).unwrap_or(bytes.len());
        let is_bare = bytes[first..].starts_with(b"\r") && !bytes[first..].starts_with(b"\r\n");
        Self { bytes, ending: if is_bare { b'\r' } else { b'\n' }, at: 0, number: 0 }
    }

    fn next(&mut self) -> Option<&'a [u8]> {
        let rest = &self.bytes[self.at..];
        let end = memchr::memchr(self.ending, rest)?;
        self.at += end + 1;
        self.number += 1;
        Some(rest[..end].trim_ascii())
    }
}

/// The header while it is read.
#[derive(Default)]
struct HeaderDraft {
    encoding: Option<PlyEncoding>,
    elements: Vec<Element>,
    textures: Vec<(u64, String)>,
}

/// So many images are told apart.
const MOST_TEXTURES: usize = 1 << 12;

pub(super) fn read_header(import: &mut Import<'_>, bytes: &[u8]) -> Result<PlyHeader, LoadError> {
    const REMEDY: &str = "export the model again";
    let path = import.path;
    let malformed =
        |line: u64, what: String| LoadError::malformed(path, what, REMEDY).at(Location::Line(line));
    let mut lines = HeaderLines::new(bytes);
    if lines.next() != Some(b"ply") {
        return Err(malformed(
            1,
            "it does not begin with a line \"ply\", so it is not a PLY file".to_owned(),
        ));
    }
    let mut draft = HeaderDraft::default();
    loop {
        let Some(line) = lines.next() else {
            return Err(malformed(lines.number, "the header has no end_header".to_owned()));
        };
        if line == b"end_header" {
            break;
        }
        if let Some(name) = texture_file(line)
            && draft.textures.len() < MOST_TEXTURES
        {
            draft.textures.push((lines.number, name));
        }
        match draft.statement(line) {
            Ok(true) => {}
            Ok(false) => import.warnings.push(
                Location::Line(lines.number),
                format!("the statement {} is not one of PLY and is ignored", first_word(line)),
                REMEDY,
            ),
            Err(what) => return Err(malformed(lines.number, what)),
        }
    }
    let Some(encoding) = draft.encoding else {
        return Err(malformed(lines.number, "the header has no format statement".to_owned()));
    };
    let HeaderDraft { elements, textures, .. } = draft;
    Ok(PlyHeader { encoding, elements, textures, lines: lines.number, data: lines.at })
}

/// The name of an image, which MeshLab and others write as `comment TextureFile wood.png`.
fn texture_file(line: &[u8]) -> Option<String> {
    let rest = line.strip_prefix(b"comment")?.trim_ascii_start();
    let (keyword, name) = rest.split_at_checked(b"TextureFile".len())?;
    let is_it =
        keyword.eq_ignore_ascii_case(b"TextureFile") && name.first().is_some_and(u8::is_ascii_whitespace);
    let name = text(name.trim_ascii());
    let name = name.trim_matches('"');
    (is_it && !name.is_empty()).then(|| name.to_owned())
}

fn first_word(line: &[u8]) -> String {
    quoted(words(line).next().unwrap_or_default())
}

impl HeaderDraft {
    /// Takes in a line; false if it is none of the format.
    fn statement(&mut self, line: &[u8]) -> Result<bool, String> {
        let mut words = words(line);
        let Some(keyword) = words.next() else { return Ok(true) };
        match keyword {
            b"comment" | b"obj_info" => {}
            b"format" => self.encoding = Some(encoding(words.next().unwrap_or_default())?),
            b"element" => self.elements.push(element(words)?),
            b"property" => {
                let property = property(words)?;
                let Some(element) = self.elements.last_mut() else {
                    return Err("a property stands before the first element".to_owned());
                };
                element.properties.push(property);
            }
            _ => return Ok(false),
        }
        Ok(true)
    }
}

fn encoding(name: &[u8]) -> Result<PlyEncoding, String> {
    match name {
        b"ascii" => Ok(PlyEncoding::Text),
        b"binary_little_endian" => Ok(PlyEncoding::Binary(ByteOrder::Little)),
        b"binary_big_endian" => Ok(PlyEncoding::Binary(ByteOrder::Big)),
        _ => Err(format!(
            "the format {} is unknown; it must be ascii, binary_little_endian or binary_big_endian",
            quoted(name)
        )),
    }
}

fn element<'a>(mut words: impl Iterator<Item = &'a [u8]>) -> Result<Element, String> {
    let name = text(words.next().unwrap_or_default());
    let word = words.next().unwrap_or_default();
    let count = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
    let count =
        count.ok_or_else(|| format!("the element \"{name}\" has {}, which is not a count", quoted(word)))?;
    Ok(Element { name, count, properties: Vec::new() })
}

fn property<'a>(mut words: impl Iterator<Item = &'a [u8]>) -> Result<Property, String> {
    let mut word = || words.next().unwrap_or_default();
    let scalar = |name: &[u8]| {
        Scalar::from_name(name).ok_or_else(|| format!("{} is not a PLY number type", quoted(name)))
    };
    let first = word();
    let kind = if first == b"list" {
        let (count, item) = (scalar(word())?, scalar(word())?);
        if matches!(count, Scalar::Float32 | Scalar::Float64) {
            return Err("the length of a list is a fraction".to_owned());
        }
        Kind::List { count, item }
    } else {
        Kind::Scalar(scalar(first)?)
    };
    Ok(Property { name: text(word()), kind })
}

fn text(word: &[u8]) -> String {
    String::from_utf8_lossy(word).into_owned()
}

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
