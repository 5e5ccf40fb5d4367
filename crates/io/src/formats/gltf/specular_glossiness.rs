//! KHR_materials_pbrSpecularGlossiness, read as the extensions that took its place. Its diffuse colour is the base
//! colour of a dielectric. Its specular colour is that of KHR_materials_specular, with an index of refraction of
//! 0, which leaves the colour as it is. The roughness is 1 − glossiness; its texture is made of the alpha of the
//! specular-glossiness texture.
//!
//! All of it is exact but for two things. Roughness from a texture is rounded to 8 bits. Diffuse light loses what
//! is reflected at the angle of view; the extension takes off the largest channel of the specular colour.

use gltf::json::extensions::material::{
    IndexOfRefraction, Ior, Specular, SpecularColorFactor, SpecularFactor,
};
use gltf::json::material::{PbrBaseColorFactor, StrengthFactor};
use gltf::json::{Material, Root, texture};
use serde_json::{Map, Value};

use super::material_extensions::numbers;
use super::material_extensions::share;

/// The name of the extension.
pub(crate) const NAME: &str = "KHR_materials_pbrSpecularGlossiness";

/// Puts the extension of all materials in the place of their metallic-roughness. An unlit material shows
/// the latter's base colour.
pub(crate) fn translate(root: &mut Root) {
    for material in &mut root.materials {
        if let Some(members) = members(material).cloned() {
            translate_one(material, &members);
        }
    }
}

/// The glossiness of a material whose texture of roughness holds glossiness in its alpha.
pub(crate) fn glossiness(material: &Material) -> Option<f32> {
    let members = members(material)?;
    texture_in(members, "specularGlossinessTexture")?;
    Some(factor(members))
}

fn members(material: &Material) -> Option<&Map<String, Value>> {
    let extensions = material.extensions.as_ref().filter(|extensions| extensions.unlit.is_none())?;
    extensions.others.get(NAME)?.as_object()
}

fn factor(members: &Map<String, Value>) -> f32 {
    let given = members.get("glossinessFactor").and_then(Value::as_f64);
    given.map_or(1.0, |factor| share(factor as f32, 1.0))
}

fn texture_in(members: &Map<String, Value>, name: &str) -> Option<texture::Info> {
    serde_json::from_value(members.get(name)?.clone()).ok()
}

fn translate_one(material: &mut Material, members: &Map<String, Value>) {
    let color = |name: &str| members.get(name).and_then(numbers).unwrap_or_default();
    let surface = texture_in(members, "specularGlossinessTexture");
    let pbr = &mut material.pbr_metallic_roughness;
    pbr.base_color_factor = PbrBaseColorFactor(color("diffuseFactor").try_into().unwrap_or([1.0; 4]));
    pbr.base_color_texture = texture_in(members, "diffuseTexture");
    pbr.metallic_factor = StrengthFactor(0.0);
    pbr.roughness_factor = StrengthFactor(if surface.is_some() { 1.0 } else { 1.0 - factor(members) });
    pbr.metallic_roughness_texture = surface.clone();
    let extensions = material.extensions.get_or_insert_default();
    extensions.ior = Some(Ior { ior: IndexOfRefraction(0.0), extras: Default::default() });
    extensions.specular = Some(Specular {
        specular_factor: SpecularFactor(1.0),
        specular_color_factor: SpecularColorFactor(color("specularFactor").try_into().unwrap_or([1.0; 3])),
        specular_color_texture: surface,
        ..Specular::default()
    });
}
