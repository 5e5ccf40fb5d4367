//! Other ways to draw a scene than the renderer's.

use std::fmt;
use std::sync::Arc;

use trigon_camera::Camera;
use trigon_scene::{Cancel, Frame, RenderSettings, Scene};

/// Draws the picture at rest in place of the renderer: see
/// [`Stage::drawer`](crate::Stage::drawer). It is called beside the window's thread.
pub trait Drawer: Send + Sync {
    /// Draws colours, as large as the settings say. Where it takes long, it looks at
    /// `cancel` now and then and gives up; what it answers then does not matter.
    ///
    /// # Errors
    /// Why it cannot, in words for a user; the window shows them.
    fn draw(
        &self,
        scene: &Scene,
        camera: &Camera,
        settings: &RenderSettings,
        cancel: &Cancel,
    ) -> Result<Frame, String>;

    /// Whether it draws drafts, too, while something moves. Usually the renderer does, as it is quick.
    fn draws_drafts(&self) -> bool {
        false
    }
}

/// The drawer that a picture is of. Kept, so that no other can be taken for it.
#[derive(Clone)]
pub(crate) struct DrawnBy(pub(crate) Option<Arc<dyn Drawer>>);

impl PartialEq for DrawnBy {
    fn eq(&self, other: &Self) -> bool {
        match (&self.0, &other.0) {
            (None, None) => true,
            (Some(one), Some(other)) => Arc::ptr_eq(one, other),
            _ => false,
        }
    }
}

impl fmt::Debug for DrawnBy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.0.is_some() { "another" } else { "the renderer" })
    }
}
