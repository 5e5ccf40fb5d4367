//! Positions and normals of eight pixels of a surface; flat faces, one colour per triangle, lit once; and surfaces that show
//! one of their values as a colour, instead of light.

use trigon_math::Vec3;
use trigon_raster::FragmentLanes;
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, InlineMap, LANES, Mask, Simd, inlined};

use super::{Coverage, Illumination, Model, Surface, TextureMap, shown};
use crate::display::Display;
use crate::lanes::{
    V3, cross, difference, dot, negated, normalized, pow, saturated, scaled, select, splat, sum, turned,
};
use crate::lighting::{ImageLanes, LitPoints};
use crate::material::MaterialTexture;
use crate::placement::{Rays, Side};
use crate::work::{Work, note};

impl<const FLAT: bool> Surface<'_, FLAT> {
    /// The positions and normals of the pixels.
    #[inline(always)]
    pub(super) fn points<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> LitPoints<S> {
        let zero = [F32::splat(simd, 0.0); 3];
        // `Option::map_or` is not always inlined, and would lose the level's instructions.
        let or_zero = inlined(
            #[inline(always)]
            |at: Option<usize>| match at {
                Some(at) => three(fragments, at),
                None => zero,
            },
        );
        let position = or_zero(self.layout.position);
        let normal = match &self.columns.face_normals {
            Some(normals) => self.normals_of_faces(simd, fragments.primitives(), normals),
            None => or_zero(self.layout.normal),
        };
        let facing = normalized(normal);
        let normal = match (self.params.maps.get(MaterialTexture::Normal), self.layout.tangent) {
            (Some(map), Some(at)) => {
                let scale = self.params.material.normal_map.map_or(1.0, |map| map.scale);
                let basis = NormalBasis { normal, tangent_at: at };
                apply_normal_map(simd, fragments, basis, map, scale)
            }
            _ => facing,
        };
        let front = self.shows_front(fragments);
        LitPoints {
            position,
            normal: select(front, normal, negated(normal)),
            facing: select(front, facing, negated(facing)),
            plane: self.plane(simd, fragments).unwrap_or(facing),
            view: self.view(simd, position),
            lanes: ImageLanes { pixels: fragments.position(), active: fragments.active(), is_direct: true },
        }
    }

    /// The normals of the polygons of eight triangles: what interpolation makes of the same normal at three
    /// vertices.
    fn normals_of_faces<S: Simd>(&self, simd: S, primitives: [u32; LANES], normals: &[Vec<f32>; 3]) -> V3<S> {
        simd.vectorize(
            #[inline(always)]
            || {
                let faces = primitives.each(
                    #[inline(always)]
                    |primitive| match self.faces {
                        Some(faces) => faces[primitive as usize] as usize,
                        None => primitive as usize,
                    },
                );
                let normal = normals.each_ref().each(
                    #[inline(always)]
                    |column| {
                        let values = faces.each(
                            #[inline(always)]
                            |face| column[face],
                        );
                        F32::simd_from(simd, values)
                    },
                );
                normalized(turned(&self.placement.normal_to_camera, normal))
            },
        )
    }

    /// Perpendicular to the triangles, where shadow maps are looked up on surfaces whose normals are interpolated.
    #[inline(always)]
    fn plane<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> Option<V3<S>> {
        let is_needed = self.layout.normal.is_some() && self.lighting.shadow_maps.is_some();
        let at = self.layout.position.filter(|_| is_needed)?;
        Some(simd.vectorize(
            #[inline(always)]
            || {
                let [x, y, z] = [at, at + 1, at + 2].each(
                    #[inline(always)]
                    |varying| fragments.gradient(varying),
                );
                // Unit vectors, so that the product of the steps of a tiny model does not vanish.
                cross(normalized([x[0], y[0], z[0]]), normalized([x[1], y[1], z[1]]))
            },
        ))
    }

    /// Unit vectors towards the eye.
    #[inline(always)]
    pub(super) fn view<S: Simd>(&self, simd: S, position: V3<S>) -> V3<S> {
        match self.rays {
            Rays::Meeting => normalized(negated(position)),
            Rays::Parallel => splat(simd, Vec3::Z),
        }
    }

    /// The pixels that see the side from which the face winds counter-clockwise.
    #[inline(always)]
    pub(super) fn shows_front<S: Simd>(&self, fragments: &FragmentLanes<'_, S>) -> Mask<S> {
        match self.placement.front {
            Side::Front => fragments.front_facing(),
            Side::Back => !fragments.front_facing(),
        }
    }
}

