//! Position and axes of the gizmo, computed again only when something that they depend on has changed.

use trigon_document::Document;
use trigon_document::mesh::math::{DMat3, DVec3};

use crate::tool::{Orientation, Pivot, Selected};

/// The last result, with the inputs that gave it.
#[derive(Debug, Default)]
pub(crate) struct GizmoCache {
    last: Option<(GizmoInputs, Option<GizmoBasis>)>,
}

/// Everything that position and axes of the gizmo depend on, but for the view.
#[derive(Debug, Clone, Copy, PartialEq)]
struct GizmoInputs {
    revision: u64,
    pivot: Pivot,
    cursor: DVec3,
    orientation: Orientation,
}

/// The position of a gizmo, and the axes that it may have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct GizmoBasis {
    pub(super) center: DVec3,
    /// See [`Selected::local`].
    pub(super) local: DMat3,
    /// See [`Selected::normal`]; only for [`Orientation::Normal`].
    pub(super) normal: DMat3,
}

impl GizmoCache {
    /// For a document as it is now; `None` if nothing is selected.
    pub(super) fn basis(
        &mut self,
        document: &Document,
        pivot: Pivot,
        cursor: DVec3,
        orientation: Orientation,
    ) -> Option<GizmoBasis> {
        let inputs = GizmoInputs { revision: document.revision(), pivot, cursor, orientation };
        match self.last {
            Some((last, basis)) if last == inputs => basis,
            _ => {
                let basis = inputs.basis(document);
                self.last = Some((inputs, basis));
                basis
            }
        }
    }
}

impl GizmoInputs {
    fn basis(&self, document: &Document) -> Option<GizmoBasis> {
        let selected = match self.orientation {
            Orientation::Normal => Selected::of(document),
            _ => Selected::without_normal(document),
        }?;
        let center = self.pivot.point(&selected, self.cursor);
        Some(GizmoBasis { center, local: selected.local, normal: selected.normal })
    }
}
