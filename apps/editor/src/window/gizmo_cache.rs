//! Where the gizmo stands, found again only after the document or what decides about it has changed.

use trigon_edit::Document;
use trigon_edit::mesh::math::{DMat3, DVec3};

use crate::tool::{Orientation, Pivot, Selected};

/// Where the gizmo stands, and for what that was found.
#[derive(Debug, Default)]
pub(crate) struct Place {
    known: Option<(Question, Option<Stand>)>,
}

/// What decides where the gizmo stands.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Question {
    revision: u64,
    pivot: Pivot,
    cursor: DVec3,
    orientation: Orientation,
}

/// The place of a gizmo, and the axes that it may have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stand {
    pub(super) center: DVec3,
    /// See [`Selected::local`].
    pub(super) local: DMat3,
    /// See [`Selected::normal`]; only for [`Orientation::Normal`].
    pub(super) normal: DMat3,
}

impl Place {
    /// For a document as it is now; `None` where nothing is selected.
    pub(super) fn of(
        &mut self,
        document: &Document,
        (pivot, cursor): (Pivot, DVec3),
        orientation: Orientation,
    ) -> Option<Stand> {
        let question = Question { revision: document.revision(), pivot, cursor, orientation };
        match self.known {
            Some((known, stand)) if known == question => stand,
            _ => {
                let stand = question.answer(document);
                self.known = Some((question, stand));
                stand
            }
        }
    }
}

impl Question {
    fn answer(&self, document: &Document) -> Option<Stand> {
        let selected = match self.orientation {
            Orientation::Normal => Selected::of(document),
            _ => Selected::without_normal(document),
        }?;
        let center = self.pivot.point(&selected, self.cursor);
        Some(Stand { center, local: selected.local, normal: selected.normal })
    }
}
