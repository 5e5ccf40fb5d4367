//! The lighting environment of all surfaces in a frame: lights, shadow casters, ambient light, and fog.
//!
//! Rays through glass see the background behind the image, even where an environment lights the scene without being
//! shown: a clear pane must not be visible.

use trigon_camera::FisheyeLens;
use trigon_math::glam::Affine3;
use trigon_math::{DMat4, Mat3, Vec3, Vec4};
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, Simd};

use super::metal_studio::{MetalStudio, StudioOnMetal};
use super::rays::{AmbientRays, LampRays, OpennessBuffer, Optics, RayPart, RayScene, RayStarts};
use super::shadow::ShadowMaps;
use crate::effect_settings::Fog;
use crate::environment::Surroundings;
use crate::lanes::{V3, dot, exp2, mix, splat};
use crate::lighting::{Lights, LitPoints, Microfacets};
use crate::material::Material;
use crate::settings::Background;
use crate::settings::RenderSettings;
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
    /// The rays to lamps with an extent, if shadows are computed by rays.
    pub(crate) lamp_rays: Option<LampRays>,
    /// What they found, for the lamps, by their numbers, of which neighbours share it; empty if none do.
    pub(crate) lamp_buffers: Vec<Option<OpennessBuffer>>,
    pub(crate) ambient_rays: Option<AmbientRays>,
    /// What they found, if neighbours share it.
    pub(crate) occlusion_buffer: Option<OpennessBuffer>,
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

    /// The fraction of eight points' surroundings that is open; `None` without ambient occlusion. The positions are in
    /// pixels of the image.
    #[inline(always)]
    pub(crate) fn open<S: Simd>(
        &self,
        simd: S,
        points: &LitPoints<S>,
        pixels: [F32<S>; 2],
        active: u64,
    ) -> Option<F32<S>> {
        let all = RayStarts { points, pixels, part: RayPart::All, active };
        let Some(buffer) = &self.occlusion_buffer else { return self.open_by_rays(simd, &all) };
        let (found, is_known) = buffer.at(simd, points, pixels);
        let unknown = active & !is_known.to_bitmask();
        if unknown == 0 {
            return Some(found);
        }
        let some = RayStarts { part: RayPart::OfSquare(2), active: unknown, ..all };
        Some(is_known.select(found, self.open_by_rays(simd, &some)?))
    }

    /// The fraction of the rays that leave the surroundings of points; `None` without ambient occlusion.
    #[inline(always)]
    pub(crate) fn open_by_rays<S: Simd>(&self, simd: S, starts: &RayStarts<'_, S>) -> Option<F32<S>> {
        Some(self.ambient_rays.as_ref()?.open(simd, self.rays.as_ref()?, starts))
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

/// Precomputed fog.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FogModel {
    color: Vec3,
    /// Halvings per metre.
    halvings: f32,
}

impl FogModel {
    /// `None` for fog that hides nothing.
    pub(crate) fn new(fog: &Fog) -> Option<Self> {
        let halvings = fog.density * std::f32::consts::LOG2_E;
        (halvings > 0.0 && halvings.is_finite()).then_some(Self { color: fog.color, halvings })
    }

    /// Colours seen through the fog at positions in camera space.
    #[inline(always)]
    pub(crate) fn over<S: Simd>(&self, simd: S, position: V3<S>, color: V3<S>) -> V3<S> {
        note(Work::Fog);
        let distance = dot(position, position).sqrt();
        let transmitted = exp2(distance * -self.halvings);
        let fog_color = splat(simd, self.color);
        [
            mix(fog_color[0], color[0], transmitted),
            mix(fog_color[1], color[1], transmitted),
            mix(fog_color[2], color[2], transmitted),
        ]
    }
}

/// The background as rays through glass see it: what it shows in the direction of a ray, or at the
/// place of a ray if the camera's own are parallel. Beyond the edges of the image its edges go on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VisibleBackdrop {
    top: Vec3,
    bottom: Vec3,
    rows: BackdropRows,
}

