//! Finds what an OBJ refers to: its libraries and the materials that it uses.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::path::Path;

use trigon_scene::{AlphaMode, Material, MaterialId};

use super::mtl::{MapKind, MtlMaterial, parse_mtl};
use super::oddities::Oddity;
use super::record::Record;
use super::textures::Textures;
use crate::error::{LoadError, Location};
use crate::folder::{Found, Lookup};
use crate::image_file::{Mention, note_respelled};
use crate::import::Import;
use crate::refusal::Refusal;
use crate::warning::Warnings;

/// A material that was added to the scene.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Added {
    pub(crate) id: MaterialId,
    /// Whether it has a texture, which needs texture coordinates.
    pub(crate) is_textured: bool,
}

/// Adds the materials that faces use. The result has one entry per name of the
/// record; `None` where no library knows it.
pub(crate) fn add_materials(
    import: &mut Import<'_>,
    record: &Record,
) -> Result<Vec<Option<Added>>, LoadError> {
    let (libraries, any_missing) = read_libraries(import, record);
    let mut used = vec![false; record.materials.list().len()];
    for run in &record.runs {
        if let Some(index) = run.material {
            used[index as usize] = true;
        }
    }
    let mut wanted = Vec::new();
    for (index, name) in record.materials.list().iter().enumerate().filter(|&(index, _)| used[index]) {
        match libraries.get(name) {
            Some(material) => wanted.push((index, material)),
            None if !any_missing => {
                let what = format!("material \"{name}\" is in no library; the default material is used");
                let remedy = if record.libraries.is_empty() {
                    "name its library with mtllib"
                } else {
                    "add it to the MTL file"
                };
                import.warnings.push(Location::Line(record.material_lines[index]), what, remedy);
            }
            None => {}
        }
    }
    let has_only_these = record.runs.iter().all(|run| run.material.is_some())
        && wanted.len() == used.iter().filter(|&&is_used| is_used).count();
    let is_hidden = has_only_these && is_all_invisible(&wanted);
    if is_hidden && let Some((_, first)) = wanted.first() {
        let what = "every material is invisible (d 0 or Tr 1), and all are drawn opaque";
        import.warnings.push_about(&first.file, Location::Line(first.line), what, "write d 1");
    }
    let textures = Textures::read(import, wanted.iter().map(|(_, material)| *material))?;
    let mut ids = vec![None; used.len()];
    for (index, from) in wanted {
        let mut material = from.material.clone();
        if is_hidden {
            (material.base_color.w, material.alpha_mode) = (1.0, AlphaMode::Opaque);
        }
        let is_textured = textures.dress(&mut material, from);
        if from.map(MapKind::BaseColor).is_some() && material.base_color_texture.is_none() {
            soften_without_texture(&mut material);
        }
        ids[index] = Some(Added { id: import.scene.add_material(material), is_textured });
    }
    Ok(ids)
}

/// Nobody exports a model that cannot be seen: a single material may be hidden, but not all.
fn is_all_invisible(wanted: &[(usize, &MtlMaterial)]) -> bool {
    wanted.iter().all(|(_, material)| material.material.base_color.w == 0.0)
}

/// White that was meant for a texture is too bright without it.
fn soften_without_texture(material: &mut Material) {
    if material.base_color.truncate() == trigon_math::Vec3::ONE {
        material.base_color = Material::default().base_color.with_w(material.base_color.w);
    }
}

/// All materials by name, and whether a library was not read.
fn read_libraries(import: &mut Import<'_>, record: &Record) -> (HashMap<String, MtlMaterial>, bool) {
    let mut materials = HashMap::new();
    let mut any_missing = record.oddities.has(Oddity::Libraries);
    for (line, names) in &record.libraries {
        for (name, result) in find_libraries(import, *line, names) {
            let found = match result {
                Ok(found) => found,
                Err(refusal) => {
                    any_missing = true;
                    let tried = import.folder.would_be(Path::new(""), &name);
                    let what = format!(
                        "material library \"{}\" is not read ({refusal}), the default material is used",
                        tried.display()
                    );
                    let all = import.folder.tried(Path::new(""), &name);
                    let location = Location::Line(*line);
                    import.warnings.push_unusable(import.path, location, what, refusal.remedy(), all);
                    continue;
                }
            };
            let what = format!("material library \"{name}\"");
            let from = Mention { file: import.path, line: *line, name: &name };
            note_respelled(import, &what, &found, from);
            for material in parse_mtl(&found.path, &found.bytes, &mut import.warnings) {
                add_definition(&mut materials, material, &mut import.warnings);
            }
        }
    }
    (materials, any_missing)
}

/// In a library the last definition of a name counts; of several libraries the first
/// that has it ("the first file listed is searched first").
fn add_definition(materials: &mut HashMap<String, MtlMaterial>, new: MtlMaterial, warnings: &mut Warnings) {
    let location = Location::Line(new.line);
    match materials.entry(new.material.name.clone()) {
        Entry::Vacant(entry) => {
            entry.insert(new);
        }
        Entry::Occupied(entry) if entry.get().looks_like(&new) => {}
        Entry::Occupied(mut entry) if entry.get().file == new.file => {
            let what = "a material is defined a second time, and this definition counts";
            warnings.push_about(&new.file, location, what, "remove one, or give it another name");
            entry.insert(new);
        }
        Entry::Occupied(_) => {
            let what = "a material is defined in an earlier library, too, and that definition counts";
            warnings.push_about(&new.file, location, what, "remove one, or give it another name");
        }
    }
}

/// A `mtllib` line names one file whose name may have spaces, or several
/// files. Both are tried, the whole line first.
fn find_libraries(import: &mut Import<'_>, line: u64, names: &str) -> Vec<(String, Result<Found, Refusal>)> {
    let here = Path::new("");
    let whole = import.folder.read(here, names, Lookup::Forgiving);
    // `\ ` is how some write a space in a name.
    const MOST_NAMES: usize = 64;
    const ESCAPED: char = '\u{1}';
    let escaped = names.replace("\\ ", &ESCAPED.to_string());
    let mut each: Vec<String> =
        escaped.split_whitespace().take(MOST_NAMES + 1).map(|name| name.replace(ESCAPED, " ")).collect();
    if whole.is_ok() || each.len() < 2 {
        return vec![(names.to_owned(), whole)];
    }
    if each.len() > MOST_NAMES {
        each.truncate(MOST_NAMES);
        let what = format!("mtllib names more than {MOST_NAMES} libraries, and the others are not read");
        import.warnings.push(Location::Line(line), what, "put their materials into one file");
    }
    let mut read = |name: String| {
        let result = import.folder.read(here, &name, Lookup::Forgiving);
        (name, result)
    };
    each.into_iter().map(&mut read).collect()
}
