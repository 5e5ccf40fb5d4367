//! The textures of MTL materials: found beside the library or the model, combined where one texture needs two
//! images, and assigned to the material.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use trigon_math::Vec2;
use trigon_math::glam::Affine2;
use trigon_raster::{Sampler, Wrap};
use trigon_scene::{Material, NormalMap, Shading, TextureBinding, TextureId};

use super::map_options::MapStatement;
use super::mtl::{Map, MapKind, MtlMaterial};
use crate::error::{LoadError, Location};
use crate::image_file::{Mention, find_image};
use crate::import::Import;
use crate::layers::Role;
use crate::texture_request::{ImageBytes, Purpose, Request};
use crate::textures::add_textures;

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
pub(super) struct Textures {
    ids: HashMap<(PathBuf, String, Slot), TextureId>,
}

/// Names a material's texture: its library, its name, and what it is for.
fn user(material: &MtlMaterial, slot: Slot) -> (PathBuf, String, Slot) {
    (material.file.clone(), material.material.name.clone(), slot)
}

impl Textures {
    pub(super) fn read<'m>(
        import: &mut Import<'_>,
        materials: impl Iterator<Item = &'m MtlMaterial>,
    ) -> Result<Self, LoadError> {
        let mut images = Images::default();
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
struct Images {
    /// By library and by the name that is used there.
    searched: HashMap<(PathBuf, String), Option<PathBuf>>,
    bytes: HashMap<PathBuf, Arc<[u8]>>,
}

impl Images {
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
