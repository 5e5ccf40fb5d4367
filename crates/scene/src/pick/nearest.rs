//! The elements nearest to a point of an image.

use std::cmp::Ordering;

use trigon_math::DVec2;

use crate::node::NodeId;

/// The elements nearest to a point of an image, each with its node.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
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
    found: Option<NearestCandidate>,
}

/// An element that may be the nearest one.
#[derive(Clone, Copy, Debug)]
struct NearestCandidate {
    /// From the target, in pixels squared.
    distance_squared: f64,
    depth: f64,
    /// The index of its node.
    object: u32,
    /// Its own index.
    element: u32,
}

impl NearestCandidate {
    fn order(&self, other: &Self) -> Ordering {
        let order = self.distance_squared.total_cmp(&other.distance_squared);
        let order = order.then(self.depth.total_cmp(&other.depth));
        order.then((self.object, self.element).cmp(&(other.object, other.element)))
    }
}

impl Best {
    pub(super) fn new(target: DVec2) -> Self {
        Self { target, found: None }
    }

    /// A point of an element. Of equally near ones that which is nearer to the camera
    /// stays, and of those the first of the first node, whatever the order.
    pub(super) fn offer(&mut self, at: DVec2, depth: f64, object: u32, element: u32) {
        let distance_squared = at.distance_squared(self.target);
        self.improve(NearestCandidate { distance_squared, depth, object, element });
    }

    /// The better of two.
    pub(super) fn merged(mut self, other: Self) -> Self {
        if let Some(found) = other.found {
            self.improve(found);
        }
        self
    }

    fn improve(&mut self, new: NearestCandidate) {
        if self.found.is_none_or(|old| new.order(&old) == Ordering::Less) {
            self.found = Some(new);
        }
    }

    /// The index of the node, and that of the element.
    pub(super) fn element(&self) -> Option<(u32, u32)> {
        self.found.map(|found| (found.object, found.element))
    }
}
