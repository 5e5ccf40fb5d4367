//! Surfaces that show one of their values as a colour, instead of light.

use trigon_raster::FragmentLanes;
use trigon_raster::simd::{F32, InlineMap, Simd, prelude::*};

use super::{Model, Surface};
use crate::display::Display;
use crate::lanes::{V3, pow, saturated, turned};
use crate::material::MaterialTexture;

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
