//! Light on a surface: at its vertices or in each pixel.

use trigon_raster::simd::{F32, Simd, inlined, prelude::*};
use trigon_raster::{FragmentLanes, VertexLanes};

use super::{LightSlots, Map, Rays, Side, Surface, Values, load, shown, three};
use crate::effects::Optics;
use crate::render::lanes::{
    V3, cross, difference, dot, moved, negated, normalized, product, scaled, select, splat, sum, turned,
};
use crate::render::lighting::{Answer, LitPoints, Microfacets, Reflected};

/// Where light is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Illumination {
    /// It does not matter.
    None,
    /// At the vertices, and interpolated (H. Gouraud, "Continuous Shading of Curved
    /// Surfaces", 1971).
    AtVertices,
    /// At each pixel, for an interpolated normal (B. T. Phong, "Illumination for
    /// Computer Generated Pictures", 1975).
    InPixels,
    /// Once for each triangle, in its middle.
    OnFacets,
}

impl<const FLAT: bool> Surface<'_, FLAT> {
    /// Light at eight vertices. Textures but that of the base colour are left out.
    #[inline(always)]
    pub(super) fn set_light<S: Simd>(
        &self,
        simd: S,
        vertices: &mut VertexLanes<'_>,
        slots: LightSlots,
        position: V3<S>,
    ) {
        let normal = load(simd, vertices, &self.columns.normals);
        let normal = normalized(turned(&self.place.normal_to_camera, normal));
        let position = moved(&self.place.to_camera, position);
        let points = LitPoints { position, normal, facing: normal, view: self.view(simd, position) };
        self.set_side(simd, vertices, (slots, slots.at), &points);
        if slots.two_sided {
            let back = LitPoints { normal: negated(normal), facing: negated(normal), ..points };
            self.set_side(simd, vertices, (slots, slots.at + slots.per_side()), &back);
        }
    }

    #[inline(always)]
    fn set_side<S: Simd>(
        &self,
        simd: S,
        vertices: &mut VertexLanes<'_>,
        (slots, at): (LightSlots, usize),
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

    /// Light by the material's factors alone. The diffuse part is to be multiplied
    /// by the base colour.
    pub(super) fn lit_plainly<S: Simd>(&self, simd: S, points: &LitPoints<S>) -> Reflected<S> {
        simd.vectorize(
            #[inline(always)]
            || {
                let base = splat(simd, self.look.base_color.truncate());
                let (answer, share) = self.look.answer(simd, base, None::<&FragmentLanes<'_, S>>);
                let reflected = self.reflected(simd, points, &answer, (None, None));
                Reflected { diffuse: scaled(reflected.diffuse, share), ..reflected }
            },
        )
    }

    /// A colour in the light that its vertices got.
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

    /// A colour in the light that each pixel gets; in a function of its own.
    pub(super) fn lit<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>, albedo: V3<S>) -> V3<S> {
        simd.vectorize(
            #[inline(always)]
            || {
                let points = self.points(simd, fragments);
                let open = match (&self.scenery.ambient_rays, &self.scenery.rays) {
                    (Some(ambient), Some(scene)) => {
                        let (place, active) = (fragments.position(), fragments.active());
                        Some(ambient.open(simd, scene, &points, place, active))
                    }
                    _ => None,
                };
                self.shaded(simd, fragments, (&points, open), (albedo, fragments.active()))
            },
        )
    }

    /// A colour at points that are known.
    #[inline(always)]
    pub(super) fn shaded<S: Simd>(
        &self,
        simd: S,
        values: &impl Values<S>,
        (points, mut open): (&LitPoints<S>, Option<F32<S>>),
        (albedo, active): (V3<S>, u64),
    ) -> V3<S> {
        let (answer, share) = self.look.answer(simd, albedo, Some(values));
        if let Some((map, strength)) = &self.look.occlusion_map {
            let red = map.look_up_apart(simd, values)[0];
            let mapped = (red - 1.0) * *strength + 1.0;
            open = Some(open.map_or(mapped, |open| open * mapped));
        }
        match (&self.look.optics, &answer) {
            (Some(optics), Answer::Microfacets(facets)) => {
                self.traced(simd, points, (facets, optics, open), (albedo, share), active)
            }
            _ => shown(&self.reflected(simd, points, &answer, (open, None)), scaled(albedo, share)),
        }
    }

    /// What mirrors and glass show.
    fn traced<S: Simd>(
        &self,
        simd: S,
        points: &LitPoints<S>,
        (facets, optics, open): (&Microfacets<S>, &Optics, Option<F32<S>>),
        (albedo, share): (V3<S>, F32<S>),
        active: u64,
    ) -> V3<S> {
        simd.vectorize(
            #[inline(always)]
            || {
                let LitPoints { normal, view, facing, .. } = *points;
                let cosine = dot(normal, view);
                let back = difference(scaled(normal, cosine * 2.0), view);
                let mirrored = self.scenery.seen(simd, points, back, active);
                let answer = Answer::Microfacets(*facets);
                let reflected = self.reflected(simd, points, &answer, (open, Some(mirrored)));
                let Optics::Glass { transmission, ior } = *optics else {
                    return shown(&reflected, scaled(albedo, share));
                };
                let matt = shown(&reflected, scaled(albedo, share * (1.0 - transmission)));
                // Snell's law, into what is denser: no light is reflected as a whole.
                let ratio = 1.0 / ior;
                let bent = (1.0 - (1.0 - cosine * cosine) * (ratio * ratio)).sqrt();
                let into =
                    difference(scaled(normal, cosine * ratio - bent), scaled(view, F32::splat(simd, ratio)));
                let inside = LitPoints { facing: negated(facing), ..*points };
                let through = self.scenery.seen(simd, &inside, into, active);
                let [r, g, b] = facets.fresnel(cosine);
                let left = [1.0 - r, 1.0 - g, 1.0 - b];
                let passed = product(product(through, left), scaled(albedo, share * transmission));
                sum(matt, passed)
            },
        )
    }

    /// All light that the surface sends to the eye. `open` is the share of the
    /// ambient light that arrives.
    #[inline(always)]
    fn reflected<S: Simd>(
        &self,
        simd: S,
        points: &LitPoints<S>,
        answer: &Answer<S>,
        (open, mirrored): (Option<F32<S>>, Option<V3<S>>),
    ) -> Reflected<S> {
        let mut reflected = self.scenery.reflected(simd, points, answer);
        if !self.scenery.has_ambient() && mirrored.is_none() {
            return reflected;
        }
        let open = open.unwrap_or(F32::splat(simd, 1.0));
        let around = scaled(self.scenery.around(simd, points.normal), open);
        match answer {
            Answer::Microfacets(facets) => {
                let shares = facets.surrounded(dot(points.normal, points.view).abs());
                reflected.diffuse = sum(reflected.diffuse, product(around, shares.diffuse));
                let mirrored = match mirrored {
                    Some(traced) => traced,
                    None => scaled(self.scenery.mirrored(simd, points, facets.roughness), open),
                };
                let specular = sum(product(mirrored, shares.single), product(around, shares.repeated));
                reflected.specular = sum(reflected.specular, specular);
            }
            Answer::Lambert | Answer::BlinnPhong { .. } => {
                reflected.diffuse = sum(reflected.diffuse, around);
            }
        }
        reflected
    }

    /// Where the pixels lie and how the surface is turned there.
    #[inline(always)]
    fn points<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> LitPoints<S> {
        let zero = [F32::splat(simd, 0.0); 3];
        let position = self.layout.position.map_or(
            zero,
            #[inline(always)]
            |at| three(fragments, at),
        );
        let normal = self.layout.normal.map_or(
            zero,
            #[inline(always)]
            |at| three(fragments, at),
        );
        let facing = normalized(normal);
        let normal = match (&self.look.normal_map, self.layout.tangent) {
            (Some((map, scale)), Some(at)) => bent(simd, fragments, (map, *scale), (normal, at)),
            _ => facing,
        };
        let front = self.shows_front(fragments);
        LitPoints {
            position,
            normal: select(front, normal, negated(normal)),
            facing: select(front, facing, negated(facing)),
            view: self.view(simd, position),
        }
    }

    /// Unit vectors towards the eye.
    #[inline(always)]
    pub(super) fn view<S: Simd>(&self, simd: S, position: V3<S>) -> V3<S> {
        match self.rays {
            Rays::Meeting => normalized(negated(position)),
            Rays::Parallel => splat(simd, trigon_math::Vec3::Z),
        }
    }

    /// Which pixels see the side from which the face winds counter-clockwise.
    #[inline(always)]
    pub(super) fn shows_front<S: Simd>(
        &self,
        fragments: &FragmentLanes<'_, S>,
    ) -> trigon_raster::simd::Mask<S> {
        match self.place.front {
            Side::Front => fragments.front_facing(),
            Side::Back => !fragments.front_facing(),
        }
    }
}

/// Normals bent by a map, in the frame of tangent, bitangent and normal: as
/// MikkTSpace has it, none of them is made a unit vector first.
fn bent<S: Simd>(
    simd: S,
    fragments: &FragmentLanes<'_, S>,
    (map, scale): (&Map<'_>, f32),
    (normal, at): (V3<S>, usize),
) -> V3<S> {
    simd.vectorize(
        #[inline(always)]
        || {
            let [x, y, z, _] = map.look_up(simd, fragments);
            let tangent = three(fragments, at);
            let bitangent = scaled(cross(normal, tangent), fragments.varying(at + 3));
            let across =
                sum(scaled(tangent, (x * 2.0 - 1.0) * scale), scaled(bitangent, (y * 2.0 - 1.0) * scale));
            normalized(sum(across, scaled(normal, z * 2.0 - 1.0)))
        },
    )
}
