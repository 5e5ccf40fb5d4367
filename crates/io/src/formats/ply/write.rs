//! Scenes as PLY: the vertices and faces of all objects, with normals, colours and the first set of
//! texture coordinates.

use trigon_math::color::{linear_to_srgba8, srgba8_to_linear};

use crate::export::Loss;
use crate::export::{
    Encoding, ExportOptions, ExportedFile, ExportedVertices, Gathered, Precision, VertexColumns, push_number,
};
use crate::write::WriteError;

/// Numbers on their way into a file.
enum Sink {
    Text(String),
    Binary { bytes: Vec<u8>, is_big: bool },
}

impl Sink {
    /// A number as it comes, the lowest byte first.
    fn push<const N: usize>(&mut self, mut bytes: [u8; N], text: impl std::fmt::Display) {
        match self {
            Self::Text(sink) => {
                sink.push_str(&text.to_string());
                sink.push(' ');
            }
            Self::Binary { bytes: sink, is_big } => {
                if *is_big {
                    bytes.reverse();
                }
                sink.extend(bytes);
            }
        }
    }

    fn float(&mut self, value: f64, precision: Precision) {
        match (&mut *self, precision) {
            (Self::Text(text), _) => {
                push_number(text, value, precision);
                text.push(' ');
            }
            (_, Precision::Single) => self.push((value as f32).to_le_bytes(), ""),
            (_, Precision::Double) => self.push(value.to_le_bytes(), ""),
        }
    }

    fn byte(&mut self, value: u8) {
        self.push([value], value);
    }

    fn word(&mut self, value: u32) {
        self.push(value.to_le_bytes(), value);
    }

    fn end_row(&mut self) {
        if let Self::Text(text) = self {
            text.pop();
            text.push('\n');
        }
    }

    fn into_bytes(self) -> Vec<u8> {
        match self {
            Self::Text(text) => text.into_bytes(),
            Self::Binary { bytes, .. } => bytes,
        }
    }
}

/// What the header tells.
struct RowLayout {
    columns: VertexColumns,
    position: Precision,
    /// v is turned round: where that needs more digits than an f32 has, it gets those of an f64.
    uv: Precision,
    /// Whether a face has more corners than a byte counts.
    is_large: bool,
}

/// Writes a PLY.
pub(crate) fn write_ply(
    name: &str,
    gathered: &mut Gathered<'_>,
    options: &ExportOptions<'_>,
) -> Result<Vec<ExportedFile>, WriteError> {
    let columns = VertexColumns { normals: true, uvs: true, colors: true }.found(gathered);
    let table = ExportedVertices::new(gathered, columns);
    note_losses(gathered, &table, columns);
    let sizes = || gathered.objects.iter().flat_map(|object| object.face_sizes.iter().copied());
    let layout = RowLayout {
        columns,
        position: gathered.precision,
        uv: uv_precision(&table),
        is_large: sizes().any(|size| size > u32::from(u8::MAX)),
    };
    let mut text = header(&layout, &table, sizes().count(), options.encoding);
    let mut sink = match options.encoding {
        Encoding::Text => Sink::Text(std::mem::take(&mut text)),
        encoding => Sink::Binary { bytes: text.into_bytes(), is_big: encoding == Encoding::BinaryBigEndian },
    };
    write_vertices(&mut sink, &layout, &table);
    write_faces(&mut sink, &layout, &table, sizes());
    for edge in &table.edges {
        edge.iter().for_each(|&end| sink.word(end));
        sink.end_row();
    }
    Ok(vec![ExportedFile { name: name.to_owned(), bytes: sink.into_bytes() }])
}

fn note_losses(gathered: &mut Gathered<'_>, table: &ExportedVertices, columns: VertexColumns) {
    if table.split > 0 {
        let what = format!(
            "that {} at seams and sharp edges are one: they are written again for other normals, colours or texture coordinates",
            crate::warning::counted(table.split, "vertex")
        );
        gathered.losses.push(Loss::of_scene(what));
    }
    let is_rounded = |color| srgba8_to_linear(linear_to_srgba8(color)) != color;
    if columns.colors && table.values.iter().any(|values| is_rounded(values.color)) {
        gathered.losses.push(Loss::of_scene("digits of vertex colours: they are rounded to 8 bits"));
    }
}

/// What is written of v: PLY counts it upwards.
fn upwards(v: f32) -> f64 {
    1.0 - f64::from(v)
}

fn uv_precision(table: &ExportedVertices) -> Precision {
    let comes_back = |v: f32| ((1.0 - f64::from(upwards(v) as f32)) as f32).to_bits() == v.to_bits();
    if table.values.iter().all(|values| comes_back(values.uv.y)) {
        Precision::Single
    } else {
        Precision::Double
    }
}

fn header(layout: &RowLayout, table: &ExportedVertices, faces: usize, encoding: Encoding) -> String {
    let kind = |precision| if precision == Precision::Single { "float" } else { "double" };
    let encoding = match encoding {
        Encoding::Text => "ascii",
        Encoding::Binary => "binary_little_endian",
        Encoding::BinaryBigEndian => "binary_big_endian",
    };
    let mut text = format!("ply\nformat {encoding} 1.0\ncomment written by trigon\n");
    let properties = |kind: &str, names: &[&str]| -> String {
        names.iter().map(|name| format!("property {kind} {name}\n")).collect()
    };
    text += &format!("element vertex {}\n", table.positions.len());
    text += &properties(kind(layout.position), &["x", "y", "z"]);
    if layout.columns.normals {
        text += &properties("float", &["nx", "ny", "nz"]);
    }
    if layout.columns.uvs {
        text += &properties(kind(layout.uv), &["s", "t"]);
    }
    if layout.columns.colors {
        text += &properties("uchar", &["red", "green", "blue", "alpha"]);
    }
    if faces > 0 {
        let count = if layout.is_large { "uint" } else { "uchar" };
        text += &format!("element face {faces}\nproperty list {count} uint vertex_indices\n");
    }
    if !table.edges.is_empty() {
        text += &format!("element edge {}\n", table.edges.len());
        text += &properties("uint", &["vertex1", "vertex2"]);
    }
    text + "end_header\n"
}

fn write_vertices(sink: &mut Sink, layout: &RowLayout, table: &ExportedVertices) {
    for (position, values) in table.positions.iter().zip(&table.values) {
        position.to_array().iter().for_each(|&value| sink.float(value, layout.position));
        if layout.columns.normals {
            values.normal.to_array().iter().for_each(|&value| sink.float(value.into(), Precision::Single));
        }
        if layout.columns.uvs {
            sink.float(values.uv.x.into(), layout.uv);
            sink.float(upwards(values.uv.y), layout.uv);
        }
        if layout.columns.colors {
            linear_to_srgba8(values.color).iter().for_each(|&value| sink.byte(value));
        }
        sink.end_row();
    }
}

fn write_faces(
    sink: &mut Sink,
    layout: &RowLayout,
    table: &ExportedVertices,
    sizes: impl Iterator<Item = u32>,
) {
    let mut rest = table.corner_vertices.as_slice();
    for size in sizes {
        let (face, after) = rest.split_at(size as usize);
        rest = after;
        if layout.is_large {
            sink.word(size);
        } else {
            sink.byte(size as u8);
        }
        face.iter().for_each(|&vertex| sink.word(vertex));
        sink.end_row();
    }
}
