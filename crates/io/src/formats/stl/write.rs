//! Scenes as STL: the triangles of all objects, one solid for each in text.

use trigon_math::DVec3;

use super::binary::{HEADER, TRIANGLE};
use crate::export::{Encoding, ExportOptions, ExportedFile, Gathered, Precision, plain_name, push_number};
use crate::loss::Loss;
use crate::write::WriteError;

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
