//! The subdivision surface of a mesh while it is edited.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_scene::MeshId;

use super::whole_meshes::{remake, whole_meshes};
use super::{Action, Outcome};
use crate::error::EditError;
use crate::state::{Change, shown_levels};

/// Shows meshes as their Catmull-Clark surfaces, while their own elements, the cage, go on to be edited: the meshes that
/// are edited, or those of the selected objects. Edges with a crease stay sharp. The file of the document keeps
/// cage and levels; what is exported is the surface.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SetSubdivision {
    /// The number of subdivisions; 0 shows the mesh as it is.
    #[schemars(range(min = 0, max = 5))]
    pub levels: u32,
}

impl Action for SetSubdivision {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let mut faces = 0;
        let mut fewer = None;
        for id in whole_meshes(change, "a subdivision surface")? {
            change.edit(id, |mesh| {
                mesh.set_subdivision(self.levels)?;
                let levels = shown_levels(mesh);
                faces += mesh.subdivided_face_count(levels);
                if levels < self.levels {
                    fewer = Some(fewer.unwrap_or(levels).min(levels));
                }
                Ok(())
            })?;
        }
        let message = match fewer {
            _ if self.levels == 0 => "off".to_owned(),
            Some(levels) => format!(
                "{} levels; the view shows {levels}, as the mesh is dense; exports have all",
                self.levels
            ),
            None => format!("{}, {faces} faces", levels_in_words(self.levels)),
        };
        Ok(Outcome::with_message(message))
    }
}

fn levels_in_words(levels: u32) -> String {
    if levels == 1 { "1 level".to_owned() } else { format!("{levels} levels") }
}

/// Makes meshes the surfaces that they are shown as: those that are edited, or those of the selected objects.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ApplySubdivision {}

impl Action for ApplySubdivision {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let all = whole_meshes(change, "a subdivision surface")?;
        let has_surface = |id: &MeshId| change.state().mesh(*id).is_some_and(|mesh| mesh.subdivision() > 0);
        let some: Vec<MeshId> = all.iter().copied().filter(has_surface).collect();
        let mut faces = 0;
        // With none, the first one says why.
        for id in if some.is_empty() { all } else { some } {
            faces += remake(change, id, |mesh| Ok(mesh.apply_subdivision().map(drop)?))?;
        }
        Ok(Outcome::counted("made", faces, ["face", "faces"]))
    }
}
