//! A scene of nodes, meshes, materials and lights, and its renderer.
//!
//! The scene is plain data; [`render`] is a pure function of scene, camera and
//! settings, and the same input gives the same bytes on every machine and at
//! every thread count. This crate reads no files and opens no windows.

mod arena;
mod background;
mod frame;
mod light;
mod material;
mod node;
mod render;
mod scene;
mod settings;
mod transform;

pub use arena::{Arena, Id};
pub use background::Background;
pub use frame::{Frame, Hit};
pub use light::{Light, LightKind};
pub use material::{AlphaMode, Material, Shading, TextureBinding};
pub use node::Node;
pub use render::{RenderError, Renderer, render};
pub use scene::{MaterialId, MeshAsset, MeshId, NodeId, Scene, SceneError, TextureAsset, TextureId};
pub use settings::{Lighting, MAX_SIZE, Outputs, RenderSettings, Style};
pub use transform::Transform;
pub use trigon_raster::{Filter, MipFilter, Sampler, Stats, Texture, TextureError, TextureFormat, Wrap};
