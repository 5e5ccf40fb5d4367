//! The elements nearest to a point of an image.

use std::cmp::Ordering;

use trigon_math::DVec2;

use crate::node::NodeId;

/// The elements nearest to a point of an image, each with its node.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Nearest {
    /// The vertex whose point is nearest.
    pub vertex: Option<(NodeId, u32)>,
    /// The edge of whose points one is nearest.
    pub edge: Option<(NodeId, u32)>,
    /// The face of whose pixels' centres one is nearest.
    pub face: Option<(NodeId, u32)>,
}

/// The nearest element of a kind so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct Best {
    target: DVec2,
    /// Pixels, squared; the element's depth, its node's index, and its own.
    found: Option<(f64, f64, u32, u32)>,
}

impl Best {
    pub(super) fn new(target: DVec2) -> Self {
        Self { target, found: None }
    }

    /// A point of an element. Of equally near ones that which is nearer to the camera
    /// stays, and of those the first of the first node, whatever the order.
    pub(super) fn offer(&mut self, at: DVec2, depth: f64, object: u32, element: u32) {
        self.improve((at.distance_squared(self.target), depth, object, element));
    }

    /// The better of two.
    pub(super) fn merged(mut self, other: Self) -> Self {
        if let Some(found) = other.found {
            self.improve(found);
        }
        self
    }

    fn improve(&mut self, new: (f64, f64, u32, u32)) {
        let is_better = |old: (f64, f64, u32, u32)| {
            let order = new.0.total_cmp(&old.0).then(old.1.total_cmp(&new.1));
            order.then((new.2, new.3).cmp(&(old.2, old.3))) == Ordering::Less
        };
        if self.found.is_none_or(is_better) {
            self.found = Some(new);
        }
    }

    /// The index of the node, and that of the element.
    pub(super) fn element(&self) -> Option<(u32, u32)> {
        self.found.map(|(_, _, object, element)| (object, element))
    }
}
