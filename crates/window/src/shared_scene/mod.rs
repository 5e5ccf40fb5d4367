//! A scene that is changed on the window's thread while a worker draws it.
//!
//! Each of the worker's threads has a replica of the scene. Replicas share meshes until one is changed by
//! [`SharedScene::change_mesh`]; from then on each has its own mesh and receives only the changed values. So no
//! mesh is copied because another thread draws it.

use std::collections::BTreeMap;
use std::ops::{Deref, DerefMut};
use std::sync::atomic::{AtomicU64, Ordering};

use trigon_scene::mesh::{ChangedElements, MeshChange};
use trigon_scene::{MeshId, Scene, SceneError};

/// More than a worker has threads. If there are more replicas, the one updated longest ago gets a
/// whole scene the next time.
const MOST_REPLICAS: usize = 4;

/// A scene to use like any other. What a worker is drawing meanwhile is not affected.
///
/// Borrowing it mutably counts as a change: before the next image its nodes and materials are
/// copied, but neither meshes nor textures. Use [`change_mesh`](Self::change_mesh) to change a
/// large mesh often.
#[derive(Clone, Debug, Default)]
pub struct SharedScene {
    scene: Scene,
    revision: Revision,
    /// Scenes of other threads that differ from this one only in mesh values.
    replicas: Vec<Replica>,
}

/// The scene of another thread.
#[derive(Clone, Debug)]
struct Replica {
    /// The revision that it equals.
    revision: Revision,
    /// What has been changed since.
    changed: BTreeMap<MeshId, ChangedElements>,
}

/// Distinguishes two states of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Revision(u64);

/// What makes a replica equal to its scene.
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
    /// Gives some elements of a mesh new values; see [`Scene::change_mesh`]. The first change
    /// copies the mesh for each thread that draws it; later ones copy nothing, as long as the scene
    /// is not changed in other ways in between.
    ///
    /// # Errors
    /// The mesh does not exist, or lacks an element that is to be changed. It stays unchanged.
    pub fn change_mesh(&mut self, id: MeshId, change: &MeshChange) -> Result<(), SceneError> {
        self.scene.change_mesh(id, change)?;
        self.revision = Revision::next();
        for replica in &mut self.replicas {
            replica.changed.entry(id).or_default().add(change);
        }
        Ok(())
    }

    /// The update for a replica that equals the revision `held`. It must be applied: `held` becomes
    /// this scene's revision.
    pub(crate) fn update(&mut self, held: &mut Option<Revision>) -> SceneUpdate {
        let known = self.replicas.iter().position(|replica| Some(replica.revision) == *held);
        let behind = known.map(|known| self.replicas.remove(known));
        if self.replicas.len() == MOST_REPLICAS {
            self.replicas.remove(0);
        }
        self.replicas.push(Replica { revision: self.revision, changed: BTreeMap::new() });
        *held = Some(self.revision);
        match behind {
            Some(Replica { changed, .. }) => SceneUpdate::Meshes(self.values(&changed)),
            None => SceneUpdate::Whole(Box::new(self.scene.clone())),
        }
    }

    /// The current values of changed elements.
    fn values(&self, changed: &BTreeMap<MeshId, ChangedElements>) -> Vec<(MeshId, MeshChange)> {
        let values = changed.iter().filter_map(|(&id, changed)| {
            let mesh = self.scene.meshes().get(id)?.mesh();
            Some((id, changed.values_in(mesh)))
        });
        values.collect()
    }

    /// Tells this state from every other one: whoever derives something from the scene knows by it when to do so again.
    #[must_use]
    pub fn revision(&self) -> Revision {
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
        self.replicas.clear();
        &mut self.scene
    }
}

#[cfg(test)]
mod tests;
