//! Sums the light of all lamps at eight points of a surface.

use trigon_raster::simd::{F32, InlineMap, Simd, prelude::*};

use super::LightingEnvironment;
use crate::lanes::{V3, dot, lesser_of, normalized, positive, pow, scaled, sum, tinted};
use crate::lighting::{BRIGHTEST, Brdf, LitPoints, Reflected};
use crate::work::{Work, note};

impl LightingEnvironment {
    /// Sums the light of all lamps that a surface reflects to the eye.
    #[inline(always)]
    pub(crate) fn reflected<S: Simd>(&self, simd: S, points: &LitPoints<S>, brdf: &Brdf<S>) -> Reflected<S> {
        let mut reflected = Reflected::none(simd);
        self.each_lamp(
            simd,
            points,
            #[inline(always)]
            |light| brdf.add(&mut reflected, points, &light),
        );
        reflected
    }

    /// Calls a function with the light of each lamp that reaches any of the points.
    #[inline(always)]
    pub(crate) fn each_lamp<S: Simd>(
        &self,
        simd: S,
        points: &LitPoints<S>,
        mut shine: impl FnMut(IncidentLight<S>),
    ) {
        for (number, lamp) in self.lights.lamps.iter().enumerate() {
            note(Work::LampLight);
            let arriving = lamp.arriving(simd, points.position);
            let n_dot_l = positive(dot(points.normal, arriving.towards));
            let mut share = arriving.share * n_dot_l;
            if !share.simd_gt(0.0).any_true() {
                continue;
            }
            if let Some(visible) = self.share(simd, number, lamp, points, &arriving) {
                share *= visible;
            }
            let radiance = tinted(share, lamp.radiance).each(
                #[inline(always)]
                |channel| lesser_of(channel, BRIGHTEST),
            );
            shine(IncidentLight { radiance, towards: arriving.towards, n_dot_l });
        }
    }
}

/// A lamp's light at a surface.
#[derive(Clone, Copy)]
pub(crate) struct IncidentLight<S: Simd> {
    /// The arriving light times N·L.
    pub(crate) radiance: V3<S>,
    /// Unit vectors to the lamp.
    pub(crate) towards: V3<S>,
    /// At least 0.
    pub(crate) n_dot_l: F32<S>,
}

impl<S: Simd> Brdf<S> {
    /// Adds what the surface reflects of a lamp's light.
    #[inline(always)]
    fn add(&self, reflected: &mut Reflected<S>, points: &LitPoints<S>, light: &IncidentLight<S>) {
        let IncidentLight { radiance: light, towards, n_dot_l } = *light;
        match self {
            Self::Lambert => reflected.diffuse = sum(reflected.diffuse, light),
            Self::BlinnPhong { specular, shininess } => {
                note(Work::Highlight);
                let half = normalized(sum(towards, points.view));
                let highlight = pow(positive(dot(points.normal, half)), *shininess);
                let one = [F32::splat(n_dot_l.token(), 1.0); 3];
                reflected.add(light, one, scaled(*specular, highlight));
            }
            Self::Microfacets(facets) => {
                /// At grazing views, V would divide by zero.
                const LEAST_COSINE: f32 = 1e-4;
                note(Work::Highlight);
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
