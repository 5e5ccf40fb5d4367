//! Materials of the document to materials of the scene.

use std::collections::BTreeMap;

use gltf::json::Root;
use gltf::json::extensions::material::Material as Extensions;
use gltf::json::material::AlphaMode as JsonAlphaMode;
use trigon_math::{Vec3, Vec4};
use trigon_scene::{
    AlphaMode, Material, MaterialId, MaterialTexture, MetallicRoughness, NormalMap, Occlusion, Shading,
    TextureBinding,
};

use super::accessor::valid;
use super::buffers::Buffers;
use super::document::Document;
use super::images::{Images, convert_sampler};
use super::material_extensions;
use super::material_extensions::{amount, share};
use super::native::{ExactShading, Extras, MaterialExtras};
use super::slots::{SlotTexture, slot_textures};
use crate::error::LoadError;
use crate::import::Import;

/// Converts the materials that are used, `None` being the format's default.
pub(crate) fn add_materials(
    import: &mut Import<'_>,
    document: &Document,
    buffers: &mut Buffers,
    used: &[Option<usize>],
) -> Result<BTreeMap<Option<usize>, MaterialId>, LoadError> {
    let root = &document.root;
    let of_material = |&material: &Option<usize>| slot_textures_of(root, material);
    let textures: Vec<SlotTexture> = used.iter().flat_map(of_material).collect();
    let images = Images::read(import, root, buffers, &textures)?;
    let mut ids = BTreeMap::new();
    for &index in used {
        let material = match index {
            Some(index) => {
                let plain = Converter { root, index, images: &images }.material();
                let extras = document.native_materials.get(index).and_then(Extras::get);
                Material { shading: extras.map_or(plain.shading, |own| exact_shading(own, &plain)), ..plain }
            }
            None => default_material(),
        };
        ids.insert(index, import.scene.add_material(material));
    }
    Ok(ids)
}

/// The textures of a material; the default has none.
pub(crate) fn slot_textures_of(root: &Root, material: Option<usize>) -> Vec<SlotTexture> {
    material.map_or_else(Vec::new, |material| slot_textures(&root.materials[material]))
}

/// The base colour of a material and what it emits, which is all that lines and points show of it.
pub(crate) fn unlit_colors(root: &Root, material: Option<usize>) -> (Vec4, Vec3) {
    let Some(from) = material.map(|material| &root.materials[material]) else {
        return (Vec4::ONE, Vec3::ZERO);
    };
    let none = Extensions::default();
    let extensions = from.extensions.as_ref().unwrap_or(&none);
    let is_unlit = extensions.unlit.is_some();
    let emissive = if is_unlit { Vec3::ZERO } else { emissive(from.emissive_factor.0, extensions) };
    (base_color(from), emissive)
}

/// Whether nothing is seen through a material.
pub(crate) fn is_opaque(root: &Root, material: Option<usize>) -> bool {
    let mode = material.and_then(|material| valid(&root.materials[material].alpha_mode));
    !matches!(mode, Some(JsonAlphaMode::Mask | JsonAlphaMode::Blend))
}

fn base_color(from: &gltf::json::Material) -> Vec4 {
    Vec4::from(from.pbr_metallic_roughness.base_color_factor.0.map(|channel| share(channel, 1.0)))
}

/// A white, rough metal, seen from one side: what the specification gives a
/// primitive without a material.
fn default_material() -> Material {
    let model = MetallicRoughness { metallic: 1.0, roughness: 1.0, ..MetallicRoughness::default() };
    let plain = Material { base_color: Vec4::ONE, double_sided: false, ..Material::default() };
    plain.with_name("default").with_shading(Shading::MetallicRoughness(model))
}

/// One material on its way.
struct Converter<'a> {
    root: &'a Root,
    index: usize,
    images: &'a Images,
}

