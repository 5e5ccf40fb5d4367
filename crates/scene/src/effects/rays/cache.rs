//! Keeps the BVH over the casters' triangles until they change.

use std::sync::Arc;

use trigon_math::DAffine3;

use super::{RayScene, RayTriangles};
use crate::effects::casters::{Casters, ShadowSource};
use crate::scene::Scene;

/// The BVH of the last frame.
#[derive(Debug, Default)]
pub(crate) struct RayCache {
    cached: Option<(Vec<ShadowSource>, Arc<RayTriangles>)>,
}

impl RayCache {
    /// With materials, if sight rays may end on the casters.
    pub(crate) fn scene(
        &mut self,
        casters: &Casters,
        looks_of: Option<&Scene>,
        camera_to_world: &DAffine3,
    ) -> RayScene {
        let fits = |(cached, triangles): &(Vec<ShadowSource>, Arc<RayTriangles>)| {
            casters.shadow_sources().eq(cached) && triangles.surfaces.is_some() == looks_of.is_some()
        };
        let cached = self.cached.take().filter(fits);
        let sources = || casters.shadow_sources().cloned().collect();
        let made = || (sources(), Arc::new(RayTriangles::new(casters, looks_of)));
        let (_, triangles) = self.cached.insert(cached.unwrap_or_else(made));
        RayScene::new(Arc::clone(triangles), camera_to_world)
    }
}
