//! Selecting by position in space, for scripts. The boxes that users draw on the image are in `display/pick.rs`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::math::DVec3;

use super::select_related::change_selections;
use super::{Action, Outcome};
use crate::error::EditError;
use crate::state::Change;

/// Selects the elements whose centre (the mean of their vertices) lies within a box, boundary included.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SelectWithin {
    /// The smallest coordinates, in metres in the space of the mesh.
    pub min: [f64; 3],
    /// The largest coordinates, in metres in the space of the mesh.
    pub max: [f64; 3],
    /// Whether to add to the previous selection.
    pub add: bool,
}

impl Default for SelectWithin {
    fn default() -> Self {
        Self { min: [-1e30; 3], max: [1e30; 3], add: false }
    }
}

impl Action for SelectWithin {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let (min, max) = (DVec3::from(self.min), DVec3::from(self.max));
        let is_within = |middle: DVec3| middle.cmpge(min).all() && middle.cmple(max).all();
        change_selections(change, "select within a box", |mesh, kind, selection| {
            let mut found = kind.visible(mesh);
            let outside = found.ones().filter(|&index| !is_within(kind.middle_of(mesh, index as u32)));
            let outside: Vec<usize> = outside.collect();
            outside.into_iter().for_each(|index| found.remove(index));
            if self.add {
                found.union_with(selection.bits());
            }
            selection.set(found);
            Ok(())
        })
    }
}
