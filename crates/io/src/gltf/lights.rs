//! KHR_lights_punctual.

use gltf_json::extensions::scene::khr_lights_punctual::{Light as JsonLight, Type};
use gltf_json::{Node, Root};
use trigon_math::Vec3;
use trigon_scene::Light;

use super::accessor::valid;
use crate::error::Place;
use crate::warning::Warnings;

/// Lux and candela count the light that arrives; a white diffuse surface
/// sends 1/π of it back in each direction, and that is trigon's unit.
const TO_INTENSITY: f32 = std::f32::consts::FRAC_1_PI;

pub(crate) fn light_index(node: &Node) -> Option<usize> {
    Some(node.extensions.as_ref()?.khr_lights_punctual.as_ref()?.light.value())
}

pub(crate) fn light_count(root: &Root) -> usize {
    lights(root).len()
}

fn lights(root: &Root) -> &[JsonLight] {
    let punctual = root.extensions.as_ref().and_then(|extensions| extensions.khr_lights_punctual.as_ref());
    punctual.map_or(&[], |punctual| &punctual.lights)
}

/// The light of a node, if it has one.
pub(crate) fn convert_light(root: &Root, node: &Node, warnings: &mut Warnings) -> Option<Light> {
    let index = light_index(node)?;
    let light = &lights(root)[index];
    let place = || Place::Item("light", index);
    let intensity = light.intensity * TO_INTENSITY;
    let plain = match valid(&light.type_) {
        Some(Type::Directional) => Light::directional(intensity),
        Some(Type::Point) => Light::point(intensity),
        Some(Type::Spot) => {
            warnings.push(
                place(),
                "spot lights are not drawn yet; it shines in all directions",
                "aim at the same effect with a point or directional light",
            );
            Light::point(intensity)
        }
        None => {
            warnings.push(place(), "its type is unknown and it is left out", "export the model again");
            return None;
        }
    };
    Some(plain.with_color(Vec3::from(light.color)))
}
