//! What the stage shows of a document.

use std::collections::BTreeSet;

use trigon_document::DisplayMarks;
use trigon_document::scene::NodeId;

use super::surfaces::Surfaces;

/// What the stage shows, as far as the document does not tell.
#[derive(Debug, Default)]
pub(crate) struct Look {
    pub(super) marks: DisplayMarks,
    /// The only objects that the stage shows.
    pub(super) local: Option<BTreeSet<NodeId>>,
    pub(super) surfaces: Surfaces,
}
