//! PLY, the Stanford triangle format, as text and in both byte orders (G. Turk, "The PLY Polygon
//! File Format", 1994).
//!
//! `header` (elements and their properties) → `values` (numbers of either encoding, one by one) → `vertices`,
//! `faces` (everything that has a meaning; the rest is skipped by its type). `write` is the other direction.
//!
//! Of the crates for PLY, `ply-rs-bw` 4.0 is maintained (`ply-rs` 0.1 is not). It rejects a whole file for one bad
//! row, also if only the last faces are cut off. It counts rows of binary data as lines, so its errors name no
//! byte. It delivers each number through a call with the name of its property.

mod faces;
mod header;
mod values;
mod vertices;
mod write;

use std::borrow::Cow;

use self::faces::read_strips;
use self::faces::{read_edges, read_faces};
use self::header::{PlyEncoding, PlyHeader, read_header};
use self::values::skip;
use self::values::{Binary, Ended, Text, Values};
use self::vertices::read_vertices;
use crate::error::LoadError;
use crate::import::Import;
use crate::options::LoadStage;
use crate::polygons::{NamedTextures, Polygons, add_polygons};

pub(crate) use write::write_ply;

/// Whether a file starts as a PLY does.
pub(crate) fn is_ply(bytes: &[u8]) -> bool {
    matches!(bytes, [b'p', b'l', b'y', b'\n' | b'\r', ..])
}

/// Reads a PLY into the scene.
pub(crate) fn import_ply(import: &mut Import<'_>, bytes: Cow<'_, [u8]>) -> Result<(), LoadError> {
    import.options.report(import.path, LoadStage::Geometry, 0.0)?;
    let header = read_header(import, &bytes)?;
    let data = &bytes[header.data..];
    let textures = NamedTextures { names: header.textures.clone(), of_faces: Vec::new() };
    let mut polygons = Polygons { textures, ..Polygons::default() };
    match header.encoding {
        PlyEncoding::Text => {
            read_elements(import, &header, &mut Text::new(header.lines, data), &mut polygons)?;
        }
        PlyEncoding::Binary(order) => {
            let mut values = Binary::new(order, header.data as u64, data);
            read_elements(import, &header, &mut values, &mut polygons)?;
        }
    }
    drop(bytes);
    add_polygons(import, vec![polygons])
}

fn read_elements<V: Values>(
    import: &mut Import<'_>,
    header: &PlyHeader,
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
            import.warnings.push(values.location(), what, "copy or export the file again");
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
    if polygons.textures.of_faces.len() != polygons.face_sizes.len() {
        polygons.textures.of_faces.clear();
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
