//! Light on a surface: at its vertices or in each pixel.

use trigon_raster::simd::{F32, Simd, inlined, prelude::*};
use trigon_raster::{FragmentLanes, VertexLanes};

use super::traced::TracedSurface;
use super::{LightSlots, Surface, load, shown};
use crate::effects::{OpennessOf, RayPart, RayStarts};
use crate::lanes::{V3, dot, mixed, negated, normalized, product, scaled, select, splat, sum, turned};
use crate::lighting::{Brdf, LitPoints, Reflected};
use crate::material::MaterialTexture;
use crate::work::{Work, note};

impl<const FLAT: bool> Surface<'_, FLAT> {
    /// The light at eight vertices. Only the texture of the base colour is applied later; all others are
    /// ignored.
    #[inline(always)]
    pub(super) fn set_light<S: Simd>(
        &self,
        simd: S,
        vertices: &mut VertexLanes<'_>,
        slots: LightSlots,
        position: V3<S>,
    ) {
        let normal = load(simd, vertices, &self.columns.normals);
        let normal = normalized(turned(&self.placement.normal_to_camera, normal));
        let position = self.placement.camera(simd, position);
        let points = LitPoints::elsewhere(simd, position, normal, self.view(simd, position));
        self.set_side(simd, vertices, slots, slots.at, &points);
        if slots.two_sided {
            let back = LitPoints { normal: negated(normal), facing: negated(normal), ..points };
            self.set_side(simd, vertices, slots, slots.at + slots.per_side(), &back);
        }
    }

    #[inline(always)]
    fn set_side<S: Simd>(
        &self,
        simd: S,
        vertices: &mut VertexLanes<'_>,
        slots: LightSlots,
        at: usize,
        points: &LitPoints<S>,
    ) {
        let reflected = self.lit_plainly(simd, points);
        let channels = slots.channels;
        for (index, channel) in reflected.diffuse.into_iter().enumerate().take(channels) {
            vertices.set(at + index, channel);
        }
        if slots.specular {
            for (index, channel) in reflected.specular.into_iter().enumerate().take(channels) {
                vertices.set(at + channels + index, channel);
            }
        }
    }

    /// Light from the material's factors alone. The diffuse part has to be multiplied by the base colour.
    pub(super) fn lit_plainly<S: Simd>(&self, simd: S, points: &LitPoints<S>) -> Reflected<S> {
        simd.vectorize(
            #[inline(always)]
            || {
                let base = splat(simd, self.params.material.base_color.truncate());
                let (brdf, share) = self.params.brdf(simd, base, None);
                let reflected = self.reflected(simd, points, &brdf, None, None);
                Reflected { diffuse: scaled(reflected.diffuse, share), ..reflected }
            },
        )
    }

    /// A colour lit at its vertices.
    #[inline(always)]
    pub(super) fn interpolated<S: Simd>(&self, fragments: &FragmentLanes<'_, S>, [r, g, b]: V3<S>) -> V3<S> {
        let Some(slots) = self.layout.light else { return [r, g, b] };
        let value = inlined(
            #[inline(always)]
            |index: usize| {
                let front = fragments.varying(slots.at + index);
                if !slots.two_sided {
                    return front;
                }
                let back = fragments.varying(slots.at + slots.per_side() + index);
                self.shows_front(fragments).select(front, back)
            },
        );
        let shaded = if slots.channels == 1 {
            let light = value(0);
            [r * light, g * light, b * light]
        } else {
            [r * value(0), g * value(1), b * value(2)]
        };
        match (slots.specular, slots.channels) {
            (false, _) => shaded,
            (true, 1) => sum(shaded, [value(1); 3]),
            (true, _) => sum(shaded, [value(3), value(4), value(5)]),
        }
    }

    /// A colour lit in each pixel; a separate function.
    pub(super) fn lit<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>, albedo: V3<S>) -> V3<S> {
        simd.vectorize(
            #[inline(always)]
            || {
                let points = self.points(simd, fragments);
                let (pixel, active) = (fragments.position(), fragments.active());
                let open = self.lighting.open(simd, &points, pixel, active);
                self.shaded(simd, fragments, &points, open, albedo)
            },
        )
    }

    /// Normals, and the fraction of the surroundings or of a lamp that is visible by a part of the rays: no colour. Where
    /// nothing is to be found out there is no normal either.
    pub(super) fn openness<S: Simd>(
        &self,
        simd: S,
        fragments: &FragmentLanes<'_, S>,
        of: OpennessOf,
    ) -> [F32<S>; 4] {
        /// The pixels of a square cast all rays together.
        const PART: RayPart = RayPart::OfSquare(4);
        simd.vectorize(
            #[inline(always)]
            || {
                let points = self.points(simd, fragments);
                let (pixels, active) = (fragments.position(), fragments.active());
                let starts = RayStarts { points: &points, pixels, part: PART, active };
                let found = match of {
                    OpennessOf::Surroundings => self.lighting.open_by_rays(simd, &starts),
                    OpennessOf::Lamp(number) => self.lighting.lamp_by_rays(simd, number, &points, PART),
                };
                let zero = F32::splat(simd, 0.0);
                let Some(open) = found else { return [zero; 4] };
                let [x, y, z] = select(open.simd_ge(zero), points.facing, [zero; 3]);
                [x, y, z, open]
            },
        )
    }

    /// A colour lit at known points.
    #[inline(always)]
    pub(super) fn shaded<S: Simd>(
        &self,
        simd: S,
        fragments: &FragmentLanes<'_, S>,
        points: &LitPoints<S>,
        mut open: Option<F32<S>>,
        albedo: V3<S>,
    ) -> V3<S> {
        let (brdf, share) = self.params.brdf(simd, albedo, Some(fragments));
        let strength = self.params.material.occlusion.map_or(0.0, |map| map.strength);
        if let Some(map) = self.params.maps.get(MaterialTexture::Occlusion) {
            let red = map.look_up_apart(simd, fragments)[0];
            let mapped = (red - 1.0) * strength + 1.0;
            open = match open {
                Some(open) => Some(open * mapped),
                None => Some(mapped),
            };
        }
        match (&self.params.optics, &brdf) {
            (Some(optics), Brdf::Microfacets(facets)) => {
                let map = self.params.maps.get(MaterialTexture::Transmission);
                let transmission = map.map(|map| map.look_up_apart(simd, fragments)[0]);
                let map = self.params.maps.get(MaterialTexture::Thickness);
                let thickness = map.map(|map| map.look_up_apart(simd, fragments)[1]);
                let surface = TracedSurface {
                    facets,
                    optics,
                    open,
                    albedo,
                    diffuse_share: share,
                    transmission,
                    thickness,
                    pixel: fragments.position(),
                };
                self.traced(simd, points, &surface, fragments.active())
            }
            (None, _) | (Some(_), Brdf::Lambert | Brdf::BlinnPhong { .. }) => {
                shown(&self.reflected(simd, points, &brdf, open, None), scaled(albedo, share))
            }
        }
    }

    /// All light from the surface to the eye. `open` is the fraction of the ambient light that arrives,
    /// `traced` the light that rays found in the mirror direction.
    #[inline(always)]
    pub(super) fn reflected<S: Simd>(
        &self,
        simd: S,
        points: &LitPoints<S>,
        brdf: &Brdf<S>,
        open: Option<F32<S>>,
        traced: Option<V3<S>>,
    ) -> Reflected<S> {
        let mut reflected = self.lighting.reflected(simd, points, brdf);
        if !self.lighting.has_ambient() && traced.is_none() {
            return reflected;
        }
        let open = open.unwrap_or(F32::splat(simd, 1.0));
        let around = scaled(self.lighting.around(simd, points.normal), open);
        match brdf {
            Brdf::Microfacets(facets) => {
                note(Work::Highlight);
                let shares = facets.surrounded(dot(points.normal, points.view).abs());
                reflected.diffuse = sum(reflected.diffuse, product(around, shares.diffuse));
                let mut mirrored = match traced {
                    Some(traced) => traced,
                    None => scaled(self.lighting.mirrored(simd, points, facets.roughness), open),
                };
                let mut repeated = around;
                if let Some(studio) = self.lighting.studio_on_metal(simd, points, facets) {
                    repeated = mixed(repeated, [studio.around * open; 3], facets.metallic);
                    if traced.is_none() {
                        mirrored = mixed(mirrored, [studio.mirrored * open; 3], facets.metallic);
                    }
                }
                let specular = sum(product(mirrored, shares.single), product(repeated, shares.repeated));
                reflected.specular = sum(reflected.specular, specular);
            }
            Brdf::Lambert | Brdf::BlinnPhong { .. } => {
                reflected.diffuse = sum(reflected.diffuse, around);
            }
        }
        reflected
    }
}
