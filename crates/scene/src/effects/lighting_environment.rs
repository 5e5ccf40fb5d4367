//! The lighting environment of all surfaces in a frame: its lights, shadow casters, ambient light,
//! and fog.

use trigon_math::{Mat3, Vec3};
use trigon_raster::simd::{F32, Simd, prelude::*};

use super::backdrop::VisibleBackdrop;
use super::fog::FogModel;
use super::metal_studio::{MetalStudio, StudioOnMetal};
use super::rays::{AmbientRays, Optics, RayScene};
use super::shadow::ShadowMaps;
use crate::environment::Surroundings;
use crate::lanes::{V3, dot, splat};
use crate::lighting::{Arriving, Lamp, Lights, LitPoints, Microfacets};
use crate::material::Material;
use crate::work::{Work, note};

/// The lighting environment of all surfaces in a frame.
#[derive(Debug, Default)]
pub(crate) struct LightingEnvironment {
    pub(crate) lights: Lights,
    pub(crate) shadow_maps: Option<ShadowMaps>,
    /// All casters, for rays.
    pub(crate) rays: Option<RayScene>,
    /// Whether rays test the visibility of lamps.
    pub(crate) shadow_rays: bool,
    pub(crate) ambient_rays: Option<AmbientRays>,
    /// The maximum number of surfaces that a sight ray meets; 0 for no such rays.
    pub(crate) bounces: u32,
    /// Whether mirrors and the reflections in glass have sight rays, and not only what is behind glass.
    pub(crate) traces_mirrors: bool,
    /// What they see far behind glass, if it is not the environment.
    pub(crate) backdrop: Option<VisibleBackdrop>,
    pub(crate) surroundings: Option<Surroundings>,
    /// What metals mirror instead of ambient light.
    pub(crate) metal_studio: Option<MetalStudio>,
    /// From world space to that of the surroundings and of the metals' studio, in which +Y is up.
    pub(crate) world_to_sky: Mat3,
    pub(crate) fog: Option<FogModel>,
}

impl LightingEnvironment {
    /// From which surfaces of a material sight rays start.
    pub(crate) fn traced(&self, material: &Material) -> Option<Optics> {
        let optics = Optics::of(material)?;
        let has_rays = match optics {
            Optics::Mirror => self.traces_mirrors,
            Optics::Glass(_) => self.bounces > 0,
        };
        has_rays.then_some(optics)
    }

    /// Whether light depends on a surface's position, and not only on its orientation.
    pub(crate) fn needs_position(&self) -> bool {
        let shadows = self.shadow_maps.is_some() || self.shadow_rays;
        shadows || self.ambient_rays.is_some() || self.lights.need_position()
    }

    /// Whether all light is grey, so that a white surface is grey everywhere.
    pub(crate) fn are_grey(&self) -> bool {
        self.lights.are_grey() && self.surroundings.is_none()
    }

    /// The unshadowed fraction of a lamp's light; `None` if all of it arrives.
    #[inline(always)]
    pub(crate) fn share<S: Simd>(
        &self,
        simd: S,
        number: usize,
        lamp: &Lamp,
        points: &LitPoints<S>,
        arriving: &Arriving<S>,
    ) -> Option<F32<S>> {
        if let Some(maps) = &self.shadow_maps {
            return maps.share(simd, number, points, arriving.towards);
        }
        let rays = self.rays.as_ref().filter(|_| self.shadow_rays)?;
        Some(rays.lit(simd, lamp, points, arriving))
    }

    /// What white matt surfaces show in ambient light.
    #[inline(always)]
    pub(crate) fn around<S: Simd>(&self, simd: S, normal: V3<S>) -> V3<S> {
        match &self.surroundings {
            Some(surroundings) => surroundings.matt(simd, normal),
            None => self.ambient(simd),
        }
    }

    /// What surfaces mirror of ambient light.
    #[inline(always)]
    pub(crate) fn mirrored<S: Simd>(&self, simd: S, points: &LitPoints<S>, roughness: F32<S>) -> V3<S> {
        match &self.surroundings {
            Some(surroundings) => {
                let twice = dot(points.normal, points.view) * 2.0;
                let [n, v] = [points.normal, points.view];
                let direction = [n[0] * twice - v[0], n[1] * twice - v[1], n[2] * twice - v[2]];
                surroundings.mirrored(simd, direction, roughness)
            }
            None => self.ambient(simd),
        }
    }

    /// Light that is the same from all directions.
    #[inline(always)]
    fn ambient<S: Simd>(&self, simd: S) -> V3<S> {
        // Reflections are added to it, so this is evaluated without ambient light, too.
        if self.lights.ambient != Vec3::ZERO {
            note(Work::AmbientLight);
        }
        splat(simd, self.lights.ambient)
    }

    /// The built-in studio's light on metals, if they mirror it and any point is metallic.
    #[inline(always)]
    pub(crate) fn studio_on_metal<S: Simd>(
        &self,
        simd: S,
        points: &LitPoints<S>,
        facets: &Microfacets<S>,
    ) -> Option<StudioOnMetal<S>> {
        let studio = self.metal_studio.as_ref().filter(|_| facets.metallic.simd_gt(0.0).any_true())?;
        Some(studio.light(simd, points, facets.roughness))
    }

    /// Whether no light reaches any surface, except what reflected and refracted rays bring.
    pub(crate) fn is_dark(&self) -> bool {
        self.lights.lamps.is_empty() && !self.has_ambient()
    }

    /// Whether there is any ambient light.
    pub(crate) fn has_ambient(&self) -> bool {
        self.surroundings.is_some() || self.lights.ambient != Vec3::ZERO
    }
}
