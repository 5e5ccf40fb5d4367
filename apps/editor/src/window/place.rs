//! Where the selected things are, found again only after the document has changed.

use trigon_edit::Document;

use crate::tool::Selected;

/// Where the selected things are, of which revision of the document.
#[derive(Debug, Default)]
pub(crate) struct Place {
    known: Option<(u64, Option<Selected>)>,
}

impl Place {
    /// Of a document as it is now; `None` where nothing is selected.
    pub(super) fn of(&mut self, document: &Document) -> Option<&Selected> {
        let revision = document.revision();
        if self.known.as_ref().is_none_or(|(known, _)| *known != revision) {
            self.known = Some((revision, Selected::of(document)));
        }
        self.known.as_ref()?.1.as_ref()
    }
}
