//! Contradictions in a document, found before it is read. It is drawn anyway, and each warning says
//! how.
//!
//! Only parts that the scene reaches are checked, because the rest is not visible. Contradictions
//! that only show in accessor data are reported where it is read.

use std::collections::{BTreeSet, HashSet};

use gltf::json;
use gltf::json::animation::{Channel, Property};
use gltf::json::extensions::texture::TextureTransform;
use gltf::json::validation::Checked;
use gltf::json::{Animation, Root};
use serde_json::{Map, Value};
use trigon_scene::{Material, ParameterField};

use super::accessor::valid;
use super::document::Document;
use super::hierarchy::Hierarchy;
use super::images::image_of;
use super::material_extensions;
use super::material_extensions::numbers;
use super::slots::slot_textures;
use crate::error::Location;
use crate::warning::{Warnings, counted};

pub(crate) fn warn_of_contradictions(document: &Document, hierarchy: &Hierarchy, warnings: &mut Warnings) {
    let root = &document.root;
    warn_of_version(root, warnings);
    warn_of_listed_children(hierarchy, warnings);
    let meshes: BTreeSet<usize> =
        hierarchy.order.iter().filter_map(|&node| Some(root.nodes[node].mesh?.value())).collect();
    warn_of_meshes(document, hierarchy, &meshes, warnings);
    let primitives = meshes.iter().flat_map(|&mesh| &root.meshes[mesh].primitives);
    let materials: BTreeSet<usize> =
        primitives.filter_map(|primitive| Some(primitive.material?.value())).collect();
    warn_of_materials(root, &materials, warnings);
    warn_of_animations(document, hierarchy, warnings);
}

/// A later 2.x may be read as 2.0, unless its `minVersion` says otherwise.
fn warn_of_version(root: &Root, warnings: &mut Warnings) {
    let version = &root.asset.version;
    if version.split('.').nth(1).is_some_and(|minor| minor != "0") {
        let what = format!("the file is glTF {version} and is read as 2.0: what is newer is not drawn");
        warnings.push(Location::Whole, what, "export the model as glTF 2.0");
    }
}

/// Reports nodes that the scene lists as its roots although they have a parent.
fn warn_of_listed_children(hierarchy: &Hierarchy, warnings: &mut Warnings) {
    for &node in &hierarchy.listed_children {
        let what = match hierarchy.parents[node] {
            Some(_) => {
                "the scene lists it as a root, and it is another node's child; it is drawn once, as that child"
            }
            None => {
                "the scene lists it as a root without its parent; it is drawn without the parent's transform"
            }
        };
        warnings.push(Location::Item("node", node), what, REMEDY);
    }
}

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

fn warn_of_materials(root: &Root, used: &BTreeSet<usize>, warnings: &mut Warnings) {
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

fn warn_of_meshes(
    document: &Document,
    hierarchy: &Hierarchy,
    used: &BTreeSet<usize>,
    warnings: &mut Warnings,
) {
    let root = &document.root;
    for &mesh in used {
        warn_of_weights(
            root.meshes[mesh].weights.as_ref(),
            root,
            mesh,
            Location::Item("mesh", mesh),
            warnings,
        );
        let counts: BTreeSet<usize> = target_counts(root, mesh).collect();
        if counts.len() > 1 {
            let what = "its primitives have different numbers of morph targets; a primitive without a target keeps its shape";
            warnings.push(Location::Item("mesh", mesh), what, REMEDY);
        }
    }
    for &node in &hierarchy.order {
        let from = &root.nodes[node];
        if let Some(mesh) = from.mesh {
            let location = Location::Item("node", node);
            warn_of_weights(from.weights.as_ref(), root, mesh.value(), location, warnings);
        }
    }
    for from in document.foreign_attributes.iter().filter(|from| used.contains(&from.mesh)) {
        let location = Location::Named(format!("mesh {}, primitive {}", from.mesh, from.primitive));
        let (name, remedy) = (&from.name, "rename or bake it if something is missing");
        let what = if from.in_target {
            format!("{name} of a morph target is not supported and is ignored")
        } else {
            format!("{name} is not an attribute of glTF and is ignored")
        };
        warnings.push(location, what, remedy);
    }
}

/// The number of morph targets of each primitive of a mesh.
fn target_counts(root: &Root, mesh: usize) -> impl Iterator<Item = usize> {
    let primitives = root.meshes[mesh].primitives.iter();
    primitives.map(|primitive| primitive.targets.as_ref().map_or(0, Vec::len))
}

/// Warns if the number of weights differs from the number of morph targets of a mesh.
fn warn_of_weights(
    weights: Option<&Vec<f32>>,
    root: &Root,
    mesh: usize,
    location: Location,
    warnings: &mut Warnings,
) {
    let targets = target_counts(root, mesh).max().unwrap_or(0);
    if let Some(weights) = weights.filter(|weights| weights.len() != targets) {
        let (weights, targets) = (counted(weights.len(), "weight"), counted(targets, "morph target"));
        let what =
            format!("it has {weights} for {targets}; missing weights count as 0, and extra ones are ignored");
        warnings.push(location, what, REMEDY);
    }
}

fn warn_of_animations(document: &Document, hierarchy: &Hierarchy, warnings: &mut Warnings) {
    for (index, animation) in document.root.animations.iter().enumerate() {
        warn_of_animation(document, hierarchy, animation, index, warnings);
    }
}

fn warn_of_animation(
    document: &Document,
    hierarchy: &Hierarchy,
    animation: &Animation,
    index: usize,
    warnings: &mut Warnings,
) {
    let mut moved = HashSet::new();
    for (number, channel) in animation.channels.iter().enumerate() {
        let node = channel.target.node.value();
        let Some(property) = valid(&channel.target.path).filter(|_| hierarchy.included[node]) else {
            continue;
        };
        let location = || Location::Named(format!("animation {index}, channel {number}"));
        if !moved.insert((node, property as u8)) {
            let what = "an earlier channel moves the same property of the same node; the last one counts";
            warnings.push(location(), what, "remove one of them, or export the animation again");
        }
        if moves_a_matrix(document, channel) {
            let what =
                "its node has a matrix, which is split into translation, rotation and scale; shear is lost";
            warnings.push(location(), what, REMEDY);
        }
    }
}

fn moves_a_matrix(document: &Document, channel: &Channel) -> bool {
    let transform = document.transforms.get(channel.target.node.value());
    transform.is_some_and(|transform| transform.matrix.is_some())
        && valid(&channel.target.path) != Some(Property::MorphTargetWeights)
}

const REMEDY: &str = "export the model again";
