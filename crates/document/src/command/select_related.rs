//! Selecting what is related to the selection, or to one element of it, and selecting by properties of elements.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::DVec3;
use trigon_modelling::{EdgeId, EditMesh, Refusal};

use super::{Action, Outcome};
use crate::error::EditError;
use crate::selection::{
    ElementKind, Elements, MeshSelection, Similarity, border_edges, edge_loop, edge_ring, face_loop,
    faces_of_material, faces_towards, non_manifold_edges, sharp_edges, shortest_path, similar,
};
use crate::state::Change;

/// Changes the selection of each mesh that is edited.
pub(super) fn change_selections(
    change: &mut Change<'_>,
    command: &'static str,
    mut select: impl FnMut(&EditMesh, ElementKind, &mut MeshSelection) -> Result<(), EditError>,
) -> Result<Outcome, EditError> {
    if !change.selection().is_editing() {
        return Err(EditError::NotEditing(command));
    }
    let kind = change.selection().kind();
    let ids: Vec<_> = change.selection().meshes().map(|(id, _)| id).collect();
    let (selection, meshes) = change.selection_and_meshes();
    for id in ids {
        if let (Some(mesh), Some(selection)) = (meshes.get(&id), selection.of_mut(id)) {
            select(mesh, kind, selection)?;
        }
    }
    Ok(Outcome::silent())
}

/// Selects everything connected to the selection.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectLinked {}

impl Action for SelectLinked {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        change_selections(change, "select linked", |mesh, kind, selection| {
            selection.grow_linked(mesh, kind);
            Ok(())
        })
    }
}

/// Grows the selection by its neighbours.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectMore {}

impl Action for SelectMore {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        change_selections(change, "select more", |mesh, kind, selection| {
            selection.grow(mesh, kind);
            Ok(())
        })
    }
}

/// Shrinks the selection: elements that touch an unselected one are deselected.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectLess {}

impl Action for SelectLess {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        change_selections(change, "select less", |mesh, kind, selection| {
            selection.shrink(mesh, kind);
            Ok(())
        })
    }
}

/// Selects the edge loops through the selected edges; in face mode, the loops of quads across their
/// fully selected edges.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectLoop {}

impl Action for SelectLoop {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        change_selections(change, "select loop", |mesh, kind, selection| {
            extend(mesh, kind, selection, |edge| match kind {
                ElementKind::Face => Elements::Faces(face_loop(mesh, edge)),
                _ => Elements::Edges(edge_loop(mesh, edge)),
            });
            Ok(())
        })
    }
}

/// Selects the rings of edges across quads, starting from the selected edges.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectRing {}

impl Action for SelectRing {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        change_selections(change, "select ring", |mesh, kind, selection| {
            extend(mesh, kind, selection, |edge| Elements::Edges(edge_ring(mesh, edge)));
            Ok(())
        })
    }
}

/// Adds the edges related to each selected edge. An edge that another one added is not examined
/// again.
fn extend(
    mesh: &EditMesh,
    kind: ElementKind,
    selection: &mut MeshSelection,
    along: impl Fn(EdgeId) -> Elements,
) {
    let mut visited = vec![false; mesh.edge_capacity()];
    let mut bits = selection.bits().clone();
    for edge in selection.edges(mesh, kind) {
        if std::mem::replace(&mut visited[edge.index() as usize], true) {
            continue;
        }
        let elements = along(edge);
        if let Elements::Edges(edges) = &elements {
            edges.iter().for_each(|edge| visited[edge.index() as usize] = true);
        }
        let mut found = MeshSelection::default();
        found.select(mesh, kind, &elements);
        bits.union_with(found.bits());
    }
    selection.set(bits);
}

/// Selects the shortest path between the last two elements that were selected individually.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectPath {}

