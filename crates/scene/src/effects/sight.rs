//! Sight rays: reflections and refractions (T. Whitted, "An Improved Illumination Model for Shaded
//! Display", 1980).
//!
//! Eight rays are traced together. A ray ends at a surface that is neither mirror nor glass and takes its
//! diffuse colour in the light of the scene, shadows included. At glass it follows the refraction;
//! reflections there come from the environment alone.

use std::sync::atomic::Ordering;

use trigon_math::{Ray, Vec3};
use trigon_raster::simd::{F32, LANES, Simd, lanes_of, prelude::*};

use super::LightingEnvironment;
use super::rays::{Optics, RayScene, SurfaceHit, rows};
use crate::lanes::{V3, moved, normalized, sum, turned};
use crate::lighting::{Brdf, LitPoints};

/// The maximum number of bounces of a ray.
const MOST: u32 = 16;

/// Eight sight rays in flight.
struct Walk {
    origins: [Vec3; LANES],
    directions: [Vec3; LANES],
    /// The fraction of their light that reaches the eye.
    weights: [Vec3; LANES],
    light: [Vec3; LANES],
    alive: [bool; LANES],
    /// Whether the last surface was a mirror, and not glass.
    mirrored: [bool; LANES],
}

impl LightingEnvironment {
    /// What is visible from eight points on surfaces of a kind in some directions; both in camera
    /// space.
    pub(crate) fn seen<S: Simd>(
        &self,
        simd: S,
        points: &LitPoints<S>,
        optics: &Optics,
        directions: V3<S>,
        active: u64,
    ) -> V3<S> {
        let Some(rays) = &self.rays else {
            return simd.vectorize(
                #[inline(always)]
                || [F32::splat(simd, 0.0); 3],
            );
        };
        let directions = simd.vectorize(
            #[inline(always)]
            || normalized(directions),
        );
        let [x, y, z] = rays.turned_rows(simd, directions);
        let mut walk = Walk {
            origins: rays.origins(simd, points),
            directions: lanes_of(|lane| Vec3::new(x[lane], y[lane], z[lane])),
            weights: [Vec3::ONE; LANES],
            light: [Vec3::ZERO; LANES],
            alive: lanes_of(|lane| active >> lane & 1 != 0),
            mirrored: [*optics == Optics::Mirror; LANES],
        };
        for _ in 0..self.bounces.min(MOST) {
            let met = lanes_of(|lane| walk.alive[lane].then(|| rays.met(&walk.ray(lane))).flatten());
            let cast = walk.alive.iter().filter(|&&alive| alive).count();
            rays.cast[2].fetch_add(cast as u64, Ordering::Relaxed);
            let lit = self.lit(simd, rays, &met, &walk);
            for lane in 0..LANES {
                match &met[lane] {
                    Some(met) => walk.go_on(lane, (self, rays), met, lit[lane]),
                    None => walk.end(lane, self),
                }
            }
        }
        (0..LANES).for_each(|lane| walk.end(lane, self));
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
        if met.iter().all(|met| met.is_none_or(|met| met.optics == Some(Optics::Mirror))) {
            return [Vec3::ZERO; LANES];
        }
        simd.vectorize(
            #[inline(always)]
            || {
                let lanes = |of: &dyn Fn(&SurfaceHit, Vec3) -> Vec3| -> V3<S> {
                    let values: [Vec3; LANES] = lanes_of(|lane| {
                        met[lane].as_ref().map_or(Vec3::ZERO, |met| of(met, walk.directions[lane]))
                    });
                    [0, 1, 2].map(|axis| F32::simd_from(simd, values.map(|value| value[axis])))
                };
                let seen_side = |met: &SurfaceHit, along: Vec3| {
                    if met.normal.dot(along) > 0.0 { -met.normal } else { met.normal }
                };
                let turn = rays.turn().transpose();
                let normal = turned(&turn, lanes(&seen_side));
                let points = LitPoints {
                    position: moved(&rays.from_scene, lanes(&|met, _| met.position)),
                    normal,
                    facing: normal,
                    plane: normal,
                    view: turned(&turn, lanes(&|_, along| -along)),
                };
                let reflected = self.reflected(simd, &points, &Brdf::Lambert);
                let [r, g, b] = rows(sum(reflected.diffuse, self.around(simd, normal)));
                lanes_of(|lane| Vec3::new(r[lane], g[lane], b[lane]))
            },
        )
    }

    /// What is visible in a world direction where a ray hits nothing: from a mirror, or otherwise
    /// from glass.
    fn far(&self, direction: Vec3, from_mirror: bool) -> Vec3 {
        let direction = self.world_to_sky * direction;
        match (&self.surroundings, &self.metal_studio) {
            (Some(surroundings), _) => {
                surroundings.environment.radiance(direction, 0.0) * surroundings.intensity
            }
            (None, Some(studio)) if from_mirror => studio.radiance(direction),
            (None, _) => self.lights.ambient,
        }
    }
}

impl Walk {
    fn ray(&self, lane: usize) -> Ray {
        Ray { origin: self.origins[lane], direction: self.directions[lane] }
    }

    /// A ray that hits nothing more.
    fn end(&mut self, lane: usize, lighting: &LightingEnvironment) {
        if std::mem::take(&mut self.alive[lane]) {
            self.light[lane] += self.weights[lane] * lighting.far(self.directions[lane], self.mirrored[lane]);
        }
    }

    /// A ray that hit a surface, on which white matt surfaces show `lit`.
    fn go_on(
        &mut self,
        lane: usize,
        (lighting, rays): (&LightingEnvironment, &RayScene),
        met: &SurfaceHit,
        lit: Vec3,
    ) {
        self.light[lane] += self.weights[lane] * met.emissive;
        let along = self.directions[lane];
        match met.optics {
            None => {
                self.light[lane] += self.weights[lane] * met.color * lit;
                self.alive[lane] = false;
            }
            Some(Optics::Mirror) => {
                let normal = if met.normal.dot(along) > 0.0 { -met.normal } else { met.normal };
                let reflected = met.color + (Vec3::ONE - met.color) * fresnel(-normal.dot(along), 0.0);
                self.weights[lane] *= reflected;
                self.mirrored[lane] = true;
                self.turn(lane, rays, (met.position, normal), mirrored(along, normal));
            }
            Some(Optics::Glass { transmission, ior }) => {
                self.light[lane] += self.weights[lane] * met.color * lit * (1.0 - transmission);
                self.weights[lane] *= transmission;
                self.mirrored[lane] = false;
                let enters = met.normal.dot(along) < 0.0;
                let normal = if enters { met.normal } else { -met.normal };
                let ratio = if enters { 1.0 / ior } else { ior };
                let Some(through) = refracted(along, normal, ratio) else {
                    return self.turn(lane, rays, (met.position, normal), mirrored(along, normal));
                };
                let root = (ior - 1.0) / (ior + 1.0);
                let cosine = if enters { -normal.dot(along) } else { -normal.dot(through) };
                let away = fresnel(cosine, root * root);
                self.light[lane] += self.weights[lane] * lighting.far(mirrored(along, normal), false) * away;
                let tint = if enters { met.color } else { Vec3::ONE };
                self.weights[lane] *= tint * (1.0 - away);
                self.turn(lane, rays, (met.position, -normal), through);
            }
        }
    }

    /// Continues in another direction, on the side of a surface to which a unit vector points.
    fn turn(&mut self, lane: usize, rays: &RayScene, (position, side): (Vec3, Vec3), direction: Vec3) {
        self.origins[lane] = rays.off(position, side);
        self.directions[lane] = direction;
    }
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
