//! Sight rays: reflections and refractions (T. Whitted, "An Improved Illumination Model for Shaded
//! Display", 1980).
//!
//! Eight rays are traced together. A ray ends at a surface that is neither mirror nor glass and takes its
//! diffuse colour in the light of the scene, shadows included. At glass it follows the refraction;
//! reflections there come from far away alone. Thin glass bends nothing; a volume absorbs light along the
//! way of the ray through it.

use std::sync::atomic::Ordering;

use trigon_math::{Ray, Vec3};
use trigon_raster::simd::{F32, LANES, Simd, lanes_of, prelude::*};

use super::LightingEnvironment;
use super::rays::{Glass, Medium, Optics, RayScene, SurfaceHit, left_after, rows};
use crate::lanes::{V3, moved, normalized, sum, turned};
use crate::lighting::{Brdf, ImageLanes, LitPoints};

/// Where sight rays come from.
#[derive(Clone, Copy, Debug)]
pub(crate) enum SightStart {
    /// A mirror.
    AtMirror,
    /// A reflection in glass.
    AtReflection,
    /// The eye, through glass: into a volume, or behind what is thin.
    Through(Option<Medium>),
}

/// What a ray shows that hits nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
enum FarLight {
    /// What surfaces that are no metal reflect.
    Ambient,
    /// What metals reflect.
    MetalStudio,
    /// What the eye sees where nothing is drawn.
    Backdrop,
}

/// The volumes that a ray is in, each within the one before it.
#[derive(Clone, Copy, Debug, Default)]
struct Media {
    nested: [Option<Medium>; 4],
}

impl Media {
    fn innermost(&self) -> Option<&Medium> {
        self.nested.iter().rev().flatten().next()
    }

    /// Enters another one. Those deeper than there is room for count as the last one.
    fn enter(&mut self, medium: Medium) {
        let free = self.nested.iter().position(Option::is_none);
        self.nested[free.unwrap_or(self.nested.len() - 1)] = Some(medium);
    }

    /// Leaves the innermost one.
    fn leave(&mut self) {
        if let Some(last) = self.nested.iter_mut().rev().find(|medium| medium.is_some()) {
            *last = None;
        }
    }

    /// The index of refraction of the innermost one; 1 is that of air.
    fn ior(&self) -> f32 {
        self.innermost().map_or(1.0, |medium| medium.ior)
    }
}

/// What sight rays meet, and its light.
#[derive(Clone, Copy)]
struct TracedScene<'a> {
    lighting: &'a LightingEnvironment,
    rays: &'a RayScene,
}

/// Eight sight rays in flight.
struct Walk {
    rays: [Ray; LANES],
    /// The fraction of their light that reaches the eye.
    weights: [Vec3; LANES],
    light: [Vec3; LANES],
    alive: [bool; LANES],
    far: [FarLight; LANES],
    media: [Media; LANES],
    /// Where they start in the image, in pixels: across, and down.
    pixels: [[f32; LANES]; 2],
}

impl LightingEnvironment {
    /// What is visible from eight points on surfaces in some directions; both in camera space.
    pub(crate) fn visible_light<S: Simd>(
        &self,
        simd: S,
        points: &LitPoints<S>,
        start: &SightStart,
        directions: V3<S>,
        active: u64,
    ) -> V3<S> {
        let Some(rays) = self.rays.as_ref().filter(|_| active != 0) else {
            return simd.vectorize(
                #[inline(always)]
                || [F32::splat(simd, 0.0); 3],
            );
        };
        let [[ox, oy, oz], [x, y, z]] = simd.vectorize(
            #[inline(always)]
            || [rows(rays.origins(simd, points)), rows(turned(&rays.turn(), normalized(directions)))],
        );
        let pixels = points.lanes.pixels.map(Into::into);
        let scene = TracedScene { lighting: self, rays };
        let mut media = Media::default();
        let far = match start {
            SightStart::AtMirror => FarLight::MetalStudio,
            SightStart::AtReflection => FarLight::Ambient,
            SightStart::Through(medium) => {
                medium.iter().for_each(|&medium| media.enter(medium));
                FarLight::Backdrop
            }
        };
        let mut walk = Walk {
            rays: lanes_of(|lane| Ray {
                origin: Vec3::new(ox[lane], oy[lane], oz[lane]),
                direction: Vec3::new(x[lane], y[lane], z[lane]),
            }),
            weights: [Vec3::ONE; LANES],
            light: [Vec3::ZERO; LANES],
            alive: lanes_of(|lane| active >> lane & 1 != 0),
            far: [far; LANES],
            media: [media; LANES],
            pixels,
        };
        for _ in 0..self.bounces {
            let met = walk.met(simd, rays);
            let cast = walk.alive.iter().filter(|&&alive| alive).count();
            if cast == 0 {
                break;
            }
            rays.cast[2].fetch_add(cast as u64, Ordering::Relaxed);
            let lit = self.lit(simd, rays, &met, &walk);
            for lane in 0..LANES {
                match &met[lane] {
                    Some(met) => walk.go_on(lane, scene, met, lit[lane]),
                    None => walk.end(lane, scene),
                }
            }
        }
        (0..LANES).for_each(|lane| walk.end(lane, scene));
        [0, 1, 2].map(|channel| F32::simd_from(simd, walk.light.map(|light| light[channel])))
    }

