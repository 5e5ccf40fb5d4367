//! PLY, the Stanford triangle format, as text and in both byte orders (G. Turk, "The PLY Polygon
//! File Format", 1994).
//!
//! `header` (elements and their properties) → `values` (numbers of either encoding, one after the
//! other) → `vertices`, `faces` (what means something; all else is skipped by its type). `write`
//! goes the other way.
//!
//! Of the crates `ply-rs-bw` 4.0 is the one that is kept (`ply-rs` 0.1 is not). It gives a file up for one
//! row, also where faces are cut off at its end; it counts rows of binary data as lines, so that an
//! error names no byte; and it hands over each number through a call by the name of its property.

mod faces;
mod header;
mod scalar;
mod strips;
mod values;
mod vertices;
mod write;

use std::borrow::Cow;

use self::faces::{read_edges, read_faces};
use self::header::{Element, Encoding, Header, read_header};
use self::strips::read_strips;
use self::values::{Binary, Ended, Fault, Text, Values};
use self::vertices::read_vertices;
use crate::error::{LoadError, LoadErrorKind};
use crate::import::Import;
use crate::options::Stage;
use crate::polygons::{Polygons, add_polygons, too_many_corners};

pub(crate) use write::write_ply;

/// Whether a file starts as a PLY does.
pub(crate) fn is_ply(bytes: &[u8]) -> bool {
    matches!(bytes, [b'p', b'l', b'y', b'\n' | b'\r', ..])
}

/// Reads a PLY into the scene.
pub(crate) fn import_ply(import: &mut Import<'_>, bytes: Cow<'_, [u8]>) -> Result<(), LoadError> {
    import.options.report(import.path, Stage::Geometry, 0.0)?;
    let header = read_header(import, &bytes)?;
    let data = &bytes[header.data..];
    let mut polygons = Polygons::default();
    match header.encoding {
        Encoding::Text => {
            read_elements(import, &header, &mut Text::new(header.lines, data), &mut polygons)?;
        }
        Encoding::Binary(order) => {
            let mut values = Binary::new(order, header.data as u64, data);
            read_elements(import, &header, &mut values, &mut polygons)?;
        }
    }
    drop(bytes);
    add_polygons(import, vec![polygons])
}

/// An element to its end, or to that of the file.
type Outcome = Result<Result<(), Ended>, LoadError>;

/// So many rows are read before the caller is asked again whether to go on.
const STRIDE: u64 = 1 << 16;

/// Tells how far reading has come.
fn report(import: &Import<'_>, row: u64, values: &impl Values) -> Result<(), LoadError> {
    if row.is_multiple_of(STRIDE) {
        let (done, left) = values.progress();
        let share = 0.9 * done as f32 / (done + left).max(1) as f32;
        import.options.report(import.path, Stage::Geometry, share)?;
    }
    Ok(())
}

fn read_elements<V: Values>(
    import: &mut Import<'_>,
    header: &Header,
    values: &mut V,
    polygons: &mut Polygons,
) -> Result<(), LoadError> {
    let vertices = header.vertex_count(import)?;
    let mut has_vertices = false;
    for element in &header.elements {
        let outcome = match element.name.as_str() {
            "vertex" if !has_vertices => {
                has_vertices = true;
                read_vertices(import, element, values, polygons)?;
                Ok(())
            }
            "face" => read_faces(import, element, values, vertices, polygons)?,
            "tristrips" => read_strips(import, element, values, vertices, polygons)?,
            "edge" => read_edges(import, element, values, vertices, polygons)?,
            _ => skip(import, element, values)?,
        };
        if let Err(Ended { rows }) = outcome {
            let (name, count) = (&element.name, element.count);
            let what =
                format!("the file ends after {rows} of {count} elements \"{name}\"; the rest is missing");
            import.warnings.push(values.place(), what, "copy or export the file again");
            break;
        }
    }
    // Of several lists of faces some may have what others have not.
    if polygons.face_colors.len() != polygons.face_sizes.len() {
        polygons.face_colors.clear();
    }
    if polygons.corner_uvs.len() != polygons.corner_vertices.len() {
        polygons.corner_uvs.clear();
    }
    let surplus = values.surplus();
    import.warnings.push_counted(
        surplus.count,
        surplus.first,
        "a row has more values than its element has properties, which are ignored",
        "export the model again",
    );
    Ok(())
}

/// Passes over an element that means nothing here.
fn skip<V: Values>(import: &Import<'_>, element: &Element, values: &mut V) -> Outcome {
    // Rows without properties take no room, however many there are said to be.
    let rows = if element.properties.is_empty() { 0 } else { element.count };
    for row in 0..rows {
        report(import, row, values)?;
        if let Err(fault) = skip_row(element, values) {
            return stopped(import, element, row, values, fault);
        }
    }
    Ok(Ok(()))
}

fn skip_row<V: Values>(element: &Element, values: &mut V) -> Result<(), Fault> {
    values.begin_row()?;
    element.properties.iter().try_for_each(|property| values.skip(property.kind))?;
    values.end_row();
    Ok(())
}

/// What becomes of an element of which a row cannot be read.
fn stopped<V: Values>(import: &Import<'_>, element: &Element, row: u64, values: &V, fault: Fault) -> Outcome {
    match fault {
        Fault::Ended => Ok(Err(Ended { rows: row })),
        Fault::Bad(what) => Err(broken(import, element, row, values, &what)),
        Fault::TooMany => Err(too_many_corners(import)),
    }
}

/// The error of a row that contradicts its header.
fn broken(import: &Import<'_>, element: &Element, row: u64, values: &impl Values, what: &str) -> LoadError {
    let what = format!("{} {row} {what}", element.name);
    LoadError::malformed(import.path, what, "export the model again").at(values.place())
}

/// The error of a file that ends before its vertices do.
fn cut_off(import: &Import<'_>, element: &Element, rows: u64, values: &impl Values) -> LoadError {
    let what = format!("the header claims {} vertices, and the file ends after {rows}", element.count);
    LoadError::new(LoadErrorKind::Malformed, import.path, what, "copy or export the file again")
        .at(values.place())
}
