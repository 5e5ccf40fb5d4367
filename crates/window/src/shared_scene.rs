//! A scene that is changed on the window's thread while a worker draws it.
//!
//! Each of the worker's threads has a copy of its own. Scenes share meshes until one is
//! changed by [`SharedScene::change_mesh`]; from then on each holder has its own mesh, and
//! is told only which values changed. So nobody copies a mesh because another thread
//! draws it.

use std::collections::BTreeMap;
use std::ops::{Deref, DerefMut};
use std::sync::atomic::{AtomicU64, Ordering};

use trigon_scene::mesh::{ChangedElements, MeshChange};
use trigon_scene::{MeshId, Scene, SceneError};

/// More copies than a worker has threads; of more, the oldest are brought up to date as a
/// whole.
const MOST_COPIES: usize = 4;

/// A scene to be used as any other. What a worker is drawing meanwhile stays as it was.
///
/// Whoever takes it mutably is taken to have changed it: then the next picture begins with
/// a copy of the nodes and materials, which shares meshes and textures.
/// [`change_mesh`](Self::change_mesh) is the way to change a large mesh often.
#[derive(Clone, Debug, Default)]
pub struct SharedScene {
    scene: Scene,
    revision: Revision,
    /// Scenes elsewhere that are behind this one by nothing but changes of meshes.
    copies: Vec<Copy>,
}

/// A scene that was like this one at some revision.
#[derive(Clone, Debug)]
struct Copy {
    revision: Revision,
    /// What has been changed since.
    changed: BTreeMap<MeshId, ChangedElements>,
}

/// Tells two states of a scene apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Revision(u64);

/// What makes a copy like the scene that it is a copy of.
#[derive(Debug)]
pub(crate) enum SceneUpdate {
    /// Another scene.
    Whole(Box<Scene>),
    /// Values in meshes.
    Meshes(Vec<(MeshId, MeshChange)>),
}

impl Revision {
    fn next() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        Self(NEXT.fetch_add(1, Ordering::Relaxed))
    }
}

impl Default for Revision {
    fn default() -> Self {
        Self::next()
    }
}

impl SharedScene {
    /// Gives some elements of a mesh other values; see [`Scene::change_mesh`]. Each of the
    /// worker's threads then has a mesh of its own, made at the first change; later changes
    /// copy nothing.
    ///
    /// # Errors
    /// When the mesh is gone, or has not what is to be changed. It stays as it was.
    pub fn change_mesh(&mut self, id: MeshId, change: &MeshChange) -> Result<(), SceneError> {
        self.scene.change_mesh(id, change)?;
        self.revision = Revision::next();
        for copy in &mut self.copies {
            copy.changed.entry(id).or_default().add(change);
        }
        Ok(())
    }

    /// What brings a copy up to date that was like the scene of the revision `held`; that
    /// becomes this one's.
    pub(crate) fn update(&mut self, held: &mut Option<Revision>) -> SceneUpdate {
        let known = self.copies.iter().position(|copy| Some(copy.revision) == *held);
        let behind = known.map(|known| self.copies.remove(known));
        if self.copies.len() == MOST_COPIES {
            self.copies.remove(0);
        }
        self.copies.push(Copy { revision: self.revision, changed: BTreeMap::new() });
        *held = Some(self.revision);
        match behind {
            Some(Copy { changed, .. }) => SceneUpdate::Meshes(self.values(&changed)),
            None => SceneUpdate::Whole(Box::new(self.scene.clone())),
        }
    }

    /// The values that changed elements have now.
    fn values(&self, changed: &BTreeMap<MeshId, ChangedElements>) -> Vec<(MeshId, MeshChange)> {
        let values = changed.iter().filter_map(|(&id, changed)| {
            let mesh = self.scene.meshes().get(id)?.mesh();
            Some((id, changed.values_in(mesh)))
        });
        values.collect()
    }

    pub(crate) fn revision(&self) -> Revision {
        self.revision
    }
}

impl SceneUpdate {
    pub(crate) fn apply(self, scene: &mut Scene) {
        match self {
            Self::Whole(whole) => *scene = *whole,
            Self::Meshes(changes) => {
                for (id, change) in changes {
                    scene.change_mesh(id, &change).expect("the original was changed so");
                }
            }
        }
    }
}

impl From<Scene> for SharedScene {
    fn from(scene: Scene) -> Self {
        Self { scene, ..Self::default() }
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
        self.copies.clear();
        &mut self.scene
    }
}

#[cfg(test)]
mod tests;
