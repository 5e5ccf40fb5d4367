//! The modifier that combines the volume of a mesh with that of another object.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::refusal::Refusal;

/// How volumes are combined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum BooleanOperation {
    /// What is in any of them.
    Union,
    /// What is in the first one and in no other.
    #[default]
    Difference,
    /// What is in all of them.
    Intersection,
}

/// Combines the volume inside the mesh with that inside another object, where it stands. Both have to be closed. The other
/// object is used after its own modifiers except booleans. Its faces have the material slots of this mesh with their numbers.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct BooleanModifier {
    /// How.
    pub operation: BooleanOperation,
    /// The name of the other object, of several with it the first one. Empty: the mesh stays as it is.
    pub object: String,
}

impl BooleanModifier {
    /// Which object it is may be decided later.
    pub(super) fn check(&self) -> Result<(), Refusal> {
        Ok(())
    }
}
