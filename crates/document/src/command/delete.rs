//! Deleting elements of meshes, and objects; removing and merging elements without removing the surface.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_modelling::{LimitedDissolve, VertexId};

use super::{Action, Outcome};
use crate::error::EditError;
use crate::selection::{ElementKind, Elements};
use crate::state::{AfterEdit, Change};

/// What to delete.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Deleted {
    /// Vertices, with all edges and faces at them.
    Vertices,
    /// Edges, with all faces at them and vertices that are left without edges.
    Edges,
    /// Faces, with edges and vertices that belong to nothing else.
    Faces,
    /// Faces; their edges remain as loose edges.
    OnlyFaces,
}

/// Deletes selected elements of the edited meshes.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Delete {
    /// What to delete. Default: the selected kind of element.
    pub what: Option<Deleted>,
}

impl Action for Delete {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let what = self.what.unwrap_or(match kind {
            ElementKind::Vertex => Deleted::Vertices,
            ElementKind::Edge => Deleted::Edges,
            ElementKind::Face => Deleted::Faces,
        });
        change.edit_selected("delete", "something selected", |mesh, selection| {
            match what {
                Deleted::Vertices => mesh.delete_vertices(&selection.vertices(mesh, kind))?,
                Deleted::Edges => mesh.delete_edges(&selection.edges(mesh, kind))?,
                Deleted::Faces => mesh.delete_faces(&selection.faces(mesh, kind))?,
                Deleted::OnlyFaces => mesh.delete_only_faces(&selection.faces(mesh, kind))?,
            }
            Ok(AfterEdit::Clear)
        })?;
        Ok(Outcome::silent())
    }
}

/// Deletes the selected objects and their descendants.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct DeleteObjects {}

impl Action for DeleteObjects {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        if change.selection().is_editing() {
            return Err(EditError::Editing("deleting objects"));
        }
        let objects = std::mem::take(&mut change.selection_mut().objects);
        if objects.is_empty() {
            let needed = "at least one object";
            return Err(EditError::NothingSelected { command: "deleting objects", needed });
        }
        change.selection_mut().active = None;
        let scene = change.scene_mut();
        let count: usize = objects.into_iter().map(|object| scene.remove(object)).sum();
        Ok(Outcome::counted("deleted", count, ["object", "objects"]))
    }
}

/// Removes the selected elements and leaves the surface that they divided as larger faces.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Dissolve {}

impl Action for Dissolve {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let mut left_edges = 0;
        change.edit_selected("dissolving", "something selected", |mesh, selection| {
            let made = match kind {
                ElementKind::Vertex => mesh.dissolve_vertices(&selection.vertices(mesh, kind))?,
                ElementKind::Edge => mesh.dissolve_edges(&selection.edges(mesh, kind))?,
                ElementKind::Face => mesh.dissolve_faces(&selection.faces(mesh, kind))?,
            };
            left_edges += made.left_edges;
            Ok(AfterEdit::Select(Elements::Faces(made.faces)))
        })?;
        let mut outcome = Outcome::silent();
        if left_edges > 0 {
            let warning =
                format!("edges that are not between two faces with the same winding stay: {left_edges}");
            outcome.warnings.push(warning);
        }
        Ok(outcome)
    }
}

/// Merges selected faces that lie in one plane, and removes vertices on straight lines.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct DissolveFlat {
    /// The largest angle between faces, and of lines from straight, in degrees.
    #[schemars(range(min = 0.0, max = 180.0))]
    pub angle: f64,
}

impl Default for DissolveFlat {
    fn default() -> Self {
        Self { angle: 5.0 }
    }
}

impl Action for DissolveFlat {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let limits = LimitedDissolve { angle: self.angle.to_radians() };
        let mut removed = 0;
        change.edit_selected_faces(
            "dissolving flat areas",
            "at least one selected face",
            |mesh, faces| {
                removed += mesh.dissolve_limited(faces, limits)?.removed_vertices;
                Ok(())
            },
        )?;
        Ok(Outcome::counted("removed", removed, ["vertex", "vertices"]))
    }
}

/// Where vertices are merged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MergeAt {
    /// At their centre.
    #[default]
    Center,
    /// At the vertex selected first.
    First,
    /// At the vertex selected last.
    Last,
    /// Each group connected by selected edges, at its own centre.
    Collapse,
    /// Vertices that are close to one another.
    Distance,
}

/// Merges the selected vertices.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Merge {
    /// Where.
    pub at: MergeAt,
    /// The largest distance of vertices that are merged by distance, in metres.
    #[schemars(range(min = 0.0))]
    pub distance: f64,
}

impl Default for Merge {
    fn default() -> Self {
        Self { at: MergeAt::default(), distance: 1e-4 }
    }
}

impl Action for Merge {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let mut removed = [0; 3];
        change.edit_selected("merging", "at least two selected vertices", |mesh, selection| {
            let mut vertices = selection.vertices(mesh, kind);
            if kind == ElementKind::Vertex {
                // In the order of selection, as far as it is known.
                let order: Vec<VertexId> = selection.order().iter().map(|&v| VertexId::new(v)).collect();
                let rank = |vertex: &VertexId| order.iter().rposition(|other| other == vertex);
                if !order.is_empty() {
                    vertices.sort_by_key(rank);
                }
            }
            let merged = match self.at {
                MergeAt::Center => mesh.merge_at_center(&vertices)?,
                MergeAt::First => mesh.merge_at_first(&vertices)?,
                MergeAt::Last => mesh.merge_at_last(&vertices)?,
                MergeAt::Collapse => mesh.collapse_edges(&selection.edges(mesh, kind))?,
                MergeAt::Distance => mesh.merge_by_distance(&vertices, self.distance)?,
            };
            let counts = [merged.removed, merged.removed_edges, merged.removed_faces];
            counts.into_iter().zip(&mut removed).for_each(|(count, sum)| *sum += count);
            Ok(AfterEdit::Select(Elements::Vertices(merged.vertices)))
        })?;
        Ok(Outcome::removed(removed))
    }
}