    /// What white matt surfaces show at the hits.
    fn lit<S: Simd>(
        &self,
        simd: S,
        rays: &RayScene,
        met: &[Option<SurfaceHit>; LANES],
        walk: &Walk,
    ) -> [Vec3; LANES] {
        if met.iter().flatten().all(SurfaceHit::hides_its_color) {
            return [Vec3::ZERO; LANES];
        }
        simd.vectorize(
            #[inline(always)]
            || {
                let lanes = |of: &dyn Fn(&SurfaceHit, Vec3) -> Vec3| -> V3<S> {
                    let values: [Vec3; LANES] = lanes_of(|lane| {
                        met[lane].as_ref().map_or(Vec3::ZERO, |met| of(met, walk.rays[lane].direction))
                    });
                    [0, 1, 2].map(|axis| F32::simd_from(simd, values.map(|value| value[axis])))
                };
                let visible_side = |met: &SurfaceHit, along: Vec3| {
                    if met.normal.dot(along) > 0.0 { -met.normal } else { met.normal }
                };
                let turn = rays.turn().transpose();
                let normal = turned(&turn, lanes(&visible_side));
                let position = moved(&rays.from_scene, lanes(&|met, _| met.position));
                let view = turned(&turn, lanes(&|_, along| -along));
                let met_lanes = (0..LANES).filter(|&lane| met[lane].is_some());
                let active = met_lanes.fold(0, |bits, lane| bits | 1 << lane);
                let pixels = walk.pixels.map(|axis| F32::simd_from(simd, axis));
                let lanes = ImageLanes { pixels, active, is_direct: false };
                let points = LitPoints { lanes, ..LitPoints::elsewhere(simd, position, normal, view) };
                let reflected = self.reflected(simd, &points, &Brdf::Lambert);
                let [r, g, b] = rows(sum(reflected.diffuse, self.around(simd, normal)));
                lanes_of(|lane| Vec3::new(r[lane], g[lane], b[lane]))
            },
        )
    }
}

impl TracedScene<'_> {
    /// What is visible in a direction where a ray hits nothing.
    fn light_from_afar(&self, ray: &Ray, far: FarLight) -> Vec3 {
        let Self { lighting, rays } = self;
        let to_sky = lighting.world_to_sky * ray.direction;
        match (&lighting.surroundings, &lighting.metal_studio, &lighting.backdrop) {
            (_, _, Some(backdrop)) if far == FarLight::Backdrop => {
                backdrop.light(&rays.from_scene, ray.origin, ray.direction)
            }
            (Some(surroundings), ..) => {
                surroundings.environment.radiance(to_sky, 0.0) * surroundings.intensity
            }
            (None, Some(studio), _) if far == FarLight::MetalStudio => studio.radiance(to_sky),
            (None, ..) => lighting.lights.ambient,
        }
    }
}

impl Walk {
    /// The next surfaces. A ray that comes straight from the eye passes the same gaps as the eye.
    fn met<S: Simd>(&self, simd: S, rays: &RayScene) -> [Option<SurfaceHit>; LANES] {
        let bits =
            |is: &dyn Fn(usize) -> bool| (0..LANES).fold(0, |bits, lane| bits | u32::from(is(lane)) << lane);
        let passes_gaps = bits(&|lane| self.far[lane] == FarLight::Backdrop);
        rays.met(simd, &self.rays, bits(&|lane| self.alive[lane]), passes_gaps)
    }

    /// A ray that hits nothing more.
    fn end(&mut self, lane: usize, scene: TracedScene<'_>) {
        if std::mem::take(&mut self.alive[lane]) {
            let light = scene.light_from_afar(&self.rays[lane], self.far[lane]);
            self.light[lane] += self.weights[lane] * light;
        }
    }

    /// A ray that hit a surface, on which white matt surfaces show `lit`.
    fn go_on(&mut self, lane: usize, scene: TracedScene<'_>, met: &SurfaceHit, lit: Vec3) {
        if let Some(medium) = self.media[lane].innermost() {
            self.weights[lane] *= left_after(medium.absorption, met.distance);
        }
        self.light[lane] += self.weights[lane] * met.emissive;
        let along = self.rays[lane].direction;
        match &met.optics {
            None => {
                self.light[lane] += self.weights[lane] * met.color * lit;
                self.alive[lane] = false;
            }
            Some(Optics::Mirror) => {
                let normal = if met.normal.dot(along) > 0.0 { -met.normal } else { met.normal };
                let reflected = met.color + (Vec3::ONE - met.color) * fresnel(-normal.dot(along), 0.0);
                self.weights[lane] *= reflected;
                self.far[lane] = FarLight::MetalStudio;
                self.turn(lane, scene.rays, met.position, normal, mirrored(along, normal));
            }
            Some(Optics::Glass(glass)) => {
                self.light[lane] += self.weights[lane] * met.color * lit * (1.0 - glass.transmission);
                self.weights[lane] *= glass.transmission;
                if self.far[lane] == FarLight::MetalStudio {
                    self.far[lane] = FarLight::Ambient;
                }
                match glass.medium() {
                    _ if self.weights[lane] == Vec3::ZERO => self.alive[lane] = false,
                    Some(medium) => self.bend(lane, scene, met, medium),
                    None => self.pass(lane, scene, met, glass),
                }
            }
        }
    }

