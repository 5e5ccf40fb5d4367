//! Selecting by properties of elements.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::DVec3;

use super::select_related::change_selections;
use super::{Action, Outcome};
use crate::error::EditError;
use crate::selection::{
    ElementKind, Elements, Similarity, border_edges, faces_of_material, faces_towards, non_manifold_edges,
    sharp_edges, similar,
};
use crate::state::Change;

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
