//! Selecting by what elements are.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::DVec3;

use super::select_related::change_selections;
use super::{Action, Outcome};
use crate::document::Change;
use crate::error::EditError;
use crate::selection::{
    ElementKind, Elements, Similarity, border_edges, faces_of_material, faces_towards, non_manifold_edges,
    sharp_edges, similar,
};

/// Selects the edges that have one face only, and no others.
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

/// Selects the edges where not exactly two faces meet that wind alike, and no others.
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

/// Selects the edges that are marked sharp, or whose faces meet at more than an angle, and no
/// others.
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

/// Selects the faces that look in a direction, and no others.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectByNormal {
    /// The direction, in the space of the mesh; its length does not count.
    pub direction: [f64; 3],
    /// By how much faces may differ, in degrees.
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

/// Selects the faces of a material slot, and no others.
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

/// Selects what has something in common with what is selected.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectSimilar {
    /// What elements have to have in common.
    pub by: Similarity,
    /// The share by which lengths and areas may differ.
    #[schemars(range(min = 0.0))]
    pub tolerance: f64,
    /// The angle by which directions may differ, in degrees.
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
