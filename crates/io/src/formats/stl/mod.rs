//! STL, the format of stereolithography (3D Systems, 1988), as text and binary, with the colours that
//! VisCAM, SolidView and Materialise Magics put into its attribute bytes.
//!
//! Text files begin with the word "solid", but so do many binary ones, and some text begins with a comment:
//! the size of a file decides, and the zeros in it. Vertices are corners of single triangles; those with
//! bit-identical coordinates are merged. Normals follow from the order of the vertices; those in the file are
//! ignored, because many files contain zeros.
//!
//! The crate `stl_io` 0.11 decides by the first line alone, drops the attributes, reads only the first of
//! several solids, and rejects a file for one line without saying which.

mod binary;
mod text;

use std::borrow::Cow;
use std::hash::{Hash, Hasher};

use trigon_math::DVec3;

use self::binary::{HEADER, TRIANGLE};
use crate::error::LoadError;
use crate::export::{
    Encoding, ExportOptions, ExportedFile, Gathered, Loss, Precision, plain_name, push_number,
};
use crate::import::Import;
use crate::options::LoadStage;
use crate::polygons::{Polygons, add_polygons, check_vertices};
use crate::rows::plain_text;
use crate::vertex_table::VertexTable;
use crate::write::WriteError;

/// Whether a file without a telling name is an STL.
pub(crate) fn is_stl(bytes: &[u8]) -> bool {
    binary::has_exact_size(bytes) || as_text(bytes).is_some_and(|text| text::begins_as_stl(&text))
}

/// So much of a file tells what it is.
const START: usize = 1 << 10;

fn has_zero(bytes: &[u8]) -> bool {
    bytes[..bytes.len().min(START)].contains(&0)
}

/// The file as text, if it is that. Text has no zeros; the number of triangles of a binary file has one, unless there
/// are 16 million of them.
fn as_text(bytes: &[u8]) -> Option<Cow<'_, [u8]>> {
    if binary::has_exact_size(bytes) {
        return None;
    }
    let text = plain_text(bytes);
    (!has_zero(&text) && text::has_keyword(&text)).then_some(text)
}

/// Reads an STL into the scene.
pub(crate) fn import_stl(import: &mut Import<'_>, bytes: Cow<'_, [u8]>) -> Result<(), LoadError> {
    import.options.report(import.path, LoadStage::Geometry, 0.0)?;
    let solids = match as_text(&bytes) {
        Some(text) => text::read(import, &text)?,
        None if bytes.len() >= HEADER && !has_zero(&bytes) && !binary::has_exact_size(&bytes) => {
            let what = "it is text without a facet, so it is not an STL";
            return Err(LoadError::malformed(import.path, what, "check that it is the right file"));
        }
        None => vec![binary::read(import, &bytes)?],
    };
    drop(bytes);
    add_polygons(import, solids)
}

/// The triangles of a solid, whose vertices are united.
#[derive(Default)]
struct Solid {
    polygons: Polygons,
    /// Vertices by the bits of their coordinates.
    known: VertexTable,
    /// Of the corners that are added.
    hashes: Vec<u64>,
}

impl Solid {
    fn named(name: String) -> Self {
        Self { polygons: Polygons { name, ..Polygons::default() }, ..Self::default() }
    }

    /// Adds a face.
    fn push(&mut self, import: &Import<'_>, corners: &[DVec3]) -> Result<(), LoadError> {
        self.push_corners(corners);
        self.polygons.face_sizes.push(corners.len() as u32);
        check_vertices(import, self.polygons.positions.len() as u64)
    }

    fn push_corners(&mut self, corners: &[DVec3]) {
        self.known.hash_all(corners.iter().map(Key::new), &mut self.hashes);
        for (corner, &hash) in corners.iter().zip(&self.hashes) {
            let positions = &mut self.polygons.positions;
            let known = |vertex: u32| Key::new(&positions[vertex as usize]);
            let vertex = self.known.number(&Key::new(corner), hash, known);
            let vertex = vertex.unwrap_or_else(|new| {
                positions.push(*corner);
                new
            });
            self.polygons.corner_vertices.push(vertex);
        }
    }
}

/// What tells vertices apart: the bits of their coordinates.
#[derive(PartialEq, Eq)]
struct Key([u64; 3]);

impl Key {
    fn new(position: &DVec3) -> Self {
        // Adding zero makes −0 and +0 the same.
        Self((*position + DVec3::ZERO).to_array().map(f64::to_bits))
    }
}

impl Hash for Key {
    fn hash<H: Hasher>(&self, state: &mut H) {
        // As three numbers, which takes half as long as 24 bytes.
        self.0.iter().for_each(|&bits| state.write_u64(bits));
    }
}

/// Writes an STL.
pub(crate) fn write_stl(
    name: &str,
    gathered: &mut Gathered<'_>,
    options: &ExportOptions<'_>,
) -> Result<Vec<ExportedFile>, WriteError> {
    gathered.objects.iter_mut().for_each(|object| object.cut());
    let bytes = match options.encoding {
        Encoding::Text => text(gathered).into_bytes(),
        Encoding::Binary | Encoding::BinaryBigEndian => binary(gathered)?,
    };
    Ok(vec![ExportedFile { name: name.to_owned(), bytes }])
}

/// The places of all triangles of an object.
fn triangles(gathered: &Gathered<'_>, object: usize) -> impl Iterator<Item = [DVec3; 3]> {
    let object = &gathered.objects[object];
    let position = |corner: u32| gathered.position(object, object.vertex(corner));
    object.faces().map(move |face| [position(face[0]), position(face[1]), position(face[2])])
}

/// The unit normal of a triangle; zero where it has no area.
fn normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a).try_normalize().unwrap_or_default()
}

fn binary(gathered: &mut Gathered<'_>) -> Result<Vec<u8>, WriteError> {
    if gathered.precision == Precision::Double {
        gathered
            .losses
            .push(Loss::of_scene("digits of positions far from the origin: they are rounded to f32"));
    }
    let count: usize = gathered.objects.iter().map(|object| object.face_sizes.len()).sum();
    let length = HEADER + TRIANGLE * count;
    let number = u32::try_from(count).map_err(|_| WriteError::TooLarge { bytes: length as u64 })?;
    // It must not begin with "solid", as text does.
    let mut bytes = b"binary STL written by trigon".to_vec();
    bytes.resize(HEADER - 4, 0);
    bytes.reserve_exact(length - bytes.len());
    bytes.extend(number.to_le_bytes());
    for object in 0..gathered.objects.len() {
        for corners in triangles(gathered, object) {
            for vector in [[normal(corners)].as_slice(), &corners].concat() {
                bytes.extend(vector.to_array().iter().flat_map(|&value| (value as f32).to_le_bytes()));
            }
            bytes.extend([0; 2]);
        }
    }
    Ok(bytes)
}

fn text(gathered: &Gathered<'_>) -> String {
    let mut text = String::new();
    for (index, object) in gathered.objects.iter().enumerate() {
        let name = plain_name(&object.node.name, "object");
        text += &format!("solid {name}\n");
        for corners in triangles(gathered, index) {
            text += " facet normal";
            push_vector(&mut text, normal(corners), Precision::Single);
            text += "  outer loop\n";
            for corner in corners {
                text += "   vertex";
                push_vector(&mut text, corner, gathered.precision);
            }
            text += "  endloop\n endfacet\n";
        }
        text += &format!("endsolid {name}\n");
    }
    text
}

fn push_vector(text: &mut String, vector: DVec3, precision: Precision) {
    for value in vector.to_array() {
        text.push(' ');
        push_number(text, value, precision);
    }
    text.push('\n');
}
