//! From a scene to a frame: gather lights, compose a pipeline for each mesh and material, record
//! one pass, execute it, and compute the outputs.
//!
//! A frame is a pure function of scene, camera and settings.

mod builder;
mod compose;
mod depth_image;
mod effect_caches;
mod engine;
mod last_frame;
mod looks;
mod record;
mod renderer;
mod shared_frames;
#[cfg(test)]
mod tests;
mod vertex_list;
mod wire;

pub use builder::RendererBuilder;
pub use renderer::Renderer;
/// For picking.
pub(crate) use {
    crate::placement,
    crate::shapes::{Onlookers, Shape, Shapes},
};

use thiserror::Error;
use trigon_camera::Camera;
use trigon_raster::TargetError;
use trigon_raster::simd::SimdLevelError;

use crate::frame::Frame;
use crate::scene::Scene;
use crate::settings::RenderSettings;

/// Why a frame cannot be drawn.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum RenderError {
    /// The size or the number of samples is out of range.
    #[error(transparent)]
    Target(#[from] TargetError),
    /// The processor lacks the requested SIMD level.
    #[error(transparent)]
    Simd(#[from] SimdLevelError),
    /// [`Renderer::render_cancellable`] or [`Renderer::render_shared`] was cancelled.
    #[error("the frame was cancelled")]
    Cancelled,
}

/// Draws one frame: a pure function of scene, camera and settings. It keeps nothing; to draw many,
/// use a [`Renderer`], which gives the same bytes faster.
///
/// # Errors
/// The size or the number of samples is out of range, or the processor lacks the requested SIMD
/// level.
pub fn render(scene: &Scene, camera: &Camera, settings: &RenderSettings) -> Result<Frame, RenderError> {
    Renderer::new(settings.clone()).render(scene, camera)
}
