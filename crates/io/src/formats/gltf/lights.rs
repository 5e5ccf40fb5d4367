//! Cameras of the file, and its lights (KHR_lights_punctual). Invalid cameras are left out.

use gltf::json;
use gltf::json::extensions::scene::khr_lights_punctual::{Light as JsonLight, Spot, Type as LightType};
use gltf::json::{Root, camera};
use trigon_camera::Projection;
use trigon_math::Vec3;
use trigon_scene::{Light, LightKind};

use super::accessor::valid;
use crate::error::Location;
use crate::warning::Warnings;

/// Lux and candela count the light that arrives; a white diffuse surface
/// sends 1/π of it back in each direction, and that is trigon's unit.
const TO_INTENSITY: f32 = std::f32::consts::FRAC_1_PI;

pub(crate) fn light_index(node: &json::Node) -> Option<usize> {
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
pub(crate) fn convert_light(root: &Root, node: &json::Node, warnings: &mut Warnings) -> Option<Light> {
    let index = light_index(node)?;
    let light = &lights(root)[index];
    let location = || Location::Item("light", index);
    warn_of_range(light, &location, warnings);
    let intensity = amount(light.intensity) * TO_INTENSITY;
    let plain = match valid(&light.type_) {
        Some(LightType::Directional) => Light::directional(intensity),
        Some(LightType::Point) => Light::point(intensity),
        Some(LightType::Spot) => {
            let (inner, outer) = cone(light, location, warnings);
            Light { kind: LightKind::Spot { inner, outer }, ..Light::spot(intensity) }
        }
        None => {
            warnings.push(location(), "its type is unknown and it is left out", "export the model again");
            return None;
        }
    };
    let range = light.range.filter(|&range| range > 0.0 && range.is_finite());
    let color = Vec3::from(light.color.map(amount));
    Some(plain.with_color(color).with_range(range.unwrap_or(f32::INFINITY)))
}

/// A finite number from 0.
fn amount(value: f32) -> f32 {
    if value.is_finite() && value > 0.0 { value } else { 0.0 }
}

/// Says when a light takes light away, or reaches nowhere.
fn warn_of_range(light: &JsonLight, location: &impl Fn() -> Location, warnings: &mut Warnings) {
    let colors = light.color.iter().copied();
    if colors.chain([light.intensity]).any(|value| amount(value) != value) {
        let what = "its intensity or colour is negative or too large; it counts as 0";
        warnings.push(location(), what, "export the model again");
    }
    if light.range.is_some_and(|range| amount(range) == 0.0) {
        let what = "its range is not above 0; it counts as unlimited";
        warnings.push(location(), what, "export the model again");
    }
}

/// Inner and outer angle of a spot light in radians, mended where they
/// contradict the extension: 0 ≤ inner < outer ≤ π/2.
fn cone(light: &JsonLight, location: impl Fn() -> Location, warnings: &mut Warnings) -> (f32, f32) {
    const WIDEST: f32 = std::f32::consts::FRAC_PI_2;
    let spot = light.spot.clone().unwrap_or(Spot { inner_cone_angle: 0.0, outer_cone_angle: WIDEST / 2.0 });
    let (inner, outer) = (spot.inner_cone_angle, spot.outer_cone_angle);
    if 0.0 <= inner && inner < outer && outer <= WIDEST {
        return (inner, outer);
    }
    let what = format!("its cone from {inner} to {outer} is not within 0 and π/2 and is corrected");
    warnings.push(location(), what, "export the model again");
    let within = |angle: f32, most: f32| if angle.is_finite() { angle.clamp(0.0, most) } else { 0.0 };
    let outer = within(outer, WIDEST);
    (within(inner, outer), outer)
}

/// The camera of a node, if it has one that works.
pub(crate) fn convert_camera(root: &Root, node: &json::Node, warnings: &mut Warnings) -> Option<Projection> {
    let index = node.camera?.value();
    let camera = &root.cameras[index];
    let projection = match (valid(&camera.type_), &camera.perspective, &camera.orthographic) {
        (Some(camera::Type::Perspective), Some(from), _) => {
            Projection::perspective(from.yfov.into(), from.znear.into(), from.zfar.map(f64::from))
                .map_err(|error| error.to_string())
        }
        (Some(camera::Type::Orthographic), _, Some(from)) if from.xmag <= 0.0 => {
            Err("its xmag must be more than 0".to_owned())
        }
        // The magnifications are half extents.
        (Some(camera::Type::Orthographic), _, Some(from)) => {
            Projection::orthographic(2.0 * f64::from(from.ymag), from.znear.into(), from.zfar.into())
                .map_err(|error| error.to_string())
        }
        _ => Err("it is neither perspective nor orthographic".to_owned()),
    };
    match projection {
        Ok(projection) => Some(projection),
        Err(why) => {
            warnings.push(
                Location::Item("camera", index),
                format!("the camera is left out: {why}"),
                "correct the camera in the model",
            );
            None
        }
    }
}
