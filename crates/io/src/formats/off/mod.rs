//! OFF, the object file format of Geomview (University of Minnesota, 1991), as text: with normals (NOFF),
//! colours (COFF) and texture coordinates (STOFF) of vertices, and colours of faces.
//!
//! The format is free: only the colour of a face ends with its line. But nearly all files have a line for
//! each vertex and each face, and only so a number that is missing can be told from the next one. A file is
//! read by its lines first, and as one list of numbers if these make no sense.
//!
//! The crate `off-rs` 2.0 has limits and names lines in errors, but it reads neither normals nor texture
//! coordinates, and no file with a face of two vertices. It reads colours only of a kind that the caller knows
//! beforehand.

mod header;
mod plain;
mod reader;

use std::borrow::Cow;

use trigon_math::color::linear_to_srgba8;

use self::header::read_header;
use self::reader::{LineLayout, OffReader};
use crate::error::{LoadError, LoadErrorKind};
use crate::export::{
    ExportOptions, ExportedFile, ExportedVertices, Gathered, VertexColumns, number_text, push_number,
};
use crate::import::Import;
use crate::options::LoadStage;
use crate::polygons::{add_polygons, check_vertices};
use crate::rows::plain_text;
use crate::rows::{Rows, Words};
use crate::write::WriteError;

pub(crate) use header::is_off;

/// Reads an OFF into the scene.
pub(crate) fn import_off(import: &mut Import<'_>, bytes: Cow<'_, [u8]>) -> Result<(), LoadError> {
    import.options.report(import.path, LoadStage::Geometry, 0.0)?;
    let text = plain_text(&bytes);
    let mut words = Words::of(Rows::without_comments(&text));
    let header = read_header(import, &mut words)?;
    check_vertices(import, header.vertices)?;
    let mut lines = OffReader::new(header, words.clone(), LineLayout::Lines);
    let mut found = lines.read(import);
    let is_final = |error: &LoadError| matches!(error.kind, LoadErrorKind::Limit | LoadErrorKind::Cancelled);
    if found.as_ref().map_or_else(|error| !is_final(error), |found| found.is_doubtful) {
        let mut free = [LineLayout::Free, LineLayout::FreeWithColors].into_iter();
        let read = |layout| OffReader::new(header, words.clone(), layout).read(import).ok();
        if let Some(free) = free.find_map(read) {
            let before = std::mem::replace(&mut found, Ok(free));
            if let Some(error) = before.err().filter(|_| lines.is_within_vertices()) {
                let what = format!("{}; the numbers are read as one list, whatever their lines", error.what);
                import.warnings.push(error.location, what, header::REMEDY);
            }
        }
    }
    let found = found?;
    for (location, what, remedy) in found.warnings {
        import.warnings.push(location, what, remedy);
    }
    drop(text);
    drop(bytes);
    add_polygons(import, vec![found.polygons])
}

/// Writes an OFF.
pub(crate) fn write_off(
    name: &str,
    gathered: &mut Gathered<'_>,
    _: &ExportOptions<'_>,
) -> Result<Vec<ExportedFile>, WriteError> {
    let columns = VertexColumns { normals: false, uvs: false, colors: true }.found(gathered);
    let table = ExportedVertices::new(gathered, columns);
    let sizes = || gathered.objects.iter().flat_map(|object| object.face_sizes.iter().copied());
    let faces = sizes().count() + table.edges.len();
    let keyword = if columns.colors { "COFF" } else { "OFF" };
    let mut text = format!("{keyword}\n{} {faces} 0\n", table.positions.len());
    for (position, values) in table.positions.iter().zip(&table.values) {
        let [x, y, z] = position.to_array();
        push_number(&mut text, x, gathered.precision);
        text += &format!(" {} ", number_text(y, gathered.precision));
        push_number(&mut text, z, gathered.precision);
        if columns.colors {
            let [red, green, blue, alpha] = linear_to_srgba8(values.color);
            text += &format!(" {red} {green} {blue} {alpha}");
        }
        text.push('\n');
    }
    let mut rest = table.corner_vertices.as_slice();
    for size in sizes() {
        let (face, after) = rest.split_at(size as usize);
        rest = after;
        push_row(&mut text, face);
    }
    table.edges.iter().for_each(|edge| push_row(&mut text, edge));
    Ok(vec![ExportedFile { name: name.to_owned(), bytes: text.into_bytes() }])
}

fn push_row(text: &mut String, vertices: &[u32]) {
    *text += &vertices.len().to_string();
    for vertex in vertices {
        *text += &format!(" {vertex}");
    }
    text.push('\n');
}
