//! A material's parameters, ready to be evaluated in lanes: factors, and textures with the varyings of their
//! coordinates.

use crate::work::{Work, note};
use trigon_math::{Vec3, Vec4};
use trigon_raster::simd::{F32, InlineMap, Simd, prelude::*};
use trigon_raster::{FragmentLanes, Sampler, Texture};

use crate::effects::Optics;
use crate::lanes::{V3, lesser_of, mix, product, splat};
use crate::lighting::{Brdf, Microfacets};
use crate::material::{Material, MaterialTexture};

/// A texture and its varyings.
#[derive(Clone, Copy)]
pub(crate) struct TextureMap<'a> {
    pub(crate) texture: &'a Texture,
    pub(crate) sampler: Sampler,
    /// The varying that holds u; v is the next.
    pub(crate) at: usize,
    /// Its slot in the material.
    pub(crate) slot: MaterialTexture,
}

/// A material prepared for a draw.
#[derive(Clone)]
pub(crate) struct MaterialParams<'a> {
    /// Its factors.
    pub(crate) material: Material,
    /// The textures that are used.
    pub(crate) maps: Maps<'a>,
    pub(crate) model: Model,
    /// Whether sight rays continue from it.
    pub(crate) optics: Option<Optics>,
    /// In masked draws, fragments with less alpha are discarded.
    pub(crate) cutoff: f32,
    pub(crate) coverage: Coverage,
}

/// The effect of a surface's alpha on its colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Coverage {
    /// Alpha is 1 whatever the material says.
    Opaque,
    /// Alpha is what the material says.
    Translucent,
}

/// The factors of a [`Shading`](crate::Shading).
#[derive(Clone)]
pub(crate) enum Model {
    Lambert,
    BlinnPhong { specular: Vec3, shininess: f32 },
    Microfacets(MicrofacetModel),
}

/// The factors of [`MetallicRoughness`](crate::MetallicRoughness).
#[derive(Clone)]
pub(crate) struct MicrofacetModel {
    pub(crate) metallic: f32,
    pub(crate) roughness: f32,
    /// The reflectance of a dielectric at normal incidence, before `specular` and without a limit.
    pub(crate) f0: Vec3,
    pub(crate) specular: f32,
}

/// The textures of a material, by slot.
#[derive(Clone, Default)]
pub(crate) struct Maps<'a>([Option<TextureMap<'a>>; MaterialTexture::ALL.len()]);

impl<'a> Maps<'a> {
    /// The textures for which a function returns one.
    pub(crate) fn new(find: impl FnMut(MaterialTexture) -> Option<TextureMap<'a>>) -> Self {
        Self(MaterialTexture::ALL.map(find))
    }

    #[inline(always)]
    pub(crate) fn get(&self, slot: MaterialTexture) -> Option<&TextureMap<'a>> {
        self.0[slot as usize].as_ref()
    }

    /// The slots that are in use.
    pub(crate) fn slots(&self) -> impl Iterator<Item = MaterialTexture> {
        MaterialTexture::ALL.into_iter().filter(|&slot| self.get(slot).is_some())
    }
}

impl TextureMap<'_> {
    /// RGBA at eight points.
    #[inline(always)]
    pub(crate) fn look_up<S: Simd>(&self, simd: S, values: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        note(Work::TextureLookUp(self.slot));
        let uv = [values.varying(self.at), values.varying(self.at + 1)];
        let [[ux, uy], [vx, vy]] = [values.gradient(self.at), values.gradient(self.at + 1)];
        self.texture.sample_lanes(simd, uv, [ux, vx], [uy, vy], &self.sampler)
    }

    /// The same as a separate function, for textures that few materials have.
    pub(crate) fn look_up_apart<S: Simd>(&self, simd: S, values: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        simd.vectorize(
            #[inline(always)]
            || self.look_up(simd, values),
        )
    }
}

impl MaterialParams<'_> {
    /// Linear RGB and straight alpha before lighting.
    #[inline(always)]
    pub(crate) fn albedo<S: Simd>(
        &self,
        simd: S,
        color: Option<usize>,
        values: &FragmentLanes<'_, S>,
    ) -> [F32<S>; 4] {
        let mut albedo = match self.maps.get(MaterialTexture::BaseColor) {
            Some(map) => {
                let [r, g, b, a] = map.look_up(simd, values);
                let factor = self.material.base_color;
                if factor == Vec4::ONE {
                    [r, g, b, a]
                } else {
                    [r * factor.x, g * factor.y, b * factor.z, a * factor.w]
                }
            }
            None => {
                let [r, g, b] = splat(simd, self.material.base_color.truncate());
                [r, g, b, F32::splat(simd, self.material.base_color.w)]
            }
        };
        if let Some(at) = color {
            note(Work::VertexColors);
            for (channel, albedo) in albedo.iter_mut().enumerate() {
                *albedo *= values.varying(at + channel);
            }
        }
        albedo
    }

    /// The reflection model, and the fraction of the base colour that is diffuse. Without values only the
    /// factors are used.
    #[inline(always)]
    pub(crate) fn brdf<S: Simd>(
        &self,
        simd: S,
        albedo: V3<S>,
        values: Option<&FragmentLanes<'_, S>>,
    ) -> (Brdf<S>, F32<S>) {
        let one = F32::splat(simd, 1.0);
        match &self.model {
            Model::Lambert => (Brdf::Lambert, one),
            Model::BlinnPhong { specular, shininess } => {
                let mut specular = splat(simd, *specular);
                if let (Some(map), Some(values)) = (self.maps.get(MaterialTexture::Highlight), values) {
                    let [r, g, b, _] = map.look_up_apart(simd, values);
                    specular = product(specular, [r, g, b]);
                }
                (Brdf::BlinnPhong { specular, shininess: F32::splat(simd, *shininess) }, one)
            }
            Model::Microfacets(model) => model.brdf(simd, albedo, &self.maps, values),
        }
    }
}

impl MicrofacetModel {
    #[inline(always)]
    fn brdf<S: Simd>(
        &self,
        simd: S,
        [r, g, b]: V3<S>,
        maps: &Maps<'_>,
        values: Option<&FragmentLanes<'_, S>>,
    ) -> (Brdf<S>, F32<S>) {
        let [mut roughness, mut metallic, mut specular] = [self.roughness, self.metallic, self.specular]
            .each(
                #[inline(always)]
                |factor| F32::splat(simd, factor),
            );
        let mut dielectric = splat(simd, self.f0);
        if let Some(values) = values {
            if let Some(map) = maps.get(MaterialTexture::MetallicRoughness) {
                let [_, green, blue, _] = map.look_up_apart(simd, values);
                roughness *= green;
                metallic *= blue;
            }
            if let Some(map) = maps.get(MaterialTexture::Specular) {
                specular *= map.look_up_apart(simd, values)[3];
            }
            if let Some(map) = maps.get(MaterialTexture::SpecularColor) {
                let [red, green, blue, _] = map.look_up_apart(simd, values);
                dielectric = product(dielectric, [red, green, blue]);
            }
        }
        let [x, y, z] = dielectric;
        let f0 = [
            mix(lesser_of(x, 1.0) * specular, r, metallic),
            mix(lesser_of(y, 1.0) * specular, g, metallic),
            mix(lesser_of(z, 1.0) * specular, b, metallic),
        ];
        let grazing = mix(specular, F32::splat(simd, 1.0), metallic);
        (Brdf::Microfacets(Microfacets { f0, grazing, roughness, metallic }), 1.0 - metallic)
    }
}
