//! Scenes as OFF: the vertices and faces of all objects; COFF if vertices have colours, because it is the
//! only variant beside OFF that other programs read.

use trigon_math::color::linear_to_srgba8;

use crate::export::{Columns, ExportOptions, ExportedFile, Gathered, VertexTable, number_text, push_number};
use crate::write::WriteError;

/// Writes an OFF.
pub(crate) fn write_off(
    name: &str,
    gathered: &mut Gathered<'_>,
    _: &ExportOptions<'_>,
) -> Result<Vec<ExportedFile>, WriteError> {
    let columns = Columns { normals: false, uvs: false, colors: true }.found(gathered);
    let table = VertexTable::new(gathered, columns);
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
