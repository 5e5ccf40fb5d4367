//! What outlives a picker: screen positions, and which vertices are visible.

use std::sync::Arc;

use trigon_math::{DMat4, DVec2};
use trigon_raster::simd::LANES;

use super::facing::Facing;
use super::screen::Spot;
use crate::elements::ElementSet;
use crate::geometry::GeometryState;

/// Where the vertices of a scene's objects are on the screen and which of them are visible, as far as a picker has
/// found out: the next one need not do so again. It uses only what it knows of objects that are as they were, and
/// seen in the same way.
#[derive(Clone, Debug, Default)]
pub struct CachedPoints {
    /// By the indices of nodes.
    pub(super) objects: Vec<Option<ObjectPoints>>,
    pub(super) visible: Option<Arc<VisibleVertices>>,
}

/// The vertices of an object at rest.
#[derive(Clone, Debug)]
pub(super) struct ObjectPoints {
    pub(super) origin: PointOrigin,
    /// With some more at the end.
    pub(super) spots: Arc<Vec<[Spot; LANES]>>,
}

/// Everything that the screen positions of an object at rest depend on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PointOrigin {
    pub(super) state: GeometryState,
    /// To clip space.
    pub(super) map: DMat4,
    /// Of the image, in pixels.
    pub(super) half_size: DVec2,
}

/// Which vertices no face but their own hides, of all that lie in an image.
#[derive(Clone, Debug)]
pub(super) struct VisibleVertices {
    /// By the indices of nodes.
    pub(super) origins: Vec<Option<VisibleOrigin>>,
    pub(super) vertices: ElementSet,
}

/// What the visibility of points depends on, of one object.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct VisibleOrigin {
    pub(super) points: PointOrigin,
    pub(super) facings: Vec<Facing>,
}

impl CachedPoints {
    /// The points of the node with this index, if they have this origin.
    pub(super) fn of(&self, index: usize, origin: &PointOrigin) -> Option<Arc<Vec<[Spot; LANES]>>> {
        let points = self.objects.get(index)?.as_ref()?;
        (points.origin == *origin).then(|| Arc::clone(&points.spots))
    }
}
