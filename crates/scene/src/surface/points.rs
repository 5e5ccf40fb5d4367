//! Positions and normals of eight pixels of a surface.

use trigon_math::Vec3;
use trigon_raster::FragmentLanes;
use trigon_raster::simd::{F32, InlineMap, LANES, Mask, Simd, inlined, prelude::*};

use super::{Surface, TextureMap};
use crate::lanes::{V3, cross, negated, normalized, scaled, select, splat, sum, turned};
use crate::lighting::LitPoints;
use crate::material::MaterialTexture;
use crate::placement::{Rays, Side};

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
