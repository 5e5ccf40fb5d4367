//! Contradictions in materials, samplers and images, which cannot be drawn as specified.

use std::collections::BTreeSet;

use gltf::json::extensions::texture::TextureTransform;
use gltf::json::validation::Checked;
use gltf::json::{self, Root};
use serde_json::{Map, Value};
use trigon_scene::{Material, ParameterField};

use super::remedy::REMEDY;
use crate::error::Location;
use crate::formats::gltf::images::image_of;
use crate::formats::gltf::material_extensions::{self, numbers};
use crate::formats::gltf::slots::slot_textures;
use crate::warning::Warnings;

/// The valid range of a factor, and what happens outside it.
#[derive(Clone, Copy)]
struct Range {
    least: f32,
    most: f32,
    otherwise: &'static str,
}

const SHARE: Range = Range { least: 0.0, most: 1.0, otherwise: "not between 0 and 1" };
const AMOUNT: Range = Range { least: 0.0, most: f32::MAX, otherwise: "negative or too large" };
const REFRACTION: Range = Range { least: 1.0, most: f32::MAX, otherwise: "below 1 or too large" };

pub(super) fn warn_of_materials(root: &Root, used: &BTreeSet<usize>, warnings: &mut Warnings) {
    let mut textures = BTreeSet::new();
    for &index in used {
        let material = &root.materials[index];
        let mut warn = |what: String| warnings.push(Location::Item("material", index), what, REMEDY);
        factors(material).into_iter().filter_map(|factor| factor.fault()).for_each(&mut warn);
        if matches!(material.alpha_mode, Checked::Invalid) {
            warn("its alphaMode is unknown; it is drawn opaque".to_owned());
        }
        if is_unlit_and_more(material) {
            warn("it is unlit, so its other extensions have no effect".to_owned());
        }
        if is_closed_volume(material) {
            warn("it is a volume without transmission, which no light enters".to_owned());
        }
        for name in malformed_transforms(material) {
            warn(format!("the KHR_texture_transform of its {name} is malformed and ignored"));
        }
        textures.extend(slot_textures(material).into_iter().map(|texture| texture.texture));
    }
    warn_of_samplers(root, &textures, warnings);
    warn_of_images(root, &textures, warnings);
}

/// One or more numbers of a material, and their valid range.
struct Factor {
    name: &'static str,
    values: Vec<f32>,
    range: Range,
}

impl Factor {
    /// The message if it is out of range.
    fn fault(&self) -> Option<String> {
        let Range { least, most, otherwise } = self.range;
        let is_sound = self.values.iter().all(|value| (least..=most).contains(value));
        (!is_sound).then(|| format!("its {} is {otherwise} and is clamped", self.name))
    }
}

/// The factors with which the material is drawn: for an unlit one only its colour.
fn factors(material: &json::Material) -> Vec<Factor> {
    let pbr = &material.pbr_metallic_roughness;
    let factor = |name, values: &[f32], range| Factor { name, values: values.to_vec(), range };
    let mut list = vec![factor("baseColorFactor", &pbr.base_color_factor.0, SHARE)];
    let extensions = material.extensions.as_ref();
    if extensions.is_some_and(|extensions| extensions.unlit.is_some()) {
        return list;
    }
    list.push(factor("metallicFactor", &[pbr.metallic_factor.0], SHARE));
    list.push(factor("roughnessFactor", &[pbr.roughness_factor.0], SHARE));
    list.push(factor("emissiveFactor", &material.emissive_factor.0, AMOUNT));
    if let Some(occlusion) = &material.occlusion_texture {
        list.push(factor("occlusion strength", &[occlusion.strength.0], SHARE));
    }
    let Some(extensions) = extensions else { return list };
    if let Some(from) = &extensions.emissive_strength {
        list.push(factor("emissiveStrength", &[from.emissive_strength.0], AMOUNT));
    }
    for row in Material::EXTENSION_PARAMETERS {
        let range = match row.field {
            ParameterField::Share(_) => SHARE,
            ParameterField::Amount(_) | ParameterField::Color(_) => AMOUNT,
            ParameterField::Texture(_) => continue,
        };
        let members = material_extensions::members(extensions, row.extension);
        let values = members.as_ref().and_then(|members| numbers(members.get(row.name)?));
        list.extend(values.map(|values| factor(row.name, &values, range)));
    }
    // 0 stands for a surface that reflects everything.
    if let Some(ior) = extensions.ior.as_ref().map(|from| from.ior.0).filter(|&ior| ior != 0.0) {
        list.push(factor("ior", &[ior], REFRACTION));
    }
    list
}

/// Whether it is unlit and has effects that apply only to lit surfaces.
fn is_unlit_and_more(material: &json::Material) -> bool {
    material.extensions.as_ref().is_some_and(|extensions| {
        let more = extensions.emissive_strength.is_some()
            || material_extensions::names()
                .iter()
                .any(|name| material_extensions::members(extensions, name).is_some())
            || extensions.ior.is_some();
        extensions.unlit.is_some() && more
    })
}

/// Whether it has a volume under a surface that lets no light through.
fn is_closed_volume(material: &json::Material) -> bool {
    material.extensions.as_ref().is_some_and(|extensions| {
        extensions.others.contains_key("KHR_materials_volume") && extensions.transmission.is_none()
    })
}

/// The textures with a malformed transform, which gltf-json does not check.
fn malformed_transforms(material: &json::Material) -> Vec<&'static str> {
    let is_malformed = |others: &Map<String, Value>| {
        let transform = others.get("KHR_texture_transform");
        transform.is_some_and(|from| serde_json::from_value::<TextureTransform>(from.clone()).is_err())
    };
    let normal = material.normal_texture.as_ref().and_then(|texture| texture.extensions.as_ref());
    let occlusion = material.occlusion_texture.as_ref().and_then(|texture| texture.extensions.as_ref());
    let normal = normal.filter(|extensions| is_malformed(&extensions.others)).map(|_| "normalTexture");
    let occlusion =
        occlusion.filter(|extensions| is_malformed(&extensions.others)).map(|_| "occlusionTexture");
    normal.into_iter().chain(occlusion).collect()
}

fn warn_of_samplers(root: &Root, textures: &BTreeSet<usize>, warnings: &mut Warnings) {
    let samplers: BTreeSet<usize> =
        textures.iter().filter_map(|&texture| Some(root.textures[texture].sampler?.value())).collect();
    for index in samplers {
        let sampler = &root.samplers[index];
        let faults = [
            ("wrapS", matches!(sampler.wrap_s, Checked::Invalid), "it repeats"),
            ("wrapT", matches!(sampler.wrap_t, Checked::Invalid), "it repeats"),
            ("magFilter", matches!(sampler.mag_filter, Some(Checked::Invalid)), "it is linear"),
            ("minFilter", matches!(sampler.min_filter, Some(Checked::Invalid)), "it is linear"),
        ];
        for (name, _, instead) in faults.into_iter().filter(|(_, is_invalid, _)| *is_invalid) {
            warnings.push(
                Location::Item("sampler", index),
                format!("its {name} is unknown; {instead}"),
                REMEDY,
            );
        }
    }
}

fn warn_of_images(root: &Root, textures: &BTreeSet<usize>, warnings: &mut Warnings) {
    let images: BTreeSet<usize> = textures.iter().filter_map(|&texture| image_of(root, texture)).collect();
    for index in images {
        let image = &root.images[index];
        if image.uri.is_some() && image.buffer_view.is_some() {
            let what = "it has a URI and a bufferView; the URI is used";
            warnings.push(Location::Item("image", index), what, REMEDY);
        }
    }
}
