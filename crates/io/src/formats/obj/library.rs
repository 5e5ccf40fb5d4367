//! Finds what an OBJ refers to: its libraries, the materials that it uses, and their images, beside the library or
//! the model.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use trigon_math::Vec2;
use trigon_math::glam::Affine2;
use trigon_raster::{Sampler, Wrap};
use trigon_scene::{AlphaMode, Material, MaterialId, NormalMap, Shading, TextureBinding, TextureId};

use super::mtl::{Map, MapKind, MapStatement, MtlMaterial, parse_mtl};
use super::oddities::Oddity;
use super::record::Record;
use crate::error::{LoadError, Location};
use crate::folder::{Found, Lookup};
use crate::import::Import;
use crate::refusal::Refusal;
use crate::texture_request::Role;
use crate::texture_request::{ImageBytes, Purpose, Request};
use crate::textures::add_textures;
use crate::textures::{Mention, find_image, note_respelled};
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
    let textures = LibraryTextures::read(import, wanted.iter().map(|(_, material)| *material))?;
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

/// The textures that a material of the scene can have from MTL.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Slot {
    BaseColor,
    Specular,
    Emissive,
    MetallicRoughness,
    Normal,
}

const SLOTS: [Slot; 5] =
    [Slot::BaseColor, Slot::Specular, Slot::Emissive, Slot::MetallicRoughness, Slot::Normal];

impl Slot {
    fn purpose(self) -> Purpose {
        match self {
            Self::BaseColor => Purpose::BaseColor,
            Self::Specular | Self::Emissive => Purpose::Color,
            Self::MetallicRoughness | Self::Normal => Purpose::Data,
        }
    }

    /// The statements that make it, and what each one gives.
    fn layers(self, material: &MtlMaterial) -> Vec<(Role, &Map)> {
        let with = |role: Role, kind: MapKind| material.map(kind).map(|map| (role, map));
        let has_highlight = matches!(material.material.shading, Shading::BlinnPhong { .. });
        match self {
            Self::BaseColor => {
                vec![with(Role::Whole, MapKind::BaseColor), with(Role::Alpha, MapKind::Opacity)]
            }
            Self::Specular if !has_highlight => Vec::new(),
            Self::Specular => vec![with(Role::Whole, MapKind::Specular)],
            Self::Emissive => vec![with(Role::Whole, MapKind::Emissive)],
            Self::MetallicRoughness => {
                vec![with(Role::Roughness, MapKind::Roughness), with(Role::Metallic, MapKind::Metallic)]
            }
            Self::Normal => {
                vec![with(Role::Whole, MapKind::Normal).or_else(|| with(Role::Directions, MapKind::Bump))]
            }
        }
        .into_iter()
        .flatten()
        .collect()
    }
}

/// The images of a texture with their roles, and what they are for.
type Recipe = (Vec<(Role, PathBuf)>, Purpose);

/// The textures of all wanted materials, each read and decoded once.
pub(super) struct LibraryTextures {
    ids: HashMap<(PathBuf, String, Slot), TextureId>,
}

/// Names a material's texture: its library, its name, and what it is for.
fn user(material: &MtlMaterial, slot: Slot) -> (PathBuf, String, Slot) {
    (material.file.clone(), material.material.name.clone(), slot)
}

