//! How to load: limits, and a callback that follows along.

use std::fmt;
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::path::Path;

use crate::error::LoadError;
use crate::format::Format;
use crate::limits::Limits;

/// What a load is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Bytes come from the disk.
    Reading,
    /// Bytes become vertices and faces.
    Geometry,
    /// Pictures are decoded.
    Textures,
}

/// How far a load has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// What is being done.
    pub stage: Stage,
    /// Of the whole load, 0 to 1; an estimate that never goes back.
    pub fraction: f32,
}

/// Called now and then during a load; `Break` cancels it, and the load ends
/// with an error of the kind `Cancelled`.
pub type ProgressHook<'a> = &'a (dyn Fn(Progress) -> ControlFlow<()> + Sync);

/// One of several scenes of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SceneChoice {
    /// By its number, from 0.
    Index(usize),
    /// By its name; of several with the same name the first.
    Name(String),
}

/// How to load a file.
#[derive(Clone, Default)]
pub struct LoadOptions<'a> {
    /// How much the file may ask for.
    pub limits: Limits,
    /// The format of the file; without it the one that its name or its contents tell.
    pub format: Option<Format>,
    /// The scene to load of a file that has several; without it the one that
    /// the file itself shows. Formats without scenes take no notice.
    pub scene: Option<SceneChoice>,
    /// How many threads may work on it: as many as the machine runs at once, unless
    /// given.
    pub threads: Option<NonZeroUsize>,
    /// Keep the JSON, buffers and pictures of a glTF file and say which object of it each
    /// part of the scene was, in [`Loaded::source`](crate::Loaded::source). Costs their
    /// memory, and reads buffers and pictures that nothing uses, too. A file without any mesh is
    /// loaded only so: something may be added to it. Off by default; other formats take no notice.
    pub keep_source: bool,
    /// Follows the progress, and may cancel.
    pub progress: Option<ProgressHook<'a>>,
}

impl fmt::Debug for LoadOptions<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let progress = self.progress.map(|_| "a callback");
        let Self { limits, format, scene, threads, keep_source, .. } = self;
        f.debug_struct("LoadOptions")
            .field("limits", limits)
            .field("format", format)
            .field("scene", scene)
            .field("threads", threads)
            .field("keep_source", keep_source)
            .field("progress", &progress)
            .finish()
    }
}

impl LoadOptions<'_> {
    /// Tells the callback; an error when it wants to stop. `within` is the
    /// fraction of the stage, 0 to 1.
    pub(crate) fn report(&self, file: &Path, stage: Stage, within: f32) -> Result<(), LoadError> {
        let Some(hook) = self.progress else { return Ok(()) };
        let (start, share) = share_of(stage);
        let fraction = start + share * within.clamp(0.0, 1.0);
        match hook(Progress { stage, fraction }) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(LoadError::cancelled(file)),
        }
    }
}

/// Where a stage starts and how much of the whole it takes. Measured on a
/// large OBJ and a textured GLB: reading is quick, the rest about even.
fn share_of(stage: Stage) -> (f32, f32) {
    match stage {
        Stage::Reading => (0.0, 0.1),
        Stage::Geometry => (0.1, 0.6),
        Stage::Textures => (0.7, 0.3),
    }
}