/// The interpolated normal, and the varying that holds the tangent.
#[derive(Clone, Copy)]
struct NormalBasis<S: Simd> {
    normal: V3<S>,
    tangent_at: usize,
}

/// Normals from a normal map, in the basis of tangent, bitangent and normal. As MikkTSpace defines it, none
/// of the three is normalized first.
fn apply_normal_map<S: Simd>(
    simd: S,
    fragments: &FragmentLanes<'_, S>,
    basis: NormalBasis<S>,
    map: &TextureMap<'_>,
    scale: f32,
) -> V3<S> {
    let NormalBasis { normal, tangent_at: at } = basis;
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

/// Three varyings in a row.
#[inline(always)]
pub(super) fn three<S: Simd>(fragments: &FragmentLanes<'_, S>, at: usize) -> V3<S> {
    [fragments.varying(at), fragments.varying(at + 1), fragments.varying(at + 2)]
}

impl<const FLAT: bool> Surface<'_, FLAT> {
    /// One colour for each triangle.
    #[inline(always)]
    pub(super) fn facet_color<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let base = splat(simd, self.params.material.base_color.truncate());
        let lit = match self.illumination {
            Illumination::OnFacets => self.lit_facets(simd, fragments, base),
            Illumination::None
            | Illumination::AtVertices
            | Illumination::InPixels
            | Illumination::Value(_)
            | Illumination::Openness(_) => base,
        };
        let emissive = self.params.material.emissive;
        if emissive != Vec3::ZERO {
            note(Work::Emission);
        }
        let [r, g, b] = sum(lit, splat(simd, emissive));
        match self.params.coverage {
            Coverage::Opaque => [r, g, b, F32::splat(simd, 1.0)],
            Coverage::Translucent => {
                note(Work::Blend);
                let alpha = F32::splat(simd, self.params.material.base_color.w.clamp(0.0, 1.0));
                [r * alpha, g * alpha, b * alpha, alpha]
            }
        }
    }

    /// A colour lit at the centre of its triangle.
    pub(super) fn lit_facets<S: Simd>(
        &self,
        simd: S,
        fragments: &FragmentLanes<'_, S>,
        albedo: V3<S>,
    ) -> V3<S> {
        simd.vectorize(
            #[inline(always)]
            || {
                let points = self.facets(simd, fragments.primitives());
                shown(&self.lit_plainly(simd, &points), albedo)
            },
        )
    }

    /// The centres of triangles, and the sides from which they are seen.
    #[inline(always)]
    pub(super) fn facets<S: Simd>(&self, simd: S, primitives: [u32; LANES]) -> LitPoints<S> {
        let [a, b, c] = [0, 1, 2].each(
            #[inline(always)]
            |corner| self.placement.camera(simd, self.corners(simd, primitives, corner)),
        );
        let position = scaled(sum(sum(a, b), c), F32::splat(simd, 1.0 / 3.0));
        let normal = normalized(cross(difference(b, a), difference(c, a)));
        let view = self.view(simd, position);
        // The visible side is the one that faces the eye, whatever the winding.
        let faces_eye = dot(normal, view).simd_ge(0.0);
        let normal = select(faces_eye, normal, negated(normal));
        LitPoints::elsewhere(simd, position, normal, view)
    }

    /// The positions of one corner of eight triangles, in the mesh's space.
    #[inline(always)]
    fn corners<S: Simd>(&self, simd: S, primitives: [u32; LANES], corner: usize) -> V3<S> {
        let vertices = primitives.each(
            #[inline(always)]
            |primitive| self.triangles[primitive as usize][corner] as usize,
        );
        self.columns.positions.each_ref().each(
            #[inline(always)]
            |column| {
                let values = vertices.each(
                    #[inline(always)]
                    |vertex| column[vertex],
                );
                F32::simd_from(simd, values)
            },
        )
    }
}

