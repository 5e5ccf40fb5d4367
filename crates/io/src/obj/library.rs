//! Finding what an OBJ refers to: its libraries, the materials it uses, and
//! their textures.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use trigon_math::Vec2;
use trigon_math::glam::Affine2;
use trigon_raster::{Sampler, Wrap};
use trigon_scene::{Material, MaterialId, TextureBinding, TextureId};

use super::map_options::MapStatement;
use super::mtl::{MtlMaterial, parse_mtl};
use super::record::Record;
use crate::error::{LoadError, Place};
use crate::folder::{Found, Lookup};
use crate::import::Import;
use crate::refusal::Refusal;
use crate::textures::{PictureBytes, Purpose, Request, add_textures};

/// Adds the materials that faces use. The result has one entry per name of the
/// record; `None` where no library knows it.
pub(crate) fn add_materials(
    import: &mut Import<'_>,
    record: &Record,
) -> Result<Vec<Option<MaterialId>>, LoadError> {
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
                import.warnings.push(Place::Line(record.material_lines[index]), what, remedy);
            }
            None => {}
        }
    }
    let textures = Textures::read(import, wanted.iter().map(|(_, material)| *material))?;
    let mut ids = vec![None; used.len()];
    for (index, from) in wanted {
        let binding = from.texture.as_ref().and_then(|(_, map)| textures.bind(from, map));
        let mut material = Material { base_color_texture: binding, ..from.material.clone() };
        if from.texture.is_some() && binding.is_none() {
            soften_without_texture(&mut material);
        }
        ids[index] = Some(import.scene.add_material(material));
    }
    Ok(ids)
}

/// White that was meant for a texture is too bright without it.
fn soften_without_texture(material: &mut Material) {
    if material.base_color.truncate() == trigon_math::Vec3::ONE {
        material.base_color = Material::default().base_color.with_w(material.base_color.w);
    }
}

/// All materials by name, and whether a library could not be read.
fn read_libraries(import: &mut Import<'_>, record: &Record) -> (HashMap<String, MtlMaterial>, bool) {
    let mut materials = HashMap::new();
    let mut any_missing = false;
    for (line, names) in &record.libraries {
        for (name, result) in find_libraries(import, names) {
            let found = match result {
                Ok(found) => found,
                Err(refusal) => {
                    any_missing = true;
                    let tried = import.folder.would_be(Path::new(""), &name);
                    let what = format!(
                        "material library \"{}\" is not read ({refusal}), the default material is used",
                        tried.display()
                    );
                    import.warnings.push(Place::Line(*line), what, refusal.remedy());
                    continue;
                }
            };
            let (what, place) = (format!("material library \"{name}\""), Place::Line(*line));
            note_respelled(import, &what, &found, import.path, place);
            for material in parse_mtl(&found.path, &found.bytes, &mut import.warnings) {
                materials.insert(material.material.name.clone(), material);
            }
        }
    }
    (materials, any_missing)
}

/// A `mtllib` line names one file whose name may have spaces, or several
/// files. Both are tried, the whole line first.
fn find_libraries(import: &mut Import<'_>, names: &str) -> Vec<(String, Result<Found, Refusal>)> {
    let here = Path::new("");
    let whole = import.folder.read(here, names, Lookup::Forgiving);
    // `\ ` is how some write a space in a name.
    const MOST_NAMES: usize = 64;
    const ESCAPED: char = '\u{1}';
    let escaped = names.replace("\\ ", &ESCAPED.to_string());
    let each: Vec<String> =
        escaped.split_whitespace().take(MOST_NAMES).map(|name| name.replace(ESCAPED, " ")).collect();
    if whole.is_ok() || each.len() < 2 {
        return vec![(names.to_owned(), whole)];
    }
    let mut read = |name: String| {
        let result = import.folder.read(here, &name, Lookup::Forgiving);
        (name, result)
    };
    each.into_iter().map(&mut read).collect()
}

/// `from` and `place` are the file and the line that have the name.
fn note_respelled(import: &mut Import<'_>, name: &str, found: &Found, from: &Path, place: Place) {
    if found.respelled {
        let what = format!("{name} was not found; \"{}\" is used instead", found.path.display());
        import.warnings.push_about(from, place, what, "correct the name there");
    }
}

/// The textures of all wanted materials, each read and decoded once.
struct Textures {
    ids: HashMap<(PathBuf, String), TextureId>,
}

impl Textures {
    fn read<'m>(
        import: &mut Import<'_>,
        materials: impl Iterator<Item = &'m MtlMaterial>,
    ) -> Result<Self, LoadError> {
        let (mut keys, mut requests, mut by_path) = (HashMap::new(), Vec::new(), HashMap::new());
        for material in materials {
            let Some((line, map)) = &material.texture else { continue };
            let key = key(material, map);
            if keys.contains_key(&key) {
                continue;
            }
            let Some(found) = find_texture(import, material, *line, map) else { continue };
            let index = *by_path.entry(found.path.clone()).or_insert(requests.len());
            keys.insert(key, index);
            if index == requests.len() {
                let (name, place) = (map.file.clone(), Place::Line(*line));
                let bytes = PictureBytes::Own(found.bytes);
                requests.push(Request {
                    name,
                    file: material.file.clone(),
                    place,
                    bytes,
                    purpose: Purpose::BaseColor,
                });
            }
        }
        let ids = add_textures(import, &requests)?;
        Ok(Self { ids: keys.into_iter().filter_map(|(key, index)| Some((key, ids[index]?))).collect() })
    }

    fn bind(&self, material: &MtlMaterial, map: &MapStatement) -> Option<TextureBinding> {
        let &texture = self.ids.get(&key(material, map))?;
        let wrap = if map.clamp { Wrap::ClampToEdge } else { Wrap::Repeat };
        let sampler = Sampler { wrap_u: wrap, wrap_v: wrap, ..Sampler::default() };
        // The statement counts v upwards: v' = s·v + o; down is 1 − v.
        let down = Vec2::new(map.offset.x, 1.0 - map.scale.y - map.offset.y);
        let transform = Affine2::from_scale_angle_translation(map.scale, 0.0, down);
        Some(TextureBinding { transform, sampler, ..TextureBinding::new(texture) })
    }
}

fn key(material: &MtlMaterial, map: &MapStatement) -> (PathBuf, String) {
    (material.file.clone(), map.file.clone())
}

/// Looks beside the library, then beside the model.
fn find_texture(
    import: &mut Import<'_>,
    material: &MtlMaterial,
    line: u64,
    map: &MapStatement,
) -> Option<Found> {
    let beside = import.folder.relative_folder(&material.file);
    let mut result = import.folder.read(&beside, &map.file, Lookup::Forgiving);
    if matches!(result, Err(Refusal::Missing)) && !beside.as_os_str().is_empty() {
        result = import.folder.read(Path::new(""), &map.file, Lookup::Forgiving);
    }
    match result {
        Ok(found) => {
            let what = format!("texture \"{}\"", map.file);
            note_respelled(import, &what, &found, &material.file, Place::Line(line));
            Some(found)
        }
        Err(refusal) => {
            let what = format!("texture \"{}\" is not drawn: {refusal}", map.file);
            import.warnings.push_about(&material.file, Place::Line(line), what, refusal.remedy());
            None
        }
    }
}