impl Action for SelectPath {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let mut found = false;
        change_selections(change, "select path", |mesh, kind, selection| {
            let &[.., from, to] = selection.order() else { return Ok(()) };
            let path = shortest_path(mesh, kind, from, to).ok_or(Refusal::NotPossible {
                operation: "selecting a path",
                reason: "both are in different parts of the mesh",
            })?;
            selection.insert(&path);
            found = true;
            Ok(())
        })?;
        let needed = "two elements selected one after the other";
        if found {
            Ok(Outcome::silent())
        } else {
            Err(EditError::NothingSelected { command: "selecting a path", needed })
        }
    }
}

/// Selects exactly the edges that have one face only.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectBorder {}

impl Action for SelectBorder {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        change_selections(change, "select border", |mesh, kind, selection| {
            selection.select(mesh, kind, &border_edges(mesh));
            Ok(())
        })
    }
}

/// Selects exactly the edges that do not have two faces of consistent winding.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectNonManifold {}

impl Action for SelectNonManifold {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        change_selections(change, "select non-manifold", |mesh, kind, selection| {
            selection.select(mesh, kind, &non_manifold_edges(mesh));
            Ok(())
        })
    }
}

/// Selects exactly the edges that are marked sharp, or whose faces meet at more than an angle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectSharp {
    /// In degrees: 0 to 180.
    #[schemars(range(min = 0.0, max = 180.0))]
    pub angle: f64,
}

impl Default for SelectSharp {
    fn default() -> Self {
        Self { angle: 30.0 }
    }
}

impl Action for SelectSharp {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        change_selections(change, "select sharp", |mesh, kind, selection| {
            selection.select(mesh, kind, &sharp_edges(mesh, self.angle.to_radians()));
            Ok(())
        })
    }
}

/// Selects exactly the faces that point in a direction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectByNormal {
    /// The direction, in the space of the mesh; its length does not matter.
    pub direction: [f64; 3],
    /// The largest deviation of faces, in degrees.
    #[schemars(range(min = 0.0, max = 180.0))]
    pub angle: f64,
}

impl Default for SelectByNormal {
    fn default() -> Self {
        Self { direction: [0.0, 1.0, 0.0], angle: 0.1 }
    }
}

impl Action for SelectByNormal {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        change_selections(change, "select by normal", |mesh, kind, selection| {
            let faces = faces_towards(mesh, DVec3::from(self.direction), self.angle.to_radians());
            selection.select(mesh, kind, &faces);
            Ok(())
        })
    }
}

/// Selects exactly the faces of a material slot.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectByMaterial {
    /// The slot, from 0.
    pub material: u32,
}

impl Action for SelectByMaterial {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        change_selections(change, "select by material", |mesh, kind, selection| {
            selection.select(mesh, kind, &faces_of_material(mesh, self.material));
            Ok(())
        })
    }
}

/// Selects elements that share a property with the selection.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectSimilar {
    /// The property that elements must share.
    pub by: Similarity,
    /// The relative difference allowed for lengths and areas.
    #[schemars(range(min = 0.0))]
    pub tolerance: f64,
    /// The angle allowed between directions, in degrees.
    #[schemars(range(min = 0.0, max = 180.0))]
    pub angle: f64,
}

impl Default for SelectSimilar {
    fn default() -> Self {
        Self { by: Similarity::default(), tolerance: 1e-3, angle: 0.1 }
    }
}

impl Action for SelectSimilar {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        change_selections(change, "select similar", |mesh, kind, selection| {
            let given = match kind {
                ElementKind::Vertex => Elements::Vertices(selection.vertices(mesh, kind)),
                ElementKind::Edge => Elements::Edges(selection.edges(mesh, kind)),
                ElementKind::Face => Elements::Faces(selection.faces(mesh, kind)),
            };
            let tolerance = match self.by {
                Similarity::Normal => self.angle.to_radians(),
                _ => self.tolerance,
            };
            let mut all = selection.bits().clone();
            selection.select(mesh, kind, &similar(mesh, &given, self.by, tolerance));
            all.union_with(selection.bits());
            selection.set(all);
            Ok(())
        })
    }
}
