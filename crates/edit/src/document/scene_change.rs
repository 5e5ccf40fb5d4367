//! What a copy of a document's scene has to do to stay equal to it.

use trigon_mesh::{Mesh, MeshChange};
use trigon_scene::{MeshId, Scene};

/// What a copy of a document's scene has to do to be equal to it again.
#[derive(Debug, Clone, PartialEq)]
pub enum SceneChange {
    /// Become a clone of it.
    Whole,
    /// Take over a mesh: [`Scene::adopt_mesh`].
    Mesh(MeshId),
    /// Show another mesh than the scene's: the part of one that is edited that is not hidden, or its
    /// subdivision surface.
    /// [`Scene::replace_mesh`].
    Visible(MeshId, Box<Mesh>),
    /// Take over everything but meshes: [`Scene::swap_parts`].
    Parts,
    /// Give a mesh other values: [`Scene::change_mesh`].
    Values(MeshId, MeshChange),
}

impl SceneChange {
    /// Makes the change in a copy. For a scene that tells others of changes, such as a
    /// window's, call what the variants name.
    pub fn apply(self, from: &Scene, copy: &mut Scene) {
        match self {
            Self::Whole => *copy = from.clone(),
            Self::Mesh(id) => {
                copy.adopt_mesh(from, id).expect("meshes are told of in the order of their ids");
            }
            Self::Visible(id, mesh) => copy.replace_mesh(id, *mesh).expect("it was told of before"),
            Self::Parts => copy.swap_parts(&mut from.parts()),
            Self::Values(id, change) => copy.change_mesh(id, &change).expect("the original was changed so"),
        }
    }
}