impl LibraryTextures {
    pub(super) fn read<'m>(
        import: &mut Import<'_>,
        materials: impl Iterator<Item = &'m MtlMaterial>,
    ) -> Result<Self, LoadError> {
        let mut images = LibraryImages::default();
        let (mut requests, mut known, mut users) = (Vec::new(), HashMap::<Recipe, usize>::new(), Vec::new());
        for (material, slot) in materials.flat_map(|material| SLOTS.map(|slot| (material, slot))) {
            let layers = slot.layers(material);
            let found =
                layers.iter().filter_map(|&(role, map)| Some((role, images.find(import, material, map)?)));
            let recipe = (found.collect::<Vec<_>>(), slot.purpose());
            let (Some((_, first)), false) = (layers.first(), recipe.0.is_empty()) else { continue };
            let layers = recipe.0.iter().map(|(role, path)| (*role, images.bytes(path))).collect();
            let index = *known.entry(recipe).or_insert(requests.len());
            users.push((user(material, slot), index));
            if index == requests.len() {
                let (name, file, location) =
                    (first.statement.file.clone(), material.file.clone(), Location::Line(first.line));
                requests.push(Request { name, file, location, layers, purpose: slot.purpose() });
            }
        }
        let ids = add_textures(import, &requests)?;
        let ids = users.into_iter().filter_map(|(user, index)| Some((user, ids[index]?))).collect();
        Ok(Self { ids })
    }

    /// Binds a material's textures to it, and says whether there are any.
    pub(super) fn dress(&self, material: &mut Material, from: &MtlMaterial) -> bool {
        material.base_color_texture = self.bind(from, Slot::BaseColor);
        material.emissive_texture = self.bind(from, Slot::Emissive);
        let scale = Slot::Normal.layers(from).first().map_or(1.0, |(_, map)| map.statement.bump);
        material.normal_map = self.bind(from, Slot::Normal).map(|binding| NormalMap { binding, scale });
        match &mut material.shading {
            Shading::BlinnPhong { specular_texture, .. } => {
                *specular_texture = self.bind(from, Slot::Specular);
            }
            Shading::MetallicRoughness(model) => model.texture = self.bind(from, Slot::MetallicRoughness),
            Shading::Unlit | Shading::Lambert => {}
        }
        SLOTS.iter().any(|&slot| self.bind(from, slot).is_some())
    }

    /// Placed as the first of the statements says.
    fn bind(&self, material: &MtlMaterial, slot: Slot) -> Option<TextureBinding> {
        let &texture = self.ids.get(&user(material, slot))?;
        let (_, map) = *slot.layers(material).first()?;
        Some(placed(texture, &map.statement))
    }
}

fn placed(texture: TextureId, map: &MapStatement) -> TextureBinding {
    let wrap = if map.clamp { Wrap::ClampToEdge } else { Wrap::Repeat };
    let sampler = Sampler { wrap_u: wrap, wrap_v: wrap, ..Sampler::default() };
    // The statement counts v upwards: v' = s·v + o; down is 1 − v.
    let down = Vec2::new(map.offset.x, 1.0 - map.scale.y - map.offset.y);
    let transform = Affine2::from_scale_angle_translation(map.scale, 0.0, down);
    TextureBinding { transform, sampler, ..TextureBinding::new(texture) }
}

/// The image files, each searched and read once.
#[derive(Default)]
struct LibraryImages {
    /// By library and by the name that is used there.
    searched: HashMap<(PathBuf, String), Option<PathBuf>>,
    bytes: HashMap<PathBuf, Arc<[u8]>>,
}

impl LibraryImages {
    fn find(&mut self, import: &mut Import<'_>, material: &MtlMaterial, map: &Map) -> Option<PathBuf> {
        let name = (material.file.clone(), map.statement.file.clone());
        if let Some(known) = self.searched.get(&name) {
            return known.clone();
        }
        let (file, name_there) = (&material.file, &map.statement.file);
        let found = find_image(import, Mention { file, line: map.line, name: name_there });
        let path = found.as_ref().map(|found| found.path.clone());
        if let Some(found) = found {
            self.bytes.entry(found.path).or_insert_with(|| found.bytes.into());
        }
        self.searched.insert(name, path.clone());
        path
    }

    /// The bytes of a file that was found.
    fn bytes(&self, path: &Path) -> ImageBytes {
        let bytes = self.bytes[path].clone();
        let whole = 0..bytes.len();
        ImageBytes::Shared(bytes, whole)
    }
}
