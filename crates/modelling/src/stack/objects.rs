//! Other objects that modifiers use. This crate knows no scenes, so whoever evaluates a stack gives access to them.

use std::borrow::Cow;

use trigon_math::DAffine3;

use crate::edit_mesh::EditMesh;

/// What of another object matters to a modifier, besides its mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ObjectState {
    /// Another number after each change of its mesh or of the modifiers of that.
    pub revision: u64,
    /// From its space to that of the mesh with the modifier, in metres.
    pub transform: DAffine3,
}

/// Finds objects by their names, as seen from the mesh whose stack is evaluated.
pub trait ModifierObjects {
    /// The state of an object; `None` if there is none of this name.
    fn state(&self, name: &str) -> Option<ObjectState>;

    /// Its mesh as it is edited, with its own modifiers; `None` if it has none.
    fn mesh(&self, name: &str) -> Option<Cow<'_, EditMesh>>;
}

/// There are no other objects: modifiers that need one are refused.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoObjects;

impl ModifierObjects for NoObjects {
    fn state(&self, _: &str) -> Option<ObjectState> {
        None
    }

    fn mesh(&self, _: &str) -> Option<Cow<'_, EditMesh>> {
        None
    }
}
