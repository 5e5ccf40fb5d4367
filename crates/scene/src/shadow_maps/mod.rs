//! Draws shadow maps (`draw`) and keeps them from frame to frame, until lamp, casters or resolution change. A
//! cached map has the same bytes as one that is drawn again.

mod draw;

use std::sync::Arc;

use trigon_math::DAffine3;
use trigon_raster::{Rasterizer, TargetError};

use crate::effects::{Casters, LampPose, PlacedMap, ShadowMap, ShadowMaps, ShadowSource, views};
use crate::scene::Scene;

/// What casts shadows in a frame.
pub(crate) struct CastingScene<'s> {
    pub(crate) scene: &'s Scene,
    pub(crate) casters: &'s Casters,
    pub(crate) camera_to_world: &'s DAffine3,
}

/// The shadow maps of the last frame.
#[derive(Clone, Debug, Default)]
pub(crate) struct ShadowCache {
    /// What was drawn, and in which resolution.
    casters: Vec<ShadowSource>,
    resolution: u32,
    maps: Vec<(LampPose, Vec<Arc<ShadowMap>>)>,
    drawn: usize,
}

impl ShadowCache {
    /// The maps of all lamps.
    pub(crate) fn maps(
        &mut self,
        poses: &[LampPose],
        casting: &CastingScene<'_>,
        resolution: u32,
        rasterizer: &mut Rasterizer,
    ) -> Result<ShadowMaps, TargetError> {
        if !casting.casters.shadow_sources().eq(&self.casters) || self.resolution != resolution {
            self.maps.clear();
            self.casters = casting.casters.shadow_sources().cloned().collect();
            self.resolution = resolution;
        }
        self.maps.retain(|(cached, _)| poses.contains(cached));
        self.drawn = 0;
        let missing = poses.iter().filter(|pose| !self.maps.iter().any(|(cached, _)| cached == *pose));
        let passes: usize = missing.map(|pose| views(pose, casting.casters).len()).sum();
        rasterizer.expect_passes(u32::try_from(passes).unwrap_or(u32::MAX));
        let mut maps = ShadowMaps::default();
        for pose in poses {
            let maps_of_lamp = self.of(pose, casting, rasterizer)?;
            let placed = maps_of_lamp.into_iter().map(|map| PlacedMap::new(map, casting.camera_to_world));
            maps.lamps.push(placed.collect());
        }
        Ok(maps)
    }

    /// How many maps the last frame had to draw.
    pub(crate) fn drawn(&self) -> usize {
        self.drawn
    }

    fn of(
        &mut self,
        pose: &LampPose,
        casting: &CastingScene<'_>,
        rasterizer: &mut Rasterizer,
    ) -> Result<Vec<Arc<ShadowMap>>, TargetError> {
        if let Some((_, maps)) = self.maps.iter().find(|(cached, _)| cached == pose) {
            return Ok(maps.clone());
        }
        let mut maps = Vec::new();
        for view in views(pose, casting.casters) {
            let map = draw::draw(view, self.resolution, casting, rasterizer)?;
            maps.push(Arc::new(map));
        }
        self.drawn += maps.len();
        self.maps.push((*pose, maps.clone()));
        Ok(maps)
    }
}
