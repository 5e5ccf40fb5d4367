//! A scene that is changed on the window's thread while a worker draws it.

use std::ops::{Deref, DerefMut};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use trigon_scene::Scene;

/// A scene to be used as any other. What a worker is drawing meanwhile stays as it
/// was: the first change after a picture was begun copies the nodes and materials, but
/// neither meshes nor textures. Whoever takes it mutably is taken to have changed it.
#[derive(Clone, Debug)]
pub struct SharedScene {
    scene: Arc<Scene>,
    revision: Revision,
}

/// Tells two states of a scene apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Revision(u64);

impl Revision {
    fn next() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        Self(NEXT.fetch_add(1, Ordering::Relaxed))
    }
}

impl SharedScene {
    /// The scene of this moment, for another thread.
    pub(crate) fn share(&self) -> Arc<Scene> {
        Arc::clone(&self.scene)
    }

    pub(crate) fn revision(&self) -> Revision {
        self.revision
    }
}

impl Default for SharedScene {
    fn default() -> Self {
        Scene::new().into()
    }
}

impl From<Scene> for SharedScene {
    fn from(scene: Scene) -> Self {
        Self { scene: Arc::new(scene), revision: Revision::next() }
    }
}

impl Deref for SharedScene {
    type Target = Scene;

    fn deref(&self) -> &Scene {
        &self.scene
    }
}

impl DerefMut for SharedScene {
    fn deref_mut(&mut self) -> &mut Scene {
        self.revision = Revision::next();
        Arc::make_mut(&mut self.scene)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_drawn_stays_and_what_is_changed_is_known() {
        let mut scene = SharedScene::default();
        scene.add(trigon_scene::Node::default());
        let (drawn, before) = (scene.share(), scene.revision());
        assert_eq!(scene.nodes().len(), 1, "looking changes nothing");
        assert_eq!(scene.revision(), before, "and is not taken for a change");
        scene.add(trigon_scene::Node::default());
        assert_eq!(
            (drawn.nodes().len(), scene.nodes().len()),
            (1, 2),
            "the picture under way is of one node"
        );
        assert_ne!(scene.revision(), before, "the next one has to be drawn");
        assert_ne!(
            SharedScene::default().revision(),
            SharedScene::default().revision(),
            "another scene is another"
        );
    }
}