    /// Straight on through thin glass, or a plate of it.
    fn pass(&mut self, lane: usize, scene: TracedScene<'_>, met: &SurfaceHit, glass: &Glass) {
        let along = self.rays[lane].direction;
        let [normal, side] = met.normals_against(along);
        let cosine = -normal.dot(along);
        let reflected = fresnel(cosine, f0(1.0, glass.ior));
        self.reflect(lane, scene, mirrored(along, normal), reflected, FarLight::Ambient);
        let left = glass.plate().map_or(Vec3::ONE, |plate| plate.left_behind_plate(glass.ior, cosine, 1.0));
        self.weights[lane] *= met.color * left;
        self.turn(lane, scene.rays, met.position, -side, along);
    }

    /// Into a volume, or out of it, or back within it (total reflection).
    fn bend(&mut self, lane: usize, scene: TracedScene<'_>, met: &SurfaceHit, medium: Medium) {
        let along = self.rays[lane].direction;
        let enters = met.plane_normal.dot(along) < 0.0;
        let [normal, side] = met.normals_against(along);
        let mut behind = self.media[lane];
        if enters {
            behind.enter(medium);
        } else {
            behind.leave();
        }
        let before = if enters { self.media[lane].ior() } else { medium.ior };
        let after = behind.ior();
        let Some(through) = refracted(along, normal, before / after) else {
            return self.turn(lane, scene.rays, met.position, side, mirrored(along, normal));
        };
        // Schlick's approximation takes the angle in the thinner medium.
        let cosine = if before <= after { -normal.dot(along) } else { -normal.dot(through) };
        let reflected = fresnel(cosine, f0(before, after));
        // Within the volume the light that is reflected sees the same as that which leaves it.
        let far = if enters { FarLight::Ambient } else { self.far[lane] };
        self.reflect(lane, scene, mirrored(along, normal), reflected, far);
        let tint = if enters { met.color } else { Vec3::ONE };
        self.weights[lane] *= tint;
        self.media[lane] = behind;
        self.turn(lane, scene.rays, met.position, -side, through);
    }

    /// Adds what glass reflects, a fraction of the light, from far away.
    fn reflect(
        &mut self,
        lane: usize,
        scene: TracedScene<'_>,
        direction: Vec3,
        fraction: f32,
        far: FarLight,
    ) {
        let ray = Ray { direction, ..self.rays[lane] };
        self.light[lane] += self.weights[lane] * scene.light_from_afar(&ray, far) * fraction;
        self.weights[lane] *= 1.0 - fraction;
    }

    /// Continues in another direction, on the side of a surface to which a unit vector points.
    fn turn(&mut self, lane: usize, rays: &RayScene, position: Vec3, side: Vec3, direction: Vec3) {
        self.rays[lane] = Ray { origin: rays.off(position, side), direction };
    }
}

/// The reflectance between two media at normal incidence.
fn f0(before: f32, after: f32) -> f32 {
    let root = (before - after) / (before + after);
    root * root
}

/// Schlick's approximation of Fresnel's law.
fn fresnel(cosine: f32, f0: f32) -> f32 {
    let away = 1.0 - cosine.clamp(0.0, 1.0);
    f0 + (1.0 - f0) * away * away * away * away * away
}

/// A reflected unit vector.
fn mirrored(along: Vec3, normal: Vec3) -> Vec3 {
    along - normal * (2.0 * along.dot(normal))
}

/// A unit vector refracted by a surface whose normal points against it (Snell's law); `None` at
/// total reflection.
pub(crate) fn refracted(along: Vec3, normal: Vec3, ratio: f32) -> Option<Vec3> {
    let cosine = -along.dot(normal);
    let square = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    (square >= 0.0).then(|| along * ratio + normal * (ratio * cosine - square.sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_is_bent_by_snells_law() {
        let along = Vec3::new(0.6, -0.8, 0.0);
        let bent = refracted(along, Vec3::Y, 1.0 / 1.5).expect("into glass");
        assert!((bent.length() - 1.0).abs() < 1e-6, "of unit length: {bent}");
        assert!((bent.x - 0.6 / 1.5).abs() < 1e-6, "sines are as the indices: {bent}");
        let back = refracted(bent, Vec3::Y, 1.5).expect("out again");
        assert!((back - along).length() < 1e-6, "and back: {back}");
        assert_eq!(refracted(along, Vec3::Y, 1.7), None, "nothing leaves at such an angle");
    }
}
