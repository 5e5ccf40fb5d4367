//! What the parts of the properties are about.

use trigon_document::Document;
use trigon_document::scene::{Node, NodeId};

use crate::up::Up;

/// The object whose properties are shown.
#[derive(Clone, Copy)]
pub(super) struct ShownObject<'d> {
    pub(super) document: &'d Document,
    pub(super) id: NodeId,
    pub(super) node: &'d Node,
    pub(super) up: Up,
}
