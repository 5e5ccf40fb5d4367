//! Load options: limits and a progress callback.

use std::fmt;
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::path::Path;

use trigon_camera::UpAxis;

use super::error::LoadError;
use super::format::Format;

/// The stage of a load.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoadStage {
    /// Reading bytes from the disk.
    Reading,
    /// Parsing vertices and faces.
    Geometry,
    /// Decoding images.
    Textures,
}

/// The progress of a load.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Progress {
    /// The stage.
    pub stage: LoadStage,
    /// The fraction of the whole load, 0 to 1; an estimate that never decreases.
    pub fraction: f32,
}

/// Called regularly during a load; `Break` cancels it, and the load fails with an error of the kind
/// `Cancelled`.
pub type ProgressHook<'a> = &'a (dyn Fn(Progress) -> ControlFlow<()> + Sync);

/// One of several scenes of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SceneChoice {
    /// By its number, from 0.
    Index(usize),
    /// By its name; if several have the name, the first.
    Name(String),
}

/// How to load a file.
#[derive(Clone, Default)]
pub struct LoadOptions<'a> {
    /// Resource limits.
    pub limits: Limits,
    /// The format of the file; by default the one given by its name or its contents.
    pub format: Option<Format>,
    /// The scene to load from a file with several; by default the one that the file selects.
    /// Ignored for formats without scenes.
    pub scene: Option<SceneChoice>,
    /// The variant of the materials, by its name; by default the materials that the file gives without
    /// one. A file that has variants, but none of the name, is an error that lists them.
    pub variant: Option<String>,
    /// The axis that points up in the file, for [`Scene::up`](trigon_scene::Scene::up); by default that of its
    /// [format](Format::up). No coordinate is changed by it.
    pub up: Option<UpAxis>,
    /// The maximum number of threads; by default as many as the machine runs at once.
    pub threads: Option<NonZeroUsize>,
    /// Keeps the JSON, buffers and images of a glTF file, and which object in it each part of the
    /// scene was, in [`Loaded::source`](crate::Loaded::source). Costs their memory, and also reads
    /// buffers and images that nothing uses. Off by default; ignored for other formats.
    pub keep_source: bool,
    /// Loads a file with nothing to draw as a scene without anything to draw, since something may be added to it. Off by
    /// default: such a file is an error of the kind [`Empty`](crate::LoadErrorKind::Empty).
    pub may_be_empty: bool,
    /// The progress callback, which may cancel.
    pub progress: Option<ProgressHook<'a>>,
}

impl fmt::Debug for LoadOptions<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let progress = self.progress.map(|_| "a callback");
        let Self { limits, format, scene, variant, up, threads, keep_source, may_be_empty, .. } = self;
        f.debug_struct("LoadOptions")
            .field("limits", limits)
            .field("format", format)
            .field("scene", scene)
            .field("variant", variant)
            .field("up", up)
            .field("threads", threads)
            .field("keep_source", keep_source)
            .field("may_be_empty", may_be_empty)
            .field("progress", &progress)
            .finish()
    }
}

impl LoadOptions<'_> {
    /// Calls the callback; an error if it cancels. `within` is the fraction of the stage, 0 to 1.
    pub(crate) fn report(&self, file: &Path, stage: LoadStage, within: f32) -> Result<(), LoadError> {
        let Some(hook) = self.progress else { return Ok(()) };
        let (start, share) = share_of(stage);
        let fraction = start + share * within.clamp(0.0, 1.0);
        match hook(Progress { stage, fraction }) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(LoadError::cancelled(file)),
        }
    }
}

/// The start of a stage and its share of the whole. Measured on a large OBJ and a textured GLB:
/// reading is fast, the rest about even.
fn share_of(stage: LoadStage) -> (f32, f32) {
    match stage {
        LoadStage::Reading => (0.0, 0.1),
        LoadStage::Geometry => (0.1, 0.6),
        LoadStage::Textures => (0.7, 0.3),
    }
}

/// Resource limits.
///
/// A file is untrusted: a few bytes can claim billions of vertices. Sizes are checked with checked arithmetic
/// before anything is allocated; these limits bound what a valid but huge file may use.
///
/// Upper bounds on what a load may read and allocate. The defaults fit large
/// real models on an ordinary machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Limits {
    /// The largest single file, in bytes. Default 2 GiB.
    pub file_bytes: u64,
    /// All files of a model and all decoded data URIs together, in bytes.
    /// Default 4 GiB.
    pub total_bytes: u64,
    /// Vertices of one mesh, and of one accessor. Default 50 million.
    pub vertices: usize,
    /// Corners of all faces of one file (and ends of lines, and points), counted as often as nodes
    /// use them. Default 100 million: 33 million triangles, which take about 3 GB to draw.
    pub corners: usize,
    /// Nodes of a scene, and groups of an OBJ. Default 1 million.
    pub nodes: usize,
    /// The depth of the node tree. Default 100 000.
    pub depth: usize,
    /// Width and height of an image, in pixels. Default 16 384, which is also the largest size of a
    /// texture.
    pub image_side: u32,
    /// Width times height of an image. Default 2²⁶, which is 8192 × 8192.
    pub image_pixels: u64,
    /// Pixels of all images of a model together. A few bytes of file can claim millions of pixels,
    /// so a limit on their number alone is not enough. Default 2²⁹, which is 32 images of 4096 ×
    /// 4096, and 3 GB with smaller copies.
    pub total_pixels: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            file_bytes: 2 << 30,
            total_bytes: 4 << 30,
            vertices: 50_000_000,
            corners: 100_000_000,
            nodes: 1_000_000,
            depth: 100_000,
            image_side: 1 << 14,
            image_pixels: 1 << 26,
            total_pixels: 1 << 29,
        }
    }
}
