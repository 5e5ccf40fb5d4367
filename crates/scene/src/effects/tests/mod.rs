//! Images of single effects against what geometry says.

mod backdrop;
mod glass;
mod kept;
mod metals;
mod occlusion;
mod planning;
mod poses;
mod shading;
mod shadows;
mod sight;
mod soft_shadows;
mod studio;
mod unseen;

use std::sync::Arc;

use trigon_camera::{Camera, Projection};
use trigon_math::{DQuat, DVec3, Vec3, Vec4, color, elementary};
use trigon_mesh::{Attributes, primitives};
use trigon_raster::{Texture, TextureFormat};

use super::*;
use crate::{
    AlphaMode, AmbientOcclusion, Background, Decision, EffectPlan, EffectSettings, Environment, Exposure,
    Fog, Frame, Light, LightKind, Lighting, Material, MetalReflection, MetallicRoughness, Node, NormalMap,
    Occlusion, Outline, RaySampling, RenderSettings, Renderer, Scene, Shading, ShadingModel, Shadows,
    SightRays, SoftShadows, Style, TextureBinding, ToneMapping, Transform, render,
};

const SIDE: u32 = 128;

/// Metres from the left edge of the image to the right one.
const WIDE: f64 = 4.0;

fn settings(effects: EffectSettings) -> RenderSettings {
    RenderSettings {
        samples_per_axis: 1,
        background: Background::Color(Vec3::ZERO),
        lighting: Lighting::Scene,
        effects,
        ..RenderSettings::new(SIDE, SIDE)
    }
}

/// Straight down, parallel; x to the right, z downwards.
fn from_above() -> Camera {
    let projection = Projection::orthographic(WIDE, 0.1, 20.0).expect("the numbers are in range");
    Camera { projection, ..Camera::look_at(DVec3::Y * 10.0, DVec3::ZERO, DVec3::NEG_Z) }
}

/// Straight at the scene from +Z, parallel.
fn from_front() -> Camera {
    let projection = Projection::orthographic(WIDE, 0.1, 20.0).expect("the numbers are in range");
    Camera { projection, ..Camera::look_at(DVec3::Z * 10.0, DVec3::ZERO, DVec3::Y) }
}

fn matt(color: Vec3) -> Material {
    Material { base_color: color.extend(1.0), shading: Shading::Lambert, ..Material::default() }
}

/// A light that shines along a direction.
fn shining(light: Light, from: DVec3, along: DVec3) -> Node {
    let turned = Camera::look_at(from, from + along, DVec3::Z).orientation;
    Node::from_light(light).with_transform(Transform::from_scale_rotation_translation(
        DVec3::ONE,
        turned,
        from,
    ))
}

/// The light of a pixel's green, which is that of all channels here.
fn light(frame: &Frame, x: u32, y: u32) -> f32 {
    color::srgb8_to_linear(frame.pixel(x, y)[1])
}

/// Where a pixel is across and above the middle of the image, in radii of a ball around that.
fn on_ball(pixel: usize, radius: f64) -> [f64; 2] {
    let [x, y] = [pixel % SIDE as usize, pixel / SIDE as usize];
    let metres = |at: usize| (at as f64 + 0.5) / f64::from(SIDE) * WIDE - WIDE / 2.0;
    [metres(x) / radius, -metres(y) / radius]
}

fn metal(metallic: f32) -> Material {
    let model = MetallicRoughness { metallic, roughness: 0.0, ..MetallicRoughness::default() };
    Material { base_color: Vec4::ONE, shading: Shading::MetallicRoughness(model), ..Material::default() }
}
