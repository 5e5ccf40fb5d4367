//! Mirroring and symmetry, the orientation of faces, and repairing faults found by inspection.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::{DVec3, Plane};
use trigon_modelling::Refusal;

use super::{Action, Outcome};
use crate::error::EditError;
use crate::selection::Elements;
use crate::state::{AfterEdit, Change};

/// A plane in the space of the mesh.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct MirrorPlane {
    /// On the plane, in metres.
    pub point: [f64; 3],
    /// Perpendicular to it; its length does not matter.
    pub normal: [f64; 3],
}

impl Default for MirrorPlane {
    fn default() -> Self {
        Self { point: [0.0; 3], normal: [1.0, 0.0, 0.0] }
    }
}

impl MirrorPlane {
    fn plane(&self) -> Result<Plane, Refusal> {
        let plane = Plane::from_point_and_normal(DVec3::from(self.point), DVec3::from(self.normal));
        let reason = "the plane's normal is zero or not finite";
        plane.ok_or(Refusal::NotPossible { operation: "mirroring", reason })
    }
}

/// Mirrors the selection, in place or as a copy.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Mirror {
    /// The mirror plane.
    pub plane: MirrorPlane,
    /// Whether the selection stays and a copy is mirrored.
    pub copy: bool,
    /// For a copy: vertices at most this far from the plane, in metres, are shared by both halves.
    pub merge_distance: Option<f64>,
}

impl Action for Mirror {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let plane = self.plane.plane()?;
        let kind = change.selection().kind();
        change.edit_selected("mirroring", "something selected", |mesh, selection| {
            if !self.copy {
                mesh.mirror(&selection.vertices(mesh, kind), &plane)?;
                return Ok(AfterEdit::Keep);
            }
            let (faces, edges) = (selection.faces(mesh, kind), selection.edges(mesh, kind));
            let made = mesh.mirror_copy(&faces, &edges, &plane, self.merge_distance)?;
            Ok(AfterEdit::Select(Elements::Vertices(made.vertices)))
        })?;
        Ok(Outcome::silent())
    }
}

/// Makes the selected faces symmetric: the side of the plane's normal replaces the other side.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Symmetrize {
    /// The plane of symmetry.
    pub plane: MirrorPlane,
    /// Vertices at most this far from the plane, in metres, are moved onto it.
    #[schemars(range(min = 0.0))]
    pub merge_distance: f64,
}

impl Default for Symmetrize {
    fn default() -> Self {
        Self { plane: MirrorPlane::default(), merge_distance: 1e-4 }
    }
}

impl Action for Symmetrize {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let plane = self.plane.plane()?;
        let kind = change.selection().kind();
        change.edit_selected("symmetrizing", "at least one selected face", |mesh, selection| {
            let made = mesh.symmetrize(&selection.faces(mesh, kind), &plane, self.merge_distance)?;
            let mut faces = made.retained;
            faces.extend(made.mirrored.faces);
            Ok(AfterEdit::Select(Elements::Faces(faces)))
        })?;
        Ok(Outcome::silent())
    }
}

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

/// Repairs the selected kinds of faults in the edited meshes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Repair {
    /// Removes all but one of several faces on the same vertices.
    pub doubled_faces: bool,
    /// Removes edges without faces.
    pub loose_edges: bool,
    /// Removes vertices without edges.
    pub loose_vertices: bool,
    /// Collapses edges of at most this length, in metres.
    pub zero_length: Option<f64>,
    /// Merges faces of at most this area with their neighbours, in square metres.
    pub zero_area: Option<f64>,
}

impl Default for Repair {
    fn default() -> Self {
        Self {
            doubled_faces: true,
            loose_edges: true,
            loose_vertices: true,
            zero_length: Some(0.0),
            zero_area: Some(0.0),
        }
    }
}

impl Action for Repair {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        if !change.selection().is_editing() {
            return Err(EditError::NotEditing("repairing"));
        }
        let ids: Vec<_> = change.selection().meshes().map(|(id, _)| id).collect();
        let mut repaired = 0;
        for id in ids {
            repaired += change.edit(id, |mesh| {
                let mut count = 0;
                if let Some(most) = self.zero_length {
                    count += mesh.collapse_zero_length_edges(most)?;
                }
                if let Some(most) = self.zero_area {
                    count += mesh.dissolve_zero_area_faces(most)?;
                }
                if self.doubled_faces {
                    count += mesh.remove_doubled_faces()?;
                }
                if self.loose_edges {
                    count += mesh.remove_loose_edges()?;
                }
                if self.loose_vertices {
                    count += mesh.remove_loose_vertices()?;
                }
                Ok(count)
            })?;
        }
        Ok(Outcome::counted("repaired", repaired, ["element", "elements"]))
    }
}
