//! Surfaces from which sight rays continue: mirrors and glass.

use trigon_math::Vec3;
use trigon_raster::simd::{F32, LANES, Simd, lanes_of, prelude::*};

use super::scatter::GlassPoint;
use super::{Surface, shown};
use crate::effects::{Glass, Optics, SightStart, rows};
use crate::lanes::{V3, difference, dot, negated, product, scaled, sum};
use crate::lighting::{Brdf, LitPoints, Microfacets};

/// The start of sight rays at eight points.
#[derive(Clone, Copy)]
pub(super) struct TracedSurface<'a, S: Simd> {
    pub(super) facets: &'a Microfacets<S>,
    pub(super) optics: &'a Optics,
    /// The fraction of ambient light that arrives.
    pub(super) open: Option<F32<S>>,
    pub(super) albedo: V3<S>,
    /// The fraction of the albedo that is diffuse.
    pub(super) diffuse_share: F32<S>,
    /// The transmission factor of the texture.
    pub(super) transmission: Option<F32<S>>,
    /// The thickness factor of the texture.
    pub(super) thickness: Option<F32<S>>,
    /// The positions of the samples in the image.
    pub(super) pixel: [F32<S>; 2],
}

impl<const FLAT: bool> Surface<'_, FLAT> {
    /// The light from mirrors and glass. The diffuse colour gets a fraction of what the surface does not
    /// reflect, and glass transmits a part of that.
    pub(super) fn traced<S: Simd>(
        &self,
        simd: S,
        points: &LitPoints<S>,
        surface: &TracedSurface<'_, S>,
        active: u64,
    ) -> V3<S> {
        let TracedSurface { facets, optics, open, albedo, diffuse_share, .. } = *surface;
        simd.vectorize(
            #[inline(always)]
            || {
                let LitPoints { normal, view, .. } = *points;
                let mirrored = self.lighting.traces_mirrors.then(|| {
                    let back = difference(scaled(normal, dot(normal, view) * 2.0), view);
                    let start = match optics {
                        Optics::Mirror => SightStart::AtMirror,
                        Optics::Glass(_) => SightStart::AtReflection,
                    };
                    self.lighting.visible_light(simd, points, &start, back, active)
                });
                let brdf = Brdf::Microfacets(*facets);
                let reflected = self.reflected(simd, points, &brdf, open, mirrored);
                let Optics::Glass(glass) = optics else {
                    return shown(&reflected, scaled(albedo, diffuse_share));
                };
                let transmission = match surface.transmission {
                    Some(part) => part * glass.transmission,
                    None => F32::splat(simd, glass.transmission),
                };
                let matt = shown(&reflected, scaled(albedo, diffuse_share * (1.0 - transmission)));
                let shares: [f32; LANES] = (transmission * diffuse_share).into();
                let passes =
                    (0..LANES).filter(|&lane| shares[lane] > 0.0).fold(0, |bits, lane| bits | 1 << lane);
                let through = self.behind(simd, points, surface, glass, active & passes);
                sum(matt, product(through, scaled(albedo, diffuse_share * transmission)))
            },
        )
    }

    /// What is behind glass, as far as its surface does not reflect it and its volume does not absorb it.
    fn behind<S: Simd>(
        &self,
        simd: S,
        points: &LitPoints<S>,
        surface: &TracedSurface<'_, S>,
        glass: &Glass,
        active: u64,
    ) -> V3<S> {
        simd.vectorize(
            #[inline(always)]
            || {
                let cosine = dot(points.normal, points.view);
                let into = directions_behind(simd, points, surface, glass);
                let inside = LitPoints { facing: negated(points.facing), ..*points };
                let inner_light = self.lighting.visible_light(
                    simd,
                    &inside,
                    &SightStart::Through(glass.medium()),
                    into,
                    active,
                );
                let [r, g, b] = surface.facets.fresnel(cosine);
                let left = [1.0 - r, 1.0 - g, 1.0 - b];
                let through = product(inner_light, left);
                match glass.plate() {
                    None => through,
                    Some(plate) => {
                        let cosines: [f32; LANES] = cosine.into();
                        let shares: [f32; LANES] = surface.thickness.unwrap_or(F32::splat(simd, 1.0)).into();
                        let left: [Vec3; LANES] =
                            lanes_of(|lane| plate.left_behind_plate(glass.ior, cosines[lane], shares[lane]));
                        let left = [0, 1, 2].map(|axis| F32::simd_from(simd, left.map(|left| left[axis])));
                        product(through, left)
                    }
                }
            },
        )
    }
}

/// Where light from the eye goes on behind eight points of glass.
fn directions_behind<S: Simd>(
    simd: S,
    points: &LitPoints<S>,
    surface: &TracedSurface<'_, S>,
    glass: &Glass,
) -> V3<S> {
    simd.vectorize(
        #[inline(always)]
        || {
            let [[nx, ny, nz], [vx, vy, vz]] = [points.normal, points.view].map(rows);
            let [x, y]: [[f32; LANES]; 2] = surface.pixel.map(Into::into);
            let roughness: [f32; LANES] = surface.facets.roughness.into();
            let behind: [Vec3; LANES] = lanes_of(|lane| {
                let point = GlassPoint {
                    view: Vec3::new(vx[lane], vy[lane], vz[lane]),
                    normal: Vec3::new(nx[lane], ny[lane], nz[lane]),
                    roughness: roughness[lane],
                    pixel: [x[lane], y[lane]],
                };
                point.direction_behind(glass)
            });
            [0, 1, 2].map(|axis| F32::simd_from(simd, behind.map(|behind| behind[axis])))
        },
    )
}
