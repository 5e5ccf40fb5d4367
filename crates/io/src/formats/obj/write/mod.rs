//! Scenes as OBJ: objects with their polygons, normals, texture coordinates and vertex colours, a
//! material library and the images beside it.
//!
//! `elements` writes the geometry, `materials` the library, `images` what it names.

mod elements;
mod image_files;
mod materials;
mod names;

use std::path::Path;

use self::elements::Elements;
use self::image_files::ImageFiles;
use self::names::{Names, name_materials};
use crate::export::{ExportOptions, ExportedFile, Gathered, plain_name};
use crate::loss::Loss;
use crate::write::WriteError;

/// Writes an OBJ with its MTL and its images.
pub(crate) fn write_obj(
    name: &str,
    gathered: &mut Gathered<'_>,
    options: &ExportOptions<'_>,
) -> Result<Vec<ExportedFile>, WriteError> {
    let stem = plain_name(&Path::new(name).file_stem().unwrap_or_default().to_string_lossy(), "model");
    let materials = name_materials(gathered);
    let library = format!("{stem}.mtl");
    let mut text = "# written by trigon\n".to_owned();
    if !materials.is_empty() {
        text += &format!("mtllib {library}\n");
    }
    let mut names = Names::default();
    let mut elements = Elements::new(text);
    for object in &gathered.objects {
        elements.object(gathered, object, &names.unique(&object.node.name, "object"), &materials);
    }
    let has_varying_colors = elements.has_varying_colors;
    let text = elements.text;
    let mut images = ImageFiles::new(&stem, gathered.scene, options.images);
    let mtl = materials::write(gathered, &materials, &mut images);
    if has_varying_colors {
        gathered.losses.push(Loss::of_scene("vertex colours that differ between the faces of a vertex"));
    }
    let mut files = images.into_files();
    if !materials.is_empty() {
        files.push(ExportedFile { name: library, bytes: mtl.into_bytes() });
    }
    files.push(ExportedFile { name: name.to_owned(), bytes: text.into_bytes() });
    Ok(files)
}
