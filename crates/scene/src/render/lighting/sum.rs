//! The sum over lamps: what reaches the eye from eight points of a surface.

use trigon_math::Vec3;
use trigon_raster::simd::{Each, F32, Simd, prelude::*};

use super::lamp::BRIGHTEST;
use super::points::{Answer, LitPoints, Reflected};
use crate::effects::Scenery;
use crate::render::lanes::{V3, dot, lesser_of, normalized, positive, pow, scaled, sum, tinted};

impl Scenery {
    /// The light of all lamps that a surface sends to the eye.
    #[inline(always)]
    pub(crate) fn reflected<S: Simd>(
        &self,
        simd: S,
        points: &LitPoints<S>,
        answer: &Answer<S>,
    ) -> Reflected<S> {
        let mut reflected = Reflected::none(simd);
        for (number, lamp) in self.lights.lamps.iter().enumerate() {
            let arriving = lamp.arriving(simd, points.position);
            let cosine = positive(dot(points.normal, arriving.towards));
            let mut share = arriving.share * cosine;
            if !share.simd_gt(0.0).any_true() {
                continue;
            }
            if let Some(visible) = self.share(simd, (number, lamp), points, &arriving) {
                share *= visible;
            }
            answer.add(&mut reflected, points, (lamp.radiance, share), (arriving.towards, cosine));
        }
        reflected
    }
}

impl<S: Simd> Answer<S> {
    /// Adds a lamp's light: its radiance, and the share that arrives times N·L.
    #[inline(always)]
    fn add(
        &self,
        reflected: &mut Reflected<S>,
        points: &LitPoints<S>,
        (radiance, share): (Vec3, F32<S>),
        (towards, n_dot_l): (V3<S>, F32<S>),
    ) {
        let light = tinted(share, radiance).each(
            #[inline(always)]
            |channel| lesser_of(channel, BRIGHTEST),
        );
        match self {
            Self::Lambert => reflected.diffuse = sum(reflected.diffuse, light),
            Self::BlinnPhong { specular, shininess } => {
                let half = normalized(sum(towards, points.view));
                let highlight = pow(positive(dot(points.normal, half)), *shininess);
                let one = [F32::splat(share.token(), 1.0); 3];
                reflected.add(light, one, scaled(*specular, highlight));
            }
            Self::Microfacets(facets) => {
                /// Where the surface is seen edge-on, V would divide by zero.
                const LEAST_COSINE: f32 = 1e-4;
                let half = normalized(sum(towards, points.view));
                let n_dot_v = dot(points.normal, points.view).abs() + LEAST_COSINE;
                let n_dot_h = positive(dot(points.normal, half));
                let fresnel = facets.fresnel(dot(points.view, half));
                let highlight = facets.highlight([n_dot_l + LEAST_COSINE, n_dot_v, n_dot_h]);
                let [r, g, b] = fresnel;
                reflected.add(light, [1.0 - r, 1.0 - g, 1.0 - b], scaled(fresnel, highlight));
            }
        }
    }
}
