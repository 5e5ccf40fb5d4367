//! Reads the extensions of materials whose parameters are plain numbers, colours and textures.
//! [`Material::EXTENSION_PARAMETERS`] lists them. Factors have valid ranges.

use gltf::json::extensions::material::Material as Extensions;
use gltf::json::texture;
use serde_json::{Map, Value};
use trigon_scene::{ExtensionParameter, Material, MaterialTexture, ParameterField};

/// The names of the extensions.
pub(crate) fn names() -> Vec<&'static str> {
    let mut names: Vec<&str> = Material::EXTENSION_PARAMETERS.iter().map(|row| row.extension).collect();
    names.dedup();
    names
}

/// The parameters of an extension.
pub(crate) fn parameters(extension: &str) -> impl Iterator<Item = &'static ExtensionParameter> {
    Material::EXTENSION_PARAMETERS.iter().filter(move |row| row.extension == extension)
}

/// The members of an extension's object, if a material has it.
pub(crate) fn members(extensions: &Extensions, name: &str) -> Option<Map<String, Value>> {
    // gltf-json parses these two itself.
    let value = match name {
        "KHR_materials_specular" => serde_json::to_value(extensions.specular.as_ref()?).ok()?,
        "KHR_materials_transmission" => serde_json::to_value(extensions.transmission.as_ref()?).ok()?,
        _ => extensions.others.get(name)?.clone(),
    };
    match value {
        Value::Object(members) => Some(members),
        _ => None,
    }
}

/// The textures that extensions give a material.
pub(crate) fn textures(extensions: &Extensions) -> Vec<(MaterialTexture, texture::Info)> {
    let mut found = Vec::new();
    for members in names().into_iter().filter_map(|name| Some((name, members(extensions, name)?))) {
        for row in parameters(members.0) {
            if let ParameterField::Texture(slot) = row.field
                && let Some(info) = members.1.get(row.name)
                && let Ok(info) = serde_json::from_value(info.clone())
            {
                found.push((slot, info));
            }
        }
    }
    found
}

/// Sets the numbers and colours that extensions give a material. What is out of range is limited, and
/// what is no number leaves the default.
pub(crate) fn read_factors(extensions: &Extensions, material: &mut Material) {
    for name in names() {
        let Some(members) = members(extensions, name) else { continue };
        for row in parameters(name) {
            let Some(values) = members.get(row.name).and_then(numbers) else { continue };
            match row.field {
                ParameterField::Share(field) => {
                    if let (Some(field), [value]) = (field(material), values.as_slice()) {
                        *field = share(*value, *field);
                    }
                }
                ParameterField::Amount(field) => {
                    if let (Some(field), [value]) = (field(material), values.as_slice()) {
                        *field = amount(*value, *field);
                    }
                }
                ParameterField::Color(field) => {
                    if let (Some(field), &[r, g, b]) = (field(material), values.as_slice()) {
                        *field = [amount(r, field.x), amount(g, field.y), amount(b, field.z)].into();
                    }
                }
                ParameterField::Texture(_) => {}
            }
        }
    }
}

/// A number, or a list of some.
pub(crate) fn numbers(value: &Value) -> Option<Vec<f32>> {
    match value {
        Value::Array(list) => list.iter().map(|value| Some(value.as_f64()? as f32)).collect(),
        _ => value.as_f64().map(|value| vec![value as f32]),
    }
}

/// A number from 0 to 1.
pub(crate) fn share(value: f32, otherwise: f32) -> f32 {
    if value.is_finite() { value.clamp(0.0, 1.0) } else { otherwise }
}

/// A number from 0.
pub(crate) fn amount(value: f32, otherwise: f32) -> f32 {
    match value.is_finite() {
        true if value > 0.0 => value,
        true => 0.0,
        false => otherwise,
    }
}
