//! Marks of elements: sharp, seam, crease, smooth, material, hidden.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Action, Outcome};
use trigon_modelling::{EditMesh, FaceId, UnwrapSettings};

use crate::error::EditError;
use crate::selection::{ElementKind, Elements};
use crate::state::{AfterEdit, Change};

const EDGES: &str = "at least one selected edge";
const FACES: &str = "at least one selected face";

/// Marks the selected edges sharp, or clears the mark.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct MarkSharp {
    /// Whether the mark is set.
    pub sharp: bool,
    /// Marks edges whose faces meet at more than this angle in degrees, and clears the others.
    pub angle: Option<f64>,
}

impl Default for MarkSharp {
    fn default() -> Self {
        Self { sharp: true, angle: None }
    }
}

impl Action for MarkSharp {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let mut count = 0;
        change.edit_selected_edges("marking edges", EDGES, |mesh, edges| {
            count += match self.angle {
                Some(angle) => mesh.mark_sharp_by_angle(edges, angle.to_radians())?,
                None if self.sharp => mesh.mark_sharp(edges)?,
                None => mesh.clear_sharp(edges)?,
            };
            Ok(())
        })?;
        Ok(Outcome::counted("changed", count, ["edge", "edges"]))
    }
}

/// Marks the selected edges as UV seams, or clears the mark.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct MarkSeam {
    /// Whether the mark is set.
    pub seam: bool,
    /// Marks edges whose faces meet at more than this angle in degrees, and clears the others.
    pub angle: Option<f64>,
    /// Whether all faces in view of the mesh are unwrapped again, in the first set of texture coordinates.
    pub live_unwrap: bool,
}

impl Default for MarkSeam {
    fn default() -> Self {
        Self { seam: true, angle: None, live_unwrap: false }
    }
}

impl Action for MarkSeam {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let (mut count, mut warnings) = (0, Vec::new());
        change.edit_selected_edges("marking seams", EDGES, |mesh, edges| {
            count += match self.angle {
                Some(angle) => mesh.mark_seams_by_angle(edges, angle.to_radians())?,
                None if self.seam => mesh.mark_seams(edges)?,
                None => mesh.clear_seams(edges)?,
            };
            if self.live_unwrap {
                warnings.append(&mut unwrap_in_view(mesh));
            }
            Ok(())
        })?;
        Ok(Outcome { warnings, ..Outcome::counted("changed", count, ["edge", "edges"]) })
    }
}

/// Unwraps all faces in view, as far as their seams allow. Returns what users may want to improve.
fn unwrap_in_view(mesh: &mut EditMesh) -> Vec<String> {
    let faces: Vec<FaceId> = mesh.faces().filter(|&face| !mesh.is_face_hidden(face)).collect();
    match mesh.unwrap_faces(&faces, &UnwrapSettings::default()) {
        Ok(unwrapped) => super::unwrap::warnings(&unwrapped),
        Err(refusal) => vec![format!("not unwrapped yet: {refusal}")],
    }
}

/// Sets how sharp the selected edges stay in Catmull-Clark subdivision.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Crease {
    /// 0 (smooth) to 1 (sharp).
    #[schemars(range(min = 0.0, max = 1.0))]
    pub crease: f32,
}

impl Action for Crease {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let mut count = 0;
        change.edit_selected_edges("creasing edges", EDGES, |mesh, edges| {
            count += mesh.crease_edges(edges, self.crease)?;
            Ok(())
        })?;
        Ok(Outcome::counted("changed", count, ["edge", "edges"]))
    }
}

const SHADING: &str = "shading faces";

/// Shades the selected faces smooth or flat; in object mode all faces of the selected objects.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Shade {
    /// Whether smoothly.
    pub smooth: bool,
}

impl Default for Shade {
    fn default() -> Self {
        Self { smooth: true }
    }
}

impl Action for Shade {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let mut count = 0;
        let mut shade = |mesh: &mut EditMesh, faces: &[FaceId]| {
            count += if self.smooth { mesh.shade_smooth(faces)? } else { mesh.shade_flat(faces)? };
            Ok(())
        };
        if change.selection().is_editing() {
            change.edit_selected_faces(SHADING, FACES, shade)?;
        } else {
            let meshes = change.meshes_of(change.selection().objects.clone());
            if meshes.is_empty() {
                return Err(EditError::NothingSelected { command: SHADING, needed: "an object with a mesh" });
            }
            for id in meshes {
                change.edit(id, |mesh| {
                    let faces: Vec<FaceId> = mesh.faces().collect();
                    shade(mesh, &faces).map_err(EditError::from)
                })?;
            }
        }
        Ok(Outcome::counted("changed", count, ["face", "faces"]))
    }
}

/// Assigns a material slot of the object to the selected faces.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct AssignMaterial {
    /// The slot, from 0.
    pub material: u32,
}

impl Action for AssignMaterial {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let mut count = 0;
        change.edit_selected_faces("assigning a material", FACES, |mesh, faces| {
            count += mesh.assign_material(faces, self.material)?;
            Ok(())
        })?;
        Ok(Outcome::counted("changed", count, ["face", "faces"]))
    }
}

/// Hides the selection, and deselects it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Hide {
    /// Whether everything that is not selected is hidden instead.
    pub unselected: bool,
}

impl Action for Hide {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let (kind, others) = (change.selection().kind(), self.unselected);
        change.edit_selected("hiding", "something selected", |mesh, selection| {
            if others {
                let (vertices, faces) = (selection.vertices(mesh, kind), selection.faces(mesh, kind));
                match kind {
                    ElementKind::Face => mesh.hide_faces(&but(mesh.faces(), &faces))?,
                    // Hiding an edge would hide selected edges of the same faces.
                    _ => mesh.hide_vertices(&but(mesh.vertices(), &vertices))?,
                };
                return Ok(AfterEdit::Keep);
            }
            match kind {
                ElementKind::Vertex => mesh.hide_vertices(&selection.vertices(mesh, kind))?,
                ElementKind::Edge => mesh.hide_edges(&selection.edges(mesh, kind))?,
                ElementKind::Face => mesh.hide_faces(&selection.faces(mesh, kind))?,
            };
            Ok(AfterEdit::Clear)
        })?;
        Ok(Outcome::silent())
    }
}

/// All elements but some, which are in ascending order.
fn but<T: Ord>(all: impl Iterator<Item = T>, left_out: &[T]) -> Vec<T> {
    all.filter(|element| left_out.binary_search(element).is_err()).collect()
}

/// Shows all hidden elements of the edited meshes, and selects them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Reveal {}

impl Action for Reveal {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        if !change.selection().is_editing() {
            return Err(EditError::NotEditing("showing hidden elements"));
        }
        let ids: Vec<_> = change.selection().meshes().map(|(id, _)| id).collect();
        let kind = change.selection().kind();
        for id in ids {
            let shown = change.edit(id, |mesh| Ok(mesh.reveal_all()))?;
            if shown.vertices.is_empty() && shown.edges.is_empty() && shown.faces.is_empty() {
                continue;
            }
            let elements = match kind {
                ElementKind::Vertex => Elements::Vertices(shown.vertices),
                ElementKind::Edge => Elements::Edges(shown.edges),
                ElementKind::Face => Elements::Faces(shown.faces),
            };
            let (selections, meshes) = change.selection_and_meshes();
            if let (Some(selection), Some(mesh)) = (selections.of_mut(id), meshes.get(&id)) {
                selection.select(mesh, kind, &elements);
            }
        }
        Ok(Outcome::silent())
    }
}
