//! The tree over the casters' triangles is kept until they change.

use std::sync::Arc;

use trigon_math::DAffine3;

use super::{RayScene, RayTriangles};
use crate::effects::casters::Casters;

/// The tree of the last picture.
#[derive(Debug, Default)]
pub(crate) struct RayCache {
    kept: Option<(Casters, Arc<RayTriangles>)>,
}

impl RayCache {
    pub(crate) fn scene(&mut self, casters: &Casters, camera_to_world: &DAffine3) -> RayScene {
        let kept = self.kept.take().filter(|(kept, _)| kept == casters);
        let (_, triangles) =
            self.kept.insert(kept.unwrap_or_else(|| (casters.clone(), Arc::new(RayTriangles::new(casters)))));
        RayScene::new(Arc::clone(triangles), camera_to_world)
    }
}
