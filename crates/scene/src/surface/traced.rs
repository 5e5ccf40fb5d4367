//! Surfaces from which sight rays continue, mirrors and glass, and where light goes on behind a surface of glass.

use std::sync::LazyLock;

use trigon_math::{Vec2, Vec3, elementary};
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, LANES, Simd, lanes_of};

use super::{Surface, shown};
use crate::effects::{Glass, Optics, SightStart, refracted, rows};
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

/// The facets from which the samples of a pixel choose.
const FACETS: usize = 16;

/// Points on a disc, spread evenly over its area along a spiral, with the square of their distance from
/// the middle.
static DISC: LazyLock<[(Vec2, f32); FACETS]> = LazyLock::new(|| {
    /// The golden angle, in radians.
    const STEP: f32 = 2.399_963_2;
    std::array::from_fn(|index| {
        let angle = index as f32 * STEP;
        let direction = Vec2::new(elementary::cos_f32(angle), elementary::sin_f32(angle));
        (direction, (index as f32 + 0.5) / FACETS as f32)
    })
});

/// A point of a transmissive surface, as the eye sees it.
#[derive(Clone, Copy, Debug)]
pub(super) struct GlassPoint {
    /// Unit vectors: against the ray from the eye, and away from the surface.
    pub(super) view: Vec3,
    pub(super) normal: Vec3,
    /// Perceptual.
    pub(super) roughness: f32,
    /// The position of the sample in the image.
    pub(super) pixel: [f32; 2],
}

impl GlassPoint {
    /// Where light from the eye goes on. Both faces of a thin surface are parallel, so that it goes straight
    /// on; but rough ones scatter it as they scatter what they reflect.
    pub(super) fn direction_behind(&self, glass: &Glass) -> Vec3 {
        let Self { view, normal, .. } = *self;
        let facet = self.facet();
        match glass.medium() {
            Some(_) => refracted(-view, facet, 1.0 / glass.ior).unwrap_or(-view),
            None if facet == normal => -view,
            None => {
                let reflected = facet * (2.0 * facet.dot(view)) - view;
                let behind = reflected - normal * (2.0 * normal.dot(reflected));
                if behind.dot(normal) < 0.0 { behind } else { -view }
            }
        }
    }

    /// The normal of one of 16 microfacets, as GGX distributes them, chosen by the place of the sample in a
    /// square of four by four. Facets that the eye cannot see are replaced by the surface itself.
    fn facet(&self) -> Vec3 {
        /// α of GGX below which nothing is spread that a pixel shows.
        const SMOOTH: f32 = 1e-3;
        let Self { view, normal, roughness, pixel: [x, y] } = *self;
        let alpha = roughness * roughness;
        if alpha.is_nan() || alpha < SMOOTH {
            return normal;
        }
        let number = (y as usize % 4) * 4 + x as usize % 4;
        // Bit-reversed: neighbours differ most.
        let (direction, share) = DISC[usize::from((number as u8).reverse_bits() >> 4)];
        let tangent = alpha * (share / (1.0 - share)).sqrt();
        let (right, up) = normal.any_orthonormal_pair();
        let facet = (normal + (right * direction.x + up * direction.y) * tangent).normalize_or_zero();
        if facet.dot(view) > 0.0 { facet } else { normal }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The distribution of GGX: the share of facets that are tilted by less than an angle is
    /// tan² / (tan² + α²) (B. Walter et al. 2007, equation 35).
    #[test]
    fn facets_are_distributed_as_ggx_has_it() {
        let alpha = 0.3_f32;
        let point = |pixel| GlassPoint { view: Vec3::Z, normal: Vec3::Z, roughness: alpha.sqrt(), pixel };
        let pixels = (0..16_u8).map(|pixel| [f32::from(pixel % 4), f32::from(pixel / 4)]);
        let facets: Vec<Vec3> = pixels.map(|pixel| point(pixel).facet()).collect();
        for tangent in [0.1_f32, 0.3, 0.6, 1.0] {
            let within = facets.iter().filter(|facet| facet.truncate().length() / facet.z < tangent).count();
            let expected = tangent * tangent / (tangent * tangent + alpha * alpha) * 16.0;
            assert!((within as f32 - expected).abs() <= 1.0, "{within}, not {expected}, within {tangent}");
        }
        let middle = facets.iter().map(|facet| facet.truncate()).sum::<Vec2>() / 16.0;
        assert!(middle.length() < 0.05, "they lean to no side: {middle}");
    }

    #[test]
    fn smooth_glass_scatters_nothing() {
        let view = Vec3::new(0.6, 0.0, 0.8);
        let point = GlassPoint { view, normal: Vec3::Z, roughness: 0.0, pixel: [1.0, 2.0] };
        let glass = Glass { transmission: 1.0, ior: 1.5, volume: None };
        assert_eq!(point.direction_behind(&glass), -view, "straight on");
        let rough = GlassPoint { roughness: 0.5, ..point };
        let behind = rough.direction_behind(&glass);
        assert!(behind.dot(-view) < 0.999 && behind.z < 0.0, "elsewhere, but behind the surface: {behind}");
    }
}
