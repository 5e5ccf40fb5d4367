//! Eight points of a surface with their reflectance, and the light that they reflect.

use trigon_raster::simd::{F32, Simd, prelude::*};

use super::Microfacets;
use crate::lanes::{V3, product, sum};

/// Eight points of a surface, in camera space.
#[derive(Clone, Copy)]
pub(crate) struct LitPoints<S: Simd> {
    pub(crate) position: V3<S>,
    /// Of unit length, or zero, which no light reaches.
    pub(crate) normal: V3<S>,
    /// The same without the normal map: the orientation of the surface itself.
    pub(crate) facing: V3<S>,
    /// Perpendicular to the triangle, of any length and on either side: `facing` may be interpolated. Shadow maps alone
    /// need it; without them it is `facing`.
    pub(crate) plane: V3<S>,
    /// Unit vectors towards the eye.
    pub(crate) view: V3<S>,
}

/// The reflection model at eight points.
#[derive(Clone, Copy)]
pub(crate) enum Brdf<S: Simd> {
    /// Base colour × N·L.
    Lambert,
    /// See [`Shading::BlinnPhong`](crate::Shading::BlinnPhong).
    BlinnPhong { specular: V3<S>, shininess: F32<S> },
    /// See [`Shading::MetallicRoughness`](crate::Shading::MetallicRoughness).
    Microfacets(Microfacets<S>),
}

/// Light that leaves towards the eye.
#[derive(Clone, Copy)]
pub(crate) struct Reflected<S: Simd> {
    /// To be multiplied by the diffuse colour.
    pub(crate) diffuse: V3<S>,
    /// Highlights.
    pub(crate) specular: V3<S>,
}

impl<S: Simd> Reflected<S> {
    #[inline(always)]
    pub(crate) fn none(simd: S) -> Self {
        let zero = F32::splat(simd, 0.0);
        Self { diffuse: [zero; 3], specular: [zero; 3] }
    }

    /// Adds light, of which `diffuse` and `specular` are reflected to the eye.
    #[inline(always)]
    pub(crate) fn add(&mut self, light: V3<S>, diffuse: V3<S>, specular: V3<S>) {
        self.diffuse = sum(self.diffuse, product(light, diffuse));
        self.specular = sum(self.specular, product(light, specular));
    }
}
