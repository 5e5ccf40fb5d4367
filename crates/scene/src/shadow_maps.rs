//! Draws shadow maps, depth only, and keeps them from frame to frame, until lamp, casters or resolution change. A cached
//! map has the same bytes as a map that is drawn again.

use std::sync::Arc;

use trigon_math::{DAffine3, Mat3};
use trigon_raster::{Culling, Draw, Pass, Rasterizer, Target, TargetError};

use crate::display::Display;
use crate::effects::{
    Caster, Casters, LampPose, LampView, LightingEnvironment, NearestDepths, PlacedMap, ShadowMap,
    ShadowMaps, ShadowSource, View, views,
};
use crate::material::{AlphaMode, Material, Shading};
use crate::placement::{Eye, Rays};
use crate::scene::Scene;
use crate::settings::{Reflection, ShadingModel};
use crate::surface::{BoundMaterial, DrawTriangles, Look, MaterialContext, Surface};
use crate::unseen::Canvas;
use crate::work::{Work, note};

/// What casts shadows in a frame.
pub(crate) struct CastingScene<'s> {
    pub(crate) scene: &'s Scene,
    pub(crate) casters: &'s Casters,
    pub(crate) camera_to_world: &'s DAffine3,
}

/// A lamp whose shadows are mapped.
pub(crate) struct MappedLamp {
    pub(crate) pose: LampPose,
    /// 0 for a sharp shadow.
    pub(crate) radius: f32,
}

impl MappedLamp {
    fn view(&self) -> LampView {
        LampView { pose: self.pose, is_soft: self.radius > 0.0 }
    }
}

/// The shadow maps of the last frame.
#[derive(Clone, Debug, Default)]
pub(crate) struct ShadowCache {
    /// What was drawn, and in which resolution.
    casters: Vec<ShadowSource>,
    resolution: u32,
    maps: Vec<(LampView, Vec<Arc<ShadowMap>>)>,
    drawn: usize,
}

impl ShadowCache {
    /// The maps of all lamps.
    pub(crate) fn maps(
        &mut self,
        lamps: &[MappedLamp],
        casting: &CastingScene<'_>,
        resolution: u32,
        rasterizer: &mut Rasterizer,
    ) -> Result<ShadowMaps, TargetError> {
        if !casting.casters.shadow_sources().eq(&self.casters) || self.resolution != resolution {
            self.maps.clear();
            self.casters = casting.casters.shadow_sources().cloned().collect();
            self.resolution = resolution;
        }
        let needed: Vec<LampView> = lamps.iter().map(MappedLamp::view).collect();
        self.maps.retain(|(cached, _)| needed.contains(cached));
        self.drawn = 0;
        let missing = needed.iter().filter(|view| !self.maps.iter().any(|(cached, _)| cached == *view));
        let passes: usize = missing.map(|view| views(view, casting.casters).len()).sum();
        rasterizer.expect_passes(u32::try_from(passes).unwrap_or(u32::MAX));
        let mut maps = ShadowMaps::default();
        for (lamp, view) in lamps.iter().zip(&needed) {
            let maps_of_lamp = self.of(view, casting, rasterizer)?;
            let placed = maps_of_lamp.into_iter();
            let placed = placed.map(|map| PlacedMap::new(map, lamp.radius, casting.camera_to_world));
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
        lamp: &LampView,
        casting: &CastingScene<'_>,
        rasterizer: &mut Rasterizer,
    ) -> Result<Vec<Arc<ShadowMap>>, TargetError> {
        if let Some((_, maps)) = self.maps.iter().find(|(cached, _)| cached == lamp) {
            return Ok(maps.clone());
        }
        let mut maps = Vec::new();
        for view in views(lamp, casting.casters) {
            let depths = draw(&view, self.resolution, casting, rasterizer)?;
            let nearest = lamp.is_soft.then(|| NearestDepths::new(self.resolution, &depths));
            maps.push(Arc::new(ShadowMap { view, resolution: self.resolution, depths, nearest }));
        }
        self.drawn += maps.len();
        self.maps.push((*lamp, maps.clone()));
        Ok(maps)
    }
}

/// The parameters of a run of triangles.
enum ShadowDraw<'a> {
    Whole(Surface<'a, true>),
    /// With holes.
    Masked(Surface<'a, false>),
}

/// Draws the casters' depth as a lamp sees it.
fn draw(
    view: &View,
    resolution: u32,
    casting: &CastingScene<'_>,
    rasterizer: &mut Rasterizer,
) -> Result<Vec<f32>, TargetError> {
    note(Work::ShadowMap);
    let dark = LightingEnvironment::default();
    let eye = Eye::new(&view.camera, view.aspect);
    let mut shapes = Vec::new();
    for caster in &casting.casters.list {
        for (run, material) in caster.geometry.runs.iter().zip(&caster.shadow.materials) {
            let Some(material) = material else { continue };
            shapes.push((caster, run.triangles.clone(), shape(casting.scene, &dark, &eye, caster, material)));
        }
    }
    let mut pass = Pass::new();
    for (caster, triangles, shape) in &shapes {
        let triangles = &caster.geometry.triangles[triangles.clone()];
        match shape {
            ShadowDraw::Whole(surface) => {
                pass.triangles(Draw { culling: Culling::None, ..Draw::new(surface, triangles) })
            }
            ShadowDraw::Masked(surface) => pass.triangles(Draw {
                culling: Culling::None,
                blend_mode: trigon_raster::BlendMode::Masked,
                ..Draw::new(surface, triangles)
            }),
        };
    }
    let mut depths = vec![0.0; resolution as usize * resolution as usize];
    let mut target = Target::new(resolution, resolution, &[])?.with_depth(&mut depths)?;
    rasterizer.draw(&pass, &mut target);
    drop(target);
    Ok(depths)
}

fn shape<'a>(
    scene: &'a Scene,
    dark: &'a LightingEnvironment,
    eye: &Eye,
    caster: &'a Caster,
    material: &Material,
) -> ShadowDraw<'a> {
    let columns = &caster.geometry.columns;
    let alpha_mode = Canvas { scene, columns }.visible_alpha(material);
    let masked = matches!(alpha_mode, AlphaMode::Mask { .. });
    let material = Material { shading: Shading::Unlit, alpha_mode, ..material.clone() };
    let context = MaterialContext {
        scene,
        lighting: dark,
        rays: Rays::Parallel,
        shading: ShadingModel::Flat,
        reflection: Reflection::Material,
        display: Display::Shaded,
        to_world: Mat3::IDENTITY,
    };
    let placement = eye.placement(&caster.shadow.placement, &caster.geometry.bounds());
    let drawn = DrawTriangles { columns, triangles: &[], faces: None };
    let mut bound = BoundMaterial::new(&material, columns, &context);
    if !masked {
        bound.strip();
    }
    let look = Arc::new(Look::new(drawn, bound, &context));
    if masked {
        ShadowDraw::Masked(Surface::new(placement, look))
    } else {
        ShadowDraw::Whole(Surface::new(placement, look))
    }
}
