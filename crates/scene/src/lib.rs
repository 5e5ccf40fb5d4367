//! A scene of nodes, meshes, materials and lights, and its renderer.
//!
//! The scene is plain data; [`render`] is a pure function of scene, camera and
//! settings, and the same input gives the same bytes on every machine and at
//! every thread count. This crate reads no files and opens no windows.
//!
//! ```
//! use trigon_scene::mesh::primitives;
//! use trigon_scene::{Light, Material, Node, Outputs, RenderSettings, Scene, render};
//! use trigon_scene::math::Vec3;
//!
//! let mut scene = Scene::new();
//! let ball = scene.add_object("ball", primitives::icosphere(1.0, 2), Material::from_color(Vec3::X));
//! scene.add(Node::from_light(Light::ambient(1.0)));
//!
//! let outputs = Outputs { ids: true, ..Outputs::default() };
//! let settings = RenderSettings { outputs, ..RenderSettings::new(9, 9) };
//! let frame = render(&scene, &scene.overview(settings.aspect()), &settings)?;
//!
//! // A red ball in the middle of the image, and we know which one it is.
//! let [red, green, blue, alpha] = frame.pixel(4, 4);
//! assert!(red > 200 && green < 10 && blue < 10 && alpha == 255);
//! assert_eq!(frame.hit(scene.nodes(), 4, 4).map(|hit| hit.node), Some(ball));
//! assert_eq!(frame.hit(scene.nodes(), 0, 0), None, "the corner is background");
//! # Ok::<(), trigon_scene::RenderError>(())
//! ```
//!
//! [`render`] draws one image. For many, a [`Renderer`] holds the settings and
//! keeps threads, memory and shadow maps from one to the next; the bytes are the same.

mod animation;
mod arena;
#[cfg(test)]
mod baseline;
mod check;
mod coarse;
mod display;
mod effect;
mod effect_settings;
mod effects;
mod elements;
mod environment;
mod frame;
mod geometry;
mod lanes;
mod light;
mod light_meter;
mod lighting;
mod material;
mod mesh_asset;
mod node;
mod outputs;
mod pick;
mod placement;
mod plan;
mod prepare;
pub mod quality;
mod render;
mod scene;
mod settings;
mod shadow_maps;
mod shapes;
mod showcase;
mod surface;
mod texture_asset;
mod transform;
mod unseen;
pub mod views;
mod work;

pub use animation::{Animation, Channel, Curve, Interpolation, Property};
pub use arena::{Arena, Id};
pub use check::{Finding, Severity};
pub use coarse::CoarseMeshWork;
pub use display::Display;
pub use effect::Effect;
pub use effect_settings::{
    AmbientOcclusion, EffectSettings, Exposure, Fog, MetalReflection, Outline, RaySampling, Shadows,
    SightRays, SoftShadows, ToneMapping,
};
pub use effects::EffectCounts;
pub use elements::{ElementSet, Mark, Marks, VertexPoints};
pub use environment::{Environment, EnvironmentError, Sky};
/// The bit set inside [`ElementSet`].
pub use fixedbitset::FixedBitSet;
pub use frame::{Frame, Hit};
pub use light::{Light, LightKind, LightReading};
pub use light_meter::{ExposureFault, ExposureWarning};
pub use material::{
    AlphaMode, ColorError, ExtensionParameter, Material, MaterialId, MaterialTexture, MetallicRoughness,
    NormalMap, Occlusion, ParameterField, Shading, TextureBinding, css_color,
};
pub use mesh_asset::{MeshAsset, MeshId};
pub use node::{Node, NodeId, Skin, SkinId};
pub use pick::{CachedPoints, Nearest, Pick, Picker, Reach, Region, Snap, SnapElement};
pub use plan::{Absence, Cause, Decision, EffectPlan, Invisible, Named, Omission};
pub use render::{RenderError, Renderer, RendererBuilder, render, render_fisheye};
pub use scene::{NodePose, Pose, Scene, SceneError, SceneParts, SkinPose};
pub use settings::{
    Background, Lighting, MAX_SIZE, Outputs, Reflection, RenderSettings, ShadingModel, Style,
};
pub use showcase::showcase;
pub use texture_asset::{TextureAsset, TextureId};
pub use transform::Transform;
pub use trigon_raster::simd::{SimdLevel, SimdLevelError};
pub use trigon_raster::{
    Cancel, EdgeExplanation, Filter, FragmentExplanation, MipFilter, PixelExplanation, PrimitiveKind, Rect,
    SampleExplanation, Sampler, StageTimes, Stats, Texture, TextureError, TextureFormat, Verdict, Wrap,
};
pub use views::OVERVIEW_DIRECTION;
/// Re-exports of the crates below, so that a user of scenes needs no others.
pub use {trigon_camera as camera, trigon_math as math, trigon_mesh as mesh};

/// Runs the README's example as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