/// How high on the screen the background is visible.
#[derive(Clone, Copy, Debug)]
enum BackdropRows {
    /// From camera space to the height on the screen, and the divisor of it.
    Plane([Vec4; 2]),
    /// Through a lens, whose image has this height.
    Lens(FisheyeLens, f64),
}

impl VisibleBackdrop {
    /// `None` if the environment is what is seen. A transparent background counts as the default one:
    /// colours, unlike alpha, cannot be multiplied.
    pub(crate) fn new(
        settings: &RenderSettings,
        projection: &DMat4,
        lens: Option<&FisheyeLens>,
    ) -> Option<Self> {
        let [top, bottom] = match settings.background {
            Background::Environment if settings.effects.environment.is_none() => [Vec3::ZERO; 2],
            Background::Environment => return None,
            Background::Transparent if settings.effects.environment.is_some() => return None,
            Background::Transparent => Background::default().edges(),
            shown @ (Background::Color(_) | Background::Gradient { .. }) => shown.edges(),
        };
        // Surfaces are exposed, the background is not.
        let scale = 1.0 / settings.effects.exposure_factor();
        let scale = if scale.is_finite() { scale } else { 1.0 };
        let rows = match lens {
            Some(lens) => BackdropRows::Lens(*lens, f64::from(settings.height)),
            None => {
                let rows = projection.as_mat4().transpose();
                BackdropRows::Plane([rows.y_axis, rows.w_axis])
            }
        };
        Some(Self { top: top * scale, bottom: bottom * scale, rows })
    }

    /// Its light where a ray runs to, in the space of the rays.
    pub(super) fn light(&self, to_camera: &Affine3, origin: Vec3, direction: Vec3) -> Vec3 {
        if self.top == self.bottom {
            return self.top;
        }
        let down = match &self.rows {
            BackdropRows::Plane(rows) => down_on_plane(rows, to_camera, origin, direction),
            BackdropRows::Lens(lens, height) => {
                let direction = to_camera.transform_vector3(direction);
                match lens.project(direction.as_dvec3()) {
                    Some(pixel) => (pixel.y / height) as f32,
                    None if direction.y > 0.0 => 0.0,
                    None => 1.0,
                }
            }
        };
        let down = if down > 0.0 { down.min(1.0) } else { 0.0 };
        self.top + (self.bottom - self.top) * down
    }
}

/// How far below the upper edge of the image a ray runs to: 1 is the lower edge.
fn down_on_plane(rows: &[Vec4; 2], to_camera: &Affine3, origin: Vec3, direction: Vec3) -> f32 {
    // The divisor of an orthographic camera does not depend on the place.
    let at = match rows[1].w != 0.0 {
        true => to_camera.transform_point3(origin).extend(1.0),
        false => to_camera.transform_vector3(direction).extend(0.0),
    };
    let [height, divisor] = rows.map(|row| row.dot(at));
    match divisor > 0.0 {
        true => 0.5 - 0.5 * (height / divisor),
        // Behind the eye.
        false if height > 0.0 => 0.0,
        false => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::baseline::baseline;
    use trigon_math::elementary;

    #[test]
    fn a_surface_fades_exponentially_with_its_distance() {
        let simd = baseline();
        let fog = Fog { color: Vec3::new(1.0, 0.5, 0.0), density: 0.3 };
        let model = FogModel::new(&fog).expect("there is some");
        for distance in [0.0_f32, 1.0, 5.0, 40.0] {
            let at = splat(simd, Vec3::new(0.0, 0.6, -0.8) * distance);
            let foggy = model.over(simd, at, splat(simd, Vec3::Z)).map(|channel| f64::from(channel[0]));
            let transmitted = elementary::exp(-0.3 * f64::from(distance));
            let expected = [1.0 - transmitted, 0.5 - 0.5 * transmitted, transmitted];
            let worst = foggy.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-6, "{foggy:?} at {distance}, not {expected:?}");
        }
    }

    #[test]
    fn fog_without_density_is_none() {
        for density in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            assert!(FogModel::new(&Fog { color: Vec3::ONE, density }).is_none(), "{density} hides nothing");
        }
    }
}
