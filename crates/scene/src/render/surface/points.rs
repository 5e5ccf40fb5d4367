//! Where eight pixels of a surface lie, and how it is turned there.

use trigon_math::Vec3;
use trigon_raster::FragmentLanes;
use trigon_raster::simd::{F32, Mask, Simd, prelude::*};

use super::{Map, Surface, three};
use crate::render::lanes::{V3, cross, negated, normalized, scaled, select, splat, sum};
use crate::render::lighting::LitPoints;
use crate::render::placement::{Rays, Side};

impl<const FLAT: bool> Surface<'_, FLAT> {
    /// Where the pixels lie and how the surface is turned there.
    #[inline(always)]
    pub(super) fn points<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> LitPoints<S> {
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
            Rays::Parallel => splat(simd, Vec3::Z),
        }
    }

    /// Which pixels see the side from which the face winds counter-clockwise.
    #[inline(always)]
    pub(super) fn shows_front<S: Simd>(&self, fragments: &FragmentLanes<'_, S>) -> Mask<S> {
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
