//! Scenes as OBJ: objects with their polygons, normals, texture coordinates and vertex colours, a
//! material library and the pictures beside it.
//!
//! `elements` writes the geometry, `materials` the library, `pictures` what it names.

mod elements;
mod materials;
mod pictures;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use trigon_scene::MaterialId;

use self::elements::Elements;
use self::pictures::Pictures;
use crate::export::{ExportOptions, ExportedFile, Gathered, plain_name};
use crate::write::WriteError;

/// Writes an OBJ with its MTL and its pictures.
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
    let mut pictures = Pictures::new(&stem, gathered.scene, options.pictures);
    let mtl = materials::write(gathered, &materials, &mut pictures);
    if has_varying_colors {
        gathered.losses.push(crate::export::loss("vertex colours that differ between the faces of a vertex"));
    }
    let mut files = pictures.into_files();
    if !materials.is_empty() {
        files.push(ExportedFile { name: library, bytes: mtl.into_bytes() });
    }
    files.push(ExportedFile { name: name.to_owned(), bytes: text.into_bytes() });
    Ok(files)
}

/// Names that are each used once: readers unite what has the same.
#[derive(Default)]
struct Names {
    known: BTreeSet<String>,
}

impl Names {
    fn unique(&mut self, name: &str, otherwise: &str) -> String {
        let plain = plain_name(name, otherwise);
        let mut unique = plain.clone();
        let mut number = 1;
        while !self.known.insert(unique.clone()) {
            number += 1;
            unique = format!("{plain}_{number}");
        }
        unique
    }
}

/// The names of the materials that faces have: of the default one if others have one of their own.
type MaterialNames = BTreeMap<Option<MaterialId>, String>;

fn name_materials(gathered: &Gathered<'_>) -> MaterialNames {
    let (mut names, mut materials) = (Names::default(), BTreeMap::new());
    for object in &gathered.objects {
        for &face in &object.sources {
            let id = object.material(face);
            let name =
                id.and_then(|id| gathered.scene.materials.get(id)).map_or("default", |found| &found.name);
            materials.entry(id).or_insert_with(|| names.unique(name, "material"));
        }
    }
    if materials.keys().all(Option::is_none) { MaterialNames::new() } else { materials }
}
