//! Orientation of faces.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Action, Outcome};
use crate::error::EditError;
use crate::state::Change;

const FACES: &str = "at least one selected face";

/// Flips the selected faces.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct FlipNormals {}

impl Action for FlipNormals {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        change.edit_selected_faces("flipping normals", FACES, |mesh, faces| mesh.flip_faces(faces))?;
        Ok(Outcome::silent())
    }
}

/// Flips the selected faces that point inwards.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RecalculateNormals {
    /// Makes all point inwards instead.
    pub inside: bool,
}

impl Action for RecalculateNormals {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let mut turned = 0;
        change.edit_selected_faces("recalculating normals", FACES, |mesh, faces| {
            turned += mesh.recalculate_normals(faces)?.turned.len();
            if self.inside { mesh.flip_faces(faces) } else { Ok(()) }
        })?;
        Ok(Outcome::counted("turned over", turned, ["face", "faces"]))
    }
}
