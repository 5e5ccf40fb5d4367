//! The changes that keep a copy of a document's scene equal to it.

use trigon_mesh::{Mesh, MeshChange};
use trigon_scene::{MeshId, Scene};

/// A change that keeps a copy of a document's scene equal to it.
#[derive(Debug, Clone, PartialEq)]
pub enum SceneChange {
    /// Replace the copy with a clone.
    Whole,
    /// Take over a mesh: [`Scene::adopt_mesh`].
    Mesh(MeshId),
    /// Show another mesh than the scene's: the visible part of an edited one, or a subdivision surface.
    /// [`Scene::replace_mesh`].
    Visible(MeshId, Box<Mesh>),
    /// Take over everything except meshes: [`Scene::swap_parts`].
    Parts,
    /// Give a mesh other values: [`Scene::change_mesh`].
    Values(MeshId, MeshChange),
}

impl SceneChange {
    /// Applies the change to a copy. For a scene that reports changes to others, such as a
    /// window's, call the methods that the variants name.
    pub fn apply(self, from: &Scene, copy: &mut Scene) {
        match self {
            Self::Whole => *copy = from.clone(),
            Self::Mesh(id) => {
                copy.adopt_mesh(from, id).expect("meshes come in the order of their ids");
            }
            Self::Visible(id, mesh) => copy.replace_mesh(id, *mesh).expect("an earlier change added it"),
            Self::Parts => copy.swap_parts(&mut from.parts()),
            Self::Values(id, change) => copy.change_mesh(id, &change).expect("the original was changed so"),
        }
    }
}
