//! The rows of the outliner: the tree from top to bottom, without folded rows and rows that the
//! search excludes.

use std::collections::BTreeSet;

use trigon_document::Document;
use trigon_document::scene::{NodeId, Scene};

/// A row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Row {
    pub(super) id: NodeId,
    /// On how many others it hangs.
    pub(super) depth: usize,
    pub(super) has_children: bool,
    pub(super) is_folded: bool,
}

/// All rows, recomputed only after a change.
#[derive(Debug, Default)]
pub(super) struct Rows {
    rows: Vec<Row>,
    folded: BTreeSet<NodeId>,
    /// Of what the rows were found.
    known: Option<(u64, String)>,
}

impl Rows {
    /// Finds the rows of a document as it is now.
    pub(super) fn update(&mut self, document: &Document, search: &str) {
        let known = (document.revision(), search.to_lowercase());
        if self.known.as_ref() != Some(&known) {
            self.rows = found(document.nodes(), &known.1, &self.folded);
            self.known = Some(known);
        }
    }

    /// Folds what hangs on an object, or shows it.
    pub(super) fn toggle(&mut self, id: NodeId) {
        if !self.folded.remove(&id) {
            self.folded.insert(id);
        }
        self.known = None;
    }

    pub(super) fn as_slice(&self) -> &[Row] {
        &self.rows
    }

    pub(super) fn len(&self) -> usize {
        self.rows.len()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// The objects from one row to another, the second one last; that alone if the first is not there.
    pub(super) fn range(&self, from: NodeId, to: NodeId) -> Vec<NodeId> {
        let index_of = |id: NodeId| self.rows.iter().position(|row| row.id == id);
        let (Some(a), Some(b)) = (index_of(from), index_of(to)) else { return vec![to] };
        let ids = |range: &[Row]| range.iter().map(|row| row.id).collect::<Vec<_>>();
        if a <= b {
            ids(&self.rows[a..=b])
        } else {
            let mut range = ids(&self.rows[b..=a]);
            range.reverse();
            range
        }
    }
}

fn found(scene: &Scene, search: &str, folded: &BTreeSet<NodeId>) -> Vec<Row> {
    let shown = (!search.is_empty()).then(|| matching(scene, search));
    let is_shown = |id: NodeId| shown.as_ref().is_none_or(|shown| shown[id.index()]);
    let mut rows = Vec::new();
    let mut waiting: Vec<(NodeId, usize)> = scene.roots().map(|id| (id, 0)).collect();
    waiting.reverse();
    while let Some((id, depth)) = waiting.pop() {
        let Some(node) = scene.node(id).filter(|_| is_shown(id)) else { continue };
        // Search results are shown even in collapsed branches.
        let is_folded = shown.is_none() && folded.contains(&id);
        rows.push(Row { id, depth, has_children: !node.children().is_empty(), is_folded });
        if !is_folded {
            waiting.extend(node.children().iter().rev().map(|&child| (child, depth + 1)));
        }
    }
    rows
}

/// For each node by index: whether its name holds a text, or that of one that hangs on it.
fn matching(scene: &Scene, search: &str) -> Vec<bool> {
    let mut shown = vec![false; scene.nodes().index_bound()];
    for (id, node) in scene.nodes().iter() {
        if node.name.to_lowercase().contains(search) {
            for ancestor in scene.ancestors(id) {
                // Its own ancestors are marked already.
                if std::mem::replace(&mut shown[ancestor.index()], true) {
                    break;
                }
            }
        }
    }
    shown
}
