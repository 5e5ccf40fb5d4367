//! Drawers: other ways to draw a scene than the renderer.

use std::fmt;
use std::sync::Arc;

use trigon_camera::Camera;
use trigon_scene::{Cancel, Frame, RenderSettings, Scene};

/// Draws the image at rest instead of the renderer: see [`Stage::drawer`](crate::Stage::drawer). It
/// is called on a worker thread.
pub trait Drawer: Send + Sync {
    /// Draws colours, in the size given by the settings. If it takes long, it should check `cancel`
    /// regularly and return; the result is then ignored.
    ///
    /// # Errors
    /// Why it cannot draw, in words for the user; the window shows them.
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

    /// How many drawings with `cancel` make an image: the share that is drawn is told of all of them.
    fn drawings(&self) -> u32 {
        1
    }

    /// Whether the image shows the window's scene through the window's camera. If not, nothing in the image can
    /// be picked, and the selected object has no outline.
    fn shows_scene(&self) -> bool {
        true
    }
}

/// The drawer that made an image. Kept alive, so that no other can be mistaken for it.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Of some size, so that two of them have two places in memory.
    struct Nothing(u8);

    impl Drawer for Nothing {
        fn draw(&self, _: &Scene, _: &Camera, _: &RenderSettings, _: &Cancel) -> Result<Frame, String> {
            Err(self.0.to_string())
        }
    }

    #[test]
    fn drawers_are_told_apart() {
        let [one, other]: [Arc<dyn Drawer>; 2] = [Arc::new(Nothing(1)), Arc::new(Nothing(2))];
        let by = |drawer: &Arc<dyn Drawer>| DrawnBy(Some(Arc::clone(drawer)));
        assert!(by(&one) == by(&one) && by(&one) != by(&other), "each is itself");
        assert!(DrawnBy(None) == DrawnBy(None), "the renderer is one");
        assert!(by(&one) != DrawnBy(None) && DrawnBy(None) != by(&one), "and no drawer");
        assert_eq!(format!("{:?} {:?}", by(&one), DrawnBy(None)), "another the renderer");
    }

    #[test]
    fn a_drawer_usually_draws_the_scene_at_rest() {
        let drawer = Nothing(1);
        assert!(!drawer.draws_drafts() && drawer.shows_scene());
        assert_eq!(drawer.drawings(), 1);
    }
}