impl<const FLAT: bool> Surface<'_, FLAT> {
    /// The colour of eight pixels that show a value, in linear light.
    pub(super) fn value<S: Simd>(
        &self,
        simd: S,
        fragments: &FragmentLanes<'_, S>,
        display: Display,
        [r, g, b, alpha]: [F32<S>; 4],
    ) -> V3<S> {
        simd.vectorize(
            #[inline(always)]
            || {
                let zero = F32::splat(simd, 0.0);
                let stored = match display {
                    Display::Emission => return self.with_emission(simd, fragments, [zero; 3]),
                    Display::Normal => self.as_stored(self.points(simd, fragments).normal),
                    Display::GeometricNormal => {
                        self.as_stored(self.facets(simd, fragments.primitives()).normal)
                    }
                    Display::TextureCoordinates => match self.layout.shown_uv {
                        Some(at) => {
                            let fraction = |value: F32<S>| value - value.floor();
                            [fraction(fragments.varying(at)), fraction(fragments.varying(at + 1)), zero]
                        }
                        None => [zero; 3],
                    },
                    Display::Metallic => [self.metallic_and_roughness(simd, fragments)[0]; 3],
                    Display::Roughness => [self.metallic_and_roughness(simd, fragments)[1]; 3],
                    Display::Occlusion => [self.open(simd, fragments); 3],
                    Display::Alpha => [alpha; 3],
                    Display::Shaded | Display::Matcap | Display::BaseColor | Display::Depth => {
                        return [r, g, b];
                    }
                };
                stored.each(
                    #[inline(always)]
                    |channel| decoded(channel),
                )
            },
        )
    }

    /// From −1…1 in camera space to 0…1 along the world's axes.
    #[inline(always)]
    fn as_stored<S: Simd>(&self, normal: V3<S>) -> V3<S> {
        let [x, y, z] = turned(&self.to_world, normal);
        [x * 0.5 + 0.5, y * 0.5 + 0.5, z * 0.5 + 0.5]
    }

    #[inline(always)]
    fn metallic_and_roughness<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 2] {
        let (zero, one) = (F32::splat(simd, 0.0), F32::splat(simd, 1.0));
        let Model::Microfacets(model) = &self.params.model else { return [zero, one] };
        let [metallic, roughness] = [model.metallic, model.roughness].each(
            #[inline(always)]
            |value| F32::splat(simd, value),
        );
        match self.params.maps.get(MaterialTexture::MetallicRoughness) {
            Some(map) => {
                let [_, green, blue, _] = map.look_up_apart(simd, fragments);
                [metallic * blue, roughness * green]
            }
            None => [metallic, roughness],
        }
    }

    /// The fraction of ambient light that arrives.
    #[inline(always)]
    fn open<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> F32<S> {
        let strength = self.params.material.occlusion.map_or(0.0, |map| map.strength);
        match self.params.maps.get(MaterialTexture::Occlusion) {
            Some(map) => (map.look_up_apart(simd, fragments)[0] - 1.0) * strength + 1.0,
            None => F32::splat(simd, 1.0),
        }
    }
}

/// Converts a fraction of the display's range to linear light (IEC 61966-2-1).
#[inline(always)]
fn decoded<S: Simd>(stored: F32<S>) -> F32<S> {
    let stored = saturated(stored);
    let curved = pow((stored + 0.055) * (1.0 / 1.055), F32::splat(stored.token(), 2.4));
    stored.simd_le(F32::splat(stored.token(), 0.04045)).select(stored * (1.0 / 12.92), curved)
}
