//! Coarser meshes for drafts of large scenes, made while nobody waits.

use std::thread::{self, JoinHandle};

use trigon_scene::{Outputs, RenderSettings, Scene};

use crate::pacing::Quality;
use crate::worker::Purpose;

/// A million triangles take 31.5 ms on one core of a server (W2 in `docs/performance.md`), and a draft may take 33. Scenes
/// of more than twice as many get coarser meshes. It is a count, not a time, so that whether a draft shows them does not depend
/// on how busy the machine is. In tests small scenes are large.
const DRAFT_TRIANGLES: usize = if cfg!(test) { 4_000 } else { 1_000_000 };

/// Where coarser meshes are made.
pub(super) enum CoarseMeshMaker {
    /// On the calling thread.
    Caller,
    /// On a thread of their own, as long as it runs.
    Thread(Option<JoinHandle<()>>),
}

impl CoarseMeshMaker {
    /// Makes what drafts of the scene lack, unless it is at work.
    pub(super) fn make(&mut self, scene: &Scene) {
        if matches!(self, Self::Thread(Some(thread)) if !thread.is_finished()) {
            return;
        }
        let Some(work) = scene.coarse_mesh_work(DRAFT_TRIANGLES) else { return };
        match self {
            Self::Caller => work.run(),
            // Without a thread drafts stay as they are.
            Self::Thread(thread) => {
                *thread = thread::Builder::new().name("trigon-coarse".into()).spawn(|| work.run()).ok();
            }
        }
    }
}

/// The settings of a draft that shows coarser meshes, which have no ids; `None` if it must not show any.
fn draft(scene: &Scene, settings: &RenderSettings) -> Option<RenderSettings> {
    let outputs = Outputs { ids: false, ..settings.outputs };
    let settings = RenderSettings { outputs, ..settings.clone() };
    scene.allows_coarse_meshes(&settings).then_some(settings)
}

/// Whether coarser meshes are to be made after an image: one at rest, whose drafts may show them. While something moves,
/// threads are busy, and meshes may change with each image.
pub(super) fn makes_coarse(purpose: Purpose, scene: &Scene, settings: &RenderSettings) -> bool {
    purpose == Purpose::Window(Quality::Full(0)) && draft(scene, settings).is_some()
}

/// The settings of an image for this purpose if it shows coarser meshes, and there are some.
pub(super) fn coarse_settings(
    purpose: Purpose,
    scene: &Scene,
    settings: &RenderSettings,
) -> Option<RenderSettings> {
    let is_draft = matches!(purpose, Purpose::Window(Quality::Draft { .. }));
    (is_draft && scene.has_coarse_meshes()).then(|| draft(scene, settings)).flatten()
}