impl Converter<'_> {
    fn material(&self) -> Material {
        let from = &self.root.materials[self.index];
        let none = Extensions::default();
        let extensions = from.extensions.as_ref().unwrap_or(&none);
        let is_unlit = extensions.unlit.is_some();
        let normal_scale = from.normal_texture.as_ref().map_or(1.0, |normal| normal.scale);
        let strength = from.occlusion_texture.as_ref().map_or(1.0, |occlusion| occlusion.strength.0);
        let material = Material {
            name: from.name.clone().unwrap_or_else(|| format!("material {}", self.index)),
            base_color: base_color(from),
            base_color_texture: self.bind(MaterialTexture::BaseColor),
            alpha_mode: match valid(&from.alpha_mode) {
                Some(JsonAlphaMode::Mask) => {
                    AlphaMode::Mask { cutoff: from.alpha_cutoff.map_or(0.5, |cutoff| cutoff.0) }
                }
                Some(JsonAlphaMode::Blend) => AlphaMode::Blend,
                _ => AlphaMode::Opaque,
            },
            double_sided: from.double_sided,
            shading: Shading::Unlit,
            ..Material::default()
        };
        if is_unlit {
            return material;
        }
        let mut material = Material {
            shading: Shading::MetallicRoughness(self.model()),
            emissive: emissive(from.emissive_factor.0, extensions),
            emissive_texture: self.bind(MaterialTexture::Emissive),
            normal_map: self.bind(MaterialTexture::Normal).map(|binding| {
                let scale = if normal_scale.is_finite() { normal_scale } else { 1.0 };
                NormalMap { binding, scale }
            }),
            occlusion: self
                .bind(MaterialTexture::Occlusion)
                .map(|binding| Occlusion { binding, strength: share(strength, 1.0) }),
            ior: extensions.ior.as_ref().map_or(1.5, |from| refraction(from.ior.0)),
            ..material
        };
        material_extensions::read_factors(extensions, &mut material);
        for (slot, _) in material_extensions::textures(extensions) {
            material.set_texture(slot, self.bind(slot));
        }
        material
    }

    fn model(&self) -> MetallicRoughness {
        let pbr = &self.root.materials[self.index].pbr_metallic_roughness;
        MetallicRoughness {
            metallic: share(pbr.metallic_factor.0, 1.0),
            roughness: share(pbr.roughness_factor.0, 1.0),
            texture: self.bind(MaterialTexture::MetallicRoughness),
            ..MetallicRoughness::default()
        }
    }

    fn bind(&self, slot: MaterialTexture) -> Option<TextureBinding> {
        let from = slot_textures(&self.root.materials[self.index]);
        let from = from.iter().find(|texture| texture.slot == slot)?;
        Some(TextureBinding {
            texture: self.images.get(self.root, from)?,
            // Where the mesh lacks the set, the mesh reader filled it in.
            uv_set: from.uv_set as usize,
            transform: from.transform,
            sampler: convert_sampler(self.root, from.texture),
        })
    }
}

/// The shading model that a native file names beside what comes near it.
fn exact_shading(extras: &MaterialExtras, plain: &Material) -> Shading {
    match (extras.shading, &plain.shading) {
        (_, Shading::Unlit) => Shading::Unlit,
        (ExactShading::Lambert, _) => Shading::Lambert,
        (ExactShading::BlinnPhong { specular, shininess }, Shading::MetallicRoughness(model)) => {
            let specular_texture = model.specular_color_texture;
            Shading::BlinnPhong { specular: Vec3::from(specular), shininess, specular_texture }
        }
        (ExactShading::BlinnPhong { specular, shininess }, _) => {
            Shading::blinn_phong(Vec3::from(specular), shininess)
        }
    }
}

/// At least 1; 0 is what the extension writes for "reflects everything".
fn refraction(ior: f32) -> f32 {
    match amount(ior, 1.5) {
        0.0 => 0.0,
        below if below < 1.0 => 1.0,
        ior => ior,
    }
}

fn emissive(factor: [f32; 3], extensions: &Extensions) -> Vec3 {
    let strength = extensions.emissive_strength.as_ref().map_or(1.0, |from| from.emissive_strength.0);
    let emissive = Vec3::from(factor.map(|channel| amount(channel, 0.0))) * amount(strength, 1.0);
    if emissive.is_finite() { emissive } else { Vec3::ZERO }
}
