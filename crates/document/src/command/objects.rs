//! How commands name objects.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_scene::{NodeId, Scene};

use crate::error::EditError;

/// An object by its number, or by its name: the first one with that name.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum ObjectName {
    /// Its number: the index of its node.
    Number(u32),
    /// Its name.
    Name(String),
}

impl ObjectName {
    /// An object of a scene.
    #[must_use]
    pub fn of(id: NodeId) -> Self {
        Self::Number(id.index() as u32)
    }

    /// The object with this name.
    pub(crate) fn find(&self, scene: &Scene) -> Result<NodeId, EditError> {
        let found = match self {
            Self::Number(number) => scene.nodes().id_at(*number as usize),
            Self::Name(name) => scene.nodes().iter().find(|(_, node)| node.name == *name).map(|(id, _)| id),
        };
        found.ok_or_else(|| match self {
            Self::Number(number) => EditError::NoSuchObject(format!("number {number}")),
            Self::Name(name) => EditError::NoSuchObject(format!("{name:?}")),
        })
    }
}
