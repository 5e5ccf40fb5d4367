//! From a scene to a frame. A frame is a pure function of scene, camera and settings.
//!
//! | file | what it does |
//! |---|---|
//! | `renderer` | the public renderer |
//! | `engine` | **the steps of a frame**; threads, memory and caches that last from frame to frame |
//! | `compose` | gives each draw a pipeline of the parts that its material and mesh need |
//! | `looks` | what the draws of one image share |
//! | `wire` | pipelines of edges, lines, points, and faces that only hide |
//! | `fisheye`, `lens_frame` | images through lenses that rays draw; the steps of their frames |
//! | `record` | draws that own their pipelines, until they are recorded in a pass |
//! | `bounds` | records them, in large scenes with where they lie in the image |
//! | `last_frame` | whether the last image may be reused, and for which effects not |
//! | `effect_caches` | what effects keep from frame to frame |
//! | `shared_frames` | frames that a window shows, drawn into again once it releases them |

mod bounds;
mod compose;
mod effect_caches;
mod engine;
mod fisheye;
mod last_frame;
mod lens_frame;
mod looks;
mod openness;
mod record;
mod renderer;
mod shared_frames;
mod wire;

use std::num::NonZeroUsize;

use thiserror::Error;
use trigon_camera::{Camera, FisheyeCamera};
use trigon_raster::TargetError;
use trigon_raster::simd::SimdLevelError;

use crate::effect_settings::EffectSettings;
use crate::frame::Frame;
use crate::scene::Scene;
use crate::settings::{Background, Outputs, RenderSettings, Style};

pub use renderer::Renderer;
pub(crate) use {
    crate::placement,
    crate::shapes::{Onlookers, Shape, Shapes},
};

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

/// Draws one frame through a fisheye lens; see [`Renderer::render_fisheye`].
///
/// # Errors
/// As [`render()`].
pub fn render_fisheye(
    scene: &Scene,
    camera: &FisheyeCamera,
    settings: &RenderSettings,
) -> Result<Frame, RenderError> {
    Renderer::new(settings.clone()).render_fisheye(scene, camera)
}

/// The default size of an image in pixels: the viewer's, and F3D's.
const USUAL_SIZE: [u32; 2] = [1000, 600];

/// Builds a [`Renderer`] from the most common settings. The others are those of
/// [`RenderSettings::new`]; the default size is 1000×600 pixels.
///
/// Nothing is checked here: a size or a number of samples out of range is an error of the first
/// frame.
#[derive(Clone, Debug)]
pub struct RendererBuilder(RenderSettings);

impl Default for RendererBuilder {
    fn default() -> Self {
        Self(RenderSettings::new(USUAL_SIZE[0], USUAL_SIZE[1]))
    }
}

impl RendererBuilder {
    /// Width and height in pixels, each 1 to [`MAX_SIZE`](crate::MAX_SIZE).
    #[must_use]
    pub fn size(self, width: u32, height: u32) -> Self {
        Self(RenderSettings { width, height, ..self.0 })
    }

    /// Multisampling: 1, 2, 4, 8 or 16 samples per pixel, shaded once per triangle. Replaces
    /// [`samples_per_axis`](Self::samples_per_axis).
    #[must_use]
    pub fn samples(self, samples: u32) -> Self {
        Self(RenderSettings { samples, samples_per_axis: 1, ..self.0 })
    }

    /// Supersampling: 1 to 4 samples along each side of a pixel, each shaded; 3 by default.
    /// Replaces [`samples`](Self::samples).
    #[must_use]
    pub fn samples_per_axis(self, samples_per_axis: u32) -> Self {
        Self(RenderSettings { samples_per_axis, samples: 1, ..self.0 })
    }

    /// The maximum number of threads; 0 for one per core. No image depends on it.
    #[must_use]
    pub fn threads(self, threads: usize) -> Self {
        Self(RenderSettings { threads: NonZeroUsize::new(threads), ..self.0 })
    }

    /// The outputs of frames.
    #[must_use]
    pub fn outputs(self, outputs: Outputs) -> Self {
        Self(RenderSettings { outputs, ..self.0 })
    }

    /// Behind everything.
    #[must_use]
    pub fn background(self, background: Background) -> Self {
        Self(RenderSettings { background, ..self.0 })
    }

    /// Faces, edges or both.
    #[must_use]
    pub fn style(self, style: Style) -> Self {
        Self(RenderSettings { style, ..self.0 })
    }

    /// All effects beyond directly lit surfaces.
    #[must_use]
    pub fn effects(self, effects: EffectSettings) -> Self {
        Self(RenderSettings { effects, ..self.0 })
    }

    /// The renderer. It allocates no memory until its first frame.
    #[must_use]
    pub fn build(self) -> Renderer {
        Renderer::new(self.0)
    }
}

#[cfg(test)]
mod tests;
