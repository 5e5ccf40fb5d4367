//! Writes scenes as 3MF. A mesh that several nodes show is one object with several items of the build, in millimetres.
//! `resources` are its objects, the `palette` their materials; here the XML and the archive are made. The same scene gives the
//! same bytes: the archive has no time of day.

use std::io::{Cursor, Write};

use trigon_math::{DAffine3, DVec3};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, System, ZipWriter};

use super::namespaces::{CORE, MATERIAL, MODEL_TYPE};
use super::palette::{Palette, ShownItems};
use super::resources::{Resource, resources};
use super::text::{Escaped, push};
use crate::export::{ExportOptions, ExportedFile, Gathered, Loss, Object, Precision, push_number};
use crate::write::WriteError;

/// What the parts of the archive are.
const CONTENT_TYPES: &str = concat!(
    r#"<?xml version="1.0" encoding="UTF-8"?>"#,
    "\n",
    r#"<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">"#,
    r#"<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>"#,
    r#"<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>"#,
    "</Types>\n"
);

/// Writes a 3MF.
pub(crate) fn write_three_mf(
    name: &str,
    gathered: &mut Gathered<'_>,
    _options: &ExportOptions<'_>,
) -> Result<Vec<ExportedFile>, WriteError> {
    gathered.objects.iter_mut().for_each(Object::cut);
    let text = model(gathered);
    Ok(vec![ExportedFile { name: name.to_owned(), bytes: packed(&text) }])
}

/// The archive around a model.
fn packed(model: &str) -> Vec<u8> {
    let relationships = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Relationships \
         xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\"><Relationship \
         Target=\"/3D/3dmodel.model\" Id=\"rel0\" Type=\"{MODEL_TYPE}\"/></Relationships>\n"
    );
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    let parts = [
        ("[Content_Types].xml", CONTENT_TYPES),
        ("_rels/.rels", &relationships),
        ("3D/3dmodel.model", model),
    ];
    for (name, text) in parts {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .last_modified_time(DateTime::default())
            .system(System::Unix)
            .unix_permissions(0o644)
            .large_file(text.len() as u64 >= u64::from(u32::MAX));
        archive.start_file(name, options).expect("each name occurs once");
        archive.write_all(text.as_bytes()).expect("memory takes everything");
    }
    archive.finish().expect("memory takes everything").into_inner()
}

/// The numbers of resources: the first ones are groups of properties.
const BASES: usize = 1;
const COLORS: usize = 2;
const FIRST_OBJECT: usize = 3;

/// The text of the model part.
fn model(gathered: &mut Gathered<'_>) -> String {
    let resources = resources(gathered);
    let mut palette = Palette::new(gathered.scene);
    let mut objects = String::new();
    for (number, resource) in resources.iter().enumerate() {
        push_object(&mut objects, &mut palette, FIRST_OBJECT + number, resource);
    }
    let mut text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".to_owned();
    push(&mut text, format_args!("<model unit=\"millimeter\" xml:lang=\"en-US\" xmlns=\"{CORE}\""));
    if palette.has_colors() {
        push(&mut text, format_args!(" xmlns:m=\"{MATERIAL}\""));
    }
    text += ">\n <metadata name=\"Application\">trigon</metadata>\n <resources>\n";
    palette.push_bases(&mut text, BASES);
    palette.push_colors(&mut text, COLORS);
    text += &objects;
    text += " </resources>\n <build>\n";
    for (number, resource) in resources.iter().enumerate() {
        for transform in &resource.items {
            push(&mut text, format_args!("  <item objectid=\"{}\"", FIRST_OBJECT + number));
            push_transform(&mut text, transform);
            text += "/>\n";
        }
    }
    text += " </build>\n</model>\n";
    let losses = resources.iter().flat_map(|resource| resource.losses());
    let losses: Vec<Loss> = losses.chain(palette.losses()).collect();
    gathered.losses.extend(losses);
    text
}

fn push_object(text: &mut String, palette: &mut Palette<'_>, number: usize, resource: &Resource<'_>) {
    let shown: Vec<ShownItems> =
        resource.faces.iter().map(|face| palette.shown(resource.object, face)).collect();
    let default = shown.first().copied();
    push(
        text,
        format_args!("  <object id=\"{number}\" name=\"{}\" type=\"model\"", Escaped(resource.name())),
    );
    match default {
        Some(ShownItems::Base(item)) => push(text, format_args!(" pid=\"{BASES}\" pindex=\"{item}\"")),
        Some(ShownItems::Colors([item, ..])) => {
            push(text, format_args!(" pid=\"{COLORS}\" pindex=\"{item}\""));
        }
        None => {}
    }
    *text += ">\n   <mesh>\n    <vertices>\n";
    for position in &resource.positions {
        *text += "     <vertex";
        for (axis, value) in ["x", "y", "z"].into_iter().zip(position.to_array()) {
            push(text, format_args!(" {axis}=\""));
            push_millimeters(text, value);
            text.push('"');
        }
        *text += "/>\n";
    }
    *text += "    </vertices>\n    <triangles>\n";
    for (face, &shown) in resource.faces.iter().zip(&shown) {
        let [a, b, c] = face.vertices;
        push(text, format_args!("     <triangle v1=\"{a}\" v2=\"{b}\" v3=\"{c}\""));
        push_property(text, shown, default);
        *text += "/>\n";
    }
    *text += "    </triangles>\n   </mesh>\n  </object>\n";
}

/// What a triangle shows, where the object does not say it.
fn push_property(text: &mut String, shown: ShownItems, default: Option<ShownItems>) {
    match shown {
        ShownItems::Base(item) if Some(shown) != default => {
            push(text, format_args!(" pid=\"{BASES}\" p1=\"{item}\""));
        }
        ShownItems::Colors([a, b, c]) if a != b || b != c => {
            push(text, format_args!(" pid=\"{COLORS}\" p1=\"{a}\" p2=\"{b}\" p3=\"{c}\""));
        }
        ShownItems::Colors([item, ..]) if Some(shown) != default => {
            push(text, format_args!(" pid=\"{COLORS}\" p1=\"{item}\""));
        }
        _ => {}
    }
}

/// A length in metres as the shortest digits in millimetres that read as the same number.
fn push_millimeters(text: &mut String, meters: f64) {
    let (start, millimeters) = (text.len(), meters * 1000.0);
    push_number(text, millimeters, Precision::Single);
    let read = text[start..].parse::<f64>().map(|read| f64::from((read / 1000.0) as f32));
    if read != Ok(meters) {
        text.truncate(start);
        push_number(text, millimeters, Precision::Double);
    }
}

/// A transform, unless it changes nothing: its rows are those of a matrix that row vectors are multiplied with.
fn push_transform(text: &mut String, transform: &DAffine3) {
    if *transform == DAffine3::IDENTITY {
        return;
    }
    *text += " transform=\"";
    // Adding zero makes −0 a 0.
    for value in transform.matrix3.to_cols_array() {
        push_number(text, value + 0.0, Precision::Double);
        text.push(' ');
    }
    let DVec3 { x, y, z } = transform.translation;
    for (value, after) in [(x, " "), (y, " "), (z, "\"")] {
        push_millimeters(text, value + 0.0);
        *text += after;
    }
}
